# SPDX-License-Identifier: MIT OR Apache-2.0
"""What this project has set itself, and what was measured."""

FUNCTOR_RATIO = 100
SIMULATION_RATIO = 50
OVER_FLOOR_SETTLING, OVER_FLOOR_AT_REST = 2.0, 1.5
ENERGY_DRIFT = 1e-4


def targets(rows, bounces, stages):
    """A list of name, sense, target, measured (the worst of its kind), met; parts that did not run are left out."""
    result = []

    def at_least(name, target, values):
        if values:
            result.append(_row(name, "at least", target, min(values), min(values) >= target))

    def at_most(name, target, values):
        if values:
            result.append(_row(name, "at most", target, max(values), max(values) <= target))

    def ratios(name, springs):
        return [row[name] for row in rows if row["springs"] == springs]

    at_least("functor, without contact area: built-in / ours", FUNCTOR_RATIO, ratios("functor_ratio", "fixed"))
    at_least("functor, with contact area: built-in / ours", FUNCTOR_RATIO, ratios("functor_ratio", "per area"))
    pile = [stage["simulation_ratio"] for stage in stages]
    dozen = [row["simulation_ratio"] for row in rows if row["scene"] == "pyramids" and row["springs"] == "fixed"]
    at_least("simulation, pile of pyramids: built-in / ours", SIMULATION_RATIO, pile)
    at_least("simulation, a dozen pyramids: built-in / ours", SIMULATION_RATIO, dozen)
    over = {stage["name"]: stage["over_floor"] for stage in stages}
    at_most("step while settling / step without contacts", OVER_FLOOR_SETTLING, _named(over, "settling"))
    at_most("step at rest / step without contacts", OVER_FLOOR_AT_REST, _named(over, "at rest"))
    drifts = [bounce["library"]["drift"] for bounce in bounces[-1:]]
    at_most("energy, 50 bounces, finest step", ENERGY_DRIFT, drifts)
    at_most("contacts missed or invented by ours", 0, [_wrong(row["library"]) for row in rows])
    at_most("measures of physics in which ours is worse", 0, [len(row["worse"]) for row in rows])
    return result


def _row(name, sense, target, measured, met):
    return {"name": name, "sense": sense, "target": target, "measured": measured, "met": bool(met)}


def _named(values, name):
    return [values[name]] if name in values else []


def _wrong(physics):
    return physics["missed_contacts"] + physics["invented_contacts"]
