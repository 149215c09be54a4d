# SPDX-License-Identifier: MIT OR Apache-2.0
"""What came out of a run: targets, tables in Markdown, and the picture of time against error."""

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

from contestants import CONTACT, CONTESTANTS, OURS
from measure_pairs import CURVE_GROUPS
from summary import markdown, target
from pairs import FAR, LYING, NEAR_BY, POTENTIAL, ROUNDED, SHARP, TOUCHING

# The call whose time counts against the peers': alone, and as in a step of a simulation.
COUNTED = {"cold": "midway", "warm": "carried"}
EDGES = {SHARP: "sharp", ROUNDED: "rounded, k = 0", POTENTIAL: "rounded, k = 0.02"}
PLACES = {TOUCHING: "touching", LYING: "face on face", NEAR_BY: "near", FAR: "far"}
COLUMNS = (
    ("parry", "contact"),
    ("coal", "contact"),
    ("coal", "contact-nesterov"),
    ("bullet", "contact"),
    ("ours", "cone_program"),
    ("yade", "potential"),
)
HEADS = ("parry", "Coal", "Coal, Nesterov", "Bullet", "clarabel", "PotentialParticle")
LEAST_ERROR, MOST_ERROR = 1e-17, 1.0  # where an error of nothing is drawn; where the picture ends


def targets(rows):
    """One for each group and warmth: the fastest rival over ours, at least 1."""
    found = []
    for group in _unique(row["group"] for row in rows):
        for warmth in ("cold", "warm"):
            of_group = [row for row in rows if row["group"] == group and row["warmth"] == warmth]
            ours = _time(of_group, OURS, COUNTED[warmth])
            rival = _fastest(of_group)
            if ours is None:
                continue
            ratio = rival["microseconds"] / ours if rival else None
            name = f"{describe(of_group[0])}, {'from nothing' if warmth == 'cold' else 'from memory'}: fastest peer / ours"
            found.append(target(name, "at least", 1.0, ratio, peer=rival["label"] if rival else None, group=group,
                                warmth=warmth))
    return found + soundness(rows)


def soundness(rows):
    """What must not happen at all in ours."""
    ours = [row for row in rows if row["program"] == OURS and row["way"] != "cone_program"]
    count = lambda key: sum(row.get(key) or 0 for row in ours)
    worst = max((row.get("worst_error") or 0.0 for row in ours), default=0.0)
    limits = (
        ("our failures", count("failed"), 0),
        ("our contacts missed or made up", count("wrong"), 0),
        ("our worst error of the overlap, of the size", worst, 1e-9),
    )
    return [target(name, "at most", limit, value) for name, value, limit in limits]


def describe(row):
    return f"{row['planes']} planes, {EDGES[row['edges']]}, {PLACES[row['place']]}"


def pair_table(rows):
    """Microseconds a call, cold / warm; the last columns: fastest peer over ours."""
    lines = []
    judged = {(one.get("group"), one.get("warmth")): one["measured"] for one in targets(rows)}
    for group in _unique(row["group"] for row in rows):
        of_group = [row for row in rows if row["group"] == group]
        first = of_group[0]
        cells = [str(first["planes"]), EDGES[first["edges"]], PLACES[first["place"]]]
        cells += [_both(of_group, *key) for key in ((OURS, "midway"), (OURS, "carried"), *COLUMNS)]
        lines.append(cells + [_ratio(judged.get((group, warmth))) for warmth in ("cold", "warm")])
    heads = ("planes", "edges", "place", "ours: alone", "ours: in a batch", *HEADS, "peer/ours cold", "warm")
    return markdown(heads, lines)


def distance_table(rows):
    """Of bodies that are near: the distance to the end, by those who give it."""
    labels = {(row["program"], row["way"]): row["label"] for row in rows if row["work"] != CONTACT}
    lines = []
    for group in _unique(row["group"] for row in rows if row["work"] != CONTACT):
        of_group = [row for row in rows if row["group"] == group]
        lines.append([of_group[0]["planes"], EDGES[of_group[0]["edges"]], *(_both(of_group, *key) for key in labels)])
    return markdown(("planes", "edges", *labels.values()), lines)


