#!/usr/bin/python3
# SPDX-License-Identifier: MIT OR Apache-2.0
"""Checks that every sentence that docs/troubleshooting.md explains is one that the sources say.

Numbers and "..." stand for what differs from case to case; the parts between them must be found, word by word, in
string literals.
"""
import re
import sys
from pathlib import Path

TOP = Path(__file__).resolve().parents[2]
SOURCES = [
    *(TOP / "src").rglob("*.rs"), *(TOP / "yade-glue/src").rglob("*.[ch]pp"), *(TOP / "yade-glue/python").rglob("*.py")
]
# Shorter parts may be found anywhere.
LEAST = 8


def words(text):
    return re.sub(r"[^a-z(){}=]+", " ", text.lower()).strip()


def main():
    said = words(re.sub(r'"\s*\n\s*[fr]?"', "", "\n".join(path.read_text() for path in SOURCES)))
    table = (TOP / "docs/troubleshooting.md").read_text().split("## Messages")[1].split("\n## ")[0]
    passed = failed = 0
    for row in table.splitlines():
        first = row.split("|")[1] if row.startswith("| ") else ""
        for sentence in re.findall(r"`([^`]+)`", first):
            parts = [words(part) for part in re.split(r"\.\.\.|\b\d+\b|[=:]", sentence)]
            missing = [part for part in parts if len(part) >= LEAST and part not in said]
            passed, failed = passed + (not missing), failed + bool(missing)
            if missing:
                print(f"docs/troubleshooting.md: {sentence!r}: no source says {missing}")
    print(f"{passed} passed, {failed} failed")
    sys.exit(1 if failed or not passed else 0)


main()
