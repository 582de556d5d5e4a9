# shellcheck shell=bash
# Debian packages of another suite or architecture, unpacked beside the system.
#
# Sourced by toolchain.sh and emulate.sh. The system's own apt state is neither
# read nor written, and nothing here needs root. One private apt lives in one
# folder:
#
#   debian_apt_new DIR SUITE ARCH       make it, or take the one that is there
#   debian_apt DIR COMMAND ARG...       run an apt command in it
#   debian_pinned DIR SUITE ARCH PACKAGE...
#                                       fetch what debian-packages.txt has under
#                                       this heading; fails if any is not there
#   debian_download DIR SUITE ARCH PACKAGE...
#                                       fetch exactly these: so, or as the index
#                                       of SUITE for ARCH has them
#   debian_pretend DIR ARCH PACKAGE...  take these as installed: we do without
#   debian_closure DIR PACKAGE...       fetch these and all they depend on
#   debian_unpack DIR DEST              unpack all that was fetched into DEST
#   debian_forget DIR                   drop the packages and indexes
#
# A mirror may have an index that does not match its release, for days. The
# packages are in its pool all the same, so debian_pinned asks for no index.
#
# Environment:
#   EV3DEV_DEBIAN_MIRROR   where Debian is, e.g. for a machine that is not a
#                          Debian itself. Default: where this machine's apt
#                          gets its own release from.
#   EV3DEV_DEBIAN_KEYRING  keys that sign the suites
#                          (default: that of package debian-archive-keyring)

debian_mirror() {
    if [[ -n ${EV3DEV_DEBIAN_MIRROR:-} ]]; then
        echo "${EV3DEV_DEBIAN_MIRROR%/}"
        return
    fi
    [[ -r /etc/os-release ]] || return 1
    local id codename
    # shellcheck disable=SC1091
    id=$(. /etc/os-release && echo "${ID:-}")
    # shellcheck disable=SC1091
    codename=$(. /etc/os-release && echo "${VERSION_CODENAME:-}")
    [[ $id == debian ]] || return 1
    # shellcheck disable=SC2016
    apt-get indextargets --format '$(REPO_URI) $(RELEASE) $(COMPONENT)' \
        'Identifier: Packages' 2>/dev/null |
        awk -v suite="$codename" '
            !uri && ($2 == suite || $2 == "stable" || $2 == "testing") &&
            $3 == "main" { uri = $1 }
            END { sub("/$", "", uri); print uri; exit !uri }'
}

debian_apt_new() {
    local dir=$1 suite=$2 arch=$3 mirror keyring lacks=
    have apt-get dpkg ||
        die "Debian's packages are needed but apt-get or dpkg is missing"
    mirror=$(debian_mirror) ||
        die "no Debian mirror known: set EV3DEV_DEBIAN_MIRROR"
    keyring=${EV3DEV_DEBIAN_KEYRING:-/usr/share/keyrings/debian-archive-keyring.gpg}
    [[ -r $keyring ]] ||
        die "$keyring is missing: install debian-archive-keyring"

    mkdir -p "$dir"/{state/lists/partial,cache/archives/partial}
    : >"$dir/status"
    {
        # How the machine reaches its mirror (proxies, clock) holds here too.
        apt-config dump 2>/dev/null |
            grep -E '^Acquire::(http|https|Check|Retries|ForceIPv)' || true
        echo 'Dir::Etc::main "/dev/null";'
        echo 'Dir::Etc::parts "/dev/null";'
        echo "Dir::Etc::sourcelist \"$dir/sources.list\";"
        echo 'Dir::Etc::sourceparts "/dev/null";'
        echo 'Dir::Etc::preferences "/dev/null";'
        echo 'Dir::Etc::preferencesparts "/dev/null";'
        echo "Dir::State \"$dir/state\";"
        echo "Dir::State::status \"$dir/status\";"
        echo "Dir::Cache \"$dir/cache\";"
        echo 'Acquire::Languages "none";'
        echo 'Acquire::GzipIndexes "true";'
        echo 'APT::Sandbox::User "root";'
        echo 'APT::Install-Recommends "false";'
        echo "APT::Architecture \"$arch\";"
        echo "APT::Architectures:: \"$arch\";"
    } >"$dir/apt.conf"
    echo "deb [signed-by=$keyring] $mirror $suite main" >"$dir/sources.list"

    if [[ ! -e $dir/updated ]]; then
        [[ ! -e $dir/lacks ]] || lacks="cannot have $(<"$dir/lacks"), and "
        debian_apt "$dir" apt-get update -q -o APT::Update::Error-Mode=any \
            >"$dir/update.log" 2>&1 ||
            die "${lacks}the mirror's index of $suite for $arch" \
                "$(debian_why "$dir/update.log" release) (see $dir/update.log)"
        touch "$dir/updated"
    fi
}

