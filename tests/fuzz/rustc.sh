#!/bin/sh
# Stands before rustc for Ferry's own crates alone, so that what they depend on is not built again: counts the edges
# that are taken, for libFuzzer, and checks arithmetic. Build scripts stay as they are.
rustc=$1
shift
case " $* " in
*" --crate-name ferry "* | *" --crate-name ferry_"* | *" --crate-name fuzz "*)
    set -- "$@" -Cpasses=sancov-module -Cllvm-args=-sanitizer-coverage-level=4 \
        -Cllvm-args=-sanitizer-coverage-inline-8bit-counters -Cllvm-args=-sanitizer-coverage-pc-table \
        -Cllvm-args=-sanitizer-coverage-trace-compares -Cllvm-args=-simplifycfg-branch-fold-threshold=0 \
        -Coverflow-checks=on -Clink-arg=-Wl,-z,nostart-stop-gc
    ;;
esac
exec "$rustc" "$@"
