# shellcheck shell=bash
# The machines we build for, by Debian's names of them. Sourced, not run.

# EV3; Raspberry Pi (BrickPi3, PiStorms); the same with 64 bit; PC
# shellcheck disable=SC2034
all_targets=(armel armhf arm64 amd64)

# GCC's routines for the processor of the EV3: add, subtract, multiply, divide
# shellcheck disable=SC2034
floats=(_arm_addsubdf3.o _arm_addsubsf3.o _arm_muldivdf3.o _arm_muldivsf3.o)

# The oldest C library: that of ev3dev-stretch
glibc=2.24

# triple_of NAME: as Rust calls it
triple_of() {
    case $1 in
    armel) echo armv5te-unknown-linux-gnueabi ;;
    armhf) echo armv7-unknown-linux-gnueabihf ;;
    arm64) echo aarch64-unknown-linux-gnu ;;
    amd64) echo x86_64-unknown-linux-gnu ;;
    *) die "no such target: $1 (there are: ${all_targets[*]})" ;;
    esac
}

# zig_target_of NAME: as zig calls it, and the processor
zig_target_of() {
    case $1 in
    armel) echo "arm-linux-gnueabi.$glibc -mcpu=arm926ej_s" ;;
    armhf) echo "arm-linux-gnueabihf.$glibc -mcpu=generic+v7a+vfp3d16" ;;
    arm64) echo "aarch64-linux-gnu.$glibc" ;;
    amd64) echo "x86_64-linux-gnu.$glibc" ;;
    esac
}
