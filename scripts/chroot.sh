# For scripts that work in a Debian of their own, in a folder; source it at the top of the tree, with SUITE (the
# release) and CACHE (an absolute path, in which it and its packages stay between runs) set.
#
# own_namespaces SCRIPT starts SCRIPT anew, with mounts and processes of its own. After that, with ROOT set to a folder,
# prepare makes a Debian in it, prepare_to_build one with Rust, and inside COMMAND... runs there. Exit status 77:
# skipped, since root or debootstrap is not to be had.
readonly PACKAGES=$CACHE/packages LOGS=$CACHE/logs-$SUITE
# Where Rust lies within, be it mounted.
readonly RUST=/opt/rust

die() {
    printf 'debian: %s\n' "$*" >&2
    exit 1
}

# step NAME COMMAND...: a line with its time; one that fails says its last words, and ends the script.
step() {
    local name=$1 begin=$SECONDS log
    shift
    log=$LOGS/${name//[^A-Za-z0-9]/-}.log
    if "$@" </dev/null >"$log" 2>&1; then
        printf 'ok   %s (%d s)\n' "$name" $((SECONDS - begin))
    else
        printf 'FAIL %s (%d s); the whole output: %s\n' "$name" $((SECONDS - begin)) "$log"
        tail -n 10 "$log"
        printf '0 passed, 1 failed\n'
        exit 1
    fi
}

skip() {
    printf 'Debian (%s): skipped: %s\n' "$SUITE" "$*"
    exit 77
}

# In mount and process namespaces of its own: however this ends, no mount and no process is left behind.
own_namespaces() {
    if [ "${PP_INSIDE:-}" != "$$" ]; then # within, this shell is process 1
        [ "$(id -u)" -eq 0 ] || skip "it takes root to set up another release of Debian."
        [ "$(uname -m)" = x86_64 ] || skip "this machine is $(uname -m), and the YADE plugin needs x86_64."
        command -v debootstrap >/dev/null || apt-get -qq -o DPkg::Lock::Timeout=300 install --yes debootstrap >/dev/null 2>&1 ||
            { apt-get -qq update && apt-get -qq -o DPkg::Lock::Timeout=300 install --yes debootstrap; } >/dev/null 2>&1 ||
            skip "debootstrap is missing, and apt-get could not install it."
        unshare --mount --pid --fork true 2>/dev/null || skip "this root may not mount anything."
        mkdir -p "$PACKAGES/partial" "$LOGS" || die "cannot write to $CACHE."
        exec env PP_INSIDE=1 unshare --mount --pid --fork --kill-child --propagation private "$PWD/$1"
    fi
    # Interrupted, it ends with all that it has started.
    trap "exit 130" INT TERM
    exec 9>"$CACHE/$SUITE.lock"
    flock --nonblock 9 || die "another run works in $CACHE/$SUITE: wait for it, or name another CACHE."
}

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
    debootstrap --variant=minbase --include="${INCLUDE:-ca-certificates,git,make}" --cache-dir="$PACKAGES" "$SUITE" "$ROOT" ${from:+"$from"} || return
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

# The Debian in ROOT, with what every run needs; made where there is none, or FRESH=1 asks for it.
prepare() {
    [ "${FRESH:-0}" != 1 ] && [ -e "$ROOT/.complete" ] || bootstrap || return
    mkdir -p "$ROOT$RUST" "$ROOT/opt/cargo" "$ROOT/sys"
    mount -t proc proc "$ROOT/proc" && mount --rbind /dev "$ROOT/dev" && mount --rbind /sys "$ROOT/sys" || return
    mount --bind "$PACKAGES" "$ROOT/var/cache/apt/archives" || return
    cp /etc/resolv.conf "$ROOT/etc/resolv.conf"
    # A failed update is no verdict: the lists at hand may do, and the installation tells.
    inside apt-get -qq update || true
}

prepare_to_build() {
    prepare || return
    # What stands between this machine and the network may have a certificate of its own, and pip be told of it.
    local file
    for file in /etc/ssl/certs/ca-certificates.crt /etc/pip.conf; do
        [ ! -e "$file" ] || cp "$file" "$ROOT$file" || return
    done
    # With its index and settings, so that what was downloaded once is there.
    mkdir -p "${CARGO_HOME:=$HOME/.cargo}" && mount --bind "$CARGO_HOME" "$ROOT/opt/cargo" || return
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
