# SPDX-License-Identifier: GPL-2.0-or-later
"""What a test that failed says, in ten lines at most: the check, its values, where it stands, and the last words of
LAMMPS.
"""
import ast
import linecache
import traceback
from pathlib import Path

import scene

HERE = Path(__file__).resolve().parent
LINE, WORDS = 300, 4


def shortened(text):
    text = " ".join(str(text).split())
    return text if len(text) <= LINE else text[:LINE // 2] + " ... " + text[-LINE // 2:]


def parts(node):
    """The comparisons of which an assertion is made."""
    if isinstance(node, ast.BoolOp) and isinstance(node.op, ast.And):
        return [part for value in node.values for part in parts(value)]
    return [node]


def value_of(node, frame):
    return eval(compile(ast.Expression(node), "<check>", "eval"), {**frame.f_globals, **frame.f_locals})


def checks(frame, line):
    """Lines 'check: values' of the assertion that stands there, for the first of its comparisons that does not hold."""
    tree = ast.parse("".join(linecache.getlines(frame.f_code.co_filename)))
    for node in ast.walk(tree):
        if isinstance(node, ast.Assert) and node.lineno <= line <= node.end_lineno:
            for part in parts(node.test):
                if not value_of(part, frame):
                    told = [f"  check: {shortened(ast.unparse(part))}"]
                    if isinstance(part, ast.Compare):
                        inside = isinstance(part.ops[0], ast.In)
                        for what, side in (("wanted" if inside else "value", part.left), ("in" if inside else "wanted",
                                                                                          part.comparators[-1])):
                            told.append(f"  {what}: {shortened(value_of(side, frame))}")
                    return told
    return []


def of_failure(test, raised):
    walked = [(frame, line) for frame, line in traceback.walk_tb(raised.__traceback__)
              if Path(frame.f_code.co_filename).parent == HERE]
    frame, line = next(
        (f for f in reversed(walked) if Path(f[0].f_code.co_filename).name not in ("scene.py", "run.py")), walked[-1])
    told = [f"FAILED: {test.__module__}.{test.__name__} ({Path(frame.f_code.co_filename).name}:{line})"]
    if isinstance(raised, AssertionError):
        try:
            told += checks(frame, line)
        except Exception:
            pass
    if len(told) == 1 or str(raised):
        told.append(f"  {type(raised).__name__}: {shortened(raised)}")
    last = [text.strip() for text in scene.last_words().splitlines() if text.strip()]
    errors = [n for n, text in enumerate(last) if text.startswith("ERROR")]
    return "\n".join(
        told + [f"  LAMMPS: {shortened(text)}" for text in (last[errors[-1]:][:WORDS] if errors else last[-WORDS:])])
