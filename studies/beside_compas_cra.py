# SPDX-License-Identifier: MIT OR Apache-2.0
"""The examples that come with compas_cra, judged by it (RBE and CRA) and by limit analysis: verdicts and seconds.

Run it by a Python that has both, as compas_cra is no part of this project:

    make wheel && python3 -m venv out/cra && out/cra/bin/pip install compas_cra==0.8.0 matplotlib out/wheel/*.whl
    out/cra/bin/python studies/beside_compas_cra.py [--only shelf] [--output out/compas_cra]

All get the same blocks, interfaces and friction. RBE, whose question is that of `stands` with joints that open, says that it stands if no
tension is needed. CRA also asks for a motion that goes with the forces (Kao et al. 2022, Computer-Aided Design 151),
and says so if its solver finds both. Writes summary.json and compas_cra.png; takes some minutes.
"""
import argparse
import contextlib
import io
import math
import os
import time
from pathlib import Path

import matplotlib.pyplot as plt

from summary import made, print_targets, target, write_summary

# RBE needs no tension if it is below this part of the largest pressure.
TENSION = 1e-3
FINE, COARSE = {"amin": 1e-6, "tmax": 1e-4}, {"nmax": 10, "amin": 1e-2, "tmax": 1e-2}
# name: file, number of held blocks, friction, turn about y in degrees, how interfaces are found (None: they are in the
# file), settings of CRA; as in the documentation of compas_cra.
EXAMPLES = {
    "three cubes": ("cubes", 1, 0.84, 0, COARSE, {}),
    "model A": ("A", 2, 0.84, 0, COARSE, {}),
    "model H": ("H", 2, 0.84, 0, COARSE, {}),
    **{f"wedge {kind}, {turn}°": (f"type-{kind}", 2, 0.84, turn, COARSE, {"d_bnd": 1e-2})
       for kind in "abcd" for turn in (0, 90)},
    "arch": (None, 0, 0.7, 0, COARSE, {}),
    **{file.replace("-", " "): (file, 1, 0.9, 0, FINE, {"d_bnd": 0.1, "eps": 1e-3})
       for file in ("shelf", "shelf-s1", "shelf-s2", "shelf-s3", "shelf-stable")},
    "bridge": ("bridge", 2, 0.9, 0, FINE, {"d_bnd": 0.1, "eps": 0}),
    "short hook, 40°": ("concave-short", 1, 0.84, 40, None, {"d_bnd": 1e-2, "eps": 1e-3}),
    "long hook, 50°": ("concave-long", 1, 0.84, 50, None, {"d_bnd": 1e-2, "eps": 1e-3}),
    **{file: (file, 1, 0.84, 0, None, {}) for file in ("curve-3-blocks", "cube-curve-short", "cube-curve-tall")},
}


def assembly(name):
    """As compas_cra has it, its friction, and the settings of CRA."""
    import compas
    import compas_cra
    from compas_cra import algorithms, datastructures, equilibrium, geometry

    file, held, friction, turn, interfaces, settings = EXAMPLES[name]
    if file is None:
        blocks = geometry.Arch(height=5, span=10, thickness=0.5, depth=0.5, num_blocks=20).assembly()
    else:
        blocks = compas.json_load(os.path.join(compas_cra.SAMPLE, file + ".json")).copy(cls=datastructures.CRA_Assembly)
        blocks.set_boundary_conditions(range(held))
    # The middle stones of the bridge are heavier.
    heavy = range(11, 16) if name == "bridge" else ()
    equilibrium.density_setup(blocks, {node: 3.51 if node in heavy else 1.0 for node in blocks.graph.nodes()})
    if interfaces:
        algorithms.assembly_interfaces_numpy(blocks, **interfaces)
    if turn:
        blocks.rotate_assembly([0, 0, 0], [0, 1, 0], turn)
    return blocks, friction, settings


def scene(blocks, friction):
    """The same for limit analysis, and the interfaces."""
    from potential_particles import equilibrium

    to, place = equilibrium.Scene(), {}
    for node in blocks.graph.nodes():
        block = blocks.graph.node_attribute(node, "block")
        place[node] = to.add_body(block.center(), held=bool(blocks.graph.node_attribute(node, "is_support")),
                                  force=(0, 0, -block.volume() * block.attributes["density"]))
    interfaces = [(*edge, one) for edge in blocks.graph.edges()
                  for one in blocks.graph.edge_attribute(edge, "interfaces")]
    for first, second, one in interfaces:
        # The z axis of its frame looks from the first block to the second.
        to.add_contact(place[first], place[second], one.points, one.frame.zaxis, friction=friction)
    return to, [one for *_, one in interfaces]


