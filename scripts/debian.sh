#!/usr/bin/env bash
# Sets up, builds and tests in another release of Debian, in a folder of its own. Called by "make test-debian13".
# SUITE names the release, CACHE the folder in which it and its packages stay between runs, FRESH=1 makes it anew.
# Exit status 77: skipped, since root or debootstrap is not to be had.
set -uo pipefail
cd "$(dirname "$0")/.." || exit 1

SUITE=${SUITE:-trixie}
CACHE=$(realpath -m "${CACHE:-out/debian}")
readonly SUITE CACHE ROOT=$CACHE/$SUITE

. scripts/chroot.sh
own_namespaces scripts/debian.sh
. scripts/stages.sh

printf 'Debian (%s) in %s\n' "$SUITE" "$ROOT"
stage check "Debian, packages and Rust" prepare_to_build
[ "$failed" -eq 0 ] || { finish; exit 1; }
stage check "Sources" copy_sources
stage check "Set-up" in_sources make setup
stage check "Library and YADE plugin, compared with the YADE of this release" in_sources make build
stage suite "YADE scenes, -j1" in_sources tests/yade/run.py -j 1
stage suite "YADE on 1, 2 and 3 ranks" in_sources tests/mpi/run.py
stage suite "Short demo" in_sources scripts/short_demo.sh
stage check "Guide as a site" in_sources scripts/guide.sh target/guide
stage suite "Links of the guide" in_sources tests/guide/links.py target/guide
stage suite "Code blocks of the guide" in_sources tests/guide/run.py
if [ -e yade-glue/build/python/potential_particles/_glue.so ] && command -v yade >/dev/null; then
    stage suite "Files of this machine's YADE and of the other, loaded by either" scripts/exchange_saves.sh "$ROOT"
else
    echo "== Files of two YADEs: skipped: the plugin is not built on this machine (make build)"
fi

finish
