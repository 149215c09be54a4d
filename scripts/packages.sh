#!/usr/bin/env bash
# Builds the Debian packages for one release of Debian in a Debian of its own; with TRY=1 it installs them in another
# that has nothing else, uses them as a stranger would, and removes them. Called by "make deb" and "make packages-test".
# SUITE names the release; its packages go to out/packages/SUITE. CACHE and FRESH are those of debian.sh. Exit status
# 77: skipped, since root or debootstrap is not to be had.
set -uo pipefail
cd "$(dirname "$0")/.." || exit 1

SUITE=${SUITE:-trixie}
CACHE=$(realpath -m "${CACHE:-out/debian}")
readonly SUITE CACHE OUT=$PWD/out/packages/$SUITE

. scripts/chroot.sh
own_namespaces scripts/packages.sh

# Cargo need not be a package (see the function rust), so that dpkg is not asked whether it is.
build() {
    inside apt-get -qq install --yes --no-install-recommends debhelper dh-python dpkg-dev fakeroot lintian &&
        rm -f "$ROOT"/*.deb && in_sources dpkg-buildpackage --build=binary --no-sign --no-check-builddeps --no-pre-clean &&
        mkdir -p "$OUT" && rm -f "$OUT"/*.deb && cp "$ROOT"/*potential-particles*.deb "$OUT"
}

lint() {
    inside sh -c 'lintian --allow-root --fail-on error,warning --suppress-tags initial-upload-closes-no-bugs,bad-distribution-in-changes-file /*potential-particles*.deb'
}

bare() {
    ROOT=$CACHE/$SUITE-bare
    FRESH=1 INCLUDE=ca-certificates prepare && mkdir -p "$ROOT/packages" && cp "$OUT"/*.deb scripts/try_packages.sh "$ROOT/packages"
}

ROOT=$CACHE/$SUITE
printf 'Packages for Debian (%s) in %s\n' "$SUITE" "$OUT"
step "Debian, packages and Rust" prepare_to_build
step "Sources" copy_sources
step "Set-up" in_sources make setup
step "Packages" build
step "Lintian" lint
if [ "${TRY:-0}" = 1 ]; then
    step "A bare Debian" bare
    ROOT=$CACHE/$SUITE-bare
    inside bash /packages/try_packages.sh || exit
fi
ls -l "$OUT"
