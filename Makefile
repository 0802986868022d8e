# `make run` serves the laboratory, `make dev` shows an edited page at once, `make test` runs what decides whether a change
# may land, `make test-long` what takes long by nature, `make soak` keeps a page open for half an hour,
# `make fuzz` feeds damaged input to all loaders, `make audit` checks the crates for known weaknesses and licenses,
# `make dist` writes an archive with the program, `make wheel` a package for Python, `make results` runs the evaluations of docs/evaluation.md,
# `make ablations` trains the policies of docs/ablations.md, `make mazes` evaluates controllers on unseen mazes (docs/mazes.md).
# Each target first installs what is missing.

SHELL := /bin/bash
.SHELLFLAGS := -eu -o pipefail -c
.DEFAULT_GOAL := run
.PHONY: run dev test test-long dist wheel test-browser test-library test-main check-page check-wasm test-page test-package test-python test-python-rl results ablations mazes soak fuzz audit system-run system-test system-browsers

# Rerun's Python tools, at the version of the crate, check recordings. schemathesis checks the server against its OpenAPI
# description. Minari loads exported attempts, with pyarrow, and with Pillow, which it does not list. maturin builds the
# package for Python; ruff and mypy check it.
RERUN_VERSION := 0.36.3
SCHEMATHESIS_VERSION := 4.32.5
MINARI_VERSION := 0.5.4
PYARROW_VERSION := 26.0.1
PILLOW_VERSION := 13.0.0
# yourdfpy and MuJoCo read the exported models of the arm; ur_rtde reads the arm as that of a real robot.
MUJOCO_VERSION := 4.0.0
YOURDFPY_VERSION := 0.0.60
UR_RTDE_VERSION := 1.6.5
MATURIN_VERSION := 1.16.0
RUFF_VERSION := 0.17.6
MYPY_VERSION := 2.4.1
PYTEST_VERSION := 9.2.0
NBCONVERT_VERSION := 7.17.2
IPYKERNEL_VERSION := 7.4.0
MATPLOTLIB_VERSION := 3.11.2
TYPES_TQDM_VERSION := 4.70.0.20261106
# Writes the videos of Gymnasium.
MOVIEPY_VERSION := 2.2.1
TORCH_VERSION := 2.15.0
STABLE_BASELINES3_VERSION := 2.9.2
ONNX_VERSION := 1.23.2
ONNXSCRIPT_VERSION := 0.7.2
ONNXRUNTIME_VERSION := 1.32.0
RAY_VERSION := 2.60.0
VENV := target/venv
TOOLS := $(VENV)/rerun-$(RERUN_VERSION)-schemathesis-$(SCHEMATHESIS_VERSION)-minari-$(MINARI_VERSION)-mujoco-$(MUJOCO_VERSION)-rtde-$(UR_RTDE_VERSION)
MATURIN := $(VENV)/maturin-$(MATURIN_VERSION)
# The package is tested where only it is installed, with what it asks for.
WHEEL_VENV := target/wheel-venv
RL_VENV := target/rl-venv
WHEEL_TOOLS := $(WHEEL_VENV)/ruff-$(RUFF_VERSION)-mypy-$(MYPY_VERSION)-pytest-$(PYTEST_VERSION)-nbconvert-$(NBCONVERT_VERSION)-types-tqdm-$(TYPES_TQDM_VERSION)-moviepy-$(MOVIEPY_VERSION)
RL_TOOLS := $(RL_VENV)/torch-$(TORCH_VERSION)-stable-baselines3-$(STABLE_BASELINES3_VERSION)-ray-$(RAY_VERSION)
SUDO := $(if $(filter 0,$(shell id -u)),,sudo)
# Graphics drivers print long warnings when it is not set.
export XDG_RUNTIME_DIR ?= /tmp

run: system-run
	cargo run --release -- serve

# The page by Vite, with what it asks for passed to a server that runs: `FERRY_SERVER`, http://127.0.0.1:8080 if not set.
dev: system-run
	cd web && { [ node_modules/.package-lock.json -nt package-lock.json ] || npm ci --no-audit --no-fund; } && npm run --silent dev

# Clippy checks what the compiler compiles, so that lints, tests, program and package for Python share one build. `wheel`
# compiles the package.
LIBRARY_TESTS := cargo test --release --quiet --lib --
MAIN_TESTS := cargo test --release --quiet --test main --

