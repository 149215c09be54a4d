#!/usr/bin/python3
# SPDX-License-Identifier: MIT OR Apache-2.0
"""Checks every link of the guide as a site that stays within it: the file is there, and what is named after # too. And
those of every page of the repository that is read as it stands.

    tests/guide/links.py FOLDER

Pages that rustdoc made are link targets, and not looked into: rustdoc checks its own.
"""
import re
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit


class Page(HTMLParser):
    """What a page links to, and the names that it can be entered by."""

    def __init__(self, path):
        super().__init__()
        self.links, self.names = [], set()
        self.feed(path.read_text())

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.names.update(attributes[key] for key in ("id", "name") if attributes.get(key))
        self.links.extend(attributes[key] for key in ("href", "src") if attributes.get(key))


def main():
    site = Path(sys.argv[1]).resolve()
    pages = {path: Page(path) for path in site.rglob("*.html") if site / "rust" not in path.parents}
    passed = failed = 0
    for path, page in sorted(pages.items()):
        for link in page.links:
            parts = urlsplit(link)
            if parts.scheme or parts.netloc:
                continue
            target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            named = not parts.fragment or target not in pages or unquote(parts.fragment) in pages[target].names
            good = target.is_file() and named
            passed, failed = passed + good, failed + (not good)
            if not good:
                print(f"{path.relative_to(site)}: {link} leads nowhere")
    top = Path(__file__).resolve().parents[2]
    for path in (*top.glob("*.md"), *top.glob("*/README.md")):
        for link in re.findall(r"\]\(([^)#]+)\)", path.read_text()):
            good = urlsplit(link).scheme != "" or (path.parent / link).exists()
            passed, failed = passed + good, failed + (not good)
            if not good:
                print(f"{path.relative_to(top)}: {link} leads nowhere")
    if not (site / "index.html").is_file():
        failed += 1
        print(f"{site} has no index.html")
    print(f"{passed} passed, {failed} failed")
    sys.exit(1 if failed or not passed else 0)


main()
