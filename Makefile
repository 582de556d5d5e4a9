# The one entry point. `pack_install` calls `make`, `make check` and
# `make install`, with SWIPL, SWIHOME, PACKSODIR and SOEXT in the environment.
SWIPL     ?= swipl
SOEXT     ?= so
CARGO     ?= cargo
PACKSODIR ?= lib/$(shell $(SWIPL) -g "current_prolog_flag(arch,A),write(A)" -t halt 2>/dev/null)
EXAMPLE   ?= obstacle_avoidance
FUZZ      ?= 600

TESTS   = $(wildcard tests/prolog/test_*.pl tests/behavior/test_*.pl)
LIBRARY = $(PACKSODIR)/ev3dev.$(SOEXT)

.PHONY: all setup build check check-install check-rust check-prolog check-sessions check-clients check-view check-bench check-endings check-torture check-fuzz check-cases mutants check-all check-night check-old check-dist playground check-playground \
        check-brick check-brick-smoke check-versions check-brick-prolog brick-prolog \
        check-site lint bench pictures doc site dist demo install clean distclean realclean help

# Builds the pack and compiles its Prolog files
all: build
	@$(MAKE) --no-print-directory install

# Says what each target is for, by the comment above it
help:
	@awk '/^#/ { sub(/^# ?/, ""); said = said == "" ? $$0 : said " " $$0; next } \
	    /^[a-z][a-z-]*:/ && said != "" { name = $$1; sub(/:.*/, "", name); \
	        sub(/[.] .*/, "", said); printf "%-20s %s\n", name, said } \
	    { said = "" }' Makefile

# Installs what is missing on a fresh machine. pack_install of 7.2.3 copies a folder without the
# right to execute its files.
setup:
	@bash tools/setup.sh

# Builds the native library into lib/
build: setup
	@command -v $(CARGO) >/dev/null || { \
	    echo "Building this pack needs cargo: install Rust from https://rustup.rs, or use the binary pack that \`make dist\` makes on a PC that has it (docs/brick.md)." >&2; \
	    exit 1; }
	@[ -e "$${CARGO_TARGET_DIR:-target}/release/libev3dev.so" ] || \
	    echo "Building the native library (a minute or two) ..." >&2
	$(CARGO) build --release --locked
	@$(MAKE) --no-print-directory place

.PHONY: place
# Puts the library into lib/. Apart, so that PACKSODIR is asked of a swipl that setup may just
# have installed
place:
	@mkdir -p "$(PACKSODIR)"
	@built="$${CARGO_TARGET_DIR:-target}/release/libev3dev.so"; \
	    cmp -s "$$built" "$(LIBRARY)" || \
	    { cp -f "$$built" "$(LIBRARY).new" && mv -f "$(LIBRARY).new" "$(LIBRARY)"; }

# pack_install says where Prolog is, in SWIHOME, or in SWIPL_HOME_DIR if pack.pl had
# pack_version(2). There the least is checked, in seconds; from a shell, all.
ifneq ($(SWIHOME)$(SWIPL_HOME_DIR),)
check: check-install
else
# All tests. At the end it says what failed, what was skipped, and what took long. Those that wait
# most of the time run beside those that compute.
check: export EV3DEV_TEST_PERCENT := $(or $(EV3DEV_TEST_PERCENT),20)
# Not $(MAKE) itself, as `make -n check` would run it
AGAIN = $(MAKE) --no-print-directory

check: build
	@tests/run.sh $(TESTS) \
	    'Rust=$(AGAIN) check-rust' \
	    'sessions=$(AGAIN) check-sessions' \
	    'clients=$(AGAIN) check-clients' \
	    'view in Chromium=tests/view/run.sh --chromium' \
	    'view in Firefox=tests/view/run.sh --firefox' \
	    'bench=$(AGAIN) check-bench' \
	    'endings=$(AGAIN) check-endings'
endif

# Every predicate can be called, a motor and a sensor do what they should, and a robot
# drives in the simulator
check-install:
	@echo "Checking that it works (for all tests: make check in a shell) ..." >&2
	@EV3DEV_PACK=. $(SWIPL) -q -f none -g main -t 'halt(1)' tests/brick/smoke.pl </dev/null
	@EV3DEV_PACK=. $(SWIPL) -q -f none -g main -t 'halt(1)' tests/brick/example.pl </dev/null

