# SPDX-License-Identifier: MIT OR Apache-2.0
"""The Python blocks of docs/wheel.md, docs/derivatives.md and docs/equilibrium.md, in the Python that has the wheel."""
import os
import re
import tempfile
from pathlib import Path

import pytest

DOCS = Path(__file__).resolve().parents[2] / "docs"
# Not those that run elsewhere, after a comment that says where.
BLOCK = re.compile(r"(?<! -->\n)^```python\n(.*?)^```", re.M | re.S)


class Page:
    """Blocks share their names, as cells of a notebook do: each runs once, after those above it."""

    def __init__(self, name):
        text = (DOCS / name).read_text(encoding="utf-8")
        found = list(BLOCK.finditer(text))
        self.places = [f"{name}:{text.count(chr(10), 0, one.start()) + 1}" for one in found]
        self.sources = [one[1] for one in found]
        self.names, self.raised, self.folder = {"__name__": "page"}, [], tempfile.TemporaryDirectory()

    def run(self, number):
        before = os.getcwd()
        os.chdir(self.folder.name)
        while len(self.raised) <= number:
            place, source = self.places[len(self.raised)], self.sources[len(self.raised)]
            try:
                exec(compile(source, place, "exec"), self.names)
                self.raised.append(None)
            except Exception as error:
                self.raised.append(error)
        os.chdir(before)
        if self.raised[number]:
            raise self.raised[number]


PAGES = [Page(name) for name in ("wheel.md", "derivatives.md", "equilibrium.md")]


@pytest.mark.parametrize(
    "page, number",
    [pytest.param(page, number, id=place) for page in PAGES for number, place in enumerate(page.places)])
def test_block(page, number):
    page.run(number)
