#!/usr/bin/env bash
# Runs an example in the simulator, says where the robot is going, and leaves a
# picture of its way: demo.svg.
#
#   tools/demo.sh [EXAMPLE] [SECONDS]
#
# VIEW=1 shows it in a browser, too, as fast as in reality; so does a display, except
# with VIEW=0. The address is printed first.
set -euo pipefail
cd "$(dirname "$0")/.."

example=${1:-obstacle_avoidance}
view=${VIEW:-}
if [ -z "$view" ] && [ -n "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ]; then view=1; fi
case $view in
    "" | 0 | no | false) view=false seconds=${2:-15} ;;
    *) view=true seconds=${2:-120} ;;
esac
if [ ! -f "examples/$example.pl" ]; then
    echo "There is no examples/$example.pl; there are:" examples/*.pl >&2
    exit 1
fi
exec "${SWIPL:-swipl}" -g "show('$example', $seconds, $view)" -t 'halt(1)' tools/demo.pl
