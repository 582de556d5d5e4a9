#!/usr/bin/env bash
#
# Fetches what the cross build needs into .toolchain/: a Rust compiler with the
# standard library of every target, and zig as the linker that brings the C
# library of every target, as old as the bricks' one; for the EV3 also GCC's
# floating point.
#
# Usage: tools/toolchain.sh [page]
#
# With `page` it has WebAssembly's standard library, too.
#
# May be run again at any time: what is complete is left alone. Afterwards
# .toolchain/bin holds `cargo` and `rustc`, and .toolchain/zig zig itself.
#
# Environment:
#   EV3DEV_RUST      where Rust comes from
#                      rustup  rustup's toolchain and targets
#                      debian  Debian's packages, unpacked; no root needed
#                      auto    rustup if it is there and can fetch, else debian
#                              (the default)
#   EV3DEV_TOOLCHAIN where to put all this (default .toolchain)
# and those of tools/debian.sh. pip's own settings hold for zig.

set -euo pipefail
# shellcheck source=tools/common.sh
source "$(dirname "$0")/common.sh"
# shellcheck source=tools/debian.sh
source "$(dirname "$0")/debian.sh"
# shellcheck source=tools/targets.sh
source "$(dirname "$0")/targets.sh"

rust_version=1.85.1
debian_suite=trixie
zig_version=0.15.2

main() {
    locked toolchain
    fetch_zig
    fetch_floats
    case ${EV3DEV_RUST:-auto} in
    rustup) rust_of_rustup || die "rustup cannot fetch Rust $rust_version (see $toolchain/rustup.log)" ;;
    debian) rust_of_debian ;;
    auto)
        if is_made "$toolchain/rust" "$(debian_key)"; then
            rust_of_debian
        else
            rust_of_rustup || rust_of_debian
        fi
        ;;
    *) die "EV3DEV_RUST is none of rustup, debian, auto: $EV3DEV_RUST" ;;
    esac
    [[ ${1:-} != page ]] || library_of_pages
}

# zig has its linker.
library_of_pages() {
    local dir=$toolchain/rust/usr/lib/rustlib apt=$toolchain/apt-page
    if ! is_made "$toolchain/rust" "$(debian_key)"; then
        rustup target add --toolchain "$rust_version" wasm32-unknown-unknown >>"$toolchain/rustup.log" 2>&1 ||
            die "rustup cannot fetch WebAssembly's library (see $toolchain/rustup.log)"
        return
    fi
    is_made "$dir/wasm32-unknown-unknown" "$(debian_key)" && return
    say "fetching WebAssembly's library"
    rm -rf "$apt" "$toolchain/page"
    debian_download "$apt" "$debian_suite" amd64 libstd-rust-dev-wasm32
    debian_unpack "$apt" "$toolchain/page"
    debian_forget "$apt"
    rm -rf "$dir/wasm32-unknown-unknown"
    mv "$toolchain/page/usr/lib/rustlib/wasm32-unknown-unknown" "$dir/"
    rm -rf "$toolchain/page"
    made "$dir/wasm32-unknown-unknown" "$(debian_key)"
}

fetch_zig() {
    local dir=$toolchain/zig
    is_made "$dir" "$zig_version" && return
    python3 -m pip --version >/dev/null 2>&1 ||
        die "zig comes from the Python package ziglang, but python3 with pip is missing"
    say "fetching zig $zig_version"
    rm -rf "$dir"
    python3 -m pip install -q --no-deps --only-binary :all: --require-hashes \
        --no-cache-dir --no-compile --target "$dir" \
        -r "$root/tools/zig-requirements.txt" 2>"$toolchain/pip.log" ||
        die "pip cannot fetch ziglang $zig_version (see $toolchain/pip.log)"
    made "$dir" "$zig_version"
}

# The brick's processor does floating point in software. GCC's routines take two
# thirds of the instructions that Rust's own take, with the same results. Their
# license has an exception for programs that they are linked into.
fetch_floats() {
    local dir=$toolchain/floats apt=$toolchain/apt-floats package=libgcc-12-dev-armel-cross
    local key="debian bookworm $package"
    is_made "$dir" "$key" && return
    have ar || die "ar is missing: install binutils"
    say "fetching GCC's floating point for armel"
    rm -rf "$dir" "$apt"
    debian_download "$apt" bookworm amd64 "$package"
    debian_unpack "$apt" "$dir/package"
    debian_forget "$apt"
    (
        cd "$dir"
        ar x package/usr/lib/gcc-cross/arm-linux-gnueabi/12/libgcc.a "${floats[@]}"
    )
    rm -rf "$dir/package"
    made "$dir" "$key"
}

# The targets of rustup, added to a toolchain of the pinned version.
rust_of_rustup() {
    have rustup || return 1
    local name target=()
    for name in "${all_targets[@]}"; do
        target+=("$(triple_of "$name")")
    done
    rustup toolchain install "$rust_version" --profile minimal --no-self-update \
        --target "$(IFS=,; echo "${target[*]}")" >"$toolchain/rustup.log" 2>&1 ||
        return 1
    write_wrapper cargo "exec rustup run $rust_version cargo \"\$@\""
    write_wrapper rustc "exec rustup run $rust_version rustc \"\$@\""
}

debian_key() {
    echo "debian $debian_suite $rust_version ${all_targets[*]}"
}

# Debian's compiler and standard libraries. The compiler may need a newer C
# library than this machine has, so it is started through its own loader.
rust_of_debian() {
    local run
    is_made "$toolchain/rust" "$(debian_key)" || fetch_rust_of_debian
    # These may be rustup's, of a run for other targets.
    # shellcheck disable=SC2016
    run='rust=$(dirname "$0")/../rust/usr
exec "$rust/lib64/ld-linux-x86-64.so.2" \
    --library-path "$rust/lib/x86_64-linux-gnu" "$rust/bin/'
    write_wrapper cargo "${run}cargo\" \"\$@\""
    write_wrapper rustc "${run}rustc\" --sysroot \"\$rust\" \"\$@\""
}

fetch_rust_of_debian() {
    local dir=$toolchain/rust apt=$toolchain/apt name
    [[ $(uname -sm) == "Linux x86_64" ]] ||
        die "the Debian toolchain runs on x86_64 Linux only; use rustup elsewhere"
    say "fetching Rust $rust_version of Debian $debian_suite"
    rm -rf "$dir" "$apt"
    for name in "${all_targets[@]}"; do
        [[ $name != amd64 ]] || continue
        debian_download "$apt" "$debian_suite" "$name" libstd-rust-dev
        debian_unpack "$apt" "$dir"
        debian_forget "$apt"
    done
    debian_apt_new "$apt" "$debian_suite" amd64
    # zig does the linking
    debian_pretend "$apt" amd64 gcc binutils libc-dev
    debian_closure "$apt" "rustc=$rust_version*" "cargo=$rust_version*"
    debian_unpack "$apt" "$dir"
    debian_forget "$apt"
    made "$dir" "$(debian_key)"
}

write_wrapper() {
    mkdir -p "$toolchain/bin"
    printf '#!/bin/sh\n%s\n' "$2" >"$toolchain/bin/$1"
    chmod +x "$toolchain/bin/$1"
}

main "$@"
