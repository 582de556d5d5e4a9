# shellcheck shell=bash
# What every script here starts with: where things are, how to fail, how two
# runs keep out of each other's way. Sourced, not run.

# The pack's root folder, and the git-ignored folder for all that is fetched.
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)
toolchain=${EV3DEV_TOOLCHAIN:-$root/.toolchain}
mkdir -p "$toolchain"

die() {
    echo "${0##*/}: $*" >&2
    exit 1
}

say() {
    echo "${0##*/}: $*" >&2
}

# have COMMAND...: are all of these there?
have() {
    local command
    for command; do
        command -v "$command" >/dev/null || return
    done
}

# locked NAME: one run at a time, until this script ends.
locked() {
    exec {lock_fd}>"$toolchain/$1.lock"
    flock -n "$lock_fd" || {
        say "waiting for another run"
        flock "$lock_fd"
    }
}

# is_made DIR KEY: was DIR completed by the recipe named KEY?
is_made() {
    [[ -e $1/.made && $(<"$1/.made") == "$2" ]]
}

# made DIR KEY: DIR is complete. Written last, so that what was interrupted
# is made again.
made() {
    echo "$2" >"$1/.made"
}
