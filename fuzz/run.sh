#!/usr/bin/env bash
# Fuzzes each target for FUZZ_SECONDS, from its seeds. What it learns stays in out/fuzz; an input that fails is
# written there too, its name is printed, and the script fails.
#   FUZZ_SECONDS=60         how long each
#   TARGETS="particle ..."  which
set -euo pipefail
cd "$(dirname "$0")/.."

# The flags of cargo-fuzz, but for the tracing of comparisons: it takes half of the time, and the comparisons that
# matter here are of floating point, which it does not see. RUSTC_BOOTSTRAP lets the stable compiler take them.
export RUSTC_BOOTSTRAP=1
export RUSTFLAGS="-Cpasses=sancov-module -Cllvm-args=-sanitizer-coverage-level=4 \
-Cllvm-args=-sanitizer-coverage-inline-8bit-counters -Cllvm-args=-sanitizer-coverage-pc-table \
--cfg fuzzing -Zsanitizer=address -Ccodegen-units=1"
# Short stacks of allocations and a small quarantine: clarabel allocates a lot.
export ASAN_OPTIONS=malloc_context_size=4:quarantine_size_mb=16${ASAN_OPTIONS:+:$ASAN_OPTIONS}
host=$(rustc -vV | sed -n 's/^host: //p')
built=${CARGO_TARGET_DIR:-target}/fuzz
cargo build --quiet --release --manifest-path fuzz/Cargo.toml --target "$host" --target-dir "$built"

status=0
for target in ${TARGETS:-particle detect pairs_file walls memories mass}; do
    mkdir -p "out/fuzz/$target"
    printf '%s\n' "$target"
    "$built/$host/release/$target" "out/fuzz/$target" "fuzz/seeds/$target" \
        -max_total_time="${FUZZ_SECONDS:-60}" -timeout=300 -rss_limit_mb=3000 -print_final_stats=1 \
        -artifact_prefix="out/fuzz/$target-" >"out/fuzz/$target.log" 2>&1 || status=$?
    grep -E "^stat::(number_of_executed|new_units)|SUMMARY|panicked|artifact|cov: " "out/fuzz/$target.log" |
        sed -n '/cov: /{h;d};p;${x;p}' | tail -n 8
done
exit $status
