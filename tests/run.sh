#!/usr/bin/env bash
# Runs checks side by side, each in a session of its own, and sums them up.
#
#   tests/run.sh [JOB...]         default: all of tests/prolog and tests/behavior
#
# A JOB is a file of plunit, or NAME=COMMAND: a command of the shell. One that took long the
# last time is started early; target/check-times has that.
#
# Tests of devices run over several trees (see tests/support/trees.pl): plain
# files, the simulator within the process, and its mount where FUSE can be had.
# TREES leaves out those that it does not name, as in TREES="plain simulator".
#
# SWIPL names another Prolog, JOBS how many run at once (default: one for each
# processor, and four that wait). A leftover choice point or any other warning fails
# the run (before SWI-Prolog 9 a failed test alone). So does a job of which a process
# computes for LIMIT seconds, 1800 by default, or which in ten minutes prints nothing and
# neither computes nor waits for a processor for half a minute. No limit is about how long
# a job takes: that depends on the rest of the machine. Hints (tests/behavior/test_hints.pl) are off, as tests make many calls that
# fail.
set -euo pipefail
cd "$(dirname "$0")/.."

export SWIPL=${SWIPL:-swipl}
times=target/check-times
logs=$(mktemp -d)

main() {
    local jobs running=0 number=0 job
    [ $# -gt 0 ] || set -- tests/{prolog,behavior}/test_*.pl
    readarray -t jobs < <(by_length "$@")
    trap 'end_all; rm -rf "$logs"' EXIT
    trap 'exit 130' INT TERM HUP
    watch_idle &
    watcher=$!
    SECONDS=0
    for job in "${jobs[@]}"; do
        if [ $running -ge "${JOBS:-$(($(nproc) + 4))}" ]; then
            wait -n -p ended || true
            [ "$ended" = $watcher ] || running=$((running - 1))
        fi
        number=$((number + 1))
        one $number "$job" &
        running=$((running + 1))
    done
    while [ "$(find "$logs" -name '*.result' | wc -l)" -lt $number ]; do
        wait -n || true
    done
    summary "${#jobs[@]}"
}

# by_length JOB...: those that took longest come first, unknown ones before them, the large
# files first
by_length() {
    local job size
    for job; do
        size=$(stat -c %s -- "$job" 2>/dev/null || echo 1000000000)
        printf '%s\t%s\n' "$size" "$job"
    done | awk -F '\t' -v times="$times" '
        BEGIN { while ((getline <times) > 0) took[$2] = $1 }
        { known = ($2 in took)
          print (known ? took[$2] : 1e6) "\t" $1 "\t" $2 }' |
        sort -t $'\t' -k 1,1rn -k 2,2rn | cut -f 3
}

# one NUMBER JOB: its output when it is over
one() {
    local base=$logs/$1 job=$2 name=${2%%=*} how=passed wall cpu
    begin "$job" "$base" || how=failed
    read -r wall cpu <"$base.took"
    [ $how = failed ] || ! only_skipped "$base.log" || how=skipped
    {
        printf '== %s: %s, %s s, %s s of a processor\n' "$name" $how "$wall" "$cpu"
        cat "$base.log"
    }
    printf '%s\t%s\t%s\t%s\n' $how "$wall" "$cpu" "$name" >"$base.new"
    mv "$base.new" "$base.result"
}

# begin JOB BASE: runs it in a session of its own, whose number is in BASE.session
begin() {
    local TIMEFORMAT="%1R %1U+%1S" how=0 left
    mkdir "$2.tmp"
    # Prolog and C libraries look at TMP, the others at TMPDIR
    # shellcheck disable=SC2016
    { time TMP=$2.tmp TMPDIR=$2.tmp setsid --wait bash -c '
        echo $$ >"$2.session"
        ulimit -S -t "${LIMIT:-1800}"
        case $1 in
        *=*) eval "${1#*=}" ;;
        *) exec "$SWIPL" --on-warning=status --on-error=status -g "$3" -t halt "$1" ;;
        esac' -- "$1" "$2" "$plunit" </dev/null >"$2.log" 2>&1; } 2>"$2.time" || how=$?
    rm -f "$2.session"
    left=$(find "$2.tmp" -mindepth 1 -maxdepth 1 -printf '%f ' | head -c 300)
    if [ -n "$left" ]; then
        echo "ERROR: left in the folder of temporary files: $left" >>"$2.log"
        how=1
    fi
    tail -n 1 "$2.time" | awk '{ split($2, cpu, "+"); print $1, cpu[1] + cpu[2] }' >"$2.took"
    return $how
}

