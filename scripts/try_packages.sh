#!/usr/bin/env bash
# In a Debian that has nothing: installs the packages beside this script, uses them from YADE, from C and from CMake,
# and removes them. Called by packages.sh. The last line is "N passed, N failed".
set -uo pipefail
HERE=$(cd "$(dirname "$0")" && pwd)
EXAMPLES=/usr/share/doc/python3-yade-potential-particles/examples
C_EXAMPLES=/usr/share/doc/libpotential-particles-dev/examples
work=$(mktemp -d)
cd "$work" || exit 1
passed=0 failed=0

try() {
    local name=$1 begin=$SECONDS
    shift
    if "$@" >"$work/log" 2>&1; then
        printf 'ok   %s (%d s)\n' "$name" $((SECONDS - begin))
        passed=$((passed + 1))
    else
        printf 'FAIL %s (%d s)\n' "$name" $((SECONDS - begin))
        tail -n 40 "$work/log"
        failed=$((failed + 1))
    fi
}

install() { apt-get -qq install --yes --no-install-recommends "$@"; }
traces() { find / -xdev \( -path "$HERE" -o -path "$work" -o -path /var/lib/dpkg/info -o -path /proc \) -prune -o -iname '*potential?particles*' -print; }

first_pile() { yade -x -n -j1 "$EXAMPLES/first_pile.py" && [ "$(stat -c %s first_pile.png)" -gt 10000 ]; }

batch() {
    printf 'description number\none 1\ntwo 2\n' >table.txt
    cat >batch.py <<'PYTHON'
import potential_particles
from potential_particles import shapes
readParamsFromTable(number=0)
from yade.params.table import number
O.materials.append(FrictMat())
O.bodies.append([potential_particles.body(shapes.cuboid(), position=(2 * i, 0, 0)) for i in range(number)])
open(f"bodies_{number}", "w").write(str(len(O.bodies)))
PYTHON
    yade-batch -j2 --job-threads=1 table.txt batch.py && [ "$(cat bodies_1 bodies_2)" = 12 ]
}

ranks() {
    BODIES=60 STEPS=500 OUTPUT=$work/ranks mpirun --allow-run-as-root --map-by :OVERSUBSCRIBE --bind-to none -np 3 \
        yade -x -n -j1 "$EXAMPLES/mpi_pile.py" | tee ranks.txt && grep -q 'on 3 ranks.*failures: none' ranks.txt
}

by_pkg_config() {
    local example
    for example in one_pair step falling_pyramids; do
        cc -O2 "$C_EXAMPLES/$example.c" $(pkg-config --cflags --libs potential-particles) -lm -o "$example" && "./$example" || return
    done
}

static() { cc "$C_EXAMPLES/one_pair.c" -Wl,-Bstatic -lpotential_particles -Wl,-Bdynamic -lm -o one_static && ./one_static && ! ldd one_static | grep -q potential; }

by_cmake() {
    mkdir -p cmake && cat >cmake/CMakeLists.txt <<CMAKE
cmake_minimum_required(VERSION 3.18)
project(try C)
find_package(potential-particles 0.2 REQUIRED)
add_executable(shared $C_EXAMPLES/one_pair.c)
target_link_libraries(shared potential-particles::potential-particles)
add_executable(static $C_EXAMPLES/one_pair.c)
target_link_libraries(static potential-particles::static)
CMAKE
    cmake -S cmake -B cmake/build && cmake --build cmake/build && cmake/build/shared && cmake/build/static
}

newer_is_refused() {
    mkdir -p newer && printf 'cmake_minimum_required(VERSION 3.18)\nproject(try C)\nfind_package(potential-particles 99.0 REQUIRED)\n' >newer/CMakeLists.txt
    ! cmake -S newer -B newer/build && grep -q 'version: 0[.]' "$work/log"
}

removed() {
    apt-get -qq purge --yes python3-yade-potential-particles libpotential-particles-dev libpotential-particles3 &&
        [ -z "$(traces)" ] || { traces; return 1; }
}

try "installed with apt" install "$HERE"/*.deb
try "a first pile and its picture, without PYTHONPATH" first_pile
try "yade-batch" batch
try "MPI and its Python" install openmpi-bin python3-mpi4py
try "three ranks" ranks
try "a compiler, pkg-config, CMake" install gcc libc6-dev make pkg-config cmake
try "C examples by pkg-config" by_pkg_config
try "linked statically" static
try "CMake's find_package" by_cmake
try "a version that is not there, by CMake" newer_is_refused
try "removed without a trace" removed
printf '%d passed, %d failed\n' "$passed" "$failed"
[ "$failed" -eq 0 ]
