#!/usr/bin/env bash
# Before a release: versions, words, links, content of the crate, licences of dependencies (cargo-deny), changes of the
# Rust interface since the last tag (cargo-semver-checks), recipes under packaging/ (py-rattler-build). A tool that is
# not installed is named and skipped. FULL=1 adds what takes long: make test, Debian packages, the wheel. ADVISORIES=1
# lets cargo-deny fetch the list of known weaknesses.
set -uo pipefail
cd "$(dirname "$0")/.." || exit 1

TARGET=${CARGO_TARGET_DIR:-target}
TOOLS=$TARGET/release-tools
status=0

look() {
    local name=$1
    shift
    if "$@"; then echo "$name: ok"; else
        echo "$name: FAILED" >&2
        status=1
    fi
}

# The library alone: sources, licences, and the pages whose code is tested with it; what the sources include must be
# there.
crate() {
    local files
    files=$(cargo package --list --allow-dirty --offline) || return 1
    for file in src/lib.rs include/potential_particles.h README.md LICENSE-MIT LICENSE-APACHE CHANGELOG.md CITATION.cff; do
        grep -qx "$file" <<<"$files" || { echo "the crate lacks $file"; return 1; }
    done
    for page in $(sed -n 's/.*include_str!("\.\.\/\(.*\)").*/\1/p' src/lib.rs); do
        grep -qx "$page" <<<"$files" || { echo "the crate lacks $page, which src/lib.rs includes"; return 1; }
    done
    if grep -E '^(tests|yade-glue|lammps-glue|python|out|target)/' <<<"$files"; then
        echo "the crate has files of other parts"
        return 1
    fi
}

# Files of other people's works are named by their licence; ours begin with theirs.
licences() {
    local missing
    missing=$(git ls-files 'yade-glue/src/*.[ch]pp' 'lammps-glue/src/*' 'plugin-common/*' '*.py' | grep -Ev '__init__|/data/' | xargs grep -L SPDX-License-Identifier)
    [ -z "$missing" ] || { echo "without SPDX-License-Identifier: $missing"; return 1; }
}

links() {
    local site=$TARGET/guide
    scripts/guide.sh "$site" >/dev/null && tests/guide/links.py "$site"
}

look "versions" scripts/versions.py
look "words" tests/guide/words.py
look "messages that the guide explains" tests/guide/sentences.py
look "crate" crate
look "licence of each file" licences

if [ -d yade-glue/build/python/potential_particles ]; then look "guide and its links" links; else
    echo "guide and its links: skipped, the plugin is not built (make build)"
fi

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

if [ -n "${FULL:-}" ]; then
    look "tests" make test
    look "packages" make packages-test
    look "wheel" make wheel
else
    echo "tests, packages, wheel: not run (FULL=1)"
fi
exit $status
