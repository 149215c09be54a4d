#!/usr/bin/python3
# SPDX-License-Identifier: MIT OR Apache-2.0
"""The version of every manifest, from one source: that of Cargo.toml.

    scripts/versions.py          compares all of them with it
    scripts/versions.py 0.3.0    writes a new version everywhere, Cargo.toml included
"""
import re
import sys
from pathlib import Path

TOP = Path(__file__).resolve().parents[1]
# Path, what stands before the version, which part of it.
WHOLE, MINOR = "{0}.{1}.{2}", "{0}.{1}"
LOCKED = r'name = "potential-particles(?:-python)?"\nversion = "'
PLACES = [
    ("Cargo.toml", r'^version = "', WHOLE),
    ("python/Cargo.toml", r'^version = "', WHOLE),
    *((f"{folder}Cargo.lock", LOCKED, WHOLE) for folder in ("", "python/", "fuzz/", "benches/peers/rust/")),
    ("python/potential_particles/__init__.py", r'^__version__ = "', WHOLE),
    ("yade-glue/python/potential_particles/__init__.py", r'^__version__ = "', WHOLE),
    ("src/capi/abi.rs", r"^pub const PP_VERSION_MAJOR: u32 = ", "{0}"),
    ("src/capi/abi.rs", r"^pub const PP_VERSION_MINOR: u32 = ", "{1}"),
    ("src/capi/abi.rs", r"^pub const PP_VERSION_PATCH: u32 = ", "{2}"),
    ("include/potential_particles.h", r"^#define PP_VERSION_MAJOR ", "{0}"),
    ("include/potential_particles.h", r"^#define PP_VERSION_MINOR ", "{1}"),
    ("include/potential_particles.h", r"^#define PP_VERSION_PATCH ", "{2}"),
    ("CITATION.cff", r"^version: ", WHOLE),
    ("CHANGELOG.md", r"\A(?:(?!\n## ).)*\n## \[", WHOLE),
    ("packaging/conda/recipe.yaml", r"^  version: ", WHOLE),
    ("debian/changelog", r"\Apotential-particles \(", WHOLE),
    ("docs/install.md", r"^find_package\(potential-particles ", MINOR),
    ("scripts/try_install.sh", r"^ *find_package\(potential-particles ", MINOR),
    ("scripts/try_packages.sh", r"^ *find_package\(potential-particles ", MINOR),
]


def pattern(before):
    return re.compile(f"({before})" + r"(\d[\d.]*)", re.MULTILINE | (re.DOTALL if before.startswith(r"\A") else 0))


def main():
    if len(sys.argv) > 1 and not re.fullmatch(r"\d+\.\d+\.\d+", sys.argv[1]):
        sys.exit(f"version = {sys.argv[1]}: it must be three numbers, as in 0.3.0")
    source = re.search(r'^version = "(.*)"', (TOP / "Cargo.toml").read_text(), re.MULTILINE)[1]
    version = (sys.argv[1] if len(sys.argv) > 1 else source).split(".")
    faults = 0
    for path, before, form in PLACES:
        text, wanted = (TOP / path).read_text(), form.format(*version)
        found = pattern(before).findall(text)
        if not found:
            faults += 1
            print(f"{path}: no version after {before}")
        elif len(sys.argv) > 1:
            (TOP / path).write_text(pattern(before).sub(lambda match: match[1] + wanted, text))
        for value in {value for _, value in found} - {wanted} if len(sys.argv) == 1 else ():
            faults += 1
            print(f"{path}: version {value}, Cargo.toml has {wanted}")
    print(f"{len(PLACES) - faults} passed, {faults} failed")
    sys.exit(1 if faults else 0)


main()
