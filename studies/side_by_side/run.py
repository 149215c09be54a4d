# SPDX-License-Identifier: MIT OR Apache-2.0
"""YADE's own contact functor and the one of this library, side by side on the same scenes.

    make side-by-side            (or: scripts/yade.sh -j1 studies/side_by_side/run.py)

Environment: QUICK=1 for a run of seconds that shows that everything works; OUTPUT for another folder
than out/side_by_side. docs/scenes.md explains what is measured and how.
"""

import sys
import time
from pathlib import Path

# YADE runs a script without its folder on Python's path.
HERE = Path(sys.argv[0]).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

import yade

import settings
from bounce import HeadOn, momentum_change
from cases import CASES
from comparison import compare
from contact_functor import BUILTIN, DROP_IN, ContactFunctor
from figure import draw_bounce, draw_cases, draw_costs
from floor import ROUNDS, measure_stages
from known_answers import known_answers, messages_to
from parts import Parts
from report import print_report, targets
from summary import made, write_summary
from trial import run_trial


class Plan:
    """How much is done: the whole, or a little of everything."""

    def __init__(self, quick):
        self.quick = quick
        self.bodies = 12 if quick else 200
        self.stages = (
            [("falling", 1000), ("settling", 2000), ("at rest", 3000)]
            if quick
            else [("falling", 2000), ("settling", 4000), ("at rest", 14000)]
        )
        # Of each run of a case. The built-in functor does not get to the end of all of them in it.
        self.seconds = 1.0 if quick else 11.0
        self.cases = [(case, area) for area in (False, True) for case in CASES]
        if quick:
            wanted = (("pyramids", False), ("tower", False), ("pyramids", True))
            self.cases = [(case, area) for case, area in self.cases if (case.name, area) in wanted]
        # Steps a contact, whether the law keeps contacts that open, whether springs are per area.
        self.bounces = (
            [(100, True, False)]
            if quick
            else [(50, False, False), (200, False, False), (500, True, True), (500, True, False)]
        )
        self.bounce_count = 6 if quick else 50
        self.every = 12 if quick else 1  # of the known answers


def main():
    began = time.perf_counter()
    plan = Plan(settings.choice("QUICK", "0", ("0", "1"), "choice") == "1")
    out = settings.folder("OUTPUT", HERE.parents[1] / "out" / "side_by_side")
    out.mkdir(parents=True, exist_ok=True)
    # An interrupted run does not draw all of them, and those of an earlier run would pass for its own.
    for old in [*out.glob("*.png"), *out.glob("*.txt"), *out.glob("summary.json")]:
        old.unlink()
    results = {"rows": [], "bounces": [], "paths": [], "stages": [], "known_answers": {}, "free_collision": {}}
    trials, interrupted = [], False
    print("YADE's built-in functor and this library's on the same scenes", flush=True)
    parts = [
        *[("case", case, area) for case, area in plan.cases],
        ("bounces",),
        ("pile",),
        ("answers",),
    ]
    progress = Parts([describe(*part) for part in parts])
    try:
        for number, (kind, *what) in enumerate(parts):
            report = progress.of(number)
            if kind == "case":
                trials.append(run_case(plan, results, report, *what))
            else:
                {"bounces": run_bounces, "pile": run_pile, "answers": run_answers}[kind](plan, results, report, out)
            report(1.0)
    except KeyboardInterrupt:
        interrupted = True
    finally:
        progress.close()
    if interrupted:
        print("interrupted: what was measured until now follows", flush=True)
    for area, name in ((False, "side_by_side.png"), (True, "side_by_side_per_area.png")):
        shown = [trial for trial in trials if trial[1] == area]
        if shown:
            draw_cases(out / name, shown, made("")["machine"])
    if results["bounces"]:
        draw_bounce(out / "bounce.png", results["bounces"], results["paths"])
    if results["stages"]:
        draw_costs(out / "step_time.png", results["stages"], plan.bodies)
    summary = summarise(plan, results, interrupted, time.perf_counter() - began)
    write_summary(out / "summary.json", summary)
    print_report(summary, out)
    if interrupted:
        raise SystemExit(130)
    if any(row["library_failures"] for row in results["rows"]):
        raise SystemExit("The library failed on some pairs; see library_failures in summary.json.")


def describe(kind, case=None, area=False):
    return f"{case.name}, springs {'per area' if area else 'fixed'}" if case else kind


def run_case(plan, results, report, case, area):
    """Both functors on one case; the built-in one first, since it decides how far both are compared."""
    steps = case.steps(area)
    builtin = run_trial(case, area, BUILTIN, steps, plan.seconds, lambda part: report(0.7 * part))
    library = run_trial(case, area, DROP_IN, steps, plan.seconds, lambda part: report(0.7 + 0.25 * part))
    results["rows"].append(compare(case, area, builtin, library))
    return case, area, builtin, library


def run_bounces(plan, results, report, _out):
    for number, (steps_per_contact, keep, area) in enumerate(plan.bounces):
        line = HeadOn(steps_per_contact, keep, plan.bounce_count)
        library, builtin = line.run(DROP_IN, area), line.run(BUILTIN, area, plan.seconds)
        exact = None if area else line.exact
        results["paths"].append((library, builtin, exact))
        results["bounces"].append({
            "steps_per_contact": steps_per_contact, "law_keeps_contacts": keep,
            "springs": "per area" if area else "fixed", "exact_springs_drift": exact.drift if exact else None,
            "library": library.summary(), "built_in": builtin.summary()
        })
        report((number + 1) / len(plan.bounces))
    for kind in (DROP_IN, BUILTIN):
        linear, angular = momentum_change(kind, area=False)
        results["free_collision"][kind] = {"momentum_change": linear, "angular_momentum_change": angular}


def run_pile(plan, results, report, _out):
    last = plan.stages[-1][1]
    results["stages"] = measure_stages(plan.bodies, plan.stages, 1 if plan.quick else ROUNDS,
                                       lambda step: report(step / last))


def run_answers(plan, results, _report, out):
    for kind in (DROP_IN, BUILTIN):
        # YADE's functor writes a line for each ray that it loses.
        with messages_to(out / "yade_messages.txt"):
            results["known_answers"][kind] = known_answers(kind, plan.every).summary()


def summarise(plan, results, interrupted, seconds):
    rows, bounces, stages = (results[name] for name in ("rows", "bounces", "stages"))
    return {
        "quick": plan.quick,
        "interrupted": interrupted,
        "seconds": seconds,
        # A quick run is too short to be judged.
        "targets": [] if plan.quick else targets(rows, bounces, stages),
        "rows": rows,
        "bounces": bounces,
        "free_collision": results["free_collision"],
        "known_answers": results["known_answers"],
        "step_by_part": {"bodies": plan.bodies, "stages": stages},
        "threads": yade.O.numThreads,
        "versions": {"yade": yade.config.version, **ContactFunctor(DROP_IN).versions()},
        **made("make side-by-side"),
    }


main()
