# SPDX-License-Identifier: MIT OR Apache-2.0
"""Rows and targets as a page of Markdown and on the terminal."""

import summary as ending

HEADS = ("case", "closed form", "found", "error")


def markdown(results, summary):
    """table.md."""
    rows = []
    for result in results.values():
        rows += [(f"**{result['title']}**", "", "", ""), *map(_cells, result["rows"])]
    targets = [(one["name"], one["sense"], f"{one['target']:g}", _number(one["measured"]), ending.verdict(one))
               for one in summary["targets"]]
    line = f"{summary['date']}, {summary['machine']}, {summary['wall_seconds']:.0f} s"
    return "\n\n".join(["# Classics of blocks", line, ending.markdown(HEADS, rows),
                        ending.markdown(("target", "", "limit", "measured", ""), targets)]) + "\n"


def print_all(results, summary, out):
    """Rows and targets, and where the results are."""
    rows = [HEADS]
    for result in results.values():
        rows += [(result["title"].upper(), "", "", ""), *map(_cells, result["rows"])]
    ending.print_columns(rows)
    ending.print_targets(summary["targets"])
    print(f"  {summary['wall_seconds']:.0f} s in all; {summary['machine']}\n  results: {out}", flush=True)


def _cells(one):
    unit = f" {one['unit']}" if one["unit"] else ""
    return one["what"], _number(one["closed_form"]) + unit, _number(one["found"]) + unit, _number(one["error"], "+.2g")


def _number(value, style=".5g"):
    return "none" if value is None else format(value, style)
