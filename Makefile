# `make run` serves the laboratory, `make test` runs every check, `make soak` leaves a page open for half an hour.
# All first install what is missing.

SHELL := /bin/bash
.SHELLFLAGS := -eu -o pipefail -c
.DEFAULT_GOAL := run
.PHONY: run test soak system-run system-test rust web browser

# Rerun's own tools, at the version of the crate, to check recordings with.
RERUN_VERSION := 0.36.3
VENV := target/venv
SUDO := $(if $(filter 0,$(shell id -u)),,sudo)
# Graphics drivers complain of its absence, at length.
export XDG_RUNTIME_DIR ?= /tmp

run: system-run
	cargo run --release -- serve

test: system-test $(VENV)/rerun-$(RERUN_VERSION)
	cargo fmt --check
	cargo clippy --release --all-targets --quiet -- -D warnings
	RUSTDOCFLAGS="-D warnings" cargo doc --release --no-deps --quiet
	cargo test --release --no-run --quiet
	cd web && npm run --silent check && npm run --silent test
	mkdir -p test-output
	cd web && FERRY_BIN=../target/release/ferry npm run --silent e2e
	cargo test --release --quiet --lib --test main

# Its budgets are strict: let nothing else run meanwhile. SOAK_MINUTES=4 has a shorter look.
soak: system-test
	cargo build --release
	mkdir -p test-output
	cd web && FERRY_BIN=../target/release/ferry npm run --silent soak

# A graphics driver that needs no graphics card, and Node.js for the page.
system-run:
	@packages=; \
	ls /usr/share/vulkan/icd.d/*.json >/dev/null 2>&1 || packages+=" mesa-vulkan-drivers"; \
	command -v npm >/dev/null || packages+=" nodejs npm"; \
	command -v cc >/dev/null || packages+=" build-essential"; \
	$(call install,$$packages)

system-test: system-run
	@packages=; \
	command -v chromium >/dev/null || packages+=" chromium"; \
	python3 -c 'import ensurepip, venv' 2>/dev/null || packages+=" python3-venv"; \
	/sbin/ldconfig -p | grep -q libEGL.so.1 || packages+=" libegl1 libgl1-mesa-dri"; \
	$(call install,$$packages)

define install
if [ -n "$(1)" ]; then \
	command -v apt-get >/dev/null || { echo "Ferry needs$(1): install them with your system's package manager"; exit 1; }; \
	$(SUDO) apt-get update -q && $(SUDO) apt-get install -qy --no-install-recommends $(1); \
fi
endef

$(VENV)/rerun-$(RERUN_VERSION):
	python3 -m venv $(VENV)
	$(VENV)/bin/pip install --quiet --disable-pip-version-check rerun-sdk==$(RERUN_VERSION)
	touch $@
