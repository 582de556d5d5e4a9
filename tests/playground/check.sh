#!/usr/bin/env bash
# The playground: examples do the same in SWI-Prolog's WebAssembly build as natively, byte for
# byte, and the page does what a person expects, in Chromium and in Firefox.
#
#   tests/playground/check.sh [--traces [EXAMPLE...] | --marks [EXERCISE...] |
#       --page [ARGUMENT...] | --figures | --pictures]
#
# Arguments of --page go to `node --test`, in Chromium alone. --figures prints how long things
# take, --pictures makes those of docs/playground.md; these and --page take what `make playground`
# has built. Without a browser only traces and marks are compared, and it says so.
set -euo pipefail
cd "$(dirname "$0")/../.."

what=${1:---all}
[ $# -eq 0 ] || shift
case $what in
    --traces | --marks) tools/playground.sh --state ;;
    --all) tools/playground.sh ;;
esac
case $what in
    --traces | --all) node tests/playground/traces.mjs target/playground "$@" ;;&
    --marks | --all) node tests/playground/marks.mjs target/playground "$@" ;;
esac
case $what in
    --traces | --marks) exit 0 ;;
esac

why=$(tools/modules.sh tests/view target/view) || { echo "skipped: the playground in a browser: $why"; exit 0; }
firefox=${FIREFOX:-$(command -v firefox-esr || command -v firefox || true)}
unset FIREFOX
CHROMIUM=${CHROMIUM:-$(command -v chromium || command -v chromium-browser || command -v google-chrome || true)}
[ -n "$CHROMIUM" ] || { echo "skipped: the playground in a browser: there is no Chromium"; exit 0; }
export CHROMIUM EV3DEV_NODE_MODULES=$PWD/target/view
case $what in
    --figures | --pictures) exec node "tests/playground/${what#--}.mjs" ;;
esac
node --test --test-reporter=spec "$@" tests/playground/page.test.mjs
[ $# -gt 0 ] || [ -z "$firefox" ] ||
    FIREFOX=$firefox node --test --test-reporter=spec tests/playground/page.test.mjs
