#!/usr/bin/env bash
#
# The library for the EV3, cross-built, on an emulated EV3: calls every predicate
# once, and runs an example in the simulator.
#
# Usage: tools/smoke.sh
#
# Environment: as for tools/cross.sh and tools/emulate.sh

set -euo pipefail
# shellcheck source=tools/common.sh
source "$(dirname "$0")/common.sh"

main() {
    pack=$(mktemp -d)
    trap 'rm -rf "$pack"' EXIT
    "$root/tools/cross.sh" armel
    cp -R "$root/prolog" "$root/examples" "$root/pack.pl" "$pack/"
    install -D -m 644 "$root/target/dist/armel/ev3dev.so" "$pack/native/armel/ev3dev.so"
    on_brick "$root/tests/brick/smoke.pl"
    on_brick "$root/tests/brick/example.pl"
    on_brick "$root/tests/brick/things.pl"
    echo "3 passed, 0 failed"
}

on_brick() {
    EV3DEV_PACK=$pack EMULATED_HOME=$pack/home guarded "$root/tools/emulate.sh" armel \
        swipl -q -g main -t 'halt(1)' "$1" </dev/null
}

main
