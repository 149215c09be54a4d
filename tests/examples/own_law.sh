#!/usr/bin/env bash
# Builds a law in its own folder, as its page says, and runs the script it is given with it.
set -euo pipefail
top=$(cd "$(dirname "$0")/../.." && pwd)
cmake -S "$top/examples/own_law" -B "$OUTPUT/build" >"$OUTPUT/build.log"
cmake --build "$OUTPUT/build" >>"$OUTPUT/build.log"
PYTHONPATH=$OUTPUT/build exec "$top/scripts/yade.sh" -j1 "$1"
