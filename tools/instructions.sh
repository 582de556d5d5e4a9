#!/usr/bin/env bash
#
# Counts the instructions of an update of localization with 500 particles, and of
# what goes before it, with and without the table: on this machine by valgrind,
# and on the emulated EV3, one by one.
#
# Usage: tools/instructions.sh
set -euo pipefail
# shellcheck source=tools/common.sh
source "$(dirname "$0")/common.sh"

few=5
more=10

# ARGUMENTs of the program
count_here() {
    valgrind --tool=callgrind --callgrind-out-file=/dev/null \
        target/release/examples/update "$@" 2>&1 | sed -n 's/.*Collected : //p'
}

# qemu writes each block of instructions when it is translated, and its address
# each time that it runs. A program of its own, unlike the library, asks the
# processor for its thread, as those do that came after the EV3's.
count_brick() {
    EMULATED_CPU=arm1176 QEMU_LOG=in_asm,exec,nochain tools/emulate.sh armel "$brick" "$@" 2>&1 |
        awk '/^IN:/ { begins = 1 }
            /^0x/ { if (begins) { block = substr($1, 3, 8); size[block] = 0; begins = 0 }
                    size[block]++ }
            /^Trace/ { split($0, part, "/"); count += size[part[2]] }
            END { printf "%.0f\n", count }'
}

# say_update WHERE [table]
say_update() {
    local first last each
    first=$("count_$1" $few "${@:2}")
    last=$("count_$1" $more "${@:2}")
    each=$(((last - first) / (more - few)))
    echo "$1, ${2:-no table}: $each an update, $((first - few * each)) before"
}

have valgrind || die "valgrind is missing: install it"
cd "$root"
cargo build --release --locked --quiet --package ev3-localize --example update
brick=$(tools/cross.sh --example ev3-localize update)
# What is fetched first is not counted
tools/emulate.sh armel >/dev/null
for where in here brick; do
    say_update "$where"
    say_update "$where" table
done
