# SPDX-License-Identifier: MIT OR Apache-2.0
"""The numeric constants of the sources with their comments: conf.py makes the table of theory.md (section 10) of them,
tests/guide/constants.py checks them.
"""
import re
from pathlib import Path
from typing import NamedTuple

SRC = Path(__file__).resolve().parents[1] / "src"
# The folders in which a constant stands beside its use; the others have theirs in numbers.rs.
CORE = ["linalg", "pair", "model", "bounds", "solver", "contact", "boundary"]
NUMBER = r"(?:f64|usize|u8|u16|u32|u64|i32|RangeInclusive<f64>)"
CONST = re.compile(
    r"^ *(?:pub(?:\([a-z]+\))? )?const ([A-Z][A-Z0-9_]*): "
    rf"({NUMBER}|\(f64, f64\)|\[+{NUMBER}(?:; \d+\])+)(?: =\s*([^;{{]+))?;", re.MULTILINE)


class Constant(NamedTuple):
    name: str
    value: str
    comment: str


def constants(path):
    """Those of a file. One directly below another shares its comment, as one of several types does."""
    text = re.split(r"#\[cfg\(test\)\]\n(?:#\[[^\n]*\n)*mod ", path.read_text())[0]
    found, of_name, end, comment = [], {}, -1, ""
    for match in CONST.finditer(text):
        above = re.search(r"((?: *///[^\n]*\n)+)(?: *#\[[^\n]*\n)*$", text[:match.start()])
        if above:
            comment = " ".join(re.sub(r"^ *///", "", line).strip() for line in above[1].splitlines()).strip()
        elif text[end + 1:match.start()].strip() or "\n\n" in text[end:match.start()]:
            comment = ""
        end, (name, _, value) = match.end(), match.groups()
        comment = of_name.setdefault(name, comment) or comment
        if value:
            found.append(Constant(name, " ".join(re.sub("//[^\n]*", "", value).split()), comment))
    return found


def paths():
    """The files whose constants are in the table."""
    tables = sorted(path for path in SRC.glob("*/numbers.rs") if path.parent.name not in CORE)
    return [*(path for folder in CORE for path in sorted((SRC / folder).rglob("*.rs"))), SRC / "settings.rs", *tables]


def plain(comment):
    """A comment as a cell of a table: links of rustdoc are names."""
    return re.sub(r"\[`(?:\w+::)*(\w+)`\]", r"`\1`", comment).replace("|", "\\|")


def table():
    """As Markdown; constants with one comment are one row."""
    lines = ["| name | file | value | meaning |", "|---|---|---|---|"]
    for path in paths():
        rows = {}
        for constant in constants(path):
            rows.setdefault(constant.comment, {}).setdefault(constant.name, []).append(constant.value)
        for comment, values in rows.items():
            cells = [", ".join(f"`{part}`" for part in values),
                     ", ".join(f"`{value}`" for several in values.values() for value in several)]
            lines.append(f"| {cells[0]} | {path.relative_to(SRC)} | {cells[1]} | {plain(comment)} |")
    return "\n".join(lines)
