#!/usr/bin/env bash
# Examples do the same in SWI-Prolog's WebAssembly build as natively: builds the
# library for pages, and compares traces.
#
#   tests/playground/check.sh [EXAMPLE...]
set -euo pipefail
cd "$(dirname "$0")/../.."
tools/playground.sh --state
exec node tests/playground/traces.mjs target/playground "$@"
