# SPDX-License-Identifier: MIT OR Apache-2.0
"""Piles of pyramids by YADE's kinds of bodies, by this plugin, and by LAMMPS, from the same states: falling, and at
rest.
"""

import json
import os
import subprocess
import sys

import numpy as np

import install
from lammps_pile import Pile
from polyhedron import Polyhedron

sys.path.insert(0, str(install.TOP / "studies"))

from summary import markdown, target

FOLDER = install.OUT / "piles"
OURS, POTENTIAL, POLYHEDRA, LEVEL_SET, LAMMPS = "ours", "potential", "polyhedra", "levelset", "lammps"
LABELS = {
    OURS: "this plugin", POTENTIAL: "YADE's PotentialParticle", POLYHEDRA: "YADE's Polyhedra",
    LEVEL_SET: "YADE's LevelSet", LAMMPS: "LAMMPS, body/rounded/polyhedron"
}
STAGES = (FALLING, AT_REST) = ("falling", "at rest")
BOUNCE_STEPS = 50_000  # of a twentieth of the time step
# Lines of a whole scene, about: examples/first_pile.py, and for the others that with what shape, mass and walls take
# here and in studies (docs/scenes.md).
LINES = {OURS: 18, POTENTIAL: 85, POLYHEDRA: 30, LEVEL_SET: 55, LAMMPS: 60}


class Effort:
    """Steps and times of a run, by number of bodies."""

    def __init__(self, quick):
        self.counts = (200,) if quick else (200, 2000)
        self.stages = STAGES[1:] if quick else STAGES
        self.bounces = not quick
        self.falling_step = 1500
        self.settle = 2500 if quick else 8000
        self.quick = quick
        self.seconds = 3 if quick else 30  # that the steps before the windows may take, and the windows
        self.windows = 2 if quick else 8

    def takes(self, kind, count):
        """At 2,000 bodies a step of these takes seconds, and the level sets of 2,000 bodies minutes to make."""
        return count <= 200 or kind not in (POTENTIAL, LEVEL_SET)

    def before(self, kind, count, stage):
        """Steps before the windows: at rest those that a body of another shape needs to find its place."""
        if stage == FALLING:
            return 20
        if self.quick:
            return {OURS: 60, LAMMPS: 20, POTENTIAL: 2}.get(kind, 10)
        return {POTENTIAL: 20, LAMMPS: 300 if count <= 200 else 40}.get(kind, 600)

    def steps(self, kind, count):
        """Steps of a window."""
        return {OURS: 60 if count <= 200 else 20, LAMMPS: 20 if count <= 200 and not self.quick else 5,
                POTENTIAL: 2}.get(kind, 4)


def rows(found, quick):
    """One dictionary for each kind, number of bodies and stage."""
    package = install.TOP / "yade-glue" / "build" / "python"
    missing = dict(found.missing)
    if "yade" in found.commands and not (package / "potential_particles").exists():
        missing["yade"] = "the YADE plugin is not built: make build"
    if "yade" in missing:
        return [{"kind": kind, "label": label, "missing": missing["yade"]} for kind, label in LABELS.items()]
    FOLDER.mkdir(exist_ok=True)
    effort, result = Effort(quick), []
    errors = {kind: bounce(kind) for kind in (OURS, POTENTIAL, POLYHEDRA, LEVEL_SET) if effort.bounces}
    for count in effort.counts:
        files = [FOLDER / f"{count}_{stage.replace(' ', '_')}{'_quick' if quick else ''}.npz" for stage in STAGES]
        print(f"  {count} pyramids fall", flush=True)
        yade({
            "kind": OURS, "count": count, "task": "fall", "falling_step": effort.falling_step, "settle": effort.settle,
            "save": [str(file) for file in files]
        })
        for stage, file in zip(STAGES, files):
            if stage not in effort.stages:
                continue
            for kind in LABELS:
                why = missing.get(kind) if effort.takes(kind, count) else "too slow, see 200"
                if why:
                    result.append({"kind": kind, "label": LABELS[kind], "count": count, "stage": stage, "missing": why})
                    continue
                print(f"  {count} {stage}: {LABELS[kind]}", flush=True)
                row = one(kind, count, stage, file, effort, found)
                row.update(kind=kind, label=LABELS[kind], count=count, stage=stage, lines=LINES[kind],
                           **errors.get(kind, {}))
                if row.get("fastest_ms"):
                    row["body_steps_per_second"] = 1e3 * count / row["fastest_ms"]
                result.append(row)
    return result


def one(kind, count, stage, file, effort, found):
    try:
        if kind == LAMMPS:
            return lammps(file, count, stage, effort, found.commands[LAMMPS])
        return yade({
            "kind": kind, "count": count, "task": "windows", "start": str(file),
            "settle": effort.before(kind, count, stage), "seconds": effort.seconds, "windows": effort.windows,
            "steps": effort.steps(kind, count)
        })
    except (RuntimeError, OSError, subprocess.TimeoutExpired) as error:
        return {"missing": str(error)}


