#!/usr/bin/python3
# SPDX-License-Identifier: MIT OR Apache-2.0
"""The version of every manifest, from one source: that of Cargo.toml; and the number of the binary interface, which
stands in the name of the package, from src/capi/abi.rs.

    scripts/versions.py          compares all of them with these
    scripts/versions.py 0.3.0    writes a new version everywhere, Cargo.toml included
    scripts/versions.py abi 4    writes a new number of the interface everywhere
"""
import re
import sys
from pathlib import Path

TOP = Path(__file__).resolve().parents[1]
# Path, what stands before the version, which part of it.
WHOLE, MINOR, ABI = "{0}.{1}.{2}", "{0}.{1}", "{3}"
PACKAGE = "libpotential-particles"
LOCKED = r'name = "potential-particles(?:-python)?"\nversion = "'
PLACES = [
    ("Cargo.toml", r'^version = "', WHOLE),
    ("python/Cargo.toml", r'^version = "', WHOLE),
    *((f"{folder}Cargo.lock", LOCKED, WHOLE) for folder in ("", "python/", "fuzz/", "benches/peers/rust/")),
    ("python/potential_particles/__init__.py", r'^__version__ = "', WHOLE),
    ("yade-glue/python/potential_particles/yade.py", r'^_PLUGIN = "', WHOLE),
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
    ("src/capi/abi.rs", r"^pub const PP_ABI_VERSION: u32 = ", ABI),
    ("include/potential_particles.h", r"^#define PP_ABI_VERSION ", ABI),
    ("packaging/conda/recipe.yaml", r"^  abi: ", ABI),
    *((path, PACKAGE, ABI) for path in ("debian/control", ".gitignore", "docs/install.md", "scripts/try_packages.sh")),
]


def pattern(before):
    return re.compile(f"({before})" + r"(\d+(?:\.\d+)*)", re.MULTILINE | (re.DOTALL if before.startswith(r"\A") else 0))


def first(path, before):
    return pattern(before).search((TOP / path).read_text())[2]


def main():
    given = sys.argv[1:]
    if given and not re.fullmatch(r"\d+\.\d+\.\d+|abi \d+", " ".join(given)):
        sys.exit(f"{' '.join(given)}: it must be three numbers, as in 0.3.0, or abi and a number")
    version, abi = first("Cargo.toml", r'^version = "'), first("src/capi/abi.rs", r"^pub const PP_ABI_VERSION: u32 = ")
    installed = TOP / "debian" / f"{PACKAGE}{abi}.install"
    faults = 0 if installed.exists() else 1
    if faults:
        print(f"{installed.relative_to(TOP)} is missing")
    if len(given) == 2:
        abi = given[1]
        if not faults:
            installed.rename(installed.with_name(f"{PACKAGE}{abi}.install"))
    elif given:
        version = given[0]
    for path, before, form in PLACES:
        text, wanted = (TOP / path).read_text(), form.format(*version.split("."), abi)
        found = pattern(before).findall(text)
        if not found:
            faults += 1
            print(f"{path}: no number after {before}")
        elif given:
            (TOP / path).write_text(pattern(before).sub(lambda match: match[1] + wanted, text))
        for value in {value for _, value in found} - {wanted} if not given else ():
            faults += 1
            print(f"{path}: {value}, and {wanted} is wanted")
    print(f"{len(PLACES) + 1 - faults} passed, {faults} failed")
    sys.exit(1 if faults else 0)


main()
