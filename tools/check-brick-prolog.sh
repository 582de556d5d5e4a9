#!/usr/bin/env bash
#
# Tries brick-prolog on an emulated EV3 that has nothing else: a new root folder
# with the unpacked archive, in a folder whose name has a space, and a static
# busybox as /bin/sh and /usr/bin/env. It has no C library and no loader but the
# archive's.
#
# Usage: tools/check-brick-prolog.sh       after tools/brick-prolog.sh
#
# This needs no root, but a kernel that lets a user namespace start the programs
# of another processor by qemu: Linux 6.7 or later. Elsewhere a message says so,
# checks that start a second program are left out, and Prolog sees this machine's
# files.
#
# Environment: ARCHIVE  what to try (default: dist/brick-prolog-<version>.tgz)
#              PACK     the pack to install in it (default:
#                       dist/ev3dev-<version>.tgz; none if it is not there)
# and those of tools/emulate.sh.

set -euo pipefail
# shellcheck source=tools/common.sh
source "$(dirname "$0")/common.sh"

passed=0 failed=0 skipped=0

main() {
    archive=${ARCHIVE:-$root/dist/brick-prolog-$(version).tgz}
    pack=${PACK:-$root/dist/ev3dev-$(version).tgz}
    qemu=$(command -v qemu-arm-static || echo "$toolchain/qemu/usr/bin/qemu-arm-static")
    # How a 32 bit program for ARM begins, and which bits of that count
    magic='\x7fELF\x01\x01\x01\x00\x00\x00\x00\x00\x00\x00\x00\x00\x02\x00\x28\x00'
    mask='\xff\xff\xff\xff\xff\xff\xff\x00\xff\xff\xff\xff\xff\xff\xff\xff\xfe\xff\xff\xff'

    if [[ ${1:-} == --inside ]]; then
        work=$2
        mount_all
        try_all
        return
    fi
    [[ -r $archive ]] || die "there is no ${archive#"$root"/}: run tools/brick-prolog.sh"
    [[ -x $qemu ]] || "$root/tools/emulate.sh" armel >/dev/null
    work=$(mktemp -d)
    trap 'rm -rf "$work"' EXIT
    make_root
    if alone mount -t binfmt_misc binfmt_misc "$work/binfmt" 2>/dev/null; then
        alone "$BASH" "$0" --inside "$work"
    else
        say "no user namespaces with binfmt_misc here: some checks are left out," \
            "and the others see this machine's files"
        try_all
    fi
}

# alone COMMAND...: as root of namespaces of its own
alone() {
    unshare --user --map-root-user --mount "$@"
}

make_root() {
    local new=$work/root busybox=$toolchain/brick-prolog/bin/busybox
    [[ -x $busybox ]] || die "there is no busybox: run tools/brick-prolog.sh"
    mkdir -p "$work/binfmt" "$new"/{bin,dev,opt,proc,tmp,usr/bin,usr/local/bin} \
        "$new/home/robot/my tools"
    install -m 755 "$busybox" "$new/bin/busybox"
    ln -s busybox "$new/bin/sh"
    ln -s ../../bin/busybox "$new/usr/bin/env"
    tar -xzf "$archive" -C "$new/home/robot/my tools"
    ln -s '/home/robot/my tools/brick-prolog' "$new/opt/brick-prolog"
    ln -s /opt/brick-prolog/bin/swipl "$new/usr/local/bin/swipl"
    cp "$root"/tools/check-brick-prolog.pl "$root"/tests/brick/{smoke,example}.pl \
        "$new/home/robot/"
    [[ ! -r $pack ]] || cp "$pack" "$new/home/robot/"
    script '#!/usr/bin/env swipl' by-env
    script '#!/opt/brick-prolog/bin/swipl' by-name
}

# script LINE NAME: a program that prints its arguments
script() {
    local file=$work/root/home/robot/$2
    printf '%s\n' "$1" ':- initialization(main, main).' \
        'main :- current_prolog_flag(argv, Argv), print(Argv), nl.' >"$file"
    chmod +x "$file"
}

mount_all() {
    local new=$work/root name
    mount --rbind /proc "$new/proc"
    for name in null random urandom zero; do
        : >"$new/dev/$name"
        mount --bind "/dev/$name" "$new/dev/$name"
    done
    mount -t binfmt_misc binfmt_misc "$work/binfmt"
    # F: qemu is opened now, and need not be in the new root.
    printf ':ev3:M::%s:%s:%s:F' "$magic" "$mask" "$qemu" >"$work/binfmt/register"
    chroot=$(command -v chroot)
}

