# SPDX-License-Identifier: MIT OR Apache-2.0
"""The notebook of the examples, cell by cell, without Jupyter; pictures where matplotlib is there."""
import contextlib
import importlib.util
import io
import json
import os
import tempfile
import unittest
from pathlib import Path

NOTEBOOK = Path(__file__).resolve().parents[2] / "examples" / "notebook.ipynb"


class Notebook(unittest.TestCase):
    def test_its_cells_run_and_it_has_no_outputs(self):
        draws, names, before = importlib.util.find_spec("matplotlib") is not None, {}, os.getcwd()
        if draws:
            import matplotlib
            matplotlib.use("Agg")
        self.addCleanup(os.chdir, before)
        with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stdout(io.StringIO()) as said:
            os.chdir(folder)
            for number, cell in enumerate(json.loads(NOTEBOOK.read_text(encoding="utf-8"))["cells"]):
                if cell["cell_type"] == "code":
                    self.assertEqual((cell["outputs"], cell["execution_count"]), ([], None), f"cell {number}")
                    if draws or "picture" not in cell["metadata"].get("tags", ()):
                        exec(compile("".join(cell["source"]), f"{NOTEBOOK.name}, cell {number}", "exec"), names)
            self.assertEqual(sorted(os.listdir()), ["contact.png", "slope.png"] if draws else [])
            os.chdir(before)
        self.assertEqual(said.getvalue().count("\n"), 3, said.getvalue())