# docs/tests.md says what is in which suite. One browser test alone: CONTRIBUTING.md.
test test-library test-main test-long: export CLIPPY_ARGS = -D__CLIPPY_HACKERY__warnings
test test-library test-main test-long: export RUSTC_WORKSPACE_WRAPPER = clippy-driver
test: system-test $(TOOLS)
	cargo fmt --all --check
	cargo build --release --all-targets --quiet
	$(MAKE) wheel check-wasm $(WHEEL_TOOLS)
	$(MAKE) --jobs=2 --output-sync=target test-main test-package check-page test-library test-page
	$(MAKE) test-browser

test-browser:
	mkdir -p test-output
	cd web && FERRY_BIN=$(CURDIR)/target/release/ferry npm run --silent e2e
# Many of these wait for a server or a robot in real time, so the others run beside them.
test-main:
	$(MAIN_TESTS)
test-library:
	$(LIBRARY_TESTS)
# `ferry-core` must run in a browser. Where rustup cannot add the target, Debian's compiler for the web checks it, with a
# standard library that is compiled for it.
CHECK_WASM := cargo check --release --quiet --package ferry-core --target wasm32-unknown-unknown
WEB_RUST := target/rust-web
WEB_RUST_PACKAGES := rustc-web libstd-rust-web-1.96 libstd-rust-web-dev rust-web-src rust-web-llvm libllvm22 lld-22
check-wasm:
	@if [ -d "$$(rustc --print sysroot)/lib/rustlib/wasm32-unknown-unknown" ] || \
		rustup target add wasm32-unknown-unknown 2>/dev/null; then $(CHECK_WASM); \
	else $(MAKE) $(WEB_RUST)/unpacked && export RUSTC=$(CURDIR)/$(WEB_RUST)/usr/bin/rustc RUSTC_BOOTSTRAP=1 && \
		LD_LIBRARY_PATH=$(CURDIR)/$(WEB_RUST)/usr/lib/x86_64-linux-gnu CARGO_TARGET_DIR=$(WEB_RUST)/target \
		$(CHECK_WASM) -Zbuild-std=std,panic_abort; fi
$(WEB_RUST)/unpacked:
	mkdir -p $(WEB_RUST)
	cd $(WEB_RUST) && apt-get download $(WEB_RUST_PACKAGES) && for package in *.deb; do dpkg -x $$package .; done && rm *.deb
	touch $@
check-page:
	cd web && npm run --silent check
test-page:
	cd web && npm run --silent test

# A part that has passed on this commit is skipped, so an interrupted run goes on. One part alone: make test-long PARTS=docs
PARTS ?= docs rust browser python soak fuzz
PASSED := target/test-long/$(shell git rev-parse HEAD)
test-long: system-test $(TOOLS)
	mkdir -p $(PASSED) test-output
	for part in $(PARTS); do [ -e $(PASSED)/$$part ] || $(MAKE) test-long-$$part; touch $(PASSED)/$$part; done

test-long-docs:
	RUSTDOCFLAGS="-D warnings" cargo doc --release --workspace --no-deps --quiet
test-long-rust:
	cargo build --release --quiet
	$(LIBRARY_TESTS) --ignored
	$(MAIN_TESTS) --ignored
	FERRY_COMMANDS=600000 $(LIBRARY_TESTS) command_tests
	FERRY_SESSIONS=100 FERRY_KILLS=20 FERRY_EXAMPLES=25 FERRY_SEQUENCES=1000 $(MAIN_TESTS) contract crashes whatever_an_operator_does whatever_visitors_do
test-long-browser: system-browsers
	cargo build --release --quiet
	cd web && FERRY_BIN=$(CURDIR)/target/release/ferry npm run --silent e2e:long
test-long-python: test-python-rl
test-long-soak: soak
test-long-fuzz: fuzz

