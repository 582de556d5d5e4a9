#!/usr/bin/env bash
#
# Tries the binary pack in other SWI-Prologs: installs it with pack_install
# where there is nothing to build with, calls every predicate once, and runs the
# plunit suite.
#
# Usage: tools/versions.sh [NAME...]        as in tools/emulate.sh, or 7.2.3 or
#                                           10.1; default: all of the PC's
#                                           processor, and those two if given
#
# Environment: ARCHIVE  the pack to try (default: the newest in dist/)
#              SWIPL_723, SWIPL_101  swipl of a built 7.2.3 and 10.1, which come
#                       in no package. They need the packages clib, plunit, sgml,
#                       http and archive; pack_install of 7.2.3 ssl, too.
#              SUITE    the test files (default: those in tests/prolog and tests/behavior)
#              JOBS     how many of them run at once (default: one for each
#                       processor, and two that wait)

set -euo pipefail
# shellcheck source=tools/common.sh
source "$(dirname "$0")/common.sh"

pc=(8.2.4 9.0.4 9.2.9)

main() {
    local name
    archive=${ARCHIVE:-$(find "$root/dist" -name 'ev3dev-*.tgz' -printf '%T@ %p\n' |
        sort -n | tail -n 1 | cut -d ' ' -f 2-)}
    [[ -r $archive ]] || die "no binary pack in dist: run tools/dist.sh"
    if [[ $# -eq 0 ]]; then
        set -- "${pc[@]}"
        [[ -z ${SWIPL_723:-} ]] || set -- 7.2.3 "$@"
        [[ -z ${SWIPL_101:-} ]] || set -- "$@" 10.1
    fi
    work=$(mktemp -d)
    trap 'rm -rf "$work"' EXIT
    touch "$work/results"
    unset EV3DEV_SYSFS EV3DEV_DEV TREES RUST_BACKTRACE
    # It is the Prologs that are tried here. Without a floating point unit, and
    # emulated, geometry takes two hundred times as long.
    for name; do
        export EV3DEV_TEST_PERCENT=10
        [[ $name != *armel ]] || EV3DEV_TEST_PERCENT=2
        try "$name"
    done
    echo "$(grep -c passed "$work/results") passed, $(grep -c failed "$work/results") failed"
    ! grep -q failed "$work/results"
}

try() {
    local name=$1 home=$work/$1 tree=$work/$1/tree file
    mkdir -p "$home" "$tree"
    tar -xzf "$archive" -C "$tree"
    cp -R "$root/tests" "$tree/ev3dev/"
    # What the tests try beside the pack
    install -D "$root/tools/demo.pl" "$tree/ev3dev/tools/demo.pl"
    built_swipl "$name" >/dev/null || "$root/tools/emulate.sh" "$name" >/dev/null

    cp "$archive" "$home/"
    # For tests that start programs
    if built_swipl "$name" >/dev/null; then
        ln -s "$(built_swipl "$name")" "$home/swipl"
    else
        printf '#!/bin/sh\nexec "%s/tools/emulate.sh" "%s" swipl "$@"\n' \
            "$root" "$name" >"$home/swipl"
        chmod +x "$home/swipl"
    fi
    step "$name: pack_install" nothing_to_build_with \
        -g "pack_install('$home/${archive##*/}', [interactive(false)])" -t halt
    step "$name: pack_install again, to update" nothing_to_build_with \
        -g "pack_install('$home/${archive##*/}', [interactive(false), upgrade(true)])" -t halt
    step "$name: compile" nothing_to_build_with \
        -g "use_module(library(ev3dev/compile)),ev3dev_compile,halt" -t 'halt(1)'
    step "$name: every predicate" nothing_to_build_with \
        -g main -t 'halt(1)' "$root/tests/brick/smoke.pl"
    step "$name: an example" nothing_to_build_with \
        -g main -t 'halt(1)' "$root/tests/brick/example.pl"
    cd "$tree/ev3dev"
    # Emulated, a terminal is slow, and its keys are not those of a brick
    [[ $name == *arm* ]] || step "$name: sessions" sessions &
    # The large ones first, so that nothing is left to wait for at the end
    # shellcheck disable=SC2045,SC2086
    for file in $(ls -S -- ${SUITE:-tests/prolog/test_*.pl tests/behavior/test_*.pl}); do
        while [[ $(jobs -rp | wc -l) -ge ${JOBS:-$(($(nproc) + 2))} ]]; do
            wait -n
        done
        step "$name: $file" run_swipl \
            -g 'set_prolog_flag(ev3dev_hints,off),(run_tests->halt;halt(1))' "$file" &
    done
    wait
    cd "$root"
}

# What a person types and the papers show, at a terminal of this Prolog, with the pack's
# library: the clone's own may want a newer C library than there is here
sessions() {
    built_swipl "$name" >/dev/null || export EV3DEV_EMULATED=1
    EV3DEV_SESSION_HOME=$home SWIPL=$home/swipl \
        "$tree/ev3dev/tests/sessions/play.py"
}

# built_swipl NAME: the swipl that the environment names for it
built_swipl() {
    case $1 in
    7.2.3) echo "${SWIPL_723:?is where 7.2.3 was built}" ;;
    10.1) echo "${SWIPL_101:?is where 10.1 was built}" ;;
    *) return 1 ;;
    esac
}

run_swipl() {
    if built_swipl "$name" >/dev/null; then
        (
            unset XDG_DATA_HOME XDG_CONFIG_HOME
            export HOME=$home SWIPL=$home/swipl PATH=${EMULATED_PATH:-$PATH}
            guarded "$SWIPL" -q "$@"
        )
    else
        SWIPL=$home/swipl EMULATED_HOME=$home guarded \
            "$root/tools/emulate.sh" "$name" swipl -q "$@"
    fi
}

nothing_to_build_with() {
    EMULATED_PATH=/nonexistent run_swipl "$@"
}

# step TEXT COMMAND...: silent but for its last line, unless it goes wrong
step() {
    local text=$1 log
    log=$(mktemp "$work/log.XXXXXX")
    shift
    if "$@" </dev/null >"$log" 2>&1 && ! grep -qE '^(Warning|ERROR)' "$log"; then
        echo passed >>"$work/results"
        echo "ok      $text"
    else
        echo failed >>"$work/results"
        printf 'FAILED  %s\n%s\n' "$text" "$(sed 's/^/        /' "$log")"
    fi
}

main "$@"
