# For scripts that run tests in stages, from the top of the repository.
#
# begin NAME sets LOGS to a folder of that name beside what is built; a script may set LOGS to a folder that exists instead.
# stage KIND NAME COMMAND... prints a heading, runs the command, and adds to passed and failed. Its output is shown
# when it fails (of all with VERBOSE=1). finish prints the sum as the last line, and fails if a stage did.

passed=0
failed=0

begin() {
    # The stages run their own make: they must not look for the job server of the make above.
    unset MAKEFLAGS MFLAGS MAKELEVEL
    CARGO_TARGET_DIR=$(realpath -m "${CARGO_TARGET_DIR:-target}")
    export CARGO_TARGET_DIR
    LOGS=$CARGO_TARGET_DIR/$1
    mkdir -p "$LOGS"
}

# Prints "passed failed", summed over the lines of our own runners and of cargo.
counts() {
    awk '/^[0-9]+ passed, [0-9]+ failed$/ { p += $1; f += $3 }
         /^test result: / { p += $4; f += $6 }
         END { print p + 0, f + 0 }' "$1"
}

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

finish() {
    printf '\n%d passed, %d failed\n' "$passed" "$failed"
    [ "$failed" -eq 0 ]
}
