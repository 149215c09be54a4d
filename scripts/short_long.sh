#!/usr/bin/env bash
# The long runs of YADE, short: small piles, few kills, few starts. Results go to a folder of their own.
set -euo pipefail
cd "$(dirname "$0")/.."

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
# Empty, as make hands them over.
STEPS="" BODIES="" STARTS="" KILLS="" OUTPUT="$folder" tests/yade/long/run.py --short
