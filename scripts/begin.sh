#!/usr/bin/env bash
# Set-up, and beside it, where cargo finds a linker already, the library. Called by make test, whose
# first stage builds the library again and reports its errors.
set -uo pipefail
cd "$(dirname "$0")/.."
scripts/library.sh >/dev/null 2>&1 &
library=$!
trap 'kill $library 2>/dev/null' EXIT
scripts/setup.sh || exit
wait $library
exit 0
