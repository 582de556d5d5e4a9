#!/usr/bin/env bash
# Runs plunit files, each in a process of its own, and counts.
#
#   tests/run.sh [FILE...]        default: all of tests/prolog and tests/behavior
#
# Those about devices run once over each kind of tree (see tests/support/tree.pl):
# plain files, the simulator within the process, and its mount where FUSE can
# be had. TREES names others, as in TREES="plain simulator". The rest runs once.
#
# SWIPL names another Prolog, JOBS how many files run at once (default: one for
# each processor). A leftover choice point or any other warning fails the run,
# and so does a file that takes five minutes.
set -euo pipefail
cd "$(dirname "$0")/.."

# shellcheck source=tests/support/about_devices.sh
source tests/support/about_devices.sh

export SWIPL=${SWIPL:-swipl}
logs=$(mktemp -d)
trap 'rm -rf "$logs"' EXIT

main() {
    local files=("$@") file tree tests
    [ $# -gt 0 ] || files=(tests/{prolog,behavior}/test_*.pl)
    for file in "${files[@]}"; do
        if is_about_devices "$file"; then
            for tree in ${TREES:-plain simulator mount}; do
                [ "$tree" = mount ] && ! can_mount || echo "$tree" "$file"
            done
        else
            echo plain "$file"
        fi
    done >"$logs/all"
    # The long ones first, so that nothing is left to wait for at the end
    longest_first <"$logs/all" |
        xargs -P "${JOBS:-$(nproc)}" -L 1 "$0" --one "$logs" || true
    tests=$(sed -nE 's/^tally [a-z]+: ([0-9]+) tests, ([0-9]+) left out$/\1 \2/p' "$logs"/*.log |
        awk '{ run += $1; out += $2 } END { print run " tests, " out+0 " left out" }')
    can_mount || echo "the mount: skipped, there is no FUSE here"
    sed 's/^/FAILED: /' "$logs/failed" 2>/dev/null || true
    echo "of the files over several trees: $tests, as said above"
    echo "$(lines "$logs/passed") passed, $(lines "$logs/failed") failed"
    [ "$(lines "$logs/passed")" = "$(lines "$logs/all")" ]
}

# one TREE FILE: its output when it is over
one() {
    local log
    log=$logs/$1-$(basename "$2" .pl).log
    if EV3DEV_TEST_TREE=$1 timeout 300 "$SWIPL" --on-warning=status --on-error=status \
        -g run_tests -t halt "$2" </dev/null >"$log" 2>&1; then
        echo "$1 $2" >>"$logs/passed"
    else
        echo "$1 $2" >>"$logs/failed"
    fi
    printf '== %s %s\n%s\n' "$1" "$2" "$(cat "$log")"
}

can_mount() {
    [ -e "$logs/mounts" ] || {
        if "$SWIPL" -g '(can_mount->halt(0);halt(1))' tests/support/simulation.pl </dev/null; then
            echo yes
        else
            echo no
        fi >"$logs/mounts"
    }
    [ "$(<"$logs/mounts")" = yes ]
}

longest_first() {
    awk '/test_(planners|roadmap|drive|bad_input|robot|ports|nxt_sensors|dc_motors)/ { print; next }
         { rest = rest $0 "\n" } END { printf "%s", rest }'
}

lines() {
    if [ -e "$1" ]; then wc -l <"$1"; else echo 0; fi
}

if [ "${1:-}" = --one ]; then
    trap - EXIT
    rm -r "$logs"
    logs=$2
    one "$3" "$4"
else
    main "$@"
fi
