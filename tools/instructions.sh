#!/usr/bin/env bash
#
# Counts the instructions of an update of localization with 500 particles, and of
# what goes before it, with and without the table: on this machine by valgrind, and
# on the emulated brick, which writes a line for each.
#
# Usage: tools/instructions.sh
set -euo pipefail
# shellcheck source=tools/common.sh
source "$(dirname "$0")/common.sh"

few=1
more=3

# count_here PROGRAM ARGUMENT...
count_here() {
    valgrind --tool=callgrind --callgrind-out-file=/dev/null "$@" 2>&1 |
        sed -n 's/.*Collected : //p'
}

count_brick() {
    QEMU_SINGLESTEP=1 QEMU_LOG=exec,nochain "$root/tools/emulate.sh" armel "$@" 2>&1 |
        wc -l
}

# say_update WHERE PROGRAM [table]
say_update() {
    local first last
    first=$("count_$1" "$2" $few "${@:3}")
    last=$("count_$1" "$2" $more "${@:3}")
    echo "$1${3:+, with the table}: $(((last - first) / (more - few))) an update," \
        "$((first - few * (last - first) / (more - few))) before"
}

have valgrind || die "valgrind is missing: install it"
cd "$root"
cargo build --release --locked --quiet --package ev3-localize --example update
brick=$(tools/cross.sh --example ev3-localize update armel)
for table in "" table; do
    # shellcheck disable=SC2086
    say_update here target/release/examples/update $table
    # shellcheck disable=SC2086
    say_update brick "$brick" $table
done
