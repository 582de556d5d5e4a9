#!/usr/bin/env bash
#
# Makes SWI-Prolog 9 for a brick, whose own may be old or missing:
#
#   dist/brick-prolog-<version>.tgz          and .tgz.sha256 beside it
#
# Usage: tools/brick-prolog.sh [--with-pack]
#
# --with-pack installs the binary pack in it, dist/ev3dev-<version>.tgz as
# tools/dist.sh has made it. <version> is the pack's in either case.
#
# It is SWI-Prolog 9.0.4 of Debian bookworm with every library that it needs,
# down to the C library and the loader. So it runs in any folder of any ev3dev
# and leaves the system as it is. The folder brick-prolog holds
#
#   bin/swipl          the command (see brick-swipl.c)
#   libexec/swipl      the loader, under the name that ps and killall show
#   libexec/prolog     Debian's program
#   lib                the libraries, Prolog's home, and the one locale
#   pack               packs; pack_install puts new ones there
#   share/doc          licenses, and which packages of Debian these are
#
# The same commit makes the same bytes of the same packages.
#
# Environment: as for tools/toolchain.sh; SOURCE_DATE_EPOCH as for
# tools/dist.sh.

set -euo pipefail
# shellcheck source=tools/common.sh
source "$(dirname "$0")/common.sh"
# shellcheck source=tools/debian.sh
source "$root/tools/debian.sh"

# What of Prolog's home is for people who build or test it
dropped=(bin boot cmake customize demo include test library/latex2html
    'lib/*/test_*.so')

# Libraries that no file here asks for, but packs or lookups of names may
also=(libanl.so.1 libdl.so.2 libm.so.6 libnss_compat.so.2 libnss_dns.so.2
    libnss_files.so.2 libpthread.so.0 libresolv.so.2 librt.so.1 libutil.so.1)

# Packages that no file here comes from
unused=' dpkg libicu72 libselinux1 libxml2 readline-common tar '

extra=$toolchain/brick-prolog
stage=$root/target/brick-prolog/stage
target=$stage/brick-prolog

