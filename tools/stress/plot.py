# SPDX-License-Identifier: MIT OR Apache-2.0
"""Errors and times of a stress run.

    python3 tools/stress/plot.py [out/stress]

Reads summary.json of that folder and draws stress.png there.
"""

import json
import sys
from pathlib import Path

try:
    import matplotlib
except ImportError:
    sys.exit("plot.py: no picture without matplotlib (Debian: python3-matplotlib); the figures are in summary.json")

matplotlib.use("Agg")
import matplotlib.pyplot as plt

# An error of exactly zero has no place on a logarithmic axis.
LEAST = 1e-18


def shares_above(histogram):
    """Share of values above each edge, for a curve that shows the tail."""
    total = sum(count for _, count in histogram)
    edges, shares, above = [], [], total
    for edge, count in histogram:
        edges.append(edge)
        shares.append(above / total)
        above -= count
    return edges, shares


def quantile(histogram, share):
    total, seen = sum(count for _, count in histogram), 0
    for edge, count in histogram:
        seen += count
        if seen >= share * total:
            return edge
    return float("nan")


def main():
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else "out/stress")
    summary = json.loads((folder / "summary.json").read_text())
    families = [family for family in summary["families"] if family["poses"]]
    if not families:
        sys.exit("plot.py: no picture of a run without poses")
    figure, (errors, times, tails) = plt.subplots(
        1, 3, figsize=(15, 0.32 * len(families) + 2.2), gridspec_kw={"width_ratios": [1, 1, 0.9]}
    )
    places = range(len(families))[::-1]
    for place, family in zip(places, families):
        for axes, histogram, colour in ((errors, family["error_histogram"], "#0b3c8c"),
                                        (times, family["time_histogram"], "#c2182f")):
            if not histogram:
                continue
            low, middle, high, last = (max(quantile(histogram, share), LEAST) for share in (0.05, 0.5, 0.99, 1.0))
            axes.plot([low, high], [place, place], color=colour, lw=6, alpha=0.35, solid_capstyle="butt")
            axes.plot([high, last], [place, place], color=colour, lw=1, alpha=0.6)
            axes.plot([middle], [place], "|", color=colour, ms=11, mew=2.5)
            axes.plot([last], [place], "o", color=colour, ms=4)
        worst = family["gap"]["worst"]
        if worst:
            errors.plot([worst], [place], "x", color="#e07b00", ms=5)
    for axes, label in ((errors, "error of s over max(s, 1)"),
                        (times, "s (midway, cold, to the end)")):
        axes.set_xscale("log")
        axes.set_xlabel(label)
        axes.grid(axis="x", alpha=0.3)
        axes.set_yticks(list(places))
    errors.set_yticklabels([family["family"] for family in families])
    times.set_yticklabels([])
    errors.set_title("bar: 5 to 99 %, line: median, dot: worst, cross: worst gap", fontsize=9)
    times.axvline(100 * families_median(summary), color="black", lw=0.8, ls="--")
    times.set_title("dashed: 100 times the median of all", fontsize=9)
    for call in summary["calls"]:
        if call["histogram"]:
            edges, shares = shares_above(call["histogram"])
            tails.step(edges, shares, where="post", label=call["call"])
    tails.set_xscale("log")
    tails.set_yscale("log")
    tails.set_xlabel("s")
    tails.set_ylabel("share of calls that take longer")
    tails.grid(alpha=0.3)
    tails.legend(fontsize=7)
    machine = summary["machine"]
    figure.suptitle(
        f"{summary['poses']:,} poses, seed {summary['seed']}: {summary['failures']} failures "
        f"({machine['processor']}, {machine['cores']} cores, {machine['date'][:10]})", fontsize=11)
    figure.tight_layout()
    figure.savefig(folder / "stress.png", dpi=110)
    print(folder / "stress.png")


def families_median(summary):
    return next(1e-6 * call["microseconds"]["median"] for call in summary["calls"] if call["call"] == "midway, solved to the end, cold")


if __name__ == "__main__":
    main()
