#!/usr/bin/env bash
#
# Makes the binary pack: what pack_install/1 puts on a machine that has neither
# cargo nor make.
#
#   dist/ev3dev-<version>.tgz          and .tgz.sha256 beside it
#
# Usage: tools/dist.sh
#
# There is no Makefile in it, so nothing is built on installation. The foreign
# libraries are native/<target>/ev3dev.so; prolog/ev3dev/private/native/library_file.pl
# picks one. They are not below lib: where there is a folder lib but none in it that is
# named by the Prolog flag `arch`, SWI-Prolog up to 9.0 does not use the pack at
# all, and the flags of all builds there are cannot be known.
#
# The same commit gives the same bytes.
#
# Environment: as for tools/cross.sh; SOURCE_DATE_EPOCH, the time of all files
# (default: that of the last commit).

set -euo pipefail
# shellcheck source=tools/common.sh
source "$(dirname "$0")/common.sh"
# shellcheck source=tools/targets.sh
source "$root/tools/targets.sh"

# Of these, doc is made by `make doc`.
contents=(pack.pl README.md LICENSE CHANGELOG.md ARCHITECTURE.md CONTRIBUTING.md
    prolog app examples course docs doc)

main() {
    local name archive stage=$root/target/dist/stage
    "$root/tools/cross.sh" "${all_targets[@]}"
    locked dist

    rm -rf "$stage"
    mkdir -p "$stage/ev3dev" "$root/dist"
    copy_contents "$stage/ev3dev"
    for name in "${all_targets[@]}"; do
        install -D -m 644 "$root/target/dist/$name/ev3dev.so" \
            "$stage/ev3dev/native/$name/ev3dev.so"
    done

    archive=$root/dist/ev3dev-$(version).tgz
    pack "$stage" ev3dev "$archive"
    echo "${archive#"$root"/}: $(stat -c %s "$archive") bytes"
}

copy_contents() {
    local item
    for item in "${contents[@]}"; do
        [[ ! -e $root/$item ]] || cp -R "$root/$item" "$1/"
    done
    find "$1" \( -name '.*' -o -name '*~' -o -name '*.qlf' \) -delete
}

main
