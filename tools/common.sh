# shellcheck shell=bash
# The beginning of every script here: where things are, how to fail, how two
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

# guarded COMMAND...: ends it after two hours, which no check takes, and says so
guarded() {
    local status=0
    "$(PATH=/usr/bin:/bin type -P timeout)" -k 10 7200 "$@" || status=$?
    [[ $status != 124 ]] || say "ended after two hours: it hangs, or this machine is too busy"
    return $status
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

# version: the pack's
version() {
    local version=
    if [[ -e $root/pack.pl ]]; then
        version=$(sed -n "s/^version('\(.*\)')\..*/\1/p" "$root/pack.pl")
    else
        version=$(sed -n 's/^version = "\(.*\)"$/\1/p' "$root/Cargo.toml" | head -n 1)
    fi
    [[ -n $version ]] || die "no version in pack.pl"
    echo "$version"
}

# pack STAGE NAME ARCHIVE: folder NAME of STAGE as a .tgz, and its checksum
# beside it. The same files make the same bytes: their time is that of the last
# commit, or SOURCE_DATE_EPOCH. It is never 0: SWI-Prolog 9.0.4 autoloads a
# library of that time again and again, until its stack is full.
pack() {
    local stage=$1 name=$2 archive=$3 time
    time=${SOURCE_DATE_EPOCH:-$(git -C "$root" log -1 --format=%ct 2>/dev/null || echo 1)}
    [[ $time != 0 ]] || time=1
    tar -C "$stage" --create --format=ustar --sort=name --mtime="@$time" \
        --owner=0 --group=0 --numeric-owner --mode=u=rwX,go=rX "$name" |
        gzip -n -9 >"$archive.new"
    mv "$archive.new" "$archive"
    (cd "${archive%/*}" && sha256sum "${archive##*/}" >"${archive##*/}.sha256")
}
