#!/usr/bin/python3
# SPDX-License-Identifier: MIT OR Apache-2.0
"""Checks the prose of README, CONTRIBUTING, CHANGELOG and the pages under docs/: no word of the glossary's list of
words not to use (docs/glossary.md), no name of a commit, no line above 120 columns outside tables and code; and that no
comment of the sources is above 120 columns. Counts the words of each page.

    tests/guide/words.py            checks, and fails on a finding or above the limit of words
    tests/guide/words.py --count    words of each page
    tests/guide/words.py --sources  the same words in the comments of the sources, as a list; never fails
"""
import re
import sys
from pathlib import Path

from glossary import GLOSSARY, forbidden

TOP = Path(__file__).resolve().parents[2]
PAGES = [TOP / "README.md", TOP / "CONTRIBUTING.md", *sorted((TOP / "docs").glob("*.md"))]
# CHANGELOG has a limit of lines of its own.
CHANGES = TOP / "CHANGELOG.md"
COLUMNS, MOST_WORDS = 120, 37_580
LIMITS = {"README.md": 110, "CHANGELOG.md": 150}
SOURCES = {
    ".rs": ("src", "python", "tools", "fuzz", "tests", "benches"), ".cpp": ("yade-glue", "lammps-glue", "plugin-common"),
    ".hpp": ("yade-glue", "lammps-glue", "plugin-common"),
    ".py": ("yade-glue", "python", "lammps-glue", "tests", "studies", "benches", "examples", "scripts")
}
COMMENT = {".rs": r"//.*", ".cpp": r"//.*", ".hpp": r"//.*", ".py": r"#.*"}
COMMIT = re.compile(r"\b(?=[0-9a-f]*[0-9])(?=[0-9a-f]*[a-f])[0-9a-f]{7}\b")


def without_code(text):
    """The text with blanks for code, comments and addresses, so that places stay."""
    blank = lambda match: re.sub(r"[^\n]", " ", match[0])
    for pattern in (r"^```.*?^```", r"<!--.*?-->", r"^    .*?$", r"`[^`\n]*`", r"\]\([^)\n]*\)"):
        text = re.sub(pattern, blank, text, flags=re.DOTALL | re.MULTILINE)
    return text


def findings(path, phrases):
    prose = without_code(path.read_text())
    if path != GLOSSARY:
        for phrase, instead, pattern in phrases:
            for match in pattern.finditer(prose):
                yield prose.count("\n", 0, match.start()) + 1, f"{phrase!r}: say {instead}"
    for match in COMMIT.finditer(prose):
        yield prose.count("\n", 0, match.start()) + 1, f"{match[0]}: a commit belongs to git"
    code = False
    lines = path.read_text().splitlines()
    for number, line in enumerate(lines, 1):
        code ^= line.startswith("```")
        if len(line) > COLUMNS and not code and not line.lstrip().startswith("|") and not line.startswith(
            ("    ", "![", "[")):
            yield number, f"{len(line)} columns"
    if len(lines) > LIMITS.get(path.name, len(lines)):
        yield len(lines), f"at most {LIMITS[path.name]} lines"


def count(path):
    """Words with a letter or a digit: the lines of tables and the signs of formulas are none."""
    return sum(re.search(r"\w", word) is not None for word in path.read_text().split())


def comments():
    """(place, line, comment) of each comment of the sources."""
    for ending, folders in SOURCES.items():
        for path in sorted(path for folder in folders for path in (TOP / folder).rglob(f"*{ending}")
                           if "build" not in path.parts):
            for number, line in enumerate(path.read_text(errors="replace").splitlines(), 1):
                if said := re.search(COMMENT[ending], line):
                    yield f"{path.relative_to(TOP)}:{number}", line, said[0]


def of_sources(phrases):
    for place, _, comment in comments():
        for phrase, instead, pattern in phrases:
            if pattern.search(comment):
                print(f"{place}: {phrase!r}: say {instead}")


def wide_comments():
    """Where a line of the sources that is a comment is too long; a table of rustdoc may be."""
    for place, line, comment in comments():
        if len(line) > COLUMNS and line.strip() == comment and "| " not in comment:
            yield f"{place}: {len(line)} columns"


def main():
    phrases = forbidden()
    if "--sources" in sys.argv:
        return of_sources(phrases)
    words = {path.relative_to(TOP): count(path) for path in PAGES}
    if "--count" in sys.argv:
        for path, number in sorted(words.items(), key=lambda item: -item[1]):
            print(f"{number:7,}  {path}")
        print(f"{sum(words.values()):7,}  together")
        return
    failed = 0
    for path in (*PAGES, CHANGES):
        for line, said in sorted(findings(path, phrases)):
            failed += 1
            print(f"{path.relative_to(TOP)}:{line}: {said}")
    for said in wide_comments():
        failed += 1
        print(said)
    if sum(words.values()) > MOST_WORDS:
        failed += 1
        print(f"{sum(words.values())} words, at most {MOST_WORDS}")
    print(f"{0 if failed else len(PAGES) + 1} passed, {failed} failed")
    sys.exit(1 if failed else 0)


main()
