#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""YADE for a long time, killed, and started very often: what breaks?

    tests/yade/long/run.py [--short]        (make long)

A pile of pyramids for very many steps, at rest and shaken; runs that are killed and go on from their last save, beside
the same with YADE's built-in functor; and a tiny scene started again and again with two threads. Results
go to out/long/summary.json, limits and what was found to the screen. --short: small, among the tests.
Environment: BODIES (200), STEPS (200000), STARTS (500), KILLS (10), OUTPUT (out/long).
"""
import json
import os
import random
import re
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
TOP = HERE.parents[2]
sys.path.insert(0, str(TOP / "studies"))

import machine
import settings
from progress import Progress
from summary import write_summary

SEED = 2012
SHORT = "--short" in sys.argv[1:]
# bodies and steps until they lie still, steps after; starts; kills
BODIES, SETTLE, STEPS, STARTS, KILLS = (12, 10_000, 3000, 10, 2) if SHORT else (200, 15_000, 200_000, 500, 10)
# Of the runs that are killed: the built-in functor sets their size.
KEPT_BODIES, KEPT_STEPS, EVERY, LATER = (8, 2000, 500, 500) if SHORT else (30, 4000, 500, 1000)
KEPT_STATES = ("positions", "orientations", "velocities")  # m, 1, m/s

# Rise of the total energy between two looks, and its change over the second half, over weight x size:
# damping only takes, and a pile at rest has nothing left to give but slow spins. (A short run is not quite there.)
MOST_RISE, MOST_DRIFT = (1e-6, 0.1) if SHORT else (1e-9, 1e-6)
# m, 1, m/s: how far a loaded run may be from the unbroken one after LATER steps. Every contact is the same bit by bit
# until YADE, which orders its pairs anew when it loads, sums forces in another order; the pile amplifies that last
# digit, by chance more or less, with either functor.
MOST_APART = {"positions": 1e-6, "orientations": 1e-5, "velocities": 1e-3}
MOST_OVERLAP = 0.05  # over the size
# MiB: a hundred records and Python's own ups and downs; one byte a pair and step would be tens of times that.
MOST_GROWTH = 2.0


# This script's own, which make hands over empty when they are not given: the parts get theirs from here.
OWN = ("BODIES", "STEPS", "STARTS", "KILLS", "OUTPUT")

running = []  # the last process


def yade(threads, script, **environment):
    """The running process, and what it says through a pipe."""
    inherited = {key: value for key, value in os.environ.items() if key not in OWN}
    # In a session of its own: Ctrl-C is for this script, which then ends what it started.
    running[:] = [subprocess.Popen(
        [TOP / "scripts" / "yade.sh", f"-j{threads}", HERE / script], text=True, start_new_session=True,
        env={**inherited, "PYTHONPATH": str(HERE.parent), **{key: str(value) for key, value in environment.items()}},
        stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)]
    return running[0]


def end():
    """Kills what runs."""
    for process in running:
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGKILL)
            process.communicate()


def finish(process, what):
    """All that it said; SystemExit with the end of that unless it ended well."""
    text, _ = process.communicate()
    if process.returncode:
        raise SystemExit(f"{text[-2000:]}\n{what} ended with exit code {process.returncode}")
    return text


def endurance(folder, shaken):
    """A pile at rest or shaken, and what became of it."""
    bodies = settings.whole_number("BODIES", BODIES, 2, "number of pyramids")
    steps = settings.whole_number("STEPS", STEPS, 400, "number of steps")
    name = "shaken" if shaken else "at rest"
    print(f"{bodies} pyramids, {SETTLE:,} steps to fall and {steps:,} {name}", flush=True)
    result = folder / "endurance.json"
    begin = time.perf_counter()
    process = yade(1, "endurance.py", BODIES=bodies, SETTLE=SETTLE, STEPS=steps, SHAKEN=int(shaken), RESULT=result)
    for line in process.stdout:
        if re.match(r" *\d+%", line):
            print("  " + line, end="", flush=True)
    finish(process, f"the pile {name}")
    found = json.loads(result.read_text())
    looks = found["looks"]
    energies = [one["kinetic_J"] + one["potential_J"] + one["elastic_J"] for one in looks]
    half, unit = len(looks) // 2, found["weight_times_size_J"]
    return {
        "name": name, "bodies": bodies, "steps": steps, "seconds": time.perf_counter() - begin, "calls": found["calls"],
        "failures": looks[-1]["failures"], "lost": max(one["lost"] for one in looks),
        "largest_overlap_over_size": max(one["overlap_over_size"] for one in looks),
        "fastest_m_per_s": max(one["fastest_m_per_s"] for one in looks),
        "largest_rise_over_weight_size": max(b - a for a, b in zip(energies, energies[1:])) / unit,
        "drift_in_second_half_over_weight_size": (energies[-1] - energies[half]) / unit,
        "kinetic_first_half_J": max(one["kinetic_J"] for one in looks[1:half]),
        "kinetic_second_half_J": max(one["kinetic_J"] for one in looks[half:]),
        "resident_MiB": looks[-1]["resident_MiB"],
        "growth_MiB": looks[-1]["resident_MiB"] - looks[len(looks) // 20]["resident_MiB"],
        "looks": looks,
    }


def options_of(folder, name):
    return dict(STEPS=KEPT_STEPS, EVERY=EVERY, LATER=LATER, SCENE=folder / name)


def resumed(folder, name, threads, step):
    """A run loaded from the save at a step, LATER steps on."""
    result = folder / "resumed.json"
    finish(yade(threads, "kept.py", **options_of(folder, name), FROM=step, RESULT=result),
           f"{name}, loaded at step {step}")
    return json.loads(result.read_text())


def apart(one, other, step):
    """Largest difference of any number of two states: {positions: m, orientations: 1, velocities: m/s}."""
    pair = [found["states"][str(step)] for found in (one, other)]
    return {
        key: max(abs(x - y) for p, q in zip(pair[0][key], pair[1][key]) for x, y in zip(p, q))
        for key in KEPT_STATES
    }


def worst(rows):
    return {key: max((row[key] for row in rows), default=float("nan")) for key in KEPT_STATES}


def unbroken_and_reloaded(folder, functor, threads, saves):
    """The run that went on, and how far those loaded from its saves are from it after LATER steps."""
    name, result = f"{functor}-{threads}", folder / "unbroken.json"
    finish(yade(threads, "kept.py", BODIES=KEPT_BODIES, FUNCTOR=functor, **options_of(folder, name), RESULT=result),
           name)
    unbroken = json.loads(result.read_text())
    rows = [apart(unbroken, resumed(folder, name, threads, step), step + LATER) for step in saves]
    exact = sum(all(value == 0 for value in row.values()) for row in rows)
    return unbroken, {"functor": functor, "threads": threads, "contacts": unbroken["contacts"], "saves": list(saves),
                      "exact": exact, **worst(rows), "by_save": rows}


def killed(folder, unbroken, number, chance):
    """A run like the unbroken one, killed somewhere after one of its saves, loaded and taken further."""
    options = {**options_of(folder, "killed"), "LATER": 10**8}
    for old in folder.glob("killed-*"):
        old.unlink()
    process = yade(1, "kept.py", BODIES=KEPT_BODIES, FUNCTOR="library", **options, RESULT=folder / "never.json")
    saves = 1 + number % (KEPT_STEPS // EVERY - 1)
    for line in process.stdout:
        saves -= line.startswith("saved")
        if not saves:
            break
    # A step takes some tenths of a millisecond here, a save some milliseconds.
    time.sleep(chance.uniform(0.0, 0.1))
    end()
    if process.returncode != -signal.SIGKILL:
        raise SystemExit(f"the run that was to be killed ended before, with exit code {process.returncode}")
    # Not killed-N.yade.gz.part: the save that the kill broke off.
    last = max(int(re.search(r"-(\d+)\.yade\.gz$", str(path))[1]) for path in folder.glob("killed-*.yade.gz"))
    found = resumed(folder, "killed", 1, last)
    return {"killed_after_step": last, "failures": found["failures"], **apart(unbroken, found, last + LATER)}


def kept(folder, summary):
    """Saves: of runs with either functor, loaded again; and of runs that were killed."""
    chance, saves = random.Random(SEED), range(EVERY, KEPT_STEPS + 1, EVERY)
    unbroken, row = unbroken_and_reloaded(folder, "library", 1, saves)
    summary["reloads"].append(row)
    for number in range(settings.whole_number("KILLS", KILLS, 1, "number of kills")):
        summary["kills"].append(killed(folder, unbroken, number, chance))
    summary["reloads"].append(unbroken_and_reloaded(folder, "builtin", 1, saves)[1])
    for functor in () if SHORT else ("library", "builtin"):
        summary["reloads"].append(unbroken_and_reloaded(folder, functor, 2, saves[-1:])[1])


def starts(count, found):
    """A tiny scene so many times with two threads; adds to `found` what ended otherwise than well, and how it went."""
    progress = Progress(count, unit="start")
    begin = time.perf_counter()
    try:
        for number in range(count):
            process = yade(2, "start.py")
            text, _ = process.communicate()
            ending = next((line for line in text.splitlines() if line.startswith("ended with")), "no end")
            if process.returncode or ending == "no end":
                found["failed"].append({"number": number, "exit_code": process.returncode, "output": text[-2000:]})
            found["endings"][ending] = found["endings"].get(ending, 0) + 1
            found["starts"] += 1
            found["seconds"] = time.perf_counter() - begin
            progress.update(found["starts"])
    finally:
        progress.close()


def checks_of(summary):
    """What must hold, by name."""
    good = {}
    for pile in summary["piles"]:
        name = "the pile " + pile["name"]
        good[f"{name}: no failure"] = pile["failures"] == 0 and pile["calls"] > 0
        good[f"{name}: nobody lost"] = pile["lost"] == 0
        good[f"{name}: overlaps"] = 0 < pile["largest_overlap_over_size"] < MOST_OVERLAP
        good[f"{name}: memory"] = pile["growth_MiB"] < MOST_GROWTH
        if pile["name"] == "shaken":
            good[f"{name}: moves"] = pile["kinetic_second_half_J"] > 1e-3
            good[f"{name}: energy does not build up"] = pile["kinetic_second_half_J"] < 2 * pile["kinetic_first_half_J"]
        else:
            good[f"{name}: energy never rises"] = pile["largest_rise_over_weight_size"] < MOST_RISE
            good[f"{name}: no drift"] = abs(pile["drift_in_second_half_over_weight_size"]) < MOST_DRIFT
    # YADE orders its pairs anew when it loads, and sums differ in their last digit from there on: with either functor.
    # With more threads that order differs from run to run, saved or not: for the table alone.
    rows = {row["functor"]: row for row in summary["reloads"] if row["threads"] == 1}
    for functor, row in rows.items():
        good[f"{functor}: in contact"] = row["contacts"] > 3
    good["loaded runs go on as the unbroken one"] = all(rows["library"][key] <= MOST_APART[key] for key in KEPT_STATES)
    for number, row in enumerate(summary["kills"]):
        good[f"kill {number}"] = row["failures"] == 0 and all(row[key] <= MOST_APART[key] for key in KEPT_STATES)
    good["every start ends well"] = summary["starts"]["starts"] > 0 and not summary["starts"]["failed"]
    return good


def go(summary):
    """Fills the summary part by part, so that Ctrl-C leaves those that ended."""
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        for shaken in (False, True):
            summary["piles"].append(endurance(folder, shaken))
        print(f"{KEPT_BODIES} pyramids, saved every {EVERY} steps, killed and loaded", flush=True)
        kept(folder, summary)
        count = settings.whole_number("STARTS", STARTS, 1, "number of starts")
        print(f"a tiny scene, yade -j2, {count} times", flush=True)
        starts(count, summary["starts"])


def main():
    out = settings.folder("OUTPUT", TOP / "out" / "long")
    out.mkdir(parents=True, exist_ok=True)
    summary = {
        "machine": machine.machine_line(), "date": machine.now(), "seed": SEED, "short": SHORT, "interrupted": False,
        "piles": [], "reloads": [], "kills": [], "starts": {"starts": 0, "failed": [], "endings": {}, "seconds": 0.0}
    }
    try:
        go(summary)
    except KeyboardInterrupt:
        summary["interrupted"] = True
    finally:
        end()
    write_summary(out / "summary.json", summary)
    show(summary)
    print(f"results: {out / 'summary.json'}")
    if summary["interrupted"]:
        print("interrupted: the parts that had ended are above")
        return 130
    good = checks_of(summary)
    for name, held in good.items():
        if not held:
            print(f"does not hold: {name}")
    print(f"{sum(good.values())} passed, {sum(not held for held in good.values())} failed")
    return 0 if all(good.values()) else 1


def show(summary):
    """Tables of a run; docs/reliability.md has their sum."""
    print(
        "\n| pile | steps | contacts asked for | failures | lost | energy, largest rise, W x size | drift in the second half "
        "| largest overlap, size | memory grew by, MiB | time, s |\n|---|---|---|---|---|---|---|---|---|---|")
    for p in summary["piles"]:
        print(f"| {p['name']} | {p['steps']:,} | {p['calls']:,} | {p['failures']} | {p['lost']} "
              f"| {p['largest_rise_over_weight_size']:.1e} | {p['drift_in_second_half_over_weight_size']:.1e} "
              f"| {p['largest_overlap_over_size']:.1e} | {p['growth_MiB']:.2f} | {p['seconds']:.0f} |")
    print(
        "\n| unbroken against loaded | saves | bit by bit | positions, m | orientations | velocities, m/s |\n|---|---|---|---|---|---|"
    )
    for row in summary["reloads"]:
        print(f"| {row['functor']}, -j{row['threads']} | {len(row['saves'])} | {row['exact']} | "
              + " | ".join(f"{row[key]:.1e}" for key in KEPT_STATES) + " |")
    kills = summary["kills"]
    exact = sum(all(row[key] == 0 for key in KEPT_STATES) for row in kills)
    print(f"| library, -j1, killed | {len(kills)} | {exact} | " + " | ".join(f"{value:.1e}"
                                                                             for value in worst(kills).values()) + " |")
    begun = summary["starts"]
    print(f"\n{begun['starts']} starts, {len(begun['failed'])} failed, {begun['seconds']:.0f} s\n", flush=True)


if __name__ == "__main__":
    sys.exit(main())
