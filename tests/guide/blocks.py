# SPDX-License-Identifier: MIT OR Apache-2.0
"""The code blocks of a page of the guide.

What a block takes as given is said in a comment right above it, which readers do not see:

    <!-- before:                       runs before the block, in the same language
    size = 0.1
    -->
    <!-- tested by: FILE: TEXT -->     the block cannot run within a test; FILE, which holds TEXT, does what it says
"""
import dataclasses
import re
from pathlib import Path

BEFORE = re.compile(r"<!-- before:\n((?:(?!<!--).)*?)-->\n$", re.DOTALL)
TESTED_BY = re.compile(r"<!-- tested by: ([^\n]+?): ([^\n]+) -->\n$")


@dataclasses.dataclass
class Block:
    page: Path
    line: int
    language: str
    code: str
    before: str
    tested_by: tuple  # (file, text), or None

    @property
    def place(self):
        return f"{self.page}:{self.line}"


def blocks(page):
    """All blocks of a page in order, but those of what programs print (text) and of Sphinx ({...})."""
    lines, found, begin = Path(page).read_text().splitlines(keepends=True), [], None
    for number, line in enumerate(lines):
        if not line.startswith("```"):
            continue
        if begin is None:
            begin = number
            continue
        language, above = lines[begin].strip("`\n"), "".join(lines[:begin])
        if language != "text" and not language.startswith("{"):
            before, tested_by = BEFORE.search(above), TESTED_BY.search(above)
            found.append(Block(Path(page), begin + 1, language, "".join(lines[begin + 1:number]),
                               before[1] if before else "", tested_by.groups() if tested_by else None))
        begin = None
    return found
