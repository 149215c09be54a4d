# SPDX-License-Identifier: MIT OR Apache-2.0
"""Two runs of one case, made into one row: speed, and the physics that both are judged by."""

import numpy as np

from cases import tower_cube, tower_overlaps
from particles import half_height
from touching import DOUBT, ConeJudge

# Below these a difference is rounding, or the cone solver's own, and neither is better.
SAME = {"momentum_error": 1e-12, "energy_rise": 1e-9, "overlap_error": DOUBT, "tower_height_error": 1e-7}


def compare(case, area, builtin, library):
    """A row for the summary. Everything is taken over the steps that both runs made."""
    steps = min(builtin.steps, library.steps)
    judge = ConeJudge(case, area)
    row = {
        "scene": case.name,
        "springs": "per area" if area else "fixed",
        "bodies": len(library.ids),
        "steps_compared": steps,
        "steps_of_full_run": case.steps(area),
        "library_steps": library.steps,
        "library_failures": library.failures,
    }
    theirs, ours = builtin.record.until(steps), library.record.until(steps)
    row["built_in"] = physics(case, area, builtin, theirs, judge)
    row["library"] = physics(case, area, library, ours, judge)
    row["built_in"].update(speed(theirs, beside=ours))
    row["library"].update(speed(ours))
    each, rate = "microseconds_per_interaction", "steps_per_second"
    row["functor_ratio"] = row["built_in"][each] / row["library"][each]
    row["simulation_ratio"] = row["library"][rate] / row["built_in"][rate]
    row["height_difference_over_size"] = (ours.height[-1] - theirs.height[-1]) / case.size
    row["worse"] = worse_than(row["library"], row["built_in"])
    return row


def speed(record, beside=None):
    """Of a run; what is no functor in its loop is taken from the run `beside` where it has no clock of its own."""
    steps = record.step[-1]
    if beside is None:
        calls, seconds = record.calls[-1], record.functor_seconds[-1]
    else:
        law = (beside.loop_seconds[-1] - beside.functor_seconds[-1]) / beside.step[-1]
        calls = float(np.mean(record.pairs)) * steps
        seconds = record.loop_seconds[-1] - law * steps
    return {
        "steps_per_second": steps / record.all_seconds[-1],
        "microseconds_per_interaction": 1e6 * seconds / max(calls, 1.0),
        "pairs": float(np.mean(record.pairs)),
    }


def physics(case, area, trial, record, judge):
    """What a run got right and wrong."""
    misses = judge.judge([moment for moment in trial.moments if moment.step <= record.step[-1]])
    result = {
        "functor": trial.name,
        "largest_overlap_over_size": max(record.overlap) / case.size,
        "contacts": record.contacts[-1],
        "contacts_checked": misses.contacts,
        "missed_contacts": misses.missed,
        "deepest_missed_over_size": misses.deepest / case.size,
        "invented_contacts": misses.invented,
        "overlap_error": misses.overlap_error / case.size,
        "momentum_error": max(record.imbalance),
        # Springs per area store what depends on how the area grew: there is no closed form to add up.
        "energy_rise": None if area else _rise(record),
        "mean_height": record.height[-1],
        "kinetic_energy": record.kinetic[-1],
        "unbalanced_force": record.unbalanced[-1],
    }
    if case.name == "tower" and not area:
        result["tower_height_error"] = _tower_error(case, record)
    return result


def worse_than(ours, theirs):
    """Names of the measures in which the library is worse than the built-in functor, beyond rounding."""
    names = ("missed_contacts", "invented_contacts", *SAME)
    pairs = {name: (ours.get(name), theirs.get(name)) for name in names}
    return [
        name
        for name, (mine, other) in pairs.items()
        if mine is not None and other is not None and mine > max(other * (1.0 + 1e-6), SAME.get(name, 0.0))
    ]


def _rise(record):
    """Largest growth of the whole energy between two looks, over the first; dampers and friction only take."""
    energy = np.array(record.energy)
    return float(max(np.diff(energy).max(initial=0.0), 0.0) / abs(energy[0]))


def _tower_error(case, record):
    """Distance of the cubes' mean height from where their weights hold them, over the size."""
    half = half_height(tower_cube(case))
    ideal = np.cumsum(2.0 * half - tower_overlaps(case, case.springs(False))) - half
    return float(abs(record.height[-1] - ideal.mean()) / case.size)
