#!/usr/bin/python3
# SPDX-License-Identifier: MIT OR Apache-2.0
"""Side by side with the codes a user would pick instead: pairs, patches, and piles.

The contestants are installed first; then no network.

    benches/peers/run.py [--quick] [--only pairs|patches|piles]

Results go to out/peers: summary.json with targets, table.md, peers.png. Leave the machine alone meanwhile.
"""

import argparse
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "studies"))

import install
import measure_pairs
import measure_piles
import patches
import report
from summary import made, print_table, print_targets, write_summary


def main():
    arguments = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    arguments.add_argument("--quick", action="store_true", help="a little of everything, in a minute")
    arguments.add_argument("--only", choices=("pairs", "patches", "piles"),
                           help="one of the parts; the others are left out of the results")
    options = arguments.parse_args()
    started = time.perf_counter()
    print("Contestants", flush=True)
    found = install.everybody()
    summary = {
        **made("make peers" + (" QUICK=1" if options.quick else "")), "versions": found.versions,
        "missing": found.missing, "load_before": measure_pairs.load(), "load_after": None, "targets": []
    }
    line = f"{summary['machine']}, {summary['date']}"
    parts = [f"*{line}; {summary['command']}*"]
    if options.only in (None, "pairs"):
        parts += pairs_part(found, options.quick, line, summary)
        # What was measured stays if the rest is interrupted.
        write_results(parts, summary)
    if options.only in (None, "patches"):
        parts += table_part("patches", "A contact patch", patches, found, options.quick, summary)
        write_results(parts, summary)
    if options.only in (None, "piles"):
        parts += table_part("piles", "A pile", measure_piles, found, options.quick, summary)
    # Figures that others publish, on their machines: of the paper, and of codes that no package registry has.
    parts += ["## As others publish it", (install.HERE / "published.md").read_text().strip()]
    summary["load_after"] = measure_pairs.load()
    write_results(parts, summary)
    print_targets(summary["targets"])
    print_table([("time", f"{time.perf_counter() - started:.0f} s"),
                 ("results", f"{install.OUT}: table.md, peers.png, summary.json")])


def write_results(parts, summary):
    (install.OUT / "table.md").write_text("\n\n".join(parts) + "\n")
    write_summary(install.OUT / "summary.json", summary)


def pairs_part(found, quick, line, summary):
    print("Pairs", flush=True)
    measurement = measure_pairs.Measurement(found, measure_pairs.Effort(quick))
    try:
        rows, curves = measurement.rows(), measurement.curves()
    finally:
        measurement.stop()
    summary.update(pairs=rows, curves=curves)
    summary["targets"] += report.targets(rows)
    report.draw(rows, curves, line, install.OUT / "peers.png")
    return [
        "## A pair: microseconds a call, from nothing / from memory", report.pair_table(rows),
        "## Distance of bodies that are near, from nothing / from memory", report.distance_table(rows),
        "## Who computes what, and how exactly", report.contestant_table(rows, found),
    ]


def table_part(name, heading, of, found, quick, summary):
    """`of`: a module with the rows, the targets and the table of this part."""
    print(name.capitalize(), flush=True)
    rows = of.rows(found, quick)
    summary[name] = rows
    summary["targets"] += of.targets(rows)
    return [f"## {heading}", of.table(rows)]


if __name__ == "__main__":
    main()
