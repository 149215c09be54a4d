#!/usr/bin/env bash
# Builds the wheel, the library for Python without YADE, into out/wheel, and tries it in a virtual environment that has
# nothing else but numpy, and pytest with what that needs: its tests, and the blocks of its pages. With QUICK=1 it is built for this system alone,
# and the demo is not run. maturin and ziglang, a linker for systems
# with an older C library than this one, come from PyPI into a virtual environment of their own. Called by "make wheel"
# and "make test".
set -euo pipefail
cd "$(dirname "$0")/.."

OUT=${OUTPUT:-out/wheel}
CARGO_TARGET_DIR=$(realpath -m "${CARGO_TARGET_DIR:-target}")
export CARGO_TARGET_DIR
# In a folder of its own: cargo gives the library of other features the same name.
BUILD=$CARGO_TARGET_DIR/maturin
TOOLS=$CARGO_TARGET_DIR/wheel-tools
TRIED=$CARGO_TARGET_DIR/wheel-tried
PYTHON=${PYTHON:-/usr/bin/python3}

die() {
    printf 'wheel: %s\n' "$*" >&2
    exit 1
}

from_pypi() {
    local environment=$1
    shift
    "$environment/bin/python" -m pip install --quiet --disable-pip-version-check "$@" ||
        die "pip could not install $*: it needs PyPI, or a mirror of it that pip is told of"
}

if ! "$TOOLS/bin/maturin" --version >/dev/null 2>&1; then
    "$PYTHON" -m venv --clear "$TOOLS" || die "no virtual environment by $PYTHON (Debian: python3-venv)"
    from_pypi "$TOOLS" 'maturin>=1.7,<2'
fi
if [ "${QUICK:-0}" = 1 ]; then
    # As scripts/core.sh builds it.
    how=(--release)
else
    "$TOOLS/bin/python" -c 'import ziglang' 2>/dev/null || from_pypi "$TOOLS" ziglang
    how=(--release --zig --compatibility manylinux2014)
fi
mkdir -p "$OUT"
rm -f "$OUT"/*.whl
PATH=$TOOLS/bin:$PATH "$TOOLS/bin/maturin" build "${how[@]}" --locked --manifest-path python/Cargo.toml \
    --target-dir "$BUILD" --interpreter "$PYTHON" --out "$OUT"

rm -rf "$TRIED"
"$PYTHON" -m venv "$TRIED"
from_pypi "$TRIED" "$OUT"/*.whl
wants=$("$TRIED/bin/python" -m pip show potential-particles 2>/dev/null | sed -n 's/^Requires: //p')
[ "$wants" = numpy ] || die "it asks for more than numpy: $wants"
from_pypi "$TRIED" pytest
# From elsewhere, so that nothing of the sources is found by its place.
(cd "$TRIED" && bin/python -m pytest "$OLDPWD/python/tests")

# Beside the plugin for YADE, where that is built, with either of them first on the path: without the numpy of the
# environment above.
PLUGIN=yade-glue/build/python
if command -v yade >/dev/null && [ -d "$PLUGIN/potential_particles" ]; then
    rm -rf "$TRIED/alone"
    "$PYTHON" -m zipfile -e "$OUT"/*.whl "$TRIED/alone"
    for path in "$PLUGIN:$TRIED/alone" "$TRIED/alone:$PLUGIN"; do
        PYTHONPATH=$path yade -x -n -j1 python/tests/in_yade.py
        # And in a Python without YADE.
        PYTHONPATH=$path "$PYTHON" -c 'from potential_particles import *; from potential_particles import _core; assert Particle is _core.Particle and detect is _core.detect'
    done
else
    echo "no YADE with a built plugin here: the wheel was not tried beside it"
fi
if [ "${QUICK:-0}" != 1 ]; then
    from_pypi "$TRIED" matplotlib
    (cd "$OUT" && "$TRIED/bin/python" -m potential_particles demo)
fi