# A package for Python 3.10 or newer on Linux, with the command, the page, the maps and the policies.
wheel: system-run $(MATURIN)
	rm -rf target/wheels
	cd python && ../$(VENV)/bin/maturin build --release --quiet --out ../target/wheels
	@ls -l target/wheels/*.whl

# What needs torch (3 GB) or Ray: a learner, ONNX, evaluations on several workers.
test-python-rl: wheel $(RL_TOOLS)
	$(RL_VENV)/bin/pip install --quiet --disable-pip-version-check target/wheels/*.whl
	$(RL_VENV)/bin/pip install --quiet --disable-pip-version-check --force-reinstall --no-deps target/wheels/*.whl
	cd python/tests_rl && ../../$(RL_VENV)/bin/python -m pytest -q -p no:cacheprovider

test-python: wheel $(WHEEL_TOOLS)
	$(MAKE) test-package
# With the wheel that was built last.
test-package:
	$(WHEEL_VENV)/bin/pip install --quiet --disable-pip-version-check target/wheels/*.whl
	$(WHEEL_VENV)/bin/pip install --quiet --disable-pip-version-check --force-reinstall --no-deps target/wheels/*.whl
	cd python && ../$(WHEEL_VENV)/bin/ruff format --quiet --check . && ../$(WHEEL_VENV)/bin/ruff check --quiet .
	$(WHEEL_VENV)/bin/mypy --no-error-summary --config-file python/pyproject.toml python/ferry
	cd python/tests && ../../$(WHEEL_VENV)/bin/python -m pytest -q -p no:cacheprovider
	$(WHEEL_VENV)/bin/python -m jupyter nbconvert --log-level=ERROR --to notebook --execute \
		--output-dir target/notebooks docs/notebooks/*.ipynb

# An archive with one stripped program for Debian 12 or newer (x86-64). The page, the maps, the policies and Rerun's viewer
# are embedded. It may need only the system libraries below; a graphics driver is loaded at run time.
VERSION = $(shell sed -n 's/^version = "\(.*\)"/\1/p;T;q' Cargo.toml)
DIST = target/dist/ferry-$(VERSION)-x86_64-linux
LIBRARIES := libgcc_s.so.1 libm.so.6 libc.so.6 ld-linux-x86-64.so.2
NEWEST_GLIBC := 2.36
dist: system-run
	cargo build --release --locked
	rm -rf $(DIST) $(DIST).tar.gz && mkdir -p $(DIST)
	strip -o $(DIST)/ferry target/release/ferry
	cp LICENSE-MIT LICENSE-APACHE $(DIST)
	@needed=$$(objdump -p $(DIST)/ferry | sed -n 's/ *NEEDED *//p' | grep -vxF "$$(printf '%s\n' $(LIBRARIES))" || true); \
	[ -z "$$needed" ] || { echo "Ferry needs libraries that a bare system lacks:" $$needed; exit 1; }
	@glibc=$$(objdump -T $(DIST)/ferry | grep -o 'GLIBC_[0-9.]*' | cut -d_ -f2 | sort -Vu | tail -n 1); \
	[ "$$(printf '%s\n' $$glibc $(NEWEST_GLIBC) | sort -V | tail -n 1)" = $(NEWEST_GLIBC) ] || \
		{ echo "Ferry needs glibc $$glibc; Debian 12 has $(NEWEST_GLIBC)"; exit 1; }
	tar -C $(DIST)/.. --owner=0 --group=0 --numeric-owner --sort=name -cf - $(notdir $(DIST)) | gzip -9n > $(DIST).tar.gz
	@ls -l $(DIST).tar.gz

# An hour or two on two cores. An interrupted run goes on.
results: system-run
	cargo build --release
	python3 tests/results/tables.py

# Two to three hours of one core. An interrupted run goes on.
ablations: system-run
	cargo build --release
	python3 tests/results/ablations.py

# Five hours of one core with the default of 200 trials on each maze. An interrupted run goes on.
mazes: system-run
	cargo build --release
	python3 tests/results/mazes.py

# Its budgets are strict: run nothing else meanwhile. SOAK_MINUTES=4 is a shorter run.
soak: system-test
	cargo build --release
	mkdir -p test-output
	cd web && FERRY_BIN=$(CURDIR)/target/release/ferry npm run --silent soak
	cargo bench --quiet --bench load
	cargo bench --quiet --bench jobs

# Coverage-guided fuzzing: `FUZZ_SECONDS` for each of `FUZZ_TARGETS`, two at a time. It stops at the first input that
# panics, takes five seconds or two gigabytes, and keeps that input in target/fuzz. Only Ferry's own code is rebuilt, with
# the same compiler. The stack has the size of a server thread's.
FUZZ_SECONDS ?= 300
FUZZ_TARGETS ?= message map drawing case log entries policy rtde reports script dashboard
fuzz: fuzz-build
	$(MAKE) --jobs=2 $(FUZZ_TARGETS:%=fuzz-%)
fuzz-build: system-run
	RUSTC_WORKSPACE_WRAPPER=$(CURDIR)/tests/fuzz/rustc.sh cargo build --release --features fuzz --example fuzz