# All tests and what takes longer, in 100 minutes: other Prologs, the page, the site, the emulated
# brick, more random programs, and changes that tests should notice. docs/checked.md says when it
# last passed.
check-all: lint check
	$(MAKE) dist
	$(MAKE) check-torture COUNT=1000 FUZZ=30
	$(MAKE) mutants SAMPLE=40 LEAST=70 \
	    SINCE=$$(sed -n 's/.* on commit \([0-9a-f]*\),.*/\1/p' docs/checked.md)
	$(MAKE) check-playground
	$(MAKE) check-site
	$(MAKE) check-versions
	$(MAKE) check-brick SUITE="$(ON_BRICK)"
	$(MAKE) -k -j2 check-dist check-brick-prolog
	@tools/checked.sh

# What an emulated brick may do in another way: time, native code, endings, a long computation
ON_BRICK = $(patsubst %,tests/%.pl,behavior/test_halt behavior/test_threads prolog/test_sim_time \
    prolog/test_compile prolog/test_localize prolog/test_planners prolog/test_events)

# What takes a night: all random programs and cases, the whole suite on the emulated brick, and
# a larger sample of changes
check-night: check-all
	$(MAKE) check-torture
	$(MAKE) check-cases
	$(MAKE) mutants SAMPLE=240 LEAST=70
	$(MAKE) check-brick

# The tests of the Rust crates
check-rust:
	$(CARGO) test --workspace --locked --quiet

# The tests of the Prolog files, with a fifth of the random cases; check-cases has all
check-prolog: export EV3DEV_TEST_PERCENT := $(or $(EV3DEV_TEST_PERCENT),20)
check-prolog:
	@tests/run.sh $(TESTS)

# Some tests are programs in Python, which SWI-Prolog does without
WITH_PYTHON = command -v python3 >/dev/null || { echo "skipped: $@: there is no python3"; exit 0; };

# What a person types at a terminal, and what the papers show
check-sessions: build
	@$(WITH_PYTHON) tests/sessions/play.py

# Programs in other languages on the simulator's mount
check-clients: build
	@$(WITH_PYTHON) tests/clients/run.sh

# The page of library(ev3dev/view) in a headless Chromium and in Firefox, where there are
check-view: build
	@tests/view/run.sh

# The pictures of README.md and docs, and films of examples, from the simulator
pictures: build
	@$(SWIPL) -g main -t 'halt(1)' tools/films.pl
	@tests/view/run.sh --pictures

# The bench still runs, and its tables are those of its last run
check-bench: build
	@$(WITH_PYTHON) benches/run.py --smoke

# A hundred and fifty random programs, each ended in some way: none leaves a motor running
check-endings: build
	@$(WITH_PYTHON) tests/torture/torture.py --self-test && tests/torture/torture.py --count 150

# Random programs, random calls of each predicate, and random input for each reader of what others
# send: FUZZ seconds for each
check-torture: build check-fuzz
	@tests/torture/torture.py --count $(or $(COUNT),10000)
	@EV3DEV_TEST_PERCENT=$$((2 * $(FUZZ))) tests/run.sh tests/behavior/test_odd_terms.pl

# Random input for each reader, FUZZ seconds for each; downloads bolero the first time
check-fuzz: export BOLERO_RANDOM_TEST_TIME_MS = $(FUZZ)000
check-fuzz: export BOLERO_RANDOM_ITERATIONS = 1000000000
check-fuzz:
	@cd fuzz && $(CARGO) test --release --locked --quiet --no-fail-fast