# Newer versions of plunit take a warning that a test expects for one of its faults, unless
# they print what a test prints.
plunit="set_prolog_flag(ev3dev_hints,off),catch(set_test_options([output(always)]),_,true),(run_tests->true;halt(1))"

# A job that says nothing but why it did nothing
only_skipped() {
    [ -s "$1" ] && ! grep -qv '^skipped: ' "$1"
}

# A job that prints nothing for ten minutes, and hardly computes or wants to, waits for what will
# never come; a server that it has started computes a little all the time
watch_idle() {
    trap - EXIT
    local -A since=() printed=() looks=()
    local session of now size
    while sleep 15; do
        for session in "$logs"/*.session; do
            of=$(cat "$session" 2>/dev/null || true)
            [ -n "$of" ] || continue
            now=$(ticks "$of")
            size=$(stat -c %s "${session%.session}.log")
            # Less than before: a process has ended
            if [ "$size" = "${printed[$of]:-}" ] && [ "$now" -ge "${since[$of]}" ] &&
                [ $((now - ${since[$of]})) -lt 3000 ]; then
                looks[$of]=$((${looks[$of]} + 1))
            else
                since[$of]=$now printed[$of]=$size looks[$of]=0
            fi
            if [ "${looks[$of]}" -ge 40 ]; then
                echo "ERROR: ended, as it has done nothing for ten minutes" >>"${session%.session}.log"
                kill -KILL -- "-$of" || true
            fi
        done
    done
}

# ticks SESSION: hundredths of a second that its processes and their children in other sessions have
# computed, and that their threads have waited for a processor
ticks() {
    local pid ended
    while read -r pid ended; do
        echo "${ended}0000000 0" # of those that have ended, as their parent knows it
        cat "/proc/$pid"/task/*/schedstat 2>/dev/null || true
    done < <({ cat /proc/[0-9]*/stat 2>/dev/null || true; } | sed 's/ (.*) / /' |
        awk -v session="$1" '
            { parent[$1] = $3; ended[$1] = $15 + $16; if ($5 == session) ours[$1] }
            END {
                do {
                    more = 0
                    for (p in parent)
                        if (!(p in ours) && parent[p] in ours) { ours[p]; more = 1 }
                } while (more)
                for (p in ours) print p, ended[p]
            }') |
        awk '{ all += $1 + $2 } END { printf "%d\n", all / 10000000 }'
}

end_all() {
    local session
    kill $watcher 2>/dev/null || true
    for session in "$logs"/*.session; do
        [ ! -e "$session" ] || kill -KILL -- "-$(cat "$session")" 2>/dev/null || true
    done
}

summary() {
    local how name base
    echo "== Summary"
    for base in "$logs"/*.result; do
        base=${base%.result}
        IFS=$'\t' read -r how _ _ name <"$base.result"
        [ "$how" = failed ] || continue
        echo "FAILED: $name"
        first_lines "$base.log" | cut -c 1-160 | sed 's/^/    /'
    done
    cat "$logs"/*.log | sed -n 's/^\(skipped: .*\)/\1/p' | sort -u
    remember
    echo "longest: $(cat "$logs"/*.result | sort -t $'\t' -k 2,2rn | head -n 6 |
        awk -F '\t' '{ printf "%s%s %d s", sep, $4, $2; sep = ", " }')"
    sed -nE 's/^% All ([0-9]+) (\(\+([0-9]+) sub-tests\) )?tests passed.*/\1 \3/p; s/^% [Tt]est passed.*/1/p' "$logs"/*.log |
        awk '{ tests += $1 + $2 } END { print tests+0 " tests of Prolog passed" }'
    cat "$logs"/*.result | awk -F '\t' -v took=$SECONDS '
        { count[$1]++; cpu += $3 }
        END { printf "%d s, %d s of processors\n%d passed, %d failed, %d skipped\n",
                  took, cpu, count["passed"], count["failed"], count["skipped"] }'
    ! grep -q '^failed' "$logs"/*.result
}

# first_lines LOG: where it goes wrong, or else its end
first_lines() {
    local lines
    lines=$(grep -nEm 1 '(^|[^a-z])(ERROR|Warning|FAILED|not ok|panicked|error)' "$1" | cut -d : -f 1 || true)
    if [ -n "$lines" ]; then
        sed -n "$lines,$((lines + 7))p" "$1"
    else
        tail -n 8 "$1"
    fi
}

remember() {
    mkdir -p target
    touch "$times"
    cat "$logs"/*.result "$times" |
        awk -F '\t' 'NF == 4 && !seen[$4]++ { print $2 "\t" $4 }
                     NF == 2 && !seen[$2]++' >"$logs/times"
    cp "$logs/times" "$times"
}

main "$@"
