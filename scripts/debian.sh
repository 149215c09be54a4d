#!/usr/bin/env bash
# Sets up, builds and tests in another release of Debian, in a folder of its own. Called by "make test-debian13". SUITE
# names the release, CACHE the folder in which it and its packages stay between runs, FRESH=1 makes it anew; STAGE:
# stages of make test, separated by commas, or all of them. Exit status 77: skipped, since root or debootstrap is not to
# be had.
set -uo pipefail
cd "$(dirname "$0")/.." || exit 1

SUITE=${SUITE:-trixie}
CACHE=$(realpath -m "${CACHE:-out/debian}")
STAGE=${STAGE:-yade,ranks,guide,blocks}
readonly SUITE CACHE STAGE ROOT=$CACHE/$SUITE

. scripts/chroot.sh
own_namespaces scripts/debian.sh

printf 'Debian (%s) in %s\n' "$SUITE" "$ROOT"
step "Debian, packages and Rust" prepare_to_build
step "Sources" copy_sources
[ "$STAGE" = all ] && STAGES= || STAGES=$STAGE
in_sources make test STAGE="$STAGES" 2>&1 | tee "$LOGS/test.log"
status=${PIPESTATUS[0]}
read -r passed _ failed _ < <(grep -E '^[0-9]+ passed, [0-9]+ failed$' "$LOGS/test.log" | tail -n 1)
if [ -z "${passed:-}" ]; then passed=0 failed=1; fi
if [ -e yade-glue/build/python/potential_particles/_glue.so ] && command -v yade >/dev/null; then
    if scripts/exchange_saves.sh "$ROOT" >"$LOGS/exchange.log" 2>&1; then
        printf "ok   Files of this machine's YADE and of the other, loaded by either\n"
        passed=$((passed + 1))
    else
        printf "FAIL Files of this machine's YADE and of the other, loaded by either\n"
        grep -A 9 '^FAILED' "$LOGS/exchange.log" || tail -n 10 "$LOGS/exchange.log"
        status=1 failed=$((failed + 1))
    fi
else
    echo "Files of two YADEs: skipped: the plugin is not built on this machine (make build)"
fi
printf '%d passed, %d failed\n' "$passed" "$failed"
exit "$status"
