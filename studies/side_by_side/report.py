# SPDX-License-Identifier: MIT OR Apache-2.0
"""The tables on the terminal, and the plain values behind them."""

import contextlib
import io

from contact_functor import BUILTIN, DROP_IN


def bounce_row(comparison):
    """One line of cubes: plain values."""
    return {
        "steps_per_contact": comparison.steps_per_contact,
        "law_keeps_contacts": comparison.keep,
        "springs": "per area" if comparison.area else "fixed",
        "exact_springs_drift": comparison.exact.drift if comparison.exact else None,
        "library": _bounce(comparison.library),
        "built_in": _bounce(comparison.builtin),
    }


def _bounce(bounce):
    times = bounce.durations
    return {
        "bounces": bounce.bounces,
        "drift": bounce.drift,
        "contact_time_over_ideal": sum(times) / len(times) / bounce.ideal_duration if times else None,
        "spin": bounce.spin,
        "microseconds_a_step": bounce.microseconds,
    }


def stage_row(stage):
    """One state of the pile: plain values."""
    return {
        "name": stage.name,
        "step": stage.step,
        "over_floor": stage.over_floor,
        "free_functor_over_floor": stage.free_functor_over_floor,
        "simulation_ratio": stage.simulation_ratio,
        "functor_ratio": stage.functor_ratio,
        "pairs": stage.library.pairs,
        "contacts": stage.library.contacts,
        "library_microseconds": _parts(stage.library, stage.library.law),
        "built_in_microseconds": _parts(stage.builtin, stage.library.law),
        "idle_microseconds": _parts(stage.idle, 0.0),
    }


def _parts(cost, law):
    return {
        "collider": cost.collider,
        "functor": cost.loop - law,
        "law": law,
        "integrator": cost.motion,
        "step": cost.whole,
    }


def print_report(summary, out):
    """Everything a person wants to read at the end; the tables also go to a file."""
    text = io.StringIO()
    with contextlib.redirect_stdout(text):
        _print_tables(summary)
    (out / "tables.txt").write_text(text.getvalue().lstrip("\n"))
    print(text.getvalue(), end="")
    print(f"Results: {out}: {', '.join(sorted(path.name for path in out.iterdir()))}", flush=True)


def _print_tables(summary):
    if summary["rows"]:
        _print_cases(summary["rows"])
    if summary["bounces"]:
        _print_bounces(summary["bounces"], summary["free_collision"])
    if summary["known_answers"]:
        _print_answers(summary["known_answers"])
    if summary["step_by_part"]["stages"]:
        _print_stages(summary["step_by_part"])
    if summary["targets"]:
        _print_targets(summary["targets"])
    print(f"\n{summary['seconds']:.0f} s in all. {summary['machine']}, {summary['date'][:10]}")


def _print_cases(rows):
    print("\nThe same scenes, built-in | ours, over the steps that both made")
    table = [
        ["scene", "springs", "steps", "us a pair", "x", "steps/s", "x", "overlap %", "contacts"]
        + ["missed", "energy rise", "momentum", "worse"]
    ]
    for row in rows:
        theirs, ours = row["built_in"], row["library"]
        pair = lambda name, form: f"{_text(theirs[name], form)} | {_text(ours[name], form)}"
        each = "microseconds_per_interaction"
        table.append(
            [
                row["scene"],
                row["springs"],
                f"{row['steps_compared']:,}",
                f"{theirs[each]:.0f} | {ours[each]:.2f}",
                f"{row['functor_ratio']:.0f}",
                pair("steps_per_second", ",.0f"),
                f"{row['simulation_ratio']:.0f}",
                f"{100 * theirs['largest_overlap_over_size']:.2f} | {100 * ours['largest_overlap_over_size']:.2f}",
                pair("contacts", "d"),
                f"{_missed(theirs)} | {_missed(ours)}",
                pair("energy_rise", ".0e"),
                pair("momentum_error", ".0e"),
                ", ".join(row["worse"]) or "-",
            ]
        )
    _columns(table)
    tower = next((row for row in rows if "tower_height_error" in row["library"]), None)
    if tower:
        theirs, ours = (tower[name]["tower_height_error"] for name in ("built_in", "library"))
        print(f"Tower: distance from the closed form, over the size: {theirs:.1e} | {ours:.1e}")


def _missed(physics):
    return f"{physics['missed_contacts'] + physics['invented_contacts']}/{physics['contacts_checked']}"


def _print_bounces(bounces, free):
    print("\nTwo cubes bouncing head-on: change of energy, and spin (rad/s) that ought to be 0")
    table = [[
        "steps a contact", "springs", "contacts kept", "exact springs", "ours", "bounces", "spin", "built-in",
        "bounces", "spin"
    ]]
    for row in bounces:
        ours, theirs = row["library"], row["built_in"]
        table.append(
            [str(row["steps_per_contact"]), row["springs"], "yes" if row["law_keeps_contacts"] else "no"]
            + [_text(row["exact_springs_drift"], ".2e")] +
            [text for it in (ours, theirs) for text in (f"{it['drift']:.2e}", str(it["bounces"]), f"{it['spin']:.1e}")])
    _columns(table)
    if free:
        theirs, ours = free[BUILTIN], free[DROP_IN]
        print(
            "An oblique, spinning collision in free space changes momentum by "
            f"{theirs['momentum_change']:.0e} | {ours['momentum_change']:.0e}, angular momentum by "
            f"{theirs['angular_momentum_change']:.0e} | {ours['angular_momentum_change']:.0e}"
        )


def _print_answers(answers):
    print("\nPairs known to 40 digits")
    table = [["functor", "touching", "missed", "invented", "point error / R: median", "worst"]]
    for kind, name in ((BUILTIN, "built-in"), (DROP_IN, "ours")):
        if kind in answers:
            it = answers[kind]
            errors = [f"{it[f'{which}_point_error_over_R']:.1e}" for which in ("median", "worst")]
            table.append([name, *(str(it[key]) for key in ("touching", "missed", "invented")), *errors])
    _columns(table)


def _print_stages(pile):
    print(f"\nOne step of {pile['bodies']} pyramids by part, us")
    table = [[
        "state", "functor", "pairs", "touching", "collider", "functor", "law, loop", "integrator", "step", "over floor"
    ]]
    for stage in pile["stages"]:
        floor = stage["idle_microseconds"]["step"]
        for key, name in (("idle", "none"), ("library", "ours"), ("built_in", "built-in")):
            parts = stage[f"{key}_microseconds"]
            table.append(
                [stage["name"], name, f"{stage['pairs']:.0f}", str(stage["contacts"])]
                + [f"{parts[part]:,.0f}" for part in ("collider", "functor", "law", "integrator", "step")]
                + [f"{parts['step'] / floor:,.1f}"]
            )
    _columns(table)
    free = ", ".join(f"{stage['free_functor_over_floor']:.1f} {stage['name']}" for stage in pile["stages"])
    print(f"A functor that costs nothing but finds the same contacts would be over the floor by: {free}")


def _print_targets(rows):
    print()
    table = [["what", "target", "measured", "met"]]
    for row in rows:
        table.append(
            [row["name"], f"{row['sense']} {row['target']:g}", f"{row['measured']:.3g}", "yes" if row["met"] else "NO"])
    _columns(table)


def _text(value, form):
    return "-" if value is None else format(value, form)


def _columns(table):
    widths = [max(len(line[i]) for line in table) for i in range(len(table[0]))]
    for number, line in enumerate(table):
        print("  " + "  ".join(text.ljust(width) for text, width in zip(line, widths)).rstrip())
        if number == 0:
            print("  " + "  ".join("-" * width for width in widths))
