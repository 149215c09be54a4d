# SPDX-License-Identifier: GPL-3.0-or-later
"""Block theory against the simulation and limit analysis on random cuts of a slope. Run inside YADE by `make rock`;
CUTS (1000), TURNS (100), SEED (drawn); adds to out/rock/summary.json.

Of each cut one block at a free face, most often one that block theory frees, if there is one, lies among its
neighbours, which are fixed: it has to move by a millimetre in the direction that block theory has, or to stay within a
tenth of it, if need be with stiffer joints and sharper edges, since block theory is of rigid and sharp blocks. TURNS of
them are run again with blocks that may turn, which block theory leaves out.
"""
import collections
import json
import os
import sys
import time
from pathlib import Path

TOP = Path(sys.argv[0]).resolve().parents[2]
sys.path[:0] = [str(TOP / "tests/yade"), str(TOP / "studies")]

import slope_cuts  # noqa: E402
from progress import Progress  # noqa: E402
from summary import target, write_summary  # noqa: E402

CUTS, TURNS = int(os.environ.get("CUTS") or 1000), int(os.environ.get("TURNS") or 100)
first = int(os.environ.get("SEED") or time.time_ns() % 10**9)
begin, rows, seed = time.monotonic(), [], first
bar = Progress(CUTS, unit="cut")
while len(rows) < CUTS:
    mass, friction, random = slope_cuts.cut(seed)
    one = slope_cuts.chosen(mass, friction, random)
    seed += 1
    if one is None:
        continue
    distance, direction, nearer = slope_cuts.judged(mass, one, friction)
    analysis, factor = slope_cuts.limit_analysis(mass, one, friction)
    row = {
        "seed": seed - 1, "mode": one.mode, "factor": one.factor, "moves": one.moves, "distance": distance,
        "analysis": analysis, "analysis_factor": factor, "nearer": nearer,
        "agrees": slope_cuts.agrees(one, distance, direction)
    }
    if len(rows) < TURNS:
        row["distance_with_turns"] = slope_cuts.moved(mass, one, friction, turns=True)[0]
    rows.append(row)
    bar.update(len(rows))
bar.close()

counts = collections.Counter((row["mode"], row["moves"], row["agrees"]) for row in rows)
print("| mode | block theory | cuts | simulation agrees |\n|---|---|---|---|")
for mode, moves in sorted({(mode, moves) for mode, moves, _ in counts}):
    agree, not_so = counts[mode, moves, True], counts[mode, moves, False]
    print(f"| {mode} | {'moves' if moves else 'stays'} | {agree + not_so} | {agree} |")
print("| mode | limit analysis | cuts |\n|---|---|---|")
analyses = collections.Counter((row["mode"], row["analysis"]) for row in rows)
for (mode, analysis), count in sorted(analyses.items()):
    print(f"| {mode} | {analysis} | {count} |")
for row in rows:
    if row["analysis"] != "same":
        print(f"cut {row['seed']}: {row['mode']}, factor of safety {row['factor']:.4f}, by limit analysis "
              f"{row['analysis_factor']:.4f}: {row['analysis']}")
for row in rows:
    if not row["agrees"] or row["nearer"] > 1:
        print(
            f"cut {row['seed']}: {row['mode']}, factor of safety {row['factor']:.3f}, moved by {row['distance']:.1e} m, {'agrees' if row['agrees'] else 'differs'} "
            f"with joints {row['nearer']:g} times as stiff and edges as sharp")
turned = [row for row in rows if "distance_with_turns" in row and not row["moves"]]
toppled = int(sum(row["distance_with_turns"] > slope_cuts.MOVED for row in turned))
print(f"of {len(turned)} that stay, {toppled} move by 1 mm if they may turn; {time.monotonic() - begin:.0f} s")
file = TOP / "out/rock/summary.json"
summary = json.loads(file.read_text()) if file.exists() else {"targets": []}
name = "cuts of a slope where block theory and simulation differ"
wrong = int(sum(not row["agrees"] for row in rows))
unlike = "cuts without an answer of limit analysis, or with a higher factor than block theory"
other = int(sum(row["analysis"] in ("no answer", "clamped") for row in rows))
summary["targets"] = [one for one in summary["targets"] if one["name"] not in (name, unlike)] + [
    target(name, "at most", 0, wrong), target(unlike, "at most", 0, other)]
summary["key_blocks"] = {
    "cuts": len(rows), "seed": first, "limit_analysis": {f"{mode}, {said}": n for (mode, said), n in analyses.items()},
    "moves": int(sum(row["moves"] for row in rows)), "differ": wrong,
    "rigid_and_sharp": int(sum(row["nearer"] > 1 for row in rows)), "stay": len(turned), "stay_but_turn": toppled,
    "modes": {
        f"{mode}, {'moves' if moves else 'stays'}": sum(row["mode"] == mode and row["moves"] == moves for row in rows)
        for mode, moves in sorted({(row["mode"], row["moves"])
                                   for row in rows})
    }
}
file.parent.mkdir(parents=True, exist_ok=True)
write_summary(file, summary)
