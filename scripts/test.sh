#!/usr/bin/env bash
# Runs every test: one heading per stage, the whole output of a stage that fails (of all with
# VERBOSE=1), and the sum as the last line. Called by "make test".
set -uo pipefail
cd "$(dirname "$0")/.."

# The stages run their own make: they must not look for the job server of the make above.
unset MAKEFLAGS MFLAGS MAKELEVEL

CARGO_TARGET_DIR=$(realpath -m "${CARGO_TARGET_DIR:-target}")
export CARGO_TARGET_DIR
readonly LOGS=$CARGO_TARGET_DIR/test-logs
mkdir -p "$LOGS"

passed=0
failed=0

# Prints "passed failed", summed over the lines of our own runners and of cargo.
counts() {
    awk '/^[0-9]+ passed, [0-9]+ failed$/ { p += $1; f += $3 }
         /^test result: / { p += $4; f += $6 }
         END { print p + 0, f + 0 }' "$1"
}

# stage KIND NAME COMMAND...
# KIND check: succeeds or fails as a whole and counts as one. KIND suite: counts its own tests, and
# none at all is a failure, since a suite that lost its tests would otherwise look fine.
stage() {
    local kind=$1 name=$2 log status=0 p f begin=$SECONDS
    shift 2
    log=$LOGS/${name//[^A-Za-z0-9]/-}.log
    printf '== %s\n' "$name"
    if [ "${VERBOSE:-0}" = 1 ]; then
        "$@" </dev/null 2>&1 | tee "$log" || status=$?
    else
        "$@" </dev/null >"$log" 2>&1 || status=$?
    fi
    # Interrupted by the user: the rest is not wanted either.
    [ "$status" -ne 130 ] || exit 130
    if [ "$kind" = suite ]; then
        read -r p f < <(counts "$log")
        if [ $((p + f)) -eq 0 ]; then
            echo "no test was run" >>"$log"
            f=1
        elif [ "$status" -ne 0 ] && [ "$f" -eq 0 ]; then
            echo "ended with exit code $status" >>"$log"
            f=1
        fi
    elif [ "$status" -eq 0 ]; then
        p=1 f=0
    else
        p=0 f=1
    fi
    if [ "$f" -gt 0 ] && [ "${VERBOSE:-0}" != 1 ]; then
        cat "$log"
    fi
    printf '   %d passed, %d failed (%d s)\n' "$p" "$f" $((SECONDS - begin))
    passed=$((passed + p))
    failed=$((failed + f))
}

scripts/setup.sh || exit 1

submake() {
    make --no-print-directory --silent "$@"
}

stage check "Library, release build" submake library
stage suite "Rust tests, with the C header" cargo test --release --no-fail-fast
# Without optimisation: how they are built is what is tried, and the shared library stays as it is.
stage suite "Rust tests of the feature serde" cargo test --features serde --test serde
stage suite "Rust tests without the conic back end" cargo test --no-default-features --features capi --test conic_feature
stage check "Library without its default features" cargo check --lib --no-default-features
stage suite "C harness" submake -C tests/c run
stage check "C harness under valgrind" submake -C tests/c valgrind
stage check "C harness under AddressSanitizer and UBSan" submake -C tests/c asan
stage check "Many threads under ThreadSanitizer and helgrind" submake -C tests/c tsan helgrind
stage check "C harness calls every function" submake -C tests/c complete
stage suite "C header as C++17" submake -C tests/c cxx
stage check "YADE plugin, build and comparison with the installed YADE" submake glue
for threads in 1 2; do
    stage suite "YADE scenes, -j$threads" tests/yade/run.py -j "$threads"
done

stage suite "YADE killed and loaded, shaken, started often" scripts/short_long.sh
stage suite "Short demo" scripts/short_demo.sh
stage suite "Short wedge" scripts/short_wedge.sh
stage suite "Short side by side" scripts/short_side_by_side.sh

printf '\n%d passed, %d failed\n' "$passed" "$failed"
[ "$failed" -eq 0 ]
