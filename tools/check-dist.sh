#!/usr/bin/env bash
#
# Makes the binary pack a second time, from a copy of the sources in another
# folder and with nothing built there, and fails unless the bytes are those in
# dist/.
#
# Usage: tools/check-dist.sh               after tools/dist.sh
#
# Environment: as for tools/dist.sh

set -euo pipefail
# shellcheck source=tools/common.sh
source "$(dirname "$0")/common.sh"

main() {
    local copy archive
    copy=$(mktemp -d)
    # shellcheck disable=SC2064
    trap "rm -rf '$copy'" EXIT
    tar -C "$root" --create --exclude=./.git --exclude=./.toolchain \
        --exclude=target --exclude=./dist --exclude=./lib . |
        tar -C "$copy" --extract
    # The copy has no history to take the time from.
    SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(git -C "$root" log -1 --format=%ct)}
    export SOURCE_DATE_EPOCH EV3DEV_TOOLCHAIN=$toolchain
    "$copy/tools/dist.sh" >/dev/null
    archive=$(basename "$copy"/dist/*.tgz)
    (cd "$root/dist" && sha256sum --check --quiet "$archive.sha256")
    cmp "$root/dist/$archive" "$copy/dist/$archive"
    echo "$archive: the same bytes in two folders"
}

main
