#!/usr/bin/env bash
# Sets up, builds and tests in another release of Debian, in a folder of its own. Called by "make test-debian13".
# SUITE names the release, CACHE the folder in which it and its packages stay between runs, FRESH=1 makes it anew.
# Exit status 77: skipped, since root or debootstrap is not to be had.
set -uo pipefail
cd "$(dirname "$0")/.." || exit 1

SUITE=${SUITE:-trixie}
CACHE=$(realpath -m "${CACHE:-out/debian}")
readonly SUITE CACHE ROOT=$CACHE/$SUITE PACKAGES=$CACHE/packages LOGS=$CACHE/logs-$SUITE
# Where Rust lies within, be it mounted.
readonly RUST=/opt/rust

die() {
    printf 'debian: %s\n' "$*" >&2
    exit 1
}

skip() {
    printf 'Debian (%s): skipped: %s\n' "$SUITE" "$*"
    exit 77
}

# In mount and process namespaces of its own: however this ends, no mount and no process is left behind.
if [ "${PP_INSIDE:-}" != "$$" ]; then # within, this shell is process 1
    [ "$(id -u)" -eq 0 ] || skip "it takes root to set up another release of Debian."
    [ "$(uname -m)" = x86_64 ] || skip "this machine is $(uname -m), and the YADE plugin needs x86_64."
    command -v debootstrap >/dev/null || apt-get -qq -o DPkg::Lock::Timeout=300 install --yes debootstrap >/dev/null 2>&1 ||
        { apt-get -qq update && apt-get -qq -o DPkg::Lock::Timeout=300 install --yes debootstrap; } >/dev/null 2>&1 ||
        skip "debootstrap is missing, and apt-get could not install it."
    unshare --mount --pid --fork true 2>/dev/null || skip "this root may not mount anything."
    mkdir -p "$PACKAGES/partial" "$LOGS" || die "cannot write to $CACHE."
    exec env PP_INSIDE=1 unshare --mount --pid --fork --kill-child --propagation private "$PWD/scripts/debian.sh"
fi

# Interrupted, it ends with all that it has started.
trap "exit 130" INT TERM
exec 9>"$CACHE/$SUITE.lock"
flock --nonblock 9 || die "another run works in $ROOT: wait for it, or name another CACHE."

. scripts/stages.sh

# The host's own mirror and proxy; debootstrap knows a mirror itself where apt names none of Debian.
mirror() {
    apt-get indextargets --format '$(ORIGIN) $(LABEL) $(REPO_URI)' 'Created-By: Packages' 2>/dev/null |
        awk '$1 == "Debian" && $2 == "Debian" { print $3; exit }'
}
proxy=$(apt-config shell found Acquire::http::Proxy | sed "s/^found='\(.*\)'$/\1/")
export http_proxy=${http_proxy:-$proxy}

bootstrap() {
    rm -rf --one-file-system "$ROOT"
    local from
    from=$(mirror)
    # The key of a newer release may be missing here; then debootstrap says so.
    debootstrap --variant=minbase --include=ca-certificates,git,make --cache-dir="$PACKAGES" "$SUITE" "$ROOT" ${from:+"$from"} || return
    # What is lost when the power fails can be made again.
    echo force-unsafe-io >"$ROOT/etc/dpkg/dpkg.cfg.d/unsafe-io"
    apt-config dump | grep -i '^Acquire::[a-z]*::proxy' >"$ROOT/etc/apt/apt.conf.d/90proxy" || true
    touch "$ROOT/.complete"
}

inside() {
    chroot "$ROOT" /usr/bin/env -i HOME=/root TERM=dumb LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive \
        ${http_proxy:+http_proxy="$http_proxy"} ${https_proxy:+https_proxy="$https_proxy"} \
        CARGO_HOME=/opt/cargo PATH="$RUST/bin:/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin" \
        WERROR="${WERROR:-0}" "$@"
}

# Rust: the release's own where it is new enough for Cargo.toml, else this machine's.
rust() {
    local wanted offered
    wanted=$(sed -n 's/^rust-version = "\(.*\)"/\1/p' Cargo.toml)
    offered=$(inside apt-cache policy cargo | awk '/Candidate:/ { print $2 }')
    if dpkg --compare-versions "${offered:-0}" ge "$wanted"; then
        inside apt-get -qq install --yes --no-install-recommends cargo
    else
        command -v rustc >/dev/null || { echo "Cargo.toml asks for Rust $wanted, $SUITE has $offered, this machine none"; return 1; }
        mount --bind "$(rustc --print sysroot)" "$ROOT$RUST"
    fi
    inside cargo --version
}

prepare() {
    [ "${FRESH:-0}" != 1 ] && [ -e "$ROOT/.complete" ] || bootstrap || return
    mkdir -p "$ROOT$RUST" "$ROOT/opt/cargo" "$ROOT/sys"
    mount -t proc proc "$ROOT/proc" && mount --rbind /dev "$ROOT/dev" && mount --rbind /sys "$ROOT/sys" || return
    mount --bind "$PACKAGES" "$ROOT/var/cache/apt/archives" || return
    # With its index and settings, so that what was downloaded once is there.
    mkdir -p "${CARGO_HOME:=$HOME/.cargo}" && mount --bind "$CARGO_HOME" "$ROOT/opt/cargo" || return
    cp /etc/resolv.conf "$ROOT/etc/resolv.conf"
    # A failed update is no verdict: the lists at hand may do, and the installation tells.
    inside apt-get -qq update || true
    rust
}

# The files of the work tree as they are, without what git does not know; what was built before stays.
copy_sources() {
    mkdir -p "$ROOT/src" && find "$ROOT/src" -mindepth 1 -maxdepth 1 ! -name target -exec rm -rf {} + &&
        git ls-files -z --cached --others --exclude-standard | tar --null --files-from=- --ignore-failed-read -cf - 2>/dev/null |
        tar -xf - -C "$ROOT/src"
}

in_sources() {
    inside sh -c 'cd /src && exec "$@"' - "$@"
}

printf 'Debian (%s) in %s\n' "$SUITE" "$ROOT"
stage check "Debian, packages and Rust" prepare
[ "$failed" -eq 0 ] || { printf '\n%d passed, %d failed\n' "$passed" "$failed"; exit 1; }
stage check "Sources" copy_sources
stage check "Set-up" in_sources make setup
stage check "Library and YADE plugin, compared with the YADE of this release" in_sources make build
stage suite "YADE scenes, -j1" in_sources tests/yade/run.py -j 1
stage suite "YADE on 1, 2 and 3 ranks" in_sources tests/mpi/run.py
stage suite "Short demo" in_sources scripts/short_demo.sh
if [ -e yade-glue/build/python/potential_particles/_glue.so ] && command -v yade >/dev/null; then
    stage suite "Files of this machine's YADE and of the other, loaded by either" scripts/exchange_saves.sh "$ROOT"
else
    echo "== Files of two YADEs: skipped: the plugin is not built on this machine (make build)"
fi

printf '\n%d passed, %d failed\n' "$passed" "$failed"
[ "$failed" -eq 0 ]
