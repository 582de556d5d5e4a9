#!/usr/bin/env bash
# Runs plunit files, each in a process of its own, and counts.
#
#   tests/run.sh [FILE...]        default: all of tests/test_*.pl
#
# Those about devices run once over each kind of tree (see tests/tree.pl):
# plain files, the simulator within the process, and its mount where FUSE can
# be had. TREES names others, as in TREES="plain simulator". The rest runs once.
#
# SWIPL names another Prolog. A leftover choice point or any other warning
# fails the run, and so does a file that takes five minutes.
set -euo pipefail
cd "$(dirname "$0")/.."

# shellcheck source=tests/about_devices.sh
source tests/about_devices.sh

swipl=${SWIPL:-swipl}
log=$(mktemp)
trap 'rm -f "$log"' EXIT
failed_files=0

main() {
    local files=("$@") several=() once=() file tree
    [ $# -gt 0 ] || files=(tests/test_*.pl)
    for file in "${files[@]}"; do
        if is_about_devices "$file"; then several+=("$file"); else once+=("$file"); fi
    done
    local -a lines=()
    if [ ${#once[@]} -gt 0 ]; then
        run_all plain "${once[@]}"
        lines+=("$(summary 'once')")
    fi
    if [ ${#several[@]} -gt 0 ]; then
        for tree in ${TREES:-plain simulator mount}; do
            if [ "$tree" = mount ] && ! can_mount; then
                lines+=("mount: skipped, there is no FUSE here")
                continue
            fi
            echo "== over the tree: $tree"
            run_all "$tree" "${several[@]}"
            lines+=("$(summary "$tree")")
        done
    fi
    printf '%s\n' "${lines[@]}"
    [ "$failed_files" = 0 ]
}

can_mount() {
    "$swipl" -g '(can_mount->halt(0);halt(1))' tests/simulation.pl </dev/null
}

# run_all TREE FILE...
run_all() {
    local tree=$1 file
    shift
    passed=0 failed=0 run=0 left=0
    for file; do
        echo "$file"
        if EV3DEV_TEST_TREE=$tree timeout 300 "$swipl" --on-warning=status --on-error=status \
            -g run_tests -t halt "$file" </dev/null 2>&1 | tee "$log"; then
            passed=$((passed + 1))
        else
            failed=$((failed + 1))
            echo "FAILED: $file" >&2
        fi
        count_tests
    done
    failed_files=$((failed_files + failed))
}

# From what tests/tally.pl prints at the end of a file, if it does
count_tests() {
    local numbers
    numbers=$(sed -nE 's/^tally [a-z]+: ([0-9]+) tests, ([0-9]+) left out$/\1 \2/p' "$log")
    [ -n "$numbers" ] || return 0
    run=$((run + ${numbers% *}))
    left=$((left + ${numbers#* }))
}

summary() {
    local tests=
    [ "$1" = once ] || tests="; $run tests, $left left out as said above"
    echo "$1: $passed files passed, $failed failed$tests"
}

main "$@"
