#!/usr/bin/env bash
#
# Runs SWI-Prolog as another machine or another release of Debian has it:
# Debian's packages are unpacked into .toolchain/swipl/<name>, and started
# through their own loader or, for another processor, by qemu.
#
# Usage: tools/emulate.sh NAME swipl ARG...    run it
#        tools/emulate.sh NAME                 only fetch it, print its folder
#        tools/emulate.sh                      list the names
#
# A bare processor stands for its 9.0.4: `tools/emulate.sh armel swipl` is as
# near to a brick as a PC gets.
#
# It sees neither the packs nor the settings of this machine. Environment:
#   EMULATED_HOME   its home (default: .toolchain/swipl/<name>/home)
#   EMULATED_PATH   its PATH (default: ours)
#   EMULATED_CPU    the processor that armel has (default: arm926, which is the EV3's)
# and those of tools/debian.sh; EV3DEV_TOOLCHAIN (see toolchain.sh).

set -euo pipefail
# shellcheck source=tools/common.sh
source "$(dirname "$0")/common.sh"
# shellcheck source=tools/debian.sh
source "$root/tools/debian.sh"

# name           suite     architecture  library folder
known='
8.2.4            bullseye  amd64         x86_64-linux-gnu
8.2.4-armhf      bullseye  armhf         arm-linux-gnueabihf
8.2.4-arm64      bullseye  arm64         aarch64-linux-gnu
9.0.4            bookworm  amd64         x86_64-linux-gnu
9.0.4-armel      bookworm  armel         arm-linux-gnueabi
9.0.4-armhf      bookworm  armhf         arm-linux-gnueabihf
9.0.4-arm64      bookworm  arm64         aarch64-linux-gnu
9.2.9            trixie    amd64         x86_64-linux-gnu
9.2.9-armhf      trixie    armhf         arm-linux-gnueabihf
9.2.9-arm64      trixie    arm64         aarch64-linux-gnu
'

main() {
    local name=${1:-} suite arch triplet
    if [[ -z $name ]]; then
        awk 'NF { print $1 }' <<<"$known"
        return
    fi
    case $name in
    armel | armhf | arm64) name=9.0.4-$name ;;
    esac
    read -r suite arch triplet < <(
        awk -v name="$name" '$1 == name { print $2, $3, $4 }' <<<"$known"
    ) || die "no such SWI-Prolog: $name (without arguments I list them)"
    shift

    local dir=$toolchain/swipl/$name key="$suite $arch 1"
    [[ $arch == amd64 ]] || (fetch_qemu)
    is_made "$dir" "$key" || (fetch "$dir" "$suite" "$arch" "$triplet" "$key")
    if [[ $# -eq 0 ]]; then
        echo "$dir"
    else
        run "$dir" "$arch" "$triplet" "$@"
    fi
}

fetch() {
    local dir=$1 suite=$2 arch=$3 triplet=$4 key=$5 apt=$toolchain/apt-$2-$3
    locked emulate
    is_made "$dir" "$key" && return
    say "fetching SWI-Prolog of Debian $suite for $arch"
    rm -rf "$dir" "$apt"
    debian_pinned "$apt" "$suite" "$arch" swi-prolog-nox || {
        debian_apt_new "$apt" "$suite" "$arch"
        # wanted by maintainer scripts only, which nobody runs here
        debian_pretend "$apt" "$arch" debconf
        debian_closure "$apt" swi-prolog-nox
    }
    debian_unpack "$apt" "$dir"
    debian_forget "$apt"
    # since trixie /lib is /usr/lib
    [[ -e $dir/lib ]] || ln -s usr/lib "$dir/lib"
    # What Debian does when it installs the package.
    (
        unset EMULATED_HOME EMULATED_PATH
        run "$dir" "$arch" "$triplet" swipl -q \
            -g "make_library_index(swi(library))" -t halt </dev/null
    ) || true
    [[ -e $dir/usr/lib/swi-prolog/library/INDEX.pl ]] ||
        die "SWI-Prolog of Debian $suite for $arch does not start"
    made "$dir" "$key"
}

# One static program for each processor; the system's serves as well.
fetch_qemu() {
    local dir=$toolchain/qemu apt=$toolchain/apt-qemu
    ! have qemu-arm-static qemu-aarch64-static || return 0
    ! is_made "$dir" 1 || return 0
    locked emulate
    say "fetching qemu"
    rm -rf "$dir" "$apt"
    debian_download "$apt" bookworm amd64 qemu-user-static
    debian_unpack "$apt" "$dir"
    debian_forget "$apt"
    find "$dir" -type f ! -name qemu-arm-static ! -name qemu-aarch64-static -delete
    made "$dir" 1
}

# Replaces this process. The program's own loader gets the folders to look in;
# qemu's -L would show some system calls the unpacked root and others ours.
run() {
    local dir=$1 arch=$2 triplet=$3 program=$4 home=${EMULATED_HOME:-$1/home}
    local libraries=$dir/usr/lib/$triplet:$dir/lib/$triplet:$dir/usr/lib
    local loader=("$dir/lib/$triplet"/ld-linux*.so.*) emulator=()
    shift 4
    [[ $program == /* ]] || program=$dir/usr/bin/$program
    case $arch in
    armel) emulator=("$(qemu arm)" -cpu "${EMULATED_CPU:-arm926}") ;;
    armhf) emulator=("$(qemu arm)") ;;
    arm64) emulator=("$(qemu aarch64)") ;;
    esac

    mkdir -p "$home"
    unset XDG_DATA_HOME XDG_CONFIG_HOME XDG_CACHE_HOME
    export HOME=$home XDG_DATA_DIRS=$home/data XDG_CONFIG_DIRS=$home/config
    export SWI_HOME_DIR=$dir/usr/lib/swi-prolog PATH=${EMULATED_PATH:-$PATH}
    exec "${emulator[@]}" "${loader[0]}" --library-path "$libraries" "$program" "$@"
}

qemu() {
    command -v "qemu-$1-static" || echo "$toolchain/qemu/usr/bin/qemu-$1-static"
}

main "$@"