main() {
    local archive
    [[ $# -eq 0 || $* == --with-pack ]] ||
        die "usage: tools/brick-prolog.sh [--with-pack]"
    have readelf || die "readelf is missing: install binutils"
    # Files are sorted alike everywhere.
    export LC_ALL=C
    "$root/tools/toolchain.sh"
    debian=$("$root/tools/emulate.sh" armel)
    (fetch)
    locked dist

    rm -rf "$stage"
    mkdir -p "$target"/{bin,libexec,lib,pack} "$root/dist"
    make_command
    copy_home
    copy_libraries
    copy_locale
    copy_licenses
    [[ $# -eq 0 ]] || copy_pack

    archive=$root/dist/brick-prolog-$(version).tgz
    pack "$stage" brick-prolog "$archive"
    echo "${archive#"$root"/}: $(stat -c %s "$archive") bytes;" \
        "$(du -s --apparent-size -B 1 "$target" | cut -f 1) unpacked"
}

# What swi-prolog-nox does not depend on. busybox is for the check.
fetch() {
    local apt=$toolchain/apt-brick-prolog key='bookworm armel 1'
    ! is_made "$extra" "$key" || return 0
    locked brick-prolog
    say "fetching the C library's locale and busybox"
    rm -rf "$extra" "$apt"
    debian_download "$apt" bookworm armel libc-bin busybox-static
    debian_unpack "$apt" "$extra"
    debian_forget "$apt"
    made "$extra" "$key"
}

# Static, so that it starts on any C library
make_command() {
    (
        cd "$root/tools"
        ./zig-cc armel -target arm-linux-musleabi -static -Os -s -Wall \
            -o "$target/bin/swipl" brick-swipl.c
    )
    # By it, bin/swipl finds Prolog's home.
    echo lib/swi-prolog >"$target/swipl.home"
    install -m 755 "$debian/lib/ld-linux.so.3" "$target/libexec/swipl"
    install -m 755 "$debian"/usr/lib/swi-prolog/bin/*/swipl \
        "$target/libexec/prolog"
}

copy_home() {
    local home=$target/lib/swi-prolog
    cp -R "$debian/usr/lib/swi-prolog" "$home"
    (
        cd "$home"
        # shellcheck disable=SC2068
        rm -r ${dropped[@]}
    )
    # links to packages that are not here
    find "$home" -xtype l -delete
    cat >"$home/swipl.rc" <<'EOF'
%   Loaded at each start, before all else. It sets back what bin/swipl has set
%   for the C library, so that programs started from here do not see it.

:- forall(( Name = 'LC_ALL' ; Name = 'LOCPATH' ),
          (   atom_concat('BRICK_PROLOG_', Name, Saved),
              (   getenv(Saved, Value)
              ->  setenv(Name, Value)
              ;   unsetenv(Name)
              ),
              unsetenv(Saved)
          )).

:- multifile user:file_search_path/2.

user:file_search_path(pack, swi('../../pack')).
EOF
}

# Every library that a file here needs, by the name that it is asked for.
copy_libraries() {
    local name file
    local queue=("${also[@]}")
    while IFS= read -r file; do
        mapfile -t -O "${#queue[@]}" queue < <(needed "$file")
    done < <(echo "$target/libexec/prolog" && find "$target" -name '*.so')

    while [[ ${#queue[@]} -gt 0 ]]; do
        name=${queue[0]}
        queue=("${queue[@]:1}")
        file=$target/lib/$name
        case $name in
        # started as libexec/swipl
        ld-linux.so.3) continue ;;
        libxml2.so.2) [[ -e $file ]] || make_libxml2 "$file" ;;
        *)
            [[ ! -e $file ]] || continue
            install -m 644 "$(library "$name")" "$file"
            mapfile -t -O "${#queue[@]}" queue < <(needed "$file")
            ;;
        esac
    done
}

needed() {
    readelf -d "$1" | sed -n 's/.*(NEEDED).*\[\(.*\)\]$/\1/p'
}

# library NAME: the file in Debian's folders
library() {
    local folder
    for folder in "$debian"/{lib,usr/lib}/arm-linux-gnueabi; do
        [[ ! -e $folder/$1 ]] || {
            echo "$folder/$1"
            return
        }
    done
    die "no $1 in Debian's packages"
}

# pack_install unpacks archives with libarchive. libarchive needs libxml2 for a
# format that no pack has, xar, and libxml2 needs 35 MB of ICU. So libarchive gets
# a library with the functions that it asks for. They answer null; libarchive
# takes that for "not enough memory".
make_libxml2() {
    local work=$root/target/brick-prolog/libxml2
    rm -rf "$work"
    mkdir -p "$work"
    readelf --dyn-syms -W "$(library libarchive.so.13)" |
        sed -nE 's/.* UND ([A-Za-z0-9_]+)@(LIBXML2_[0-9.]+).*/\1 \2/p' |
        sort >"$work/functions"
    awk '{ print "void *" $1 "(void) { return 0; }" }' \
        "$work/functions" >"$work/libxml2.c"
    awk '{ names[$2] = names[$2] " " $1 ";" }
         END { for (v in names) print v " {" names[v] " };" }' \
        "$work/functions" | sort >"$work/libxml2.map"
    (
        cd "$work"
        "$root/tools/zig-cc" armel -shared -nostdlib -Os -s \
            -fno-builtin -Wl,-soname,libxml2.so.2 \
            -Wl,--version-script,libxml2.map -o libxml2.so.2 libxml2.c
    )
    install -m 644 "$work/libxml2.so.2" "$1"
}

# Of C.UTF-8 only what recognizes letters. Without it, an argument that is not ASCII
# keeps SWI-Prolog from starting.
copy_locale() {
    install -D -m 644 "$extra/usr/lib/locale/C.utf8/LC_CTYPE" \
        "$target/lib/locale/C.utf8/LC_CTYPE"
}

copy_licenses() {
    local folder package doc=$target/share/doc
    mkdir -p "$doc"
    for folder in "$debian"/usr/share/doc/*; do
        package=${folder##*/}
        [[ $unused != *" $package "* ]] || continue
        echo "$package $(package_version "$folder")" >>"$doc/PACKAGES"
        if [[ -L $folder ]]; then
            cp -P "$folder" "$doc/"
        else
            install -D -m 644 "$folder/copyright" "$doc/$package/copyright"
        fi
    done
    # bin/swipl
    install -D -m 644 "$root/LICENSE" "$doc/brick-prolog/copyright"
    install -D -m 644 "$toolchain/zig/ziglang/lib/libc/musl/COPYRIGHT" \
        "$doc/musl/copyright"
}

# package_version FOLDER: as the newest entry of its changelog has it
package_version() {
    local file
    for file in "$1"/changelog.Debian{.armel,}.gz; do
        [[ ! -e $file ]] || {
            gzip -cd "$file" | sed -n '1s/.*(\(.*\)).*/\1/p'
            return
        }
    done
}

copy_pack() {
    local file
    file=$root/dist/ev3dev-$(version).tgz
    [[ -r $file ]] || die "there is no ${file#"$root"/}: run tools/dist.sh"
    tar -xzf "$file" -C "$target/pack"
    find "$target/pack/ev3dev/native" -mindepth 1 -maxdepth 1 \
        ! -name armel -exec rm -r {} +
}

main "$@"
