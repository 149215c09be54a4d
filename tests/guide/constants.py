#!/usr/bin/python3
# SPDX-License-Identifier: MIT OR Apache-2.0
"""Checks the numeric constants of the sources, of which docs/constants.py makes a table.

In the folders CORE, and for what a bound rests on elsewhere, the comment of each says whether it is derived, estimated,
measured or chosen. In the other folders each stands in numbers.rs, below a comment, but for what UNTUNED names. Where
docs/theory.md says NAME = value, a constant of that name has this value; ε, u and U are the units of rounding (section
4.1).
"""
import math
import re
import sys
from pathlib import Path

TOP = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(TOP / "docs"))
from constants import CORE, SRC, constants, paths  # noqa: E402

# Mathematics (rules, series), marks, sizes of layouts and what users choose by.
UNTUNED = {
    "packing/supply.rs": "GOLDEN", "particle/mass_properties.rs": "MASS_TOLERANCE",
    "particle/plane.rs": "MAX_PLANES", "particle/polyhedron.rs": "REMOVED OF_CUBE",
    "particle/quadrature.rs": "POINTS OF_JUMP DIFFERENCE_OF_JUMP",
    "patch/cap.rs": "SINGLE", "patch/curve.rs": "ONWARDS",
    "patch/disc.rs": "OF_FOURTH", "patch/polygon.rs": "OPEN", "patch/ray.rs": "EVENTS RIM SUMS",
    "patch/rules.rs": "MOST_POINTS", "patch/triangle_rule.rs":
    "POINTS A B SQUARES_A SQUARES_B LOW OF_A OF_B C D E OF_C OF_D OF_E INTEGRALS WHOLE", "section/arc.rs": "SMALL SERIES",
    "section/boundary.rs": "WIDEST", "section/moments.rs": "SMALL TERMS", "shapes/curved_solids.rs": "SIDES",
    "shapes/rounding.rs": "SHARE"
}
# What bounds rest on outside of CORE.
BOUNDS = {
    "particle/numbers.rs": "CORNER_SLACK SQUARABLE NEARBY BOUND_MARGIN MARGIN",
    "section/numbers.rs": "MISS ON_BOUNDARY ROUNDING", "settings.rs": "LEAST_OF_DOUBLES SHARE_OF_REGULARISATION"
}
REASON = re.compile(r"\b(?:derived|estimated|measured|chosen)\b", re.IGNORECASE)
SAID = re.compile(r"`?\b([A-Z][A-Z_]{3,})`?\s=\s([\d½](?:[\d.·⁻⁰¹²³⁴⁵⁶⁷⁸⁹εuU]| − )*[\d⁰¹²³⁴⁵⁶⁷⁸⁹εuU]|[\d½])")
SUPERSCRIPTS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-")
EPSILON = 2.0**-52
UNITS = {"ε": EPSILON, "u": EPSILON / 2, "U": 4 * EPSILON**2}


def values(path):
    """(name, number) of each constant of a file that is one number."""
    known = {"gamma": lambda n: n * EPSILON / 2}
    for name, value, _ in constants(path):
        value = value.replace("f64::EPSILON", str(EPSILON)).replace("Self::", "")
        try:
            known[name] = eval(value, {"__builtins__": {}}, known)
        except (NameError, SyntaxError, AttributeError):
            continue
        yield name, known[name]


def number(text):
    """That of a value as the page writes it."""
    text = re.sub("[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+", lambda power: f"**({power[0].translate(SUPERSCRIPTS)})", text.strip())
    text = re.sub(r"(?<=\d)(?=[εuU])", "*", text.replace("·", "*").replace("−", "-").replace("½", "0.5"))
    return eval(text, {"__builtins__": {}}, UNITS)


def check_reasons():
    for path in sorted(path for folder in CORE for path in (SRC / folder).rglob("*.rs")) + [SRC / x for x in BOUNDS]:
        within = str(path.relative_to(SRC))
        found = {constant.name: constant.comment for constant in constants(path)}
        for name in BOUNDS.get(within, "").split() or found:
            yield None if REASON.search(found.get(name, "")) else (
                f"{within}: the comment of {name} does not say whether it is derived, estimated, measured or chosen")


def check_table(folder):
    """What is wrong with the numbers of a folder that has them in a table of its own."""
    for path in sorted((SRC / folder).rglob("*.rs")):
        within = str(path.relative_to(SRC))
        if path.name == "tests.rs":
            continue
        spared = UNTUNED.get(within, "").split()
        for name, _, comment in constants(path):
            if path.name == "numbers.rs":
                yield None if comment else f"{within}: no comment above {name}"
            elif name not in spared:
                yield f"{within}: {name} does not stand in {folder}/numbers.rs"


def check_page():
    actual = [pair for path in paths() for pair in values(path)]
    for name, value in SAID.findall((TOP / "docs/theory.md").read_text()):
        same = [x for known, x in actual if known == name and not isinstance(x, (list, tuple))]
        good = any(math.isclose(x, number(value), rel_tol=1e-12, abs_tol=0) for x in same)
        yield None if good else f"docs/theory.md: {name} = {value}: the sources have {same or 'no such constant'}"


def main():
    folders = sorted(path.parent.name for path in SRC.glob("*/numbers.rs"))
    checked = [*check_reasons(), *(fault for folder in folders for fault in check_table(folder)), *check_page()]
    faults = [fault for fault in checked if fault]
    for fault in faults:
        print(f"constants: {fault}")
    print(f"{len(checked) - len(faults)} passed, {len(faults)} failed")
    sys.exit(1 if faults or not checked else 0)


main()