def bounce(kind):
    try:
        return yade({"kind": kind, "count": 1, "task": "bounce", "steps": BOUNCE_STEPS})
    except (RuntimeError, subprocess.TimeoutExpired) as error:
        return {"bounce_missing": str(error)}


def yade(job):
    """The result of a run of yade_pile.py."""
    result = FOLDER / "result.json"
    result.unlink(missing_ok=True)
    environment = dict(os.environ, JOB=json.dumps(dict(job, result=str(result))), OMP_WAIT_POLICY="passive",
                       PYTHONPATH=str(install.TOP / "yade-glue" / "build" / "python"))
    command = [install.YADE_PROGRAM, "-x", "-n", "-j1", install.HERE / "yade_pile.py"]
    done = subprocess.run(list(map(str, command)), env=environment, stdin=subprocess.DEVNULL, capture_output=True,
                          text=True, timeout=1200)
    if not result.exists():
        raise RuntimeError(
            f"no result: {done.stdout.strip().splitlines()[-1:]} {done.stderr.strip().splitlines()[-1:]}")
    return json.loads(result.read_text())


def lammps(file, count, stage, effort, command):
    """The same states as rounded polyhedra of LAMMPS."""
    shape = yade({"kind": OURS, "count": count, "task": "describe"})
    core = Polyhedron(shape["normals"], shape["offsets"])
    pile = Pile(core, _faces(core), shape["r"], shape["mass"], np.array(shape["inertia"]), shape["laws"])
    states = dict(np.load(file))
    pile.write(FOLDER, states, (shape["half_width"], shape["height"]))
    steps = effort.steps(LAMMPS, count)
    seconds, table = pile.run(FOLDER, command, shape["half_width"], steps,
                              effort.windows + effort.before(LAMMPS, count, stage) // steps)
    timed = np.array(seconds[-effort.windows:]) / steps * 1e3
    _, kept, kinetic, _ = table[-1]
    return {
        "bodies": count, "fastest_ms": float(timed.min()), "median_ms": float(np.median(timed)),
        "lost": count - int(kept), "kinetic_J": kinetic
    }


def _faces(core):
    """Corners of each face in order about it."""
    faces = []
    for normal, offset in zip(core.normals, core.offsets):
        on = np.flatnonzero(np.abs(core.corners @ normal - offset) < 1e-9)
        across = core.corners[on] - core.corners[on].mean(axis=0)
        first = across[0] / np.linalg.norm(across[0])
        angles = np.arctan2(across @ np.cross(normal, first), across @ first)
        faces.append(on[np.argsort(angles)].tolist())
    return faces


def targets(piles):
    """The fastest peer's step over ours, at least 1; and that ours loses and fails nothing."""
    found = []
    known = [row for row in piles if row.get("fastest_ms")]
    for count, stage in dict.fromkeys((row["count"], row["stage"]) for row in known):
        of = [row for row in known if (row["count"], row["stage"]) == (count, stage)]
        ours = next((row["fastest_ms"] for row in of if row["kind"] == OURS), None)
        peer = min((row for row in of if row["kind"] != OURS), key=lambda row: row["fastest_ms"], default=None)
        if ours is None:
            continue
        ratio = peer["fastest_ms"] / ours if peer else None
        found.append(target(f"{count:,} pyramids {stage}: step of the fastest peer / ours", "at least", 1.0, ratio,
                            peer=peer["label"] if peer else None))
    mine = [row for row in known if row["kind"] == OURS]
    lost = sum(row["lost"] + (row["failures"] or 0) for row in mine)
    if mine:
        found.append(target("our piles: bodies lost, and failures", "at most", 0, lost))
    return found


def table(piles):
    heads = ("bodies", "", "stage", "a step, ms", "body-steps a second a core", "contacts", "lost", "kinetic energy, J",
             "energy error of a bounce", "lines")
    rows = []
    for row in piles:
        if row.get("missing"):
            rows.append((row.get("count", ""), row["label"], row.get("stage", ""), f"not measured: {row['missing']}",
                         *[""] * 6))
            continue
        error = row.get("energy_error")
        rows.append([
            f"{row['count']:,}", row["label"], row["stage"] + ("" if row.get("settled", True) else " *"),
            f"{row['fastest_ms']:.3g}", f"{row['body_steps_per_second']:,.0f}",
            f"{row['contacts']:,}" if "contacts" in row else "–",
            str(row["lost"]), f"{row['kinetic_J']:.2g}", "–" if error is None else f"{error:.1e} ({row['bounces']})",
            str(row["lines"])
        ])
    return markdown(heads, rows)
