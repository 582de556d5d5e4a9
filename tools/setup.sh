#!/usr/bin/env bash
# Installs SWI-Prolog where it is missing and may be installed; otherwise says
# in one sentence what to do.
set -euo pipefail

if command -v "${SWIPL:-swipl}" >/dev/null; then
    exit 0
fi
if command -v apt-get >/dev/null && [ "$(id -u)" = 0 ]; then
    # bubblewrap shuts in the programs that are marked
    echo "Installing SWI-Prolog (swi-prolog-nox) and bubblewrap ..." >&2
    apt-get update -qq >&2
    DEBIAN_FRONTEND=noninteractive apt-get install -y -qq swi-prolog-nox bubblewrap >&2
else
    echo "SWI-Prolog is missing: install it, on Debian and Ubuntu by 'sudo apt-get install swi-prolog-nox'." >&2
    exit 1
fi
