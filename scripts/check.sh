#!/usr/bin/env bash
# What to run before each commit: formatting, the Rust tests, the C harness and one scene of YADE, from a build without link-time
# optimisation (the profile "quick" of Cargo.toml). Called by "make check"; "make test" is everything.
set -uo pipefail
cd "$(dirname "$0")/.." || exit 1

. scripts/stages.sh
begin check-logs

glue() {
    cmake -S yade-glue -B yade-glue/build -DPP_LIBRARY="$CARGO_TARGET_DIR/quick/libpotential_particles.so" &&
        cmake --build yade-glue/build --parallel "$(nproc)"
}

if cargo fmt --version >/dev/null 2>&1; then
    stage check "Formatting of Rust" cargo fmt --check
fi
# Those of minutes, and the one of a feature, are left to "make test".
tests=(--lib)
for file in tests/*.rs; do
    name=$(basename "$file" .rs)
    case $name in
    stress | fuzz_replay | serde) ;;
    *) tests+=(--test "$name") ;;
    esac
done
stage suite "Constants of the theory" tests/guide/constants.py
stage check "Library, quick build" cargo build --profile quick --lib --example solve_pairs
stage check "Rust tests, quick build" cargo test --profile quick --no-run "${tests[@]}"
stage suite "Rust tests, with the C header" cargo test --profile quick --no-fail-fast "${tests[@]}"
stage suite "C harness" make --no-print-directory --silent -C tests/c run PROFILE=quick
if command -v yade >/dev/null; then
    stage check "YADE plugin, build and comparison with the installed YADE" glue
    stage suite "YADE: particles with particles, spheres, boxes, walls and facets" tests/yade/run.py -j 1 mixed
else
    echo "YADE is not installed: its plugin was not tried (make setup installs it)"
fi

finish
