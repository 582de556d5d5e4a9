#!/usr/bin/env bash
#
# Counts the instructions of an update of localization with 500 particles, and of
# what goes before it, with and without the table, by valgrind.
#
# Usage: tools/instructions.sh
set -euo pipefail
# shellcheck source=tools/common.sh
source "$(dirname "$0")/common.sh"

few=20
more=120

# count ARGUMENT...
count() {
    valgrind --tool=callgrind --callgrind-out-file=/dev/null \
        target/release/examples/update "$@" 2>&1 | sed -n 's/.*Collected : //p'
}

# say_update [table]
say_update() {
    local first last each
    first=$(count $few "$@")
    last=$(count $more "$@")
    each=$(((last - first) / (more - few)))
    echo "${1:-no table}: $each an update, $((first - few * each)) before"
}

have valgrind || die "valgrind is missing: install it"
cd "$root"
cargo build --release --locked --quiet --package ev3-localize --example update
say_update
say_update table