debian_apt() {
    local dir=$1
    shift
    APT_CONFIG="$dir/apt.conf" LC_ALL=C "$@"
}

debian_pinned() {
    local dir=$1 mirror sha path file files=()
    shift
    have apt-get dpkg || return
    mirror=$(debian_mirror) || return
    while read -r sha path; do
        file=$dir/cache/archives/${path##*/}
        files+=("$mirror/$path" "$file" "SHA256:$sha")
    done < <(awk -v heading="[$*]" '/^\[/ { here = $0 == heading; next } here && NF' \
        "${BASH_SOURCE[0]%/*}/debian-packages.txt")
    [[ ${#files[@]} -gt 0 ]] || return
    mkdir -p "$dir/cache/archives"
    ! LC_ALL=C /usr/lib/apt/apt-helper -o APT::Sandbox::User=root download-file \
        "${files[@]}" >"$dir/pool.log" 2>&1 || return 0
    file=$(sed -nE '/^E: Failed/{s|^[^/]*/[^ ]*/([^ ]+) .*|\1|; s/%2b/+/g; s/%7e/~/g; p; q}' \
        "$dir/pool.log")
    echo "${*:3} for $2: ${file:-a package} of the pool" \
        "$(debian_why "$dir/pool.log" pin)" >"$dir/lacks"
    rm -r "$dir/cache"
    return 1
}

debian_download() {
    local dir=$1 suite=$2 arch=$3
    ! debian_pinned "$@" || return 0
    shift 3
    debian_apt_new "$dir" "$suite" "$arch"
    (
        cd "$dir/cache/archives"
        debian_apt "$dir" apt-get download -q "$@" >"$dir/download.log" 2>&1
    ) || die "cannot download $* (see $dir/download.log)"
}

# debian_why LOG SUM: apt's first error, as what is said of a file; SUM is where its
# checksum is
debian_why() {
    local error
    error=$(sed -nE '/^E: /{s/^E: (Failed to fetch [^ ]+ +)?//p; q}' "$1")
    case $error in
    404*) echo "is not there (404)" ;;
    *"unexpected size"* | *"Hash Sum mismatch"*) echo "does not match its $2" ;;
    *onnect* | *resolv*) echo "cannot be reached" ;;
    *) echo "cannot be had: ${error:-no error from apt}" ;;
    esac
}

debian_pretend() {
    local dir=$1 arch=$2 package
    shift 2
    for package; do
        printf '%s\n' "Package: $package" 'Status: install ok installed' \
            "Architecture: $arch" 'Multi-Arch: foreign' 'Version: 99' \
            'Maintainer: nobody' 'Description: not needed here' ''
    done >>"$dir/status"
}

debian_closure() {
    local dir=$1
    shift
    debian_apt "$dir" apt-get install -q -y --download-only "$@" \
        >"$dir/download.log" 2>&1 ||
        die "cannot download $* (see $dir/download.log)"
}

debian_unpack() {
    local dir=$1 dest=$2 deb
    [[ ! -e $dir/lacks ]] || say "asked the index for $(<"$dir/lacks")"
    mkdir -p "$dest"
    for deb in "$dir"/cache/archives/*.deb; do
        dpkg -x "$deb" "$dest"
    done
}

debian_forget() {
    rm -rf "$1"
}
