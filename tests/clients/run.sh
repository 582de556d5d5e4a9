#!/usr/bin/env bash
# Programs in other languages on the simulator's mount.
#
#   tests/clients/run.sh
#
# Skips, and says so, where there is no FUSE or python-ev3dev2 cannot be had.
set -euo pipefail
cd "$(dirname "$0")/../.."

skip() {
    echo "skipped: $1"
    exit 0
}
[ -e /dev/fuse ] || skip "there is no /dev/fuse"

venv=target/clients/venv
if [ ! -x "$venv/bin/python" ] || ! "$venv/bin/python" -c 'import ev3dev2, evdev' 2>/dev/null; then
    python3 -m venv "$venv" 2>/dev/null || skip "python3 has no venv"
    "$venv/bin/python" -m pip install -q python-ev3dev2==2.1.0.post1 evdev-binary==2.0.0 ||
        skip "python-ev3dev2 cannot be installed"
fi

mount=$(mktemp -d)
mkdir "$mount.dev"
mkfifo "$mount.over"
# Mounted for as long as somebody may still write to the pipe.
"${SWIPL:-swipl}" -p library=prolog -g "serve('$mount')" -t 'halt(1)' \
    tests/clients/serve.pl <"$mount.over" &
server=$!
exec 3>"$mount.over"
trap 'exec 3>&-; wait $server || true; rm -rf "$mount" "$mount.dev" "$mount.over"' EXIT

until [ -d "$mount/tacho-motor" ] && [ -e "$mount.dev/fb0" ]; do
    kill -0 $server 2>/dev/null || skip "the tree could not be mounted"
    sleep 0.1
done
EV3DEV_DEV="$mount.dev" EV3_SERVER="$mount.over" \
    "$venv/bin/python" tests/clients/python_client.py "$mount"
