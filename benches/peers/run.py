#!/usr/bin/python3
# SPDX-License-Identifier: MIT OR Apache-2.0
"""Side by side with the codes a user would pick instead, on the same pairs.

The contestants are installed first; then no network.

    benches/peers/run.py [--quick]

Results go to out/peers: summary.json with targets, table.md, peers.png. Leave the machine alone meanwhile.
"""

import argparse
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "studies"))

import install
import measure_pairs
import report
from summary import made, print_table, print_targets, write_summary


def main():
    arguments = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    arguments.add_argument("--quick", action="store_true", help="a little of everything, in a minute")
    options = arguments.parse_args()
    started = time.perf_counter()
    print("Contestants", flush=True)
    found = install.everybody()
    summary = {
        **made("make peers" + (" QUICK=1" if options.quick else "")), "versions": found.versions,
        "missing": found.missing, "load_before": measure_pairs.load(), "load_after": None, "targets": []
    }
    line = f"{summary['machine']}, {summary['date']}"
    parts = [f"*{line}; {summary['command']}*", *pairs_part(found, options.quick, line, summary)]
    summary["load_after"] = measure_pairs.load()
    (install.OUT / "table.md").write_text("\n\n".join(parts) + "\n")
    write_summary(install.OUT / "summary.json", summary)
    print_targets(summary["targets"])
    print_table([("time", f"{time.perf_counter() - started:.0f} s"),
                 ("results", f"{install.OUT}: table.md, peers.png, summary.json")])


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


if __name__ == "__main__":
    main()