# Ten thousand moves, signals, worlds, sets of rules and odd calls, 1000 maps, and all cases of
# which `make check` has a fifth
check-cases: build
	@LIMIT=7200 EV3DEV_TEST_SCHEDULES=1-10000 \
	    tests/run.sh $$(grep -lE 'support/(cases|robots)' tests/*/test_*.pl)

# Changes of single clauses, each of which a test should notice, in FILES, in lines changed
# SINCE a commit, or a SAMPLE of so many by a SEED; LEAST is the percentage that must be
mutants: export TREES := $(or $(TREES),plain simulator)
mutants: build
	@$(SWIPL) -g main -t 'halt(1)' tools/mutate.pl -- --self_test
	@$(SWIPL) -g main -t 'halt(1)' tools/mutate.pl -- \
	    $(SINCE:%=--since=%) $(SAMPLE:%=--sample=%) $(SEED:%=--seed=%) $(LEAST:%=--least=%) $(FILES)

# The checks of style and of the papers, without running anything
lint: build
	$(CARGO) fmt --all --check
	$(CARGO) clippy --workspace --all-targets --locked -- -D warnings
	@! [ -d "$$(rustc --print target-libdir --target wasm32-unknown-unknown)" ] || \
	    RUSTFLAGS="-D warnings" $(CARGO) check --locked --target wasm32-unknown-unknown \
	        --no-default-features --features sim
	tools/layers.py --self-test
	tools/layers.py
	tools/clocks.py --self-test
	tools/clocks.py
	tools/papers.py --self-test
	tools/papers.py
	tools/natives.py
	@if command -v cargo-deny >/dev/null; then $(CARGO) deny --locked check bans licenses sources; \
	    else echo "skipped: cargo-deny is not installed, so deny.toml is not checked"; fi
	$(SWIPL) -g main -t 'halt(1)' tests/support/lint.pl
	$(SWIPL) -g main -t 'halt(1)' tests/brick/old.pl
	@! command -v shellcheck >/dev/null || shellcheck -x tools/*.sh tools/zig-cc tests/*.sh tests/*/*.sh

# Measures, beside other libraries
bench: build
	@benches/run.py

# Nothing is called that SWI-Prolog 7.2.3, the brick's, does not have
check-old: build
	@$(SWIPL) -g main -t 'halt(1)' tests/brick/old.pl

# HTML pages about all predicates, worlds, robots and planners: doc/index.html
doc: setup
	@rm -rf doc
	@$(SWIPL) -g main -t 'halt(1)' tools/doc.pl doc

# A folder for any web server: papers, course, gallery, predicates, and the playground if it was
# built: dist/site
site: doc
	@tools/site.py

# The binary pack, for machines that cannot build: dist/ev3dev-<version>.tgz
dist: doc
	@tools/dist.sh

# The binary pack made elsewhere has the same bytes
check-dist: dist
	@tools/check-dist.sh

# Prolog, robot and world in a page, for any web server: dist/playground
playground: build
	@tools/playground.sh

# The playground: in SWI-Prolog's WebAssembly build, in node, examples do the same as natively
check-playground: build
	@tests/playground/check.sh

# A lesson from the site's first page to a marked exercise, in Chromium
check-site: site
	@tests/site/check.sh

# On an emulated EV3: installs the binary pack, then the suite
check-brick: dist
	@tools/versions.sh armel

# On an emulated EV3: the library alone, every predicate, an example
check-brick-smoke:
	@tools/smoke.sh

# SWI-Prolog 9 for the brick, with the pack in it: dist/brick-prolog-<version>.tgz
brick-prolog: dist
	@tools/brick-prolog.sh --with-pack

# The same on an emulated EV3 that has nothing else
check-brick-prolog: brick-prolog
	@tools/check-brick-prolog.sh

# The binary pack in the SWI-Prologs of three Debians; SWIPL_723=<swipl> adds a built 7.2.3,
# SWIPL_101=<swipl> a built 10.1
check-versions: dist
	@tools/versions.sh

# An example drives in the simulator: EXAMPLE=grid_navigation
demo: build
	@tools/demo.sh $(EXAMPLE)

# Compiles the Prolog files, which load several times as fast then, for this Prolog alone
install:
	@$(SWIPL) -q -f none -t 'halt(1)' </dev/null \
	    -g "asserta(user:file_search_path(library,prolog)),use_module(library(ev3dev/compile)),ev3dev_compile,halt"

# Removes what cargo built
clean:
	$(CARGO) clean

# Removes all that was built
distclean: clean
	rm -rf lib dist doc compiled

# Removes the toolchain for other machines, too: 1.3 GB to fetch again
realclean: distclean
	rm -rf .toolchain