fuzz-%: fuzz-build
	ulimit -s 2048; folder=target/fuzz/$*; mkdir -p $$folder/{seeds,corpus,found}; echo "$*, $(FUZZ_SECONDS) s"; \
	FUZZ_TARGET=$* FUZZ_SEEDS=$$folder/seeds target/release/examples/fuzz $$folder/{corpus,seeds} \
		-artifact_prefix=$$folder/found/ -max_total_time=$(FUZZ_SECONDS) -timeout=5 -rss_limit_mb=2048 \
		-max_len=65536 -print_final_stats=1 2> $$folder/log || { tail -n 40 $$folder/log; exit 1; }; \
	grep -E '^#.*DONE|stat::(number|average|slowest|peak)' $$folder/log

# `deny.toml` lists what is allowed; cargo-audit gets the same exceptions. `OFFLINE=1` uses the advisories that the last
# run downloaded.
audit:
	command -v cargo-deny >/dev/null || cargo install --locked cargo-deny
	command -v cargo-audit >/dev/null || cargo install --locked cargo-audit
	cargo deny $(if $(OFFLINE),--offline) check
	cargo audit --deny warnings $(if $(OFFLINE),--no-fetch --stale) \
		$(addprefix --ignore ,$(shell grep -o 'RUSTSEC-[0-9]*-[0-9]*' deny.toml))

# A software graphics driver, which needs no graphics card, and Node.js for the page.
system-run:
	@packages=; \
	ls /usr/share/vulkan/icd.d/*.json >/dev/null 2>&1 || packages+=" mesa-vulkan-drivers"; \
	command -v npm >/dev/null || packages+=" nodejs npm"; \
	command -v cc >/dev/null || packages+=" build-essential"; \
	$(call install,$$packages)

system-test: system-run
	@packages=; \
	command -v chromium-headless-shell >/dev/null || packages+=" chromium-headless-shell"; \
	python3 -c 'import ensurepip, venv' 2>/dev/null || packages+=" python3-venv"; \
	/sbin/ldconfig -p | grep -q libEGL.so.1 || packages+=" libegl1 libgl1-mesa-dri"; \
	$(call install,$$packages)

# Other browsers: Firefox, and WebKitGTK with a driver; both need a display.
system-browsers:
	@packages=; \
	command -v firefox-esr >/dev/null || packages+=" firefox-esr"; \
	command -v WebKitWebDriver >/dev/null || packages+=" webkit2gtk-driver"; \
	command -v Xvfb >/dev/null || packages+=" xvfb"; \
	$(call install,$$packages)

define install
if [ -n "$(1)" ]; then \
	command -v apt-get >/dev/null || { echo "Ferry needs$(1): install them with your system's package manager"; exit 1; }; \
	$(SUDO) apt-get update -q && $(SUDO) apt-get install -qy --no-install-recommends $(1); \
fi
endef

$(MATURIN):
	python3 -m venv $(VENV)
	$(VENV)/bin/pip install --quiet --disable-pip-version-check maturin==$(MATURIN_VERSION)
	touch $@

$(RL_TOOLS):
	python3 -m venv $(RL_VENV)
	$(RL_VENV)/bin/pip install --quiet --disable-pip-version-check torch==$(TORCH_VERSION) \
		stable-baselines3==$(STABLE_BASELINES3_VERSION) onnx==$(ONNX_VERSION) onnxscript==$(ONNXSCRIPT_VERSION) \
		onnxruntime==$(ONNXRUNTIME_VERSION) ray==$(RAY_VERSION) pytest==$(PYTEST_VERSION)
	touch $@

$(WHEEL_TOOLS):
	python3 -m venv $(WHEEL_VENV)
	$(WHEEL_VENV)/bin/pip install --quiet --disable-pip-version-check ruff==$(RUFF_VERSION) mypy==$(MYPY_VERSION) \
		pytest==$(PYTEST_VERSION) nbconvert==$(NBCONVERT_VERSION) ipykernel==$(IPYKERNEL_VERSION) \
		matplotlib==$(MATPLOTLIB_VERSION) types-tqdm==$(TYPES_TQDM_VERSION) moviepy==$(MOVIEPY_VERSION)
	touch $@

$(TOOLS):
	python3 -m venv $(VENV)
	$(VENV)/bin/pip install --quiet --disable-pip-version-check rerun-sdk==$(RERUN_VERSION) \
		schemathesis==$(SCHEMATHESIS_VERSION) minari==$(MINARI_VERSION) pyarrow==$(PYARROW_VERSION) \
		pillow==$(PILLOW_VERSION) mujoco==$(MUJOCO_VERSION) yourdfpy==$(YOURDFPY_VERSION) \
		ur-rtde==$(UR_RTDE_VERSION)
	touch $@
