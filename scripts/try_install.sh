#!/usr/bin/env bash
# Installs the library from a checkout whose path has a space and an umlaut, moves what was installed, builds an example
# with it by pkg-config, by pkg-config statically, and by CMake with both targets, imports it in Python, and uninstalls it. Needs cargo, a C
# compiler, pkg-config, CMake and numpy; CARGO_TARGET_DIR may hold an earlier build.
set -euo pipefail
cd "$(dirname "$0")/.."
CARGO_TARGET_DIR=$(realpath -m "${CARGO_TARGET_DIR:-target}")
export CARGO_TARGET_DIR
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

try() {
    local what=$1
    shift
    "$@" >"$work/log" 2>&1 || { printf 'FAILED: %s\n' "$what"; cat "$work/log"; exit 1; }
    printf 'ok   %s\n' "$what"
}

checkout="$work/a chëckout"
mkdir "$checkout"
tar --exclude=./.git --exclude=./target --exclude=./out --exclude=./yade-glue/build -cf - . | tar -xf - -C "$checkout"
prefix="$work/some where"
try "installed from and to a path with spaces" make -C "$checkout" install PREFIX="$prefix"
moved="$work/möved to"
mv "$prefix" "$moved"
export PKG_CONFIG_PATH="$moved/lib/pkgconfig" LD_LIBRARY_PATH="$moved/lib"

by_python() {
    PYTHONPATH=$moved/lib/python3/dist-packages /usr/bin/python3 -c 'import potential_particles as pp; assert pp.Particle.sphere(2).R == 2 and pp.__file__.startswith("'"$moved"'")'
}
try "Python" by_python

compiled() {
    local flags=$1 out=$2
    # As a shell reads them: pkg-config writes a space as "\ ".
    eval "cc -O1 examples/c/one_pair.c $(pkg-config $flags --cflags --libs potential-particles) -lm $3 -o '$out'"
    "$out"
}
try "pkg-config" compiled "" "$work/shared" ""
try "pkg-config, -static" compiled --static "$work/static" -static

cat >"$work/CMakeLists.txt" <<END
cmake_minimum_required(VERSION 3.18)
project(example C)
find_package(potential-particles 0.2 REQUIRED)
foreach(kind potential-particles static)
    add_executable(by_\${kind} "$PWD/examples/c/one_pair.c")
    target_link_libraries(by_\${kind} potential-particles::\${kind} m)
endforeach()
END
by_cmake() {
    cmake -S "$work" -B "$work/build" -DCMAKE_PREFIX_PATH="$moved" && cmake --build "$work/build" && "$work/build/by_potential-particles" && "$work/build/by_static"
}
try "CMake" by_cmake

removed() {
    make -C "$checkout" uninstall PREFIX="$moved"
    local left
    left=$(find "$moved" -not -type d)
    [[ ! $left ]] || { echo "left: $left"; return 1; }
}
try "uninstalled without a trace" removed