def contestant_table(rows, found):
    """Who computes what, with what stop rule, how exactly, and what a contact law gets."""
    heads = ("contestant", "computes", "settings, stop rule", "gives", "worst error, of", "failed", "wrong", "answers")
    lines = []
    for one in CONTESTANTS:
        of_one = [row for row in rows if (row["program"], row["way"]) == (one.program, one.way) and row.get("pairs")]
        cells = [one.label, one.computes, one.settings, one.gives]
        if not of_one:
            why = found.missing.get(one.program, "no answer")
            lines.append([*cells, f"not measured: {why}", "", "", ""])
            continue
        worst = max((row["worst_error"] for row in of_one if row["worst_error"] is not None), default=None)
        total = lambda key: sum(row[key] for row in of_one)
        error = "–" if worst is None else f"{worst:.1e}, {of_one[0]['error_of']}"
        lines.append([*cells, error, *map(total, ("failed", "wrong", "pairs"))])
    return markdown(heads, lines)


def draw(rows, curves, line, path):
    """Time against error, a panel for each group; filled: warm, hollow: cold."""
    groups = [name for name in CURVE_GROUPS if any(row["group"] == name for row in rows)]
    figure, axes = plt.subplots(1, len(groups), figsize=(4.6 * len(groups), 5.0), sharey=True, squeeze=False)
    labels = _unique(row["label"] for row in rows if row["group"] in groups and row["work"] == CONTACT)
    colours = {label: plt.get_cmap("tab10" if len(labels) <= 10 else "tab20")(i) for i, label in enumerate(labels)}
    for panel, name in zip(axes[0], groups):
        panel.set(xscale="log", yscale="log", xlim=(LEAST_ERROR / 3, MOST_ERROR))
        for row in rows:
            if row["group"] == name and row.get("median_error") is not None:
                _dot(panel, row, colours[row["label"]])
        for label, warmth in _unique((one["label"], one["warmth"]) for one in curves if one["group"] == name):
            points = sorted((max(one["worst_error"], LEAST_ERROR), one["microseconds"]) for one in curves
                            if (one["group"], one["label"],
                                one["warmth"]) == (name, label, warmth) and one["worst_error"] is not None)
            panel.plot(*zip(*points), "-" if warmth == "warm" else ":", color=colours.get(label, "grey"), linewidth=1)
        panel.set_xlabel("worst error, against its own exact answer, of the size")
        panel.set_title(describe(next(row for row in rows if row["group"] == name)), fontsize=10)
        panel.grid(True, which="major", linewidth=0.3)
    axes[0][0].set_ylabel("a call, µs")
    handles = [plt.Line2D([], [], marker="o", linestyle="", color=colours[label], label=label) for label in labels]
    figure.legend(handles=handles, loc="lower center", ncols=4, fontsize=8, frameon=False)
    title = "Contacts of two convex bodies: filled: warm, hollow: cold; lines: over the tolerance"
    figure.suptitle(f"{title}\n{line}", fontsize=9)
    figure.subplots_adjust(left=0.05, right=0.99, top=0.85, bottom=0.28, wspace=0.05)
    figure.savefig(path, dpi=110)
    plt.close(figure)


def _dot(panel, row, colour):
    error = max(row["worst_error"], LEAST_ERROR)
    panel.plot(error, row["microseconds"], "o", color=colour,
               markerfacecolor=colour if row["warmth"] == "warm" else "none")


def _both(rows, program, way):
    times = [_time([row for row in rows if row["warmth"] == warmth], program, way) for warmth in ("cold", "warm")]
    if times == [None, None]:
        return next((row["why"] for row in rows if (row["program"], row["way"]) == (program, way) and row.get("why")),
                    "–")
    return " / ".join("–" if value is None else digits(value) for value in times)


def _time(rows, program, way):
    return next((row["microseconds"] for row in rows if (row["program"], row["way"]) == (program, way)), None)


def _fastest(rows):
    """Of those that answer the same question without failures or wrong answers."""
    sound = [
        row for row in rows
        if row["rival"] and row["microseconds"] is not None and not row["failed"] and not row["wrong"]
    ]
    return min(sound, key=lambda row: row["microseconds"], default=None)


def _ratio(value):
    return "–" if value is None else f"**{value:.2f}**" if value < 1 else f"{value:.2f}"


def digits(value):
    return f"{value:.2f}" if value < 9.95 else f"{value:.1f}" if value < 99.5 else f"{value:,.0f}"


def _unique(values):
    return list(dict.fromkeys(values))
