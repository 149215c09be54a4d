# SPDX-License-Identifier: MIT OR Apache-2.0
# The guide: `make guide` runs Sphinx with this file, within YADE, whose classes the Python reference describes.
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import constants  # noqa: E402

project = "Potential particles"
author = "the authors of potential-particles"
extensions = ["myst_parser", "sphinx.ext.autodoc"]
source_suffix = {".md": "markdown"}
exclude_patterns = ["figures"]
myst_heading_anchors = 3
html_theme = "furo"
html_title = "Potential particles"
html_show_copyright = False
html_copy_source = False
html_static_path = ["static"]
html_css_files = ["wide.css"]
autodoc_member_order = "bysource"
autodoc_typehints = "none"
# Indented blocks name no language: formulas and commands.
highlight_language = "none"

# "name: what it is" at the beginning of a line, after a sentence or a blank line.
PARAMETER = re.compile(r"([a-zA-Z_]+(?:, [a-zA-Z_]+)*): ")
MARKUP = re.compile(r"([\\*|]|_(?=\W|$))")


def plain_text(line):
    """A line of a docstring, which is plain text with `code` in backquotes, as reStructuredText."""
    parts = line.split("`")
    return "".join("``" + part + "``" if i % 2 else MARKUP.sub(r"\\\1", part) for i, part in enumerate(parts))


def as_restructured_text(app, what, name, obj, options, lines):
    """Paragraphs stay paragraphs, what is indented is shown as it is."""
    given, indented = [line.rstrip() for line in lines], False
    lines.clear()
    for before, line in zip(["", *given], given):
        if line.startswith("    ") or (indented and line.startswith(" ")):
            if not indented:
                lines.extend(["", "::", ""])
            indented = True
            lines.append("    " + line)
        else:
            if indented and line.strip():
                lines.append("")
                indented = False
            parameter = PARAMETER.match(line)
            if parameter and (not before.strip() or before.endswith(".")):
                lines.extend(["", f"**{parameter[1]}**: " + plain_text(line[parameter.end():])])
            else:
                lines.append("" if indented else plain_text(line))


def with_constants(app, page, source):
    """The table of constants where a page has its place."""
    source[0] = source[0].replace("<!-- constants -->", constants.table())


def setup(app):
    app.connect("source-read", with_constants)
    app.connect("autodoc-process-docstring", as_restructured_text)
