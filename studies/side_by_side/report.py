# SPDX-License-Identifier: MIT OR Apache-2.0
"""Targets, and the tables on the terminal."""

from contact_functor import BUILTIN, DROP_IN
from summary import print_columns, print_targets, target

FUNCTOR_RATIO, SIMULATION_RATIO = 100, 50
OVER_FLOOR_SETTLING, OVER_FLOOR_AT_REST = 2.0, 1.5
ENERGY_DRIFT = 1e-4


def targets(rows, bounces, stages):
    """Each by the worst of its kind; parts that did not run are left out."""
    result = []

    def at_least(name, limit, values):
        result.extend([target(name, "at least", limit, min(values))] if values else [])

    def at_most(name, limit, values):
        result.extend([target(name, "at most", limit, max(values))] if values else [])

    def of(name, springs, scenes=("pyramids", "cubes", "tower", "mixed")):
        return [row[name] for row in rows if row["springs"] == springs and row["scene"] in scenes]

    def over_floor(name):
        return [stage["over_floor"] for stage in stages if stage["name"] == name]

    at_least("functor, without contact area: built-in / ours", FUNCTOR_RATIO, of("functor_ratio", "fixed"))
    at_least("functor, with contact area: built-in / ours", FUNCTOR_RATIO, of("functor_ratio", "per area"))
    at_least("simulation, pile of pyramids: built-in / ours", SIMULATION_RATIO,
             [stage["simulation_ratio"] for stage in stages])
    at_least("simulation, a dozen pyramids: built-in / ours", SIMULATION_RATIO,
             of("simulation_ratio", "fixed", ("pyramids",)))
    at_most("step while settling / step without contacts", OVER_FLOOR_SETTLING, over_floor("settling"))
    at_most("step at rest / step without contacts", OVER_FLOOR_AT_REST, over_floor("at rest"))
    at_most("energy, 50 bounces, finest step", ENERGY_DRIFT, [one["library"]["drift"] for one in bounces[-1:]])
    at_most("contacts missed or invented by ours", 0, [_wrong(row["library"]) for row in rows])
    at_most("measures of physics in which ours is worse", 0, [len(row["worse"]) for row in rows])
    return result


def _wrong(physics):
    return physics["missed_contacts"] + physics["invented_contacts"]


def print_report(summary, out):
    """Everything a person wants to read at the end."""
    if summary["rows"]:
        _print_cases(summary["rows"])
    if summary["bounces"]:
        _print_bounces(summary["bounces"], summary["free_collision"])
    if summary["known_answers"]:
        _print_answers(summary["known_answers"])
    if summary["step_by_part"]["stages"]:
        _print_stages(summary["step_by_part"])
    if summary["targets"]:
        print_targets(summary["targets"])
    print(f"{summary['seconds']:.0f} s in all. {summary['machine']}, {summary['date'][:10]}")
    print(f"Results: {out}: {', '.join(sorted(path.name for path in out.iterdir()))}", flush=True)


def _print_cases(rows):
    print("\nThe same scenes, built-in | ours, over the steps that both made")
    table = [["scene", "springs", "steps", "us a pair", "x", "steps/s", "x", "contacts", "missed", "energy rise",
              "momentum", "worse"]]
    for row in rows:
        both = row["built_in"], row["library"]
        pair = lambda name, form: " | ".join(_text(one[name], form) for one in both)
        missed = " | ".join(f"{_wrong(one)}/{one['contacts_checked']}" for one in both)
        table.append([
            row["scene"], row["springs"], f"{row['steps_compared']:,}", pair("microseconds_per_interaction", ".3g"),
            f"{row['functor_ratio']:.0f}", pair("steps_per_second", ",.0f"), f"{row['simulation_ratio']:.0f}",
            pair("contacts", "d"), missed, pair("energy_rise", ".0e"), pair("momentum_error", ".0e"),
            ", ".join(row["worse"]) or "-"
        ])
    print_columns(table)


def _print_bounces(bounces, free):
    print("Two cubes bouncing head-on: change of energy, and spin (rad/s) that ought to be 0")
    table = [["steps a contact", "springs", "contacts kept", "exact springs", "ours", "bounces", "spin", "built-in",
              "bounces", "spin"]]
    for row in bounces:
        table.append([str(row["steps_per_contact"]), row["springs"], "yes" if row["law_keeps_contacts"] else "no",
                      _text(row["exact_springs_drift"], ".2e"),
                      *(text for it in (row["library"], row["built_in"])
                        for text in (f"{it['drift']:.2e}", str(it["bounces"]), f"{it['spin']:.1e}"))])  # fmt: skip
    print_columns(table)
    for name in ("momentum_change", "angular_momentum_change") if free else ():
        print(f"{name} in an oblique, spinning collision in free space: "
              f"{free[BUILTIN][name]:.0e} | {free[DROP_IN][name]:.0e}")


def _print_answers(answers):
    print("\nPairs known to 40 digits")
    print_columns([["functor", "touching", "missed", "invented", "point error / R: median", "worst"]] + [
        [kind, *(str(it[key]) for key in ("touching", "missed", "invented")),
         *(f"{it[f'{which}_point_error_over_R']:.1e}" for which in ("median", "worst"))]
        for kind, it in answers.items()])


def _print_stages(pile):
    print(f"One step of {pile['bodies']} pyramids by part, us")
    parts = ("collider", "functor", "law", "integrator", "step")
    print_columns([["state", "functor", "pairs", "touching", *parts, "over floor"]] + [
        [stage["name"], name, f"{stage['pairs']:.0f}", str(stage["contacts"]),
         *(f"{stage[f'{name}_microseconds'][part]:,.0f}" for part in parts),
         f"{stage[f'{name}_microseconds']['step'] / stage['idle_microseconds']['step']:,.1f}"]
        for stage in pile["stages"] for name in ("idle", "library", "built_in")])
    free = ", ".join(f"{stage['free_functor_over_floor']:.1f} {stage['name']}" for stage in pile["stages"])
    print(f"A functor that costs nothing but finds the same contacts would be over the floor by: {free}")


def _text(value, form):
    return "-" if value is None else format(value, form)
