#!/usr/bin/python3
# SPDX-License-Identifier: MIT OR Apache-2.0
"""Checks that the table of constants in docs/theory.md and the sources agree.

Every numeric constant of the folders CORE must have a row, every row a constant of its file, and both the same value.
Of the formulas below the table, each name must be a function of its file. In a value ε, u and U are the units of
rounding (section 4.1), "to" stands between the ends of a range. The other folders have their table in numbers.rs:
every numeric constant stands there, below a comment, but for what UNTUNED names.
"""
import math
import re
import sys
from pathlib import Path

TOP = Path(__file__).resolve().parents[2]
CORE = ["linalg", "pair", "model", "bounds", "solver", "contact", "boundary"]
# Mathematics (rules, series), marks, sizes of layouts and what users choose by.
UNTUNED = {
    "packing/supply.rs": "GOLDEN SOME", "particle/mass_properties.rs": "MASS_TOLERANCE",
    "particle/plane.rs": "MAX_PLANES", "particle/polyhedron.rs": "REMOVED OF_CUBE",
    "particle/quadrature.rs": "POINTS OF_JUMP DIFFERENCE_OF_JUMP",
    "patch/cap.rs": "SINGLE", "patch/curve.rs": "ONWARDS",
    "patch/disc.rs": "OF_FOURTH", "patch/polygon.rs": "OPEN", "patch/ray.rs": "EVENTS RIM SUMS",
    "patch/rules.rs": "MOST_POINTS", "patch/triangle_rule.rs":
    "POINTS A B SQUARES_A SQUARES_B LOW OF_A OF_B C D E OF_C OF_D OF_E INTEGRALS", "section/arc.rs": "SMALL SERIES",
    "section/boundary.rs": "WIDEST", "section/moments.rs": "SMALL TERMS", "shapes/curved_solids.rs": "SIDES",
    "shapes/rounding.rs": "SHARE"
}
CONST = re.compile(r"\bconst ([A-Z][A-Z0-9_]*): (?:f64|usize|u8|u16|u32|u64|\(f64, f64\)|\[f64; \d+\]) =\s*([^;>{]+);")
SUPERSCRIPTS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-")
EPSILON = 2.0**-52
# Of a particle, outside of CORE.
MAX_PLANES = int(re.search(r"const MAX_PLANES: usize = ([\d_]+);", (TOP / "src/particle/plane.rs").read_text())[1])
UNITS = {"ε": EPSILON, "u": EPSILON / 2, "U": 4 * EPSILON**2, "π": math.pi, "√": math.sqrt}


def source(path):
    """The text of a file without its comments and unit tests."""
    text = re.split(r"#\[cfg\(test\)\]\n(?:#\[[^\n]*\n)*mod ", path.read_text())[0]
    return re.sub(r"//[^\n]*", "", text)


def constants(path):
    """Name to list of numbers; a constant of several types has that of each."""
    found = {}
    for name, value in CONST.findall(source(path)):
        value = value.replace("f64::EPSILON", "EPSILON").replace("DoubleDouble::UNIT",
                                                                 "UNIT_OF_WIDE").replace("[", "(").replace("]", ")")
        value = value.replace("Self::", "").replace("std::f64::consts::FRAC_PI_2", "HALF_PI")
        known = {
            "gamma": lambda n: n * EPSILON / 2, "EPSILON": EPSILON, "UNIT_OF_WIDE": UNITS["U"],
            "HALF_PI": math.pi / 2, "MAX_PLANES": MAX_PLANES
        }
        known.update({name: values[0] for name, values in found.items()})
        number = eval(value, {"__builtins__": {}}, known)
        found.setdefault(name, []).extend(number if isinstance(number, tuple) else [number])
    return found


def number(text):
    """That of a value as the table writes it."""
    text = re.sub("[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+", lambda power: f"**({power[0].translate(SUPERSCRIPTS)})", text.strip())
    text = re.sub(r"(?<=\d)(?=[εuUπ])", "*", text.replace("·", "*").replace("−", "-"))
    return eval(text, {"__builtins__": {}}, UNITS)


def rows(table):
    for line in table.splitlines():
        cells = [cell.strip() for cell in re.split(r"(?<!\\)\|", line.strip("|"))]
        if line.startswith("| `"):
            yield [name.strip("` ") for name in cells[0].split(",")], *cells[1:]


def check_row(names, path, value):
    """What is wrong with a row."""
    known = constants(TOP / "src" / path)
    missing = [name for name in names if name not in known]
    if missing:
        return f"no constant {missing}"
    given = [number(part) for part in re.split(r", | to |; ", value)]
    actual = [number for name in names for number in known[name]]
    same = len(given) == len(actual) and all(
        math.isclose(x, y, rel_tol=1e-12, abs_tol=0) for x, y in zip(given, actual))
    return None if same else f"{value} is not {actual}"


def check_table(folder):
    """What is wrong with the numbers of a folder that has them in a table of its own."""
    for path in sorted((TOP / "src" / folder).rglob("*.rs")):
        within = str(path.relative_to(TOP / "src"))
        if path.name == "tests.rs":
            continue
        if path.name != "numbers.rs":
            spared = UNTUNED.get(within, "").split()
            names = (name for name, _ in CONST.findall(source(path)) if name not in spared)
            yield from (f"{within}: {name} does not stand in {folder}/numbers.rs" for name in names)
            continue
        lines = path.read_text().splitlines()
        for before, line in zip(lines, lines[1:]):
            if " const " in line and not re.search(r"///| const ", before):
                yield f"{within}: no comment above {line.strip()}"


def main():
    if not re.search(r"\n## 10\. Constants\n", text := (TOP / "docs/theory.md").read_text()):
        sys.exit("docs/theory.md has no section 10")
    of_constants, of_formulas = text.split("\n## 10. Constants\n")[1].split("\n**Formulas.**")
    faults, count, listed = [], 0, set()
    for names, path, value, *rest in rows(of_constants):
        count += 1
        listed.update((path, name) for name in names)
        fault = check_row(names, path, value) or (None if len(rest) == 2 and all(rest) else "meaning or reason lacks")
        faults += [f"{path}, {', '.join(names)}: {fault}"] if fault else []
    for path in sorted(path for folder in CORE for path in (TOP / "src" / folder).rglob("*.rs")):
        within = str(path.relative_to(TOP / "src"))
        count += 1
        faults += [f"{within}: {name} is not in the table" for name in constants(path) if (within, name) not in listed]
    for names, path, *_ in rows(of_formulas):
        count += 1
        text = source(TOP / "src" / path)
        faults += [f"{path}: no function {name}" for name in names if not re.search(rf"\bfn {name}\b", text)]
    for folder in sorted(path.parent.name for path in (TOP / "src").glob("*/numbers.rs")):
        count += 1
        faults += check_table(folder)
    for fault in faults:
        print(f"constants: {fault}")
    print(f"{max(count - len(faults), 0)} passed, {len(faults)} failed")
    sys.exit(1 if faults else 0)


main()
