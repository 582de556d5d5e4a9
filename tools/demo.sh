#!/usr/bin/env bash
# Runs an example in the simulator, tells where the robot is going, and leaves a
# picture of its way: demo.svg.
#
#   tools/demo.sh [EXAMPLE] [SECONDS]
set -euo pipefail
cd "$(dirname "$0")/.."

example=${1:-obstacle_avoidance}
seconds=${2:-15}
if [ ! -f "examples/$example.pl" ]; then
    echo "There is no examples/$example.pl; there are:" examples/*.pl >&2
    exit 1
fi
exec "${SWIPL:-swipl}" -g "demo('$example', $seconds)" -t 'halt(1)' tools/demo.pl