def timed(solve):
    """What it returns, or its error, and seconds."""
    started = time.perf_counter()
    try:
        with contextlib.redirect_stdout(io.StringIO()):
            found = solve()
    except (ValueError, RuntimeError) as error:
        found = error
    return found, time.perf_counter() - started


def judged(name):
    """A row of the results."""
    from compas_cra import equilibrium

    with contextlib.redirect_stdout(io.StringIO()):
        blocks, friction, settings = assembly(name)
    ours, interfaces = scene(blocks, friction)
    row = {"example": name, "blocks": blocks.graph.number_of_nodes(), "corners": len(ours.corners)}
    found, row["seconds"] = timed(lambda: ours.stands(dilatant=True))
    row["stands"] = getattr(found, "stands", None)
    found, row["factor_seconds"] = timed(ours.strength_factor)
    row["factor"] = math.inf if "infinite" in str(found) else getattr(found, "factor", None)
    # What no forces hold falls.
    row["factor_stands"] = row["stands"] and (None if row["factor"] is None else row["factor"] >= 1.0)
    _, row["rbe_seconds"] = timed(lambda: equilibrium.rbe_solve(blocks, mu=friction))
    pull, press = (max((force[part] for one in interfaces for force in one.forces or []), default=0.0)
                   for part in ("c_nn", "c_np"))
    row["rbe_stands"] = pull < TENSION * press
    found, row["cra_seconds"] = timed(lambda: equilibrium.cra_solve(blocks, mu=friction, **settings))
    row["cra_stands"], row["cra_says"] = not isinstance(found, Exception), str(found)[:80]
    return row


def picture(rows, path):
    """Seconds of each example; a cross where it does not stand."""
    figure, axes = plt.subplots(figsize=(8, 0.3 * len(rows) + 1.2), layout="constrained")
    for of, label, colour in (("", "stands", "#4a90d0"), ("rbe_", "RBE", "#a0a0a0"),
                              ("factor_", "strength_factor", "#1c3e70"), ("cra_", "CRA", "#c0563b")):
        for place, row in enumerate(rows):
            axes.scatter(row[of + "seconds"], -place, color=colour, marker="o" if row[of + "stands"] else "x",
                         label=None if place else label)
    axes.set_yticks([-place for place in range(len(rows))], [one["example"] for one in rows])
    axes.set(xscale="log", xlabel="seconds; a cross: it falls, or there is no answer")
    axes.legend()
    figure.savefig(path, dpi=110)


def main():
    options = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    options.add_argument("--output", default="out/compas_cra")
    options.add_argument("--only", default="", help="examples whose name has this in it")
    chosen = options.parse_args()
    names, out, rows = [name for name in EXAMPLES if chosen.only in name], Path(chosen.output), []
    if not names:
        options.error(f"--only: none of {', '.join(EXAMPLES)} has {chosen.only!r} in it")
    out.mkdir(parents=True, exist_ok=True)
    for name in names:
        rows.append(judged(name))
        print(rows[-1], flush=True)
    answered = [one for one in rows if one["factor_stands"] is not None]
    targets = [
        target("verdicts of stands that differ from RBE", "at most", 0,
               sum(one["stands"] != one["rbe_stands"] for one in rows)),
        target("examples without a factor", "at most", 0, len(rows) - len(answered)),
        target("verdicts of the others that differ from CRA", "at most", 0,
               sum(one["factor_stands"] != one["cra_stands"] for one in answered)),
        target("seconds of RBE over stands, least", "at least", 1,
               min(one["rbe_seconds"] / one["seconds"] for one in rows)),
        target("seconds of CRA over strength_factor, least", "at least", 1,
               min(one["cra_seconds"] / one["factor_seconds"] for one in rows))]
    write_summary(out / "summary.json", {**made("studies/beside_compas_cra.py"), "targets": targets, "examples": rows})
    picture(rows, out / "compas_cra.png")
    print_targets(targets)


main()
