#!/usr/bin/env bash
#
# Holds a foreign library to what the machine it is for can load.
#
# Usage: tools/check-elf.sh TARGET FILE        TARGET as for tools/cross.sh
#
# Prints one line, or one for each thing that is wrong and fails. Needs
# readelf (package binutils).

set -euo pipefail
# shellcheck source=tools/common.sh
source "$(dirname "$0")/common.sh"
# shellcheck source=tools/targets.sh
source "$root/tools/targets.sh"

# What SWI-Prolog 7.2.3 lacks. Every symbol is bound when the library is
# loaded, so one of these would keep it from loading there.
missing_in_723='PL_new_atom_mbchars PL_cvt_i_uint64 PL_unify_uint64 PL_put_uint64
PL_is_dict PL_put_dict PL_get_dict_key PL_duplicate_record PL_set_resource_db_mem'

libraries='libc.so.6 libm.so.6 libdl.so.2 libpthread.so.0 librt.so.1
ld-linux.so.3 ld-linux-armhf.so.3 ld-linux-aarch64.so.1 ld-linux-x86-64.so.2'

wrong=0

main() {
    [[ $# -eq 2 ]] || die "usage: tools/check-elf.sh TARGET FILE"
    local name=$1 file=$2 header limit size oldest
    have readelf || die "readelf is missing: install binutils"
    [[ -r $file ]] || die "no such file: $file"
    header=$(readelf -hW "$file")

    expect "$header" 'Type: +DYN'
    case $name in
    armel)
        expect "$header" 'Class: +ELF32' 'Machine: +ARM' 'Flags:.* soft-float ABI'
        expect "$(readelf -A "$file")" 'Tag_CPU_arch: v5TE'
        refuse "$(readelf -A "$file")" 'Tag_FP_arch|Tag_ABI_VFP_args'
        ;;
    armhf)
        expect "$header" 'Class: +ELF32' 'Machine: +ARM' 'Flags:.* hard-float ABI'
        refuse "$(readelf -A "$file")" 'Tag_Advanced_SIMD_arch'
        ;;
    arm64) expect "$header" 'Class: +ELF64' 'Machine: +AArch64' ;;
    amd64) expect "$header" 'Class: +ELF64' 'Machine: +Advanced Micro Devices X86-64' ;;
    *) triple_of "$name" ;;
    esac

    oldest=$(readelf -VW "$file" | grep -oE 'GLIBC_[0-9.]+' | sort -uV | tail -n 1)
    [[ $(printf '%s\n' "GLIBC_$glibc" "$oldest" | sort -V | tail -n 1) == "GLIBC_$glibc" ]] ||
        complain "wants $oldest, but a brick has $glibc"

    check_libraries "$file"
    check_symbols "$file"
    check_texts "$file"

    limit=3900000
    [[ $name == armel ]] && limit=2600000
    size=$(stat -c %s "$file")
    [[ $size -le $limit ]] || complain "has $size bytes; $limit is the limit"

    [[ $wrong == 0 ]] || exit 1
    echo "$name: $size bytes, wants ${oldest:-no GLIBC}"
}

check_libraries() {
    local library
    for library in $(readelf -dW "$1" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p'); do
        [[ " ${libraries//$'\n'/ } " == *" $library "* ]] ||
            complain "wants the library $library"
    done
    refuse "$(readelf -dW "$1")" 'RPATH|RUNPATH|TEXTREL'
}

check_symbols() {
    local symbols symbol
    symbols=$(readelf -W --dyn-syms "$1")
    expect "$symbols" ' install(_[a-z0-9_]+)?$'
    for symbol in $missing_in_723; do
        refuse "$symbols" " UND $symbol\$"
    done
    refuse "$(readelf -SW "$1")" '\.symtab|\.debug_'
}

# No path of the machine that built it
check_texts() {
    local path
    for path in "$root" "$toolchain" "$HOME" "${CARGO_HOME:-$HOME}"; do
        ! grep -qaF "$path/" "$1" || complain "holds the path $path"
    done
}

expect() {
    local text=$1 pattern
    shift
    for pattern; do
        grep -qE -- "$pattern" <<<"$text" || complain "does not have: $pattern"
    done
}

refuse() {
    ! grep -qE -- "$2" <<<"$1" || complain "has: $(grep -E -- "$2" <<<"$1" | head -n 1)"
}

complain() {
    echo "$name: $file $*" >&2
    wrong=1
}

main "$@"
