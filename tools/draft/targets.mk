# For the Makefile. `distclean` should leave .toolchain to a `realclean`, or a
# cleaned tree fetches 1.3 GB again.
.PHONY: dist check-brick check-versions check-old

# The binary pack, for machines that cannot build: dist/ev3dev-<version>.tgz
dist:
	@tools/dist.sh

# On an emulated EV3: installs the binary pack, then the suite
check-brick: dist
	@tools/versions.sh armel

# In the SWI-Prologs of three Debians; SWIPL_723=<swipl> adds a built 7.2.3
check-versions: dist
	@tools/versions.sh

# Nothing newer than 7.2.3 is called; part of lint
check-old: build
	@$(SWIPL) -g main -t 'halt(1)' tests/brick/old.pl
