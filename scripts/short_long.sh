#!/usr/bin/env bash
# The long runs of YADE, short: small piles, few kills, few starts. Results go to a folder of their own.
set -euo pipefail
cd "$(dirname "$0")/.."

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
env -u STEPS -u BODIES -u STARTS -u KILLS OUTPUT="$folder" tests/yade/long/run.py --short
