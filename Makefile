# The one entry point. `pack_install` calls `make`, `make check` and
# `make install`, with SWIPL, PACKSODIR and SOEXT in the environment.
SWIPL     ?= swipl
SOEXT     ?= so
CARGO     ?= cargo
PACKSODIR ?= lib/$(shell $(SWIPL) -g "current_prolog_flag(arch,A),write(A)" -t halt 2>/dev/null)
EXAMPLE   ?= obstacle_avoidance

TESTS   = $(wildcard tests/test_*.pl)
LIBRARY = $(PACKSODIR)/ev3dev.$(SOEXT)

.PHONY: all setup build check check-rust check-prolog lint demo doc install clean distclean

all: build

# What is missing on a fresh machine
setup:
	@tools/setup.sh

build: setup
	@command -v $(CARGO) >/dev/null || { \
	    echo "Building this pack needs cargo: install Rust from https://rustup.rs, or use the binary pack." >&2; \
	    exit 1; }
	$(CARGO) build --release --locked
	@$(MAKE) --no-print-directory place

# Apart, so that PACKSODIR is asked of a swipl that setup may just have installed
.PHONY: place
place:
	@mkdir -p "$(PACKSODIR)"
	@cp -f "$${CARGO_TARGET_DIR:-target}/release/libev3dev.so" "$(LIBRARY).new"
	@mv -f "$(LIBRARY).new" "$(LIBRARY)"

check: build check-rust check-prolog

check-rust:
	$(CARGO) test --workspace --locked --quiet

check-prolog:
	@tests/run.sh $(TESTS)

lint: build
	$(CARGO) fmt --all --check
	$(CARGO) clippy --workspace --all-targets --locked -- -D warnings
	$(SWIPL) -g main -t 'halt(1)' tests/lint.pl

demo: build
	@tools/demo.sh $(EXAMPLE)

install:

clean:
	$(CARGO) clean

distclean: clean
	rm -rf lib dist .toolchain
