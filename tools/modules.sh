#!/usr/bin/env bash
#
# Installs the npm packages that a folder's package-lock.json names beside what is built, and again
# only if that changed. Says why, and fails, where it cannot.
#
# Usage: tools/modules.sh FOLDER TARGET
set -euo pipefail
cd "$(dirname "$0")/.."

from=$1
modules=$2
for program in node npm; do
    command -v "$program" >/dev/null || { echo "there is no $program (Debian's packages: nodejs npm)"; exit 1; }
done
[ "$(node -p 'process.versions.node.split(".")[0]')" -ge 18 ] || { echo "node is older than 18"; exit 1; }

# Two checks that run at the same time install them once
mkdir -p "$modules"
exec 9>"$modules/lock"
flock 9
if ! cmp -s "$from/package-lock.json" "$modules/installed.json"; then
    cp "$from/package.json" "$from/package-lock.json" "$modules/"
    npm ci --prefix "$modules" --no-audit --no-fund --silent 2>"$modules/npm.log" ||
        { echo "npm cannot install what $from/package.json names: $(tail -n 1 "$modules/npm.log")"; exit 1; }
    cp "$from/package-lock.json" "$modules/installed.json"
fi
