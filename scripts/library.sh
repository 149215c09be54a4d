#!/usr/bin/env bash
# Builds the library, with the programs that tests run: so it is the one that cargo test links. Of dependencies cargo
# test wants more features than cargo build, and would build the library again, under the same name.
set -euo pipefail
cd "$(dirname "$0")/.."
exec cargo build --release --lib --example solve_pairs --example first_contact --example step
