#!/usr/bin/env bash
# Builds _core, the library as a module of any Python from 3.10 on, for the package that the plugin of YADE, the wheel
# and LAMMPS's Python share. PROFILE=release. The last line is its path.
set -euo pipefail
cd "$(dirname "$0")/.."
PROFILE=${PROFILE:-release}
# In a folder of its own: cargo gives the library of other features the same name.
build=$(realpath -m "${CARGO_TARGET_DIR:-target}")/maturin
# Not linked to a Python: that which imports it has the functions.
PYO3_BUILD_EXTENSION_MODULE=1 cargo build --quiet --locked --profile "$PROFILE" --manifest-path python/Cargo.toml --target-dir "$build"
echo "$build/${PROFILE/#dev/debug}/lib_core.so"
