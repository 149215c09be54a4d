# SPDX-License-Identifier: MIT OR Apache-2.0
"""Rows and targets as a page of Markdown and on the terminal."""

HEADS = ("case", "closed form", "found", "error")


def markdown(results, summary):
    """table.md."""
    lines = [
        "# Classics of blocks", "", f"{summary['date']}, {summary['machine']}, {summary['wall_seconds']:.0f} s", ""
    ]
    lines += ["| " + " | ".join(HEADS) + " |", "|" + "---|" * len(HEADS)]
    for result in results.values():
        lines.append(f"| **{result['title']}** | | | |")
        lines += ["| " + " | ".join(_cells(one)) + " |" for one in result["rows"]]
    lines += ["", "| target | | limit | measured | |", "|---|---|---|---|---|"]
    for one in summary["targets"]:
        lines.append(
            f"| {one['name']} | {one['sense']} | {one['target']:g} | {_number(one['measured'])} | {_verdict(one)} |")
    return "\n".join(lines) + "\n"


def print_rows(results):
    """The table for people."""
    rows = [HEADS]
    for result in results.values():
        rows.append((result["title"].upper(), "", "", ""))
        rows += [_cells(one) for one in result["rows"]]
    widths = [max(len(cells[i]) for cells in rows) for i in range(4)]
    print()
    for cells in rows:
        print("  " + cells[0].ljust(widths[0]) + "".join("  " + cell.rjust(width)
                                                         for cell, width in zip(cells[1:], widths[1:])))


def print_targets(summary, out):
    """Each target, and where the results are."""
    print()
    width = max((len(one["name"]) for one in summary["targets"]), default=0)
    for one in summary["targets"]:
        print(
            f"  {one['name']:<{width}}  {_number(one['measured']):>9} {one['sense']} {one['target']:<6g} {_verdict(one)}"
        )
    print(f"\n  {summary['wall_seconds']:.0f} s in all; {summary['machine']}\n  results: {out}", flush=True)


def _cells(one):
    unit = f" {one['unit']}" if one["unit"] else ""
    return one["what"], _number(one["closed_form"]) + unit, _number(one["found"]) + unit, _number(one["error"], "+.2g")


def _number(value, style=".5g"):
    return "none" if value is None else format(value, style)


def _verdict(one):
    return "met" if one["met"] else "MISSED"
