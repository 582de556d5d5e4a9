#!/usr/bin/env bash
#
# Builds the foreign library for a page, beside SWI-Prolog's WebAssembly build:
#
#   target/page/ev3dev.wasm
#
# Usage: tools/page.sh
#
# It has SWI-Prolog's memory and table of functions. In the memory its window begins
# at 8 MB; in the table it begins at 1400. playground/prolog.js knows both.
#
# Environment: as for tools/toolchain.sh; CARGO_HOME.

set -euo pipefail
# shellcheck source=tools/common.sh
source "$(dirname "$0")/common.sh"

window=$((8 << 20))
table=1400
most=$((2 << 30))
stack=$((1 << 20))

main() {
    "$root/tools/toolchain.sh" page
    locked page
    mkdir -p "$root/target/page"
    write_linker "$root/target/page/ld"
    cd "$root"
    [ -e target/page/ev3dev.wasm ] ||
        echo "compiling the library for the browser: the first time takes some minutes"
    export RUSTC=$toolchain/bin/rustc CARGO_TARGET_DIR=$root/target/page/cargo
    # A panic ends the page's worker.
    export CARGO_PROFILE_RELEASE_PANIC=abort CARGO_PROFILE_RELEASE_OPT_LEVEL=3
    export CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER=$root/target/page/ld
    local flags=(-Clinker-flavor=wasm-ld) argument
    for argument in --import-memory --import-table "--global-base=$window" \
        "--table-base=$table" "--max-memory=$most" "-zstack-size=$stack"; do
        flags+=("-Clink-arg=$argument")
    done
    RUSTFLAGS="${flags[*]}" "$toolchain/bin/cargo" build --release --locked --quiet \
        --target wasm32-unknown-unknown --package ev3dev --no-default-features --features sim
    cp "$CARGO_TARGET_DIR/wasm32-unknown-unknown/release/ev3dev.wasm" target/page/
}

# rustc wants the stack first, which would lie on SWI-Prolog's data.
write_linker() {
    cat >"$1" <<'LINKER'
#!/bin/sh
count=$#
while [ "$count" -gt 0 ]; do
    case $1 in
    --stack-first) ;;
    -flavor)
        shift
        count=$((count - 1))
        ;;
    *) set -- "$@" "$1" ;;
    esac
    shift
    count=$((count - 1))
done
LINKER
    echo "exec '$toolchain/zig/ziglang/zig' wasm-ld \"\$@\"" >>"$1"
    chmod +x "$1"
}

main
