# For .ci/run, as root on Debian 12. Nothing here is needed but shellcheck and
# readelf: qemu is fetched without root if it is not installed, and python3 with
# pip may come from anywhere.
apt-get update -qq
apt-get install -y -qq shellcheck binutils qemu-user-static >/dev/null
python3 -m pip --version >/dev/null 2>&1 || apt-get install -y -qq python3-pip >/dev/null

# Kept between runs on one machine; a fresh clone has no .toolchain.
export EV3DEV_TOOLCHAIN=${EV3DEV_TOOLCHAIN:-$HOME/.cache/ev3dev-toolchain}

shellcheck -x tools/*.sh tools/zig-cc
make dist check-brick check-versions
