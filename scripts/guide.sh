#!/usr/bin/env bash
# The guide as a site: docs/ by Sphinx, within YADE, and the library's documentation by rustdoc.
#   scripts/guide.sh FOLDER
set -euo pipefail
cd "$(dirname "$0")/.."
folder=${1:?scripts/guide.sh FOLDER}
rm -rf "$folder"
mkdir -p "$folder"
scripts/yade.sh -j1 docs/build.py "$folder"
rm -rf "$folder/.doctrees" "$folder/.buildinfo"
# Without the C interface, whose comments are plain text for the header.
RUSTDOCFLAGS="-D warnings" cargo doc --quiet --no-deps --lib --no-default-features --features equilibrium,serde
cp -r "${CARGO_TARGET_DIR:-target}/doc" "$folder/rust"
echo "The guide: $folder/index.html"
