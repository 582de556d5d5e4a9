#!/usr/bin/env bash
# Runs plunit files, each in a process of its own, and counts.
#
#   tests/run.sh [FILE...]        default: all of tests/prolog and tests/behavior
#
# Tests of devices run over several trees (see tests/support/trees.pl): plain
# files, the simulator within the process, and its mount where FUSE can be had.
# TREES leaves out those that it does not name, as in TREES="plain simulator".
#
# SWIPL names another Prolog, JOBS how many files run at once (default: one for
# each processor, and one that waits). A leftover choice point or any other
# warning fails the run (before SWI-Prolog 9 a failed test alone), and so does a
# file that takes LIMIT seconds, 1200 by default. Hints (tests/behavior/test_hints.pl)
# are off, as tests make many calls that fail.
set -euo pipefail
cd "$(dirname "$0")/.."

export SWIPL=${SWIPL:-swipl}
logs=$(mktemp -d)
trap 'rm -rf "$logs"' EXIT

main() {
    [ $# -gt 0 ] || set -- tests/{prolog,behavior}/test_*.pl
    # The large ones first, so that nothing is left to wait for at the end
    find "$@" -printf "%s %p\n" | sort -rn | cut -d " " -f 2 |
        xargs -P "${JOBS:-$(($(nproc) + 1))}" -L 1 "$0" --one "$logs" || true
    sed -n '/^skipped: /p' "$logs"/*.log | sort -u
    sed 's/^/FAILED: /' "$logs/failed" 2>/dev/null || true
    sed -nE 's/^% All ([0-9]+) (\(\+[0-9]+ sub-tests\) )?tests passed.*/\1/p; s/^% [Tt]est passed.*/1/p' "$logs"/*.log |
        awk '{ tests += $1 } END { print tests+0 " tests passed" }'
    echo "$(lines "$logs/passed") files passed, $(lines "$logs/failed") failed"
    [ "$(lines "$logs/passed")" = $# ]
}

# one FILE: its output when it is over. Newer versions of plunit take a warning that a test
# expects for one of its faults, unless they print what a test prints.
one() {
    local log options
    options="set_prolog_flag(ev3dev_hints,off),catch(set_test_options([output(always)]),_,true)"
    log=$logs/$(basename "$1" .pl).log
    SECONDS=0
    if timeout "${LIMIT:-1200}" "$SWIPL" --on-warning=status --on-error=status \
        -g "$options,(run_tests->true;halt(1))" -t halt "$1" </dev/null >"$log" 2>&1; then
        echo "$1" >>"$logs/passed"
    else
        echo "$1" >>"$logs/failed"
    fi
    printf '== %s, %s s\n%s\n' "$1" "$SECONDS" "$(cat "$log")"
}

lines() {
    if [ -e "$1" ]; then wc -l <"$1"; else echo 0; fi
}

if [ "${1:-}" = --one ]; then
    trap - EXIT
    rm -r "$logs"
    logs=$2
    one "$3"
else
    main "$@"
fi
