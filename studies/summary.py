# SPDX-License-Identifier: MIT OR Apache-2.0
"""The end of a run: targets and tables for people, bars of what a step is made of, and summary.json for programs."""

import json
import sys

import machine
# The package's module alone, by a link: the package itself needs YADE.
from files import write_summary  # noqa: F401


def target(name, sense, limit, measured, **more):
    """An entry of summary.json's list `targets`. sense: "at most" or "at least"; measured: None where it is not known.
    """
    met = None
    if measured is not None:
        met = bool(measured <= limit if sense == "at most" else measured >= limit)
    return {"name": name, "sense": sense, "target": limit, "measured": measured, "met": met, **more}


def verdict(one):
    """Of a target, in a word."""
    return {True: "met", False: "MISSED", None: "not measured"}[one["met"]]


def print_targets(targets):
    """One line each."""
    if not targets:
        return
    print_columns([("target", "", "measured", "")] + [
        (one["name"], f"{one['sense']} {one['target']:g}",
         "-" if one["measured"] is None else f"{one['measured']:.3g}", verdict(one)) for one in targets])


def print_table(rows):
    """rows: (label, text) pairs, lined up."""
    width = max(len(label) for label, _ in rows)
    print()
    for label, text in rows:
        print(f"  {label:<{width}}  {text}")
    print(flush=True)


def print_columns(table):
    """Rows of texts, lined up; the first has the heads."""
    widths = [max(len(row[i]) for row in table) for i in range(len(table[0]))]
    print()
    for row in [table[0], ["-" * width for width in widths], *table[1:]]:
        print("  " + "  ".join(text.ljust(width) for text, width in zip(row, widths)).rstrip())
    print(flush=True)


def markdown(heads, rows):
    """A table as text."""
    lines = [heads, ["---"] * len(heads), *rows]
    return "\n".join("| " + " | ".join(map(str, row)) + " |" for row in lines)


def results_of(folder, names, measure):
    """{name: result} of runs, each kept in folder/NAME.json. Those that the command line names are measured, by default
    all that have no result yet; what the others lack is left out.
    """
    folder.mkdir(parents=True, exist_ok=True)
    files = {name: folder / f"{name}.json" for name in names}
    for name in sys.argv[1:] or [name for name, file in files.items() if not file.exists()]:
        print(name, flush=True)
        files[name].write_text(json.dumps(measure(name)))
    return {name: json.loads(file.read_text()) for name, file in files.items() if file.exists()}


def made(command):
    """What a result was computed with."""
    return {"machine": machine.machine_line(), "date": machine.now(), "command": command}


def save_bars(path, rows, label, title):
    """A picture of stacked bars; rows: {name: {part: value}}, all with the same parts."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(figsize=(9, 0.45 * len(rows) + 1.5), layout="constrained")
    names, left = list(rows)[::-1], [0.0] * len(rows)
    for part in next(iter(rows.values())):
        widths = [rows[name][part] for name in names]
        axes.barh(names, widths, left=left, label=part)
        left = [start + width for start, width in zip(left, widths)]
    axes.set(xlabel=label, title=title)
    axes.legend()
    figure.savefig(path, dpi=120)
    plt.close(figure)
