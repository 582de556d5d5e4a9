#!/usr/bin/env bash
#
# Says in docs/checked.md that `make check-all` passed, on which commit.
#
# Usage: tools/checked.sh

set -euo pipefail
# shellcheck source=tools/common.sh
source "$(dirname "$0")/common.sh"

# The scores of mutants, which it does not measure
kept=$(sed -n '/^## /,$p' "$root/docs/checked.md")
commit=$(git -C "$root" describe --always --dirty --abbrev=12)
{
    echo "# When everything was last checked"
    echo
    echo "\`make check-all\` passed on commit $commit, $(date -u +%F), with"
    "${SWIPL:-swipl}" --version | sed 's/^/- /'
    [[ -z ${SWIPL_723:-} ]] || "$SWIPL_723" --version | sed 's/^/- /'
    [[ -z ${SWIPL_101:-} ]] || "$SWIPL_101" --version | sed 's/^/- /'
    echo "- those of Debian bullseye, bookworm and trixie, and bookworm's on an emulated EV3"
    [[ -z $kept ]] || printf '\n%s\n' "$kept"
} >"$root/docs/checked.md"
cat "$root/docs/checked.md"
