#!/usr/bin/python3
# SPDX-License-Identifier: MIT OR Apache-2.0
"""Every error and warning of every layer, for review: where it stands, its length, its text. What differs from case to
case is {...}.

    scripts/messages.py              as a list
    scripts/messages.py --long       those above 200 characters alone
    scripts/messages.py --words      those with words that the glossary says not to use
    scripts/messages.py --count      how many there are in each layer

Rust: thiserror's #[error(...)], and what errors of the C interface say. C++: what is thrown, and errors and warnings of
LAMMPS. Python: what is raised or warned.
"""
import ast
import re
import sys
from pathlib import Path

TOP = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(TOP / "tests/guide"))
from glossary import forbidden  # noqa: E402
MOST = 200
LITERAL = re.compile(r'"((?:[^"\\]|\\.)*)"', re.DOTALL)
LAYERS = [
    ("library", "src", "*.rs", r"#\[error\("),
    ("C interface", "src/capi", "*.rs", r"=> \"|c_str!\(|\bc\""),
    ("wheel", "python/src", "*.rs", r"\b(?:refused|wrong)\(|::new_err\("),
    ("YADE plugin", "yade-glue/src", "*.[ch]pp", r"\bthrow [\w:]+\(|PyErr_\w+\(|\bfail\(|LOG_(?:WARN|ERROR)\("),
    ("LAMMPS plugin", "lammps-glue/src", "*.[ch]pp", r"error->(?:all|one|warning|universe_all)\(|\bthrow [\w:]+\("),
    ("both plugins", "plugin-common", "*.[ch]pp", r"\bthrow [\w:]+\("),
]
PYTHON = [("YADE plugin, Python", "yade-glue/python"), ("Python", "python/potential_particles")]
ERRORS = re.compile(r"(Error|Exception|Warning|SystemExit)$")


def call(text, begin):
    """What stands between the parentheses that open at begin, strings left whole."""
    depth, position = 0, begin
    while position < len(text):
        if text[position] == '"':
            literal = LITERAL.match(text, position)
            position = literal.end() if literal else position + 1
            continue
        depth += {"(": 1, ")": -1}.get(text[position], 0)
        if depth == 0:
            return text[begin:position]
        position += 1
    return text[begin:]


def joined(parts):
    return re.sub(r"\s+", " ", "".join(part.replace('\\"', '"').replace("\\n", " ") for part in parts)).strip()


def of_compiled(layer, folder, names, start):
    for path in sorted((TOP / folder).rglob(names)):
        text = path.read_text()
        for match in re.finditer(start, text):
            opening = text.find("(", match.start())
            if match[0].endswith('"'):
                literal = LITERAL.match(text, match.end() - 1)
                said = [literal[1]] if literal else []
            elif 0 <= opening <= match.end():
                said = [one[1] for one in LITERAL.finditer(re.sub(r"\\\n\s*", "", call(text, opening)))]
            else:
                said = []
            # Names of fields and formats are no sentences.
            if " " in (message := joined(said)):
                yield layer, path, text.count("\n", 0, match.start()) + 1, message


def words(node):
    """The text of an expression, as far as it is known."""
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        return node.value
    if isinstance(node, ast.JoinedStr):
        return "".join(words(value) if isinstance(value, ast.Constant) else "{...}" for value in node.values)
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Mod):
        return words(node.left)
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add):
        return words(node.left) + words(node.right)
    return "{...}"


def of_python(layer, folder):
    for path in sorted((TOP / folder).rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text())):
            raised = node.exc if isinstance(node, ast.Raise) else node if isinstance(node, ast.Call) else None
            if not isinstance(raised, ast.Call) or not raised.args:
                continue
            name = ast.unparse(raised.func)
            if not (isinstance(node, ast.Raise) or name.endswith("warn") or ERRORS.search(name)):
                continue
            message = joined([words(raised.args[0])])
            if " " in message:
                yield layer, path, raised.lineno, message


def main():
    found = {}
    for layer, *where in LAYERS:
        for layer, path, line, message in of_compiled(layer, *where):
            found.setdefault((path, line), (layer, message))
    for layer, folder in PYTHON:
        for layer, path, line, message in of_python(layer, folder):
            found.setdefault((path, line), (layer, message))
    long = [message for _, message in found.values() if len(message) > MOST]
    if "--count" in sys.argv:
        for layer in dict.fromkeys(layer for layer, _ in found.values()):
            print(f"{sum(one == layer for one, _ in found.values()):6}  {layer}")
    else:
        last, phrases = None, forbidden()
        for (path, line), (layer, message) in found.items():
            if "--long" in sys.argv and len(message) <= MOST:
                continue
            if "--words" in sys.argv and not any(pattern.search(message) for *_, pattern in phrases):
                continue
            if layer != last:
                print(f"\n{layer}\n")
                last = layer
            print(f"{path.relative_to(TOP)}:{line}: {len(message)}: {message}")
    print(f"\n{len(found)} messages, {len(long)} above {MOST} characters")


main()
