#!/usr/bin/env bash
# Installs the library for C and C++ programs: header, shared and static library, pkg-config and CMake files; and the
# package for Python. The folder may be moved afterwards. With the argument "uninstall" it removes what it has installed. Called by "make install" and
# "make uninstall".
#   PREFIX=/usr/local    where it will be used
#   LIBDIR=$PREFIX/lib   the folder of libraries, if it is another
#   PYTHON_DIR=$PREFIX/lib/python3/dist-packages  the folder of the package, which is Debian's for PREFIX=/usr; "": no package
#   DESTDIR=             put before every path, for packages
#   CORE=                _core, if it is built already
#   PROFILE=release      how it is built: the tests take dev, which takes seconds
set -euo pipefail
cd "$(dirname "$0")/.."

PREFIX=${PREFIX:-/usr/local}
LIBDIR=${LIBDIR:-$PREFIX/lib}
PYTHON_DIR=${PYTHON_DIR-$PREFIX/lib/python3/dist-packages}
DESTDIR=${DESTDIR:-}
PROFILE=${PROFILE:-release}
for path in "$PREFIX" "$LIBDIR" ${PYTHON_DIR:+"$PYTHON_DIR"} ${DESTDIR:+"$DESTDIR"}; do
    [[ $path = /* ]] || { echo "install: $path is no absolute path: give PREFIX, LIBDIR, PYTHON_DIR and DESTDIR from the root on." >&2; exit 1; }
done
version=$(sed -n 's/^version = "\(.*\)"/\1/p' Cargo.toml | head -n 1)
# A program that needs another binary interface does not find this library.
abi=$(sed -n 's/^#define PP_ABI_VERSION \([0-9]*\)$/\1/p' include/potential_particles.h)
[[ $abi ]] || { echo "install: include/potential_particles.h names no PP_ABI_VERSION: make header" >&2; exit 1; }
soname=libpotential_particles.so.$abi
library=$soname.$version

header=$DESTDIR$PREFIX/include/potential_particles.h
libraries=$DESTDIR$LIBDIR
for_cmake=$libraries/cmake/potential-particles
package=$DESTDIR$PYTHON_DIR/potential_particles
installed=("$header" "$libraries/$library" "$libraries/$soname" "$libraries"/libpotential_particles.{so,a} "$libraries/pkgconfig/potential-particles.pc"
    "$for_cmake"/potential-particles-{config,config-version}.cmake)

if [[ ${1:-} = uninstall ]]; then
    rm -f "${installed[@]}"
    [[ ! $PYTHON_DIR ]] || rm -rf "$package"
    [[ ! -d $for_cmake ]] || rmdir --ignore-fail-on-non-empty "$for_cmake"
    echo "uninstall: version $version, $soname from $DESTDIR$PREFIX and $libraries"
    exit
fi

# A build of its own: programs and the plugin in this tree find the library without a SONAME, by its place.
export CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-target}
cargo rustc --quiet --profile "$PROFILE" --lib --crate-type cdylib,staticlib --target-dir "$CARGO_TARGET_DIR/install" \
    -- -C link-arg=-Wl,-soname,"$soname"
built=$CARGO_TARGET_DIR/install/${PROFILE/#dev/debug}

# Where PREFIX lies from a folder in LIBDIR.
prefix_from() {
    realpath -ms --relative-to="$LIBDIR/$1" "$PREFIX"
}

filled() {
    sed -e "s|@PREFIX_FROM_PC@|$(prefix_from pkgconfig)|g" -e "s|@PREFIX_FROM_CMAKE@|$(prefix_from cmake/potential-particles)|g" \
        -e "s|@VERSION@|$version|g" "packaging/$1" >"$2"
    chmod 644 "$2"
}

install -d "${header%/*}" "$libraries/pkgconfig" "$for_cmake"
install -m 644 include/potential_particles.h "$header"
install -m 644 "$built/libpotential_particles.so" "$libraries/$library"
install -m 644 "$built/libpotential_particles.a" "$libraries"
ln -sf "$library" "$libraries/$soname"
ln -sf "$soname" "$libraries/libpotential_particles.so"
filled potential-particles.pc.in "$libraries/pkgconfig/potential-particles.pc"
for part in config config-version; do
    filled "potential-particles-$part.cmake.in" "$for_cmake/potential-particles-$part.cmake"
done
if [[ $PYTHON_DIR ]]; then
    core=${CORE:-$(scripts/core.sh)}
    rm -rf "$package"
    install -d "$package"
    # With its folders, and without what Python or a build has left there.
    (cd python/potential_particles && find . -type f ! -name '*.pyc' ! -name '_core*.so' -exec install -D -m 644 {} "$package/{}" \;)
    install -m 644 "$core" "$package/_core.abi3.so"
fi
echo "install: version $version, $soname in $DESTDIR$PREFIX and $libraries"
