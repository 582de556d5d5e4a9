#!/usr/bin/env bash
#
# Builds the foreign library for other machines, one file each:
#
#   target/dist/<target>/ev3dev.so
#
# Usage: tools/cross.sh [TARGET...]        default: all of them
#        tools/cross.sh --example PACKAGE NAME
#
# The second builds an example for the EV3 alone, and prints where it is.
#
# TARGET is armel (EV3), armhf or arm64 (Raspberry Pi) or amd64 (PC). The files
# hold the simulator, but not its mount as real files: that is for programs in
# other languages on a PC, where one can build. They need a C library of 2.24
# or later and nothing of SWI-Prolog at link time; the same sources give the same
# bytes. tools/check-elf.sh holds them to that.
#
# Environment: as for tools/toolchain.sh; CARGO_HOME.

set -euo pipefail
# shellcheck source=tools/common.sh
source "$(dirname "$0")/common.sh"
# shellcheck source=tools/targets.sh
source "$root/tools/targets.sh"

main() {
    local name
    if [[ ${1:-} == --example ]]; then
        "$root/tools/toolchain.sh" >&2
        locked cross
        build armel --package "$2" --example "$3"
        echo "$root/target/cross/$(triple_of armel)/brick/examples/$3"
        return
    fi
    [[ $# -gt 0 ]] || set -- "${all_targets[@]}"
    for name; do
        triple_of "$name" >/dev/null
    done
    "$root/tools/toolchain.sh"
    locked cross
    for name; do
        build "$name" --package ev3dev --no-default-features --features sim
        install -D -m 644 "$root/target/cross/$(triple_of "$name")/$(profile_of "$name")/libev3dev.so" \
            "$root/target/dist/$name/ev3dev.so"
        "$root/tools/check-elf.sh" "$name" "$root/target/dist/$name/ev3dev.so"
    done
}

# What keeps the simulator below the brick's limit
profile_of() {
    if [[ $1 == armel ]]; then echo brick; else echo release; fi
}

# build TARGET WHAT...
build() {
    local name=$1 triple
    shift
    triple=$(triple_of "$name")
    (
        cd "$root"
        clean_environment
        write_linker amd64
        write_linker "$name"
        export RUSTC=$toolchain/bin/rustc CARGO_TARGET_DIR=$root/target/cross
        export CARGO_INCREMENTAL=0 SOURCE_DATE_EPOCH=0 LC_ALL=C TZ=UTC
        "$toolchain/bin/cargo" fetch --quiet --locked --target "$triple"
        CARGO_ENCODED_RUSTFLAGS=$(rust_flags "$name")
        export CARGO_ENCODED_RUSTFLAGS
        "$toolchain/bin/cargo" build --quiet --profile "$(profile_of "$name")" --locked \
            --target "$triple" "$@"
    )
}

# What is set for cargo on this machine must not change the bytes.
clean_environment() {
    local name
    for name in $(compgen -e); do
        case $name in
        CARGO_HOME | CARGO_HTTP_* | CARGO_NET_* | CARGO_REGISTRIES_* | CARGO_SOURCE_*) ;;
        RUST* | CARGO_* | SOURCE_DATE_EPOCH) unset "$name" ;;
        esac
    done
}

# cargo takes a linker without arguments.
write_linker() {
    local linker=$root/target/cross/$1-cc triple
    triple=$(triple_of "$1")
    mkdir -p "${linker%/*}"
    printf '#!/bin/sh\nexec "%s/tools/zig-cc" %s "$@"\n' "$root" "$1" >"$linker"
    chmod +x "$linker"
    triple=${triple^^}
    export "CARGO_TARGET_${triple//-/_}_LINKER=$linker"
}

# No path of this machine in the file, nor which registry it uses. Where two
# prefixes match, the last one counts. The brick's file gets instructions that
# it has in several places only once: 7 % less.
rust_flags() {
    local home=${CARGO_HOME:-$HOME/.cargo} crates prefix prefixes flags=()
    prefixes=("$root=/ev3dev" "$home=/cargo")
    for crates in "$home"/registry/src/*/; do
        prefixes+=("${crates%/}=/crates")
    done
    prefixes+=("$toolchain=/toolchain")
    for prefix in "${prefixes[@]}"; do
        flags+=("--remap-path-prefix=$prefix")
    done
    if [[ $1 == armel ]]; then
        flags+=(-Cllvm-args=-enable-machine-outliner=always)
        flags+=("${floats[@]/#/-Clink-arg=$toolchain/floats/}")
    fi
    (IFS=$'\x1f' && printf '%s' "${flags[*]}")
}

main "$@"
