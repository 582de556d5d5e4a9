#!/usr/bin/env bash
# The site, as `make site` builds it: a lesson from its first page to a marked exercise, in a
# headless Chromium, from a disk and without a network.
#
#   tests/site/check.sh [ARGUMENT...]     of `node --test`
set -euo pipefail
cd "$(dirname "$0")/../.."

why=$(tools/modules.sh tests/view target/view) || { echo "skipped: the site in a browser: $why"; exit 0; }
CHROMIUM=${CHROMIUM:-$(command -v chromium || command -v chromium-browser || command -v google-chrome || true)}
[ -n "$CHROMIUM" ] || { echo "skipped: the site in a browser: there is no Chromium"; exit 0; }
export CHROMIUM EV3DEV_NODE_MODULES=$PWD/target/view
unset FIREFOX
exec node --test --test-reporter=spec "$@" tests/site/lesson.test.mjs
