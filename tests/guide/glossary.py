# SPDX-License-Identifier: MIT OR Apache-2.0
"""The list of words not to use (docs/glossary.md), for tests/guide/words.py and scripts/messages.py."""
import re
from pathlib import Path

GLOSSARY = Path(__file__).resolve().parents[2] / "docs/glossary.md"


def forbidden():
    """(phrase, what to say, pattern) of each row. A phrase matches whole words, also capitalised, across the end of a
    line.
    """
    table = GLOSSARY.read_text().split("\n## Words not to use\n")[1].split("\n## ")[0]
    found = []
    for row in table.splitlines():
        cells = [cell.strip() for cell in row.strip("|").split("|")]
        if row.startswith("| ") and len(cells) == 2 and not cells[0].startswith("instead"):
            found += [(phrase, cells[1], pattern(phrase)) for phrase in re.split(r",\s*", cells[0])]
    return found


def pattern(phrase):
    first, rest = phrase[0], r"\s+".join(map(re.escape, phrase[1:].split(" ")))
    return re.compile(rf"(?<![\w-])[{first}{first.upper()}]{rest}(?![\w-])")
