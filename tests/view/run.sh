#!/usr/bin/env bash
# The page of library(ev3dev/view), driven in a headless Chromium; and what the
# tests name IN_FIREFOX in Firefox, which takes a minute.
#
#   tests/view/run.sh [--pictures | --figures | --chromium | --firefox] [ARGUMENT...]
#
# Arguments go to `node --test`, as --test-name-pattern=STOP, in Chromium alone;
# with --firefox in Firefox alone. With --pictures it makes the pictures of
# docs/pictures instead, with --figures it prints how long things take.
#
# Skips, and says so, where there is no Chromium, no Firefox, no node 18, or
# where npm cannot install the two packages that package-lock.json names; with
# EV3DEV_BROWSER=required that is an error. CHROMIUM and FIREFOX name other
# browsers of their kinds.
set -euo pipefail
cd "$(dirname "$0")/../.."

skip() {
    echo "skipped: the page in a browser: $1"
    [ "${EV3DEV_BROWSER:-}" != required ]
    exit
}

firefox=${FIREFOX:-$(command -v firefox-esr || command -v firefox || true)}
unset FIREFOX # which says to the tests in what they run
browser=${CHROMIUM:-$(command -v chromium || command -v chromium-browser || command -v google-chrome || true)}
[ -n "$browser" ] || [ "${1:-}" = --firefox ] || skip "there is no Chromium (Debian's package: chromium)"
modules=target/view
why=$(tools/modules.sh tests/view "$modules") || skip "$why"

in_firefox() {
    [ -n "$firefox" ] || skip "there is no Firefox (Debian's package: firefox-esr)"
    FIREFOX=$firefox node --test --test-reporter=spec "$@" tests/view/view.test.mjs
}

export CHROMIUM=$browser EV3DEV_NODE_MODULES=$PWD/$modules
case ${1:-} in
    --pictures) exec node tests/view/pictures.mjs "${@:2}" ;;
    --figures) exec node tests/view/figures.mjs "${@:2}" ;;
    --chromium) exec node --test --test-reporter=spec "${@:2}" tests/view/view.test.mjs ;;
    --firefox)
        in_firefox "${@:2}"
        exit
        ;;
esac
node --test --test-reporter=spec "$@" tests/view/view.test.mjs
[ $# -gt 0 ] || in_firefox
