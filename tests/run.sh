#!/usr/bin/env bash
# Runs plunit files, each in a process of its own, and counts.
#
#   tests/run.sh [FILE...]        default: all of tests/test_*.pl
#
# SWIPL names another Prolog. A leftover choice point or any other warning
# fails the run, and so does a file that takes five minutes.
set -euo pipefail
cd "$(dirname "$0")/.."

swipl=${SWIPL:-swipl}
files=("$@")
[ $# -gt 0 ] || files=(tests/test_*.pl)
passed=0 failed=0
for file in "${files[@]}"; do
    echo "$file"
    if timeout 300 "$swipl" --on-warning=status --on-error=status \
            -g run_tests -t halt "$file" </dev/null; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAILED: $file" >&2
    fi
done
echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
