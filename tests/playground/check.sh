#!/usr/bin/env bash
# Examples do the same in SWI-Prolog's WebAssembly build as natively: builds the
# library for pages, and compares traces.
#
#   tests/playground/check.sh [EXAMPLE...]
set -euo pipefail
cd "$(dirname "$0")/../.."
tools/page.sh
modules=target/playground
mkdir -p "$modules"
if ! cmp -s playground/package-lock.json "$modules/installed.json"; then
    cp playground/package.json playground/package-lock.json "$modules/"
    npm ci --prefix "$modules" --no-audit --no-fund --silent
    cp playground/package-lock.json "$modules/installed.json"
fi
node playground/image.mjs "$modules" "$modules/state.prc"
exec node tests/playground/traces.mjs "$modules" "$@"
