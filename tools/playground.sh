#!/usr/bin/env bash
#
# Builds the playground, a folder of files for any web server:
#
#   dist/playground/
#
# Usage: tools/playground.sh [--state]
#
# --state builds only what the page loads: target/playground, with the saved state, state.prc.
#
# Environment: as for tools/page.sh; SWIPL, a native Prolog.
set -euo pipefail
cd "$(dirname "$0")/.."

swipl=${SWIPL:-swipl}
modules=target/playground
tools/page.sh
tools/modules.sh playground "$modules"
node playground/image.mjs "$modules" "$modules/state.prc"
[ "${1:-}" != --state ] || exit 0

# Those that need no thread, no other robot, no remote control and no file beside them
examples=(obstacle_avoidance square backtracking braitenberg line_following slalom traffic_light
    thermometer grid_navigation grid_lost lost explore_room rules_wander rules_light_seeker
    rules_line_follower rules_sumo rules_traffic_light rules_processes rules_bumper_car
    three_places
    clear_the_ring sort_parcels goal
    golog_elevator golog_delivery golog_rescue golog_wumpus golog_classic
    compare_planners)
"$swipl" -p library=prolog playground/examples.pl "${examples[@]}" >"$modules/examples.json"
"$swipl" -q -p library=prolog playground/words.pl >"$modules/words.json"
node playground/make.mjs "$modules" dist/playground