try_all() {
    # brick-prolog's folder, as Prolog sees it
    here='/home/robot/my tools/brick-prolog'
    [[ -n ${chroot:-} ]] || here=$work/root$here
    touch "$work/stamp"

    step "the toplevel answers" toplevel
    step "flags tell what was started" goal flags "$here"
    step "every foreign library finds what it needs" goal foreign_libraries
    step "text is UTF-8" goal unicode größe€
    step "plunit runs a test" goal plunit
    step "HTTP: a page is served and fetched" goal http
    step_apart "text is UTF-8, whatever LANG is" \
        with LANG=de_DE.UTF-8 goal unicode größe€
    step_apart "text is UTF-8, whatever LC_ALL is" \
        with LC_ALL=POSIX goal unicode größe€
    step_apart "SWI_HOME_DIR may be another's" \
        with SWI_HOME_DIR=/home/robot goal flags "$here"
    step_apart "by a relative name" says 'SWI-Prolog version 9.0.4 for armv7l-linux' \
        brick /bin/sh -c 'cd "my tools" && brick-prolog/bin/swipl --version'
    step_apart "a script, by /usr/bin/env" says "['-c',b]" brick ./by-env -c b
    step_apart "a script, by the command's name" says "['-c',b]" brick ./by-name -c b
    step_apart "another swipl, by name and by the flag" goal children
    step_apart "programs see none of its settings" \
        with LC_ALL=POSIX goal environment
    step_apart "a saved state" saved_state
    step "nothing is written into its folder" nothing_written
    try_pack
    echo "$passed passed, $failed failed, $skipped skipped"
    [[ $failed == 0 ]]
}

try_pack() {
    [[ ! -r $pack ]] ||
        step "pack_install" swipl -q -t halt \
            -g "pack_install('${pack##*/}', [interactive(false), upgrade(true)])"
    if [[ -e "$work/root/home/robot/my tools/brick-prolog/pack/ev3dev" ]]; then
        step "the pack's library" goal pack_library
        step "every predicate of the pack" swipl -q -g main -t 'halt(1)' smoke.pl
        step "an example of the pack" swipl -q -g main -t 'halt(1)' example.pl
    else
        skip "the pack is not there"
    fi
}

toplevel() {
    says 'X = 42.' piped 'X is 6*7.' swipl -q
}

saved_state() {
    goal save_state
    # It would start the flag's file, but does not quote the space in its name.
    says saved with SWIPL=/opt/brick-prolog/bin/swipl brick ./state
}

nothing_written() {
    ! find "$work/root/home/robot/my tools" -newer "$work/stamp" | grep .
}

# goal NAME ARG...: of check-brick-prolog.pl
goal() {
    local name=$1
    shift
    swipl -q -g "$name" -t 'halt(1)' check-brick-prolog.pl "$@"
}

# Where this machine cannot start bin/swipl, what that would do
swipl() {
    if [[ -n ${chroot:-} ]]; then
        brick /opt/brick-prolog/bin/swipl "$@"
        return
    fi
    (
        cd "$work/root/home/robot"
        guarded env -i PATH="$PATH" HOME="$PWD" \
            LOCPATH="$here/lib/locale" LC_ALL=C.UTF-8 \
            "$qemu" -cpu arm926 "$here/libexec/swipl" \
            --library-path "$here/lib" --argv0 "$here/bin/swipl" \
            "$here/libexec/prolog" "$@"
    )
}

# brick COMMAND...: in the new root, with the variables of with
brick() {
    guarded env -i PATH=/usr/local/bin:/usr/bin:/bin HOME=/home/robot \
        QEMU_CPU=arm926 QEMU_UNAME=4.14.117 ${variable:+"$variable"} \
        "$chroot" "$work/root" /bin/sh -c 'cd && exec "$@"' sh "$@"
}

# with NAME=VALUE COMMAND...
with() {
    local variable=$1
    shift
    "$@"
}

piped() {
    printf '%s\n' "$1" | "${@:2}"
}

# says TEXT COMMAND...: does the command print just that?
says() {
    local output
    output=$("${@:2}")
    echo "$output"
    [[ $output == "$1" ]]
}

# step_apart TEXT COMMAND...: a step that starts programs in the new root
step_apart() {
    if [[ -n ${chroot:-} ]]; then
        step "$@"
    else
        skip "$1"
    fi
}

# step TEXT COMMAND...: silent unless it goes wrong
step() {
    local text=$1 log=$work/log
    shift
    if "$@" </dev/null >"$log" 2>&1 && ! grep -qE '^(Warning|ERROR)' "$log"; then
        passed=$((passed + 1))
        echo "ok      $text"
    else
        failed=$((failed + 1))
        echo "FAILED  $text"
        sed 's/^/        /' "$log"
    fi
}

skip() {
    skipped=$((skipped + 1))
    echo "skipped $1"
}

main "$@"
