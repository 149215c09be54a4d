# SPDX-License-Identifier: MIT OR Apache-2.0
"""Runs the tests of the wheel, and the Python blocks of docs/wheel.md, docs/derivatives.md and docs/equilibrium.md one
after the other, in the Python that has the wheel.

    PYTHON python/tests/run.py

The last line is "N passed, N failed".
"""
import os
import re
import sys
import tempfile
import traceback
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
PAGES = [HERE.parents[1] / "docs" / name for name in ("wheel.md", "derivatives.md", "equilibrium.md")]


def run_page(page):
    """How many blocks ran to their end, and how many did not. They share their names, as cells of a notebook do."""
    text, names, passed, failed = page.read_text(encoding="utf-8"), {"__name__": "page"}, 0, 0
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        # Not those that run elsewhere, after a comment that says where.
        for found in re.finditer(r"(?<! -->\n)^```python\n(.*?)^```", text, re.M | re.S):
            place = f"{page.name}:{text.count(chr(10), 0, found.start()) + 1}"
            try:
                exec(compile(found[1], place, "exec"), names)
                passed += 1
            except Exception:
                print(f"{place} fails")
                traceback.print_exc()
                failed += 1
        os.chdir(HERE)
    return passed, failed


def main():
    suite = unittest.defaultTestLoader.discover(str(HERE), "test_*.py")
    result = unittest.TextTestRunner(verbosity=1).run(suite)
    failed = len(result.failures) + len(result.errors)
    passed = result.testsRun - failed - len(result.skipped)
    pages = [run_page(page) for page in PAGES]
    of_page = [sum(counts) for counts in zip(*pages)]
    print(f"{passed + of_page[0]} passed, {failed + of_page[1]} failed")
    sys.exit(1 if failed or of_page[1] else 0)


main()
