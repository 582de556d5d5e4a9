#!/usr/bin/env bash
#
# Tries the binary pack in other SWI-Prologs: installs it with pack_install
# where there is nothing to build with, calls every predicate once, and runs the
# plunit suite: what is about devices over plain directory trees, and over the
# simulator within the process.
#
# Usage: tools/versions.sh [NAME...]        as in tools/emulate.sh, or 7.2.3;
#                                           default: all of the PC's processor
#
# Environment: ARCHIVE  the pack to try (default: the newest in dist/)
#              SWIPL_723  the swipl of a built 7.2.3, for want of packages
#              SUITE    the test files (default: tests/test_*.pl)

set -euo pipefail
# shellcheck source=tools/common.sh
source "$(dirname "$0")/common.sh"
# shellcheck source=tests/about_devices.sh
source "$root/tests/about_devices.sh"

pc=(8.2.4 9.0.4 9.2.9)
passed=0 failed=0

main() {
    local name
    archive=${ARCHIVE:-$(find "$root/dist" -name 'ev3dev-*.tgz' -printf '%T@ %p\n' |
        sort -n | tail -n 1 | cut -d ' ' -f 2-)}
    [[ -r $archive ]] || die "no binary pack in dist: run tools/dist.sh"
    if [[ $# -eq 0 ]]; then
        set -- "${pc[@]}"
        [[ -z ${SWIPL_723:-} ]] || set -- 7.2.3 "$@"
    fi
    work=$(mktemp -d)
    trap 'rm -rf "$work"' EXIT
    unset EV3DEV_SYSFS EV3DEV_DEV EV3DEV_TEST_TREE RUST_BACKTRACE
    # It is the Prologs that are tried here. Without a floating point unit, and
    # emulated, geometry takes two hundred times as long.
    for name; do
        export EV3DEV_TEST_PERCENT=10
        [[ $name != *armel ]] || EV3DEV_TEST_PERCENT=2
        try "$name"
    done
    echo "$passed passed, $failed failed"
    [[ $failed == 0 ]]
}

try() {
    local name=$1 home=$work/$1 tree=$work/$1/tree file
    mkdir -p "$home" "$tree"
    tar -xzf "$archive" -C "$tree"
    cp -R "$root/tests" "$tree/ev3dev/"
    [[ $name == 7.2.3 ]] || "$root/tools/emulate.sh" "$name" >/dev/null

    if [[ $name == 7.2.3 ]]; then
        # It may have been built without the packages that pack_install needs.
        step "$name: every predicate" \
            env EV3DEV_PACK="$tree/ev3dev" "$SWIPL_723" -q -g main -t 'halt(1)' \
            "$root/tests/brick/smoke.pl"
        return
    fi
    cp "$archive" "$home/"
    # For tests that start programs
    printf '#!/bin/sh\nexec "%s/tools/emulate.sh" "%s" swipl "$@"\n' \
        "$root" "$name" >"$home/swipl"
    chmod +x "$home/swipl"
    step "$name: pack_install" nothing_to_build_with \
        -g "pack_install('$home/${archive##*/}', [interactive(false)])" -t halt
    step "$name: every predicate" nothing_to_build_with \
        -g main -t 'halt(1)' "$root/tests/brick/smoke.pl"
    step "$name: an example" nothing_to_build_with \
        -g main -t 'halt(1)' "$root/tests/brick/example.pl"
    cd "$tree/ev3dev"
    for file in ${SUITE:-tests/test_*.pl}; do
        step "$name: $file" run_swipl -g '(run_tests->halt;halt(1))' "$file"
        ! is_about_devices "$file" || EV3DEV_TEST_TREE=simulator \
            step "$name, simulator: $file" run_swipl -g '(run_tests->halt;halt(1))' "$file"
    done
    cd "$root"
}

run_swipl() {
    SWIPL=$home/swipl EMULATED_HOME=$home timeout 1800 "$root/tools/emulate.sh" "$name" swipl -q "$@"
}

nothing_to_build_with() {
    EMULATED_PATH=/nonexistent run_swipl "$@"
}

# step TEXT COMMAND...: silent but for its last line, unless it goes wrong
step() {
    local text=$1 log=$work/log
    shift
    if "$@" </dev/null >"$log" 2>&1 && ! grep -qE '^(Warning|ERROR)' "$log"; then
        passed=$((passed + 1))
        # How many tests, where it is a test file
        echo "ok      $text$(sed -nE 's/^tally [a-z]+(: .*)$/\1/p' "$log")"
    else
        failed=$((failed + 1))
        echo "FAILED  $text"
        sed 's/^/        /' "$log"
    fi
}

main "$@"
