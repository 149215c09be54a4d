#!/usr/bin/env bash
# What is looked at before a release, beside "make lint" and not by the build server: licences and sources of the dependencies (cargo-deny), changes of the
# Rust interface since the last tag (cargo-semver-checks), the recipes under packaging/ (py-rattler-build, in an environment of its own). A tool that is not
# installed is named and skipped; ADVISORIES=1 asks cargo-deny for known weaknesses, too, whose list it fetches by git.
set -uo pipefail
cd "$(dirname "$0")/.." || exit 1

TOOLS=${CARGO_TARGET_DIR:-target}/release-tools
status=0

look() {
    local name=$1
    shift
    if "$@"; then echo "$name: ok"; else
        echo "$name: FAILED" >&2
        status=1
    fi
}

if cargo deny --version >/dev/null 2>&1; then
    look "dependencies" cargo deny --locked check bans licenses sources ${ADVISORIES:+advisories}
else
    echo "dependencies: skipped, cargo-deny is not installed (cargo install --locked cargo-deny)"
fi

last=$(git describe --tags --abbrev=0 --match 'v*' 2>/dev/null)
if ! cargo semver-checks --version >/dev/null 2>&1; then
    echo "Rust interface: skipped, cargo-semver-checks is not installed (cargo install --locked cargo-semver-checks)"
elif [ -z "$last" ]; then
    echo "Rust interface: skipped, no release has a tag v... yet to compare with"
else
    look "Rust interface since $last" cargo semver-checks --baseline-rev "$last"
fi

[ -x "$TOOLS/bin/python" ] || "${PYTHON:-/usr/bin/python3}" -m venv "$TOOLS"
if "$TOOLS/bin/python" -m pip install --quiet --disable-pip-version-check py-rattler-build; then
    look "recipes" "$TOOLS/bin/python" scripts/recipes.py
else
    echo "recipes: skipped, py-rattler-build is not to be had from PyPI"
fi
exit $status
