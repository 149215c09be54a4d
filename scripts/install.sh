#!/usr/bin/env bash
# Installs the library for C and C++ programs: header, shared and static library, pkg-config and CMake files.
# Called by "make install".
#   PREFIX=/usr/local    where it will be used
#   LIBDIR=$PREFIX/lib   the folder of libraries, if it is another
#   DESTDIR=             put before every path, for packages
set -euo pipefail
cd "$(dirname "$0")/.."

PREFIX=${PREFIX:-/usr/local}
LIBDIR=${LIBDIR:-$PREFIX/lib}
DESTDIR=${DESTDIR:-}
for path in "$PREFIX" "$LIBDIR" ${DESTDIR:+"$DESTDIR"}; do
    [[ $path = /* ]] || { echo "install: $path is no absolute path: give PREFIX, LIBDIR and DESTDIR from the root on." >&2; exit 1; }
done
version=$(sed -n 's/^version = "\(.*\)"/\1/p' Cargo.toml | head -n 1)
# A program that needs another binary interface does not find this library.
abi=$(sed -n 's/^#define PP_ABI_VERSION \([0-9]*\)$/\1/p' include/potential_particles.h)
[[ $abi ]] || { echo "install: include/potential_particles.h names no PP_ABI_VERSION: make header" >&2; exit 1; }
soname=libpotential_particles.so.$abi
library=$soname.$version

# A build of its own: programs and the plugin in this tree find the library without a SONAME, by its place.
export CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-target}
cargo rustc --quiet --release --lib --crate-type cdylib,staticlib --target-dir "$CARGO_TARGET_DIR/install" \
    -- -C link-arg=-Wl,-soname,"$soname"
built=$CARGO_TARGET_DIR/install/release

filled() {
    sed -e "s|@PREFIX@|$PREFIX|g" -e "s|@LIBDIR@|$LIBDIR|g" -e "s|@VERSION@|$version|g" "packaging/$1" >"$2"
    chmod 644 "$2"
}

install -d "$DESTDIR$PREFIX/include" "$DESTDIR$LIBDIR/pkgconfig" "$DESTDIR$LIBDIR/cmake/potential-particles"
install -m 644 include/potential_particles.h "$DESTDIR$PREFIX/include"
install -m 644 "$built/libpotential_particles.so" "$DESTDIR$LIBDIR/$library"
install -m 644 "$built/libpotential_particles.a" "$DESTDIR$LIBDIR"
ln -sf "$library" "$DESTDIR$LIBDIR/$soname"
ln -sf "$soname" "$DESTDIR$LIBDIR/libpotential_particles.so"
filled potential-particles.pc.in "$DESTDIR$LIBDIR/pkgconfig/potential-particles.pc"
for part in config config-version; do
    filled "potential-particles-$part.cmake.in" "$DESTDIR$LIBDIR/cmake/potential-particles/potential-particles-$part.cmake"
done
echo "install: version $version, $soname in $DESTDIR$PREFIX and $DESTDIR$LIBDIR"
