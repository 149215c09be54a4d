# SPDX-License-Identifier: MIT OR Apache-2.0
"""A rigid wedge on two joints: at which friction angle does it begin to slide?

Simulation B of Boon, Houlsby & Utili, against the closed form. Run it inside YADE:

    yade -x -n -j1 studies/wedge.py

Environment: CASES (all, or short), OUTPUT (out/wedge), LAW (point, or joint: contact patches, without what is shown of
points). Results: a table on the terminal; wedge.png, study.png, wedge.bodies.pvd and wedge.contacts.pvd with their .vtp
files for ParaView, trials.csv with each friction angle that was tried, and summary.json. SI units, angles in degrees;
world frame with x east, y north, z up.
"""

import csv
import sys
import time
from pathlib import Path

# YADE runs a script without its folder on Python's path.
HERE = Path(sys.argv[0]).resolve().parent
sys.path.insert(0, str(HERE))

import numpy as np
import potential_particles
import yade
from potential_particles import Recorder
from potential_particles.output.drawn import ShapeMeshes, drawn
from yade import O

import friction_reduction
import settings
from block_scene import JOINTS
from friction_reduction import FrictionReduction, angle_of_contact_normals, errors, expected_trials
from progress import Progress
from summary import made, print_columns, print_table, write_summary
from wedge_blocks import WedgeBlocks
from wedge_cases import (ALL, DIRECTION_TARGET, FORCE_TARGET, NEAR_POLYHEDRAL, PAPER, PAPER_ANGLE, THREE_DEC_ANGLE,
                         WIDEST_BRACKET)
from wedge_figures import save_overview, save_study
from wedge_scene import WedgeScene
from wedge_studies import ROUGH, UNREGULARISED, not_run_in, points_at_rest, slide_out

CHOICES = {"all": ALL, "short": [PAPER, NEAR_POLYHEDRAL]}
RESULTS = ["wedge.png", "study.png", "wedge.bodies.pvd", "wedge.contacts.pvd", "trials.csv", "summary.json"]
FRAMES = 28  # for ParaView, after the first
MESH_TOLERANCE = 2e-3  # of pictures and frames, over the radius of a block


class Run:
    """Cases one after the other, with what they leave behind."""

    def __init__(self, cases, out, closer):
        self.cases, self.out, self.closer = cases, out, closer
        self.rows, self.trials = [], []
        self.studies, self.picture = {}, {}
        self.failed_contacts = 0
        self.blocks = {case.name: WedgeBlocks(case.plane_a, case.plane_b, case.size) for case in cases}
        self.planned = self.finished = 0
        self.progress = None

    def go(self):
        """True if Ctrl-C came before the end."""
        self.planned = [expected_trials(self.blocks[case.name].limit) for case in self.cases]
        extra = self.planned[0] + 20 if self.closer else 0
        self.progress = Progress(sum(self.planned) + extra, unit="angle")
        try:
            for number, case in enumerate(self.cases):
                self._case(case)
                self.finished = sum(self.planned[: number + 1]) + extra
                self.progress.update(self.finished)
        except KeyboardInterrupt:
            return True
        finally:
            self.progress.close()
        return False

    def _case(self, case):
        started = time.perf_counter()
        scene = WedgeScene(case, self.blocks[case.name])
        reduction = FrictionReduction(scene, look=self._look(case))
        result = reduction.run()
        self.rows.append(_row(case, scene, reduction, result, time.perf_counter() - started))
        self.failed_contacts += scene.failed_contacts()
        if case is PAPER and not JOINTS:
            self._look_closer(scene, result)
        if case is PAPER and self.closer:
            scene = WedgeScene(case, self.blocks[case.name])
            limit = scene.blocks.limit
            rough = not_run_in(scene, self._look(case, "set down at 60 degrees, not run in"))
            self.studies["not_run_in"] = {
                "begin_degrees": ROUGH,
                "slides_at_degrees": rough.slides_at,
                "holds_at_degrees": rough.holds_at,
                "force_a_over_closed_form": rough.joints[0].normal_force / (scene.weight * limit.force_a),
                "force_b_over_closed_form": rough.joints[1].normal_force / (scene.weight * limit.force_b),
            }
            self.failed_contacts += scene.failed_contacts()

    def _look(self, case, what=None):
        count = len(self.trials)

        def look(trial):
            self.trials.append((what or case.name, trial))
            here = self.finished + len(self.trials) - count
            self.progress.update(min(here, self.progress.total - 1))

        return look

    def _look_closer(self, scene, result):
        """The path of the paper's wedge, frames and states for the pictures, contact points at rest."""
        series = Recorder(self.out / "wedge", MESH_TOLERANCE)
        frames = iter(np.linspace(0.0, 1.0, FRAMES + 1)[1:])
        self.picture["before"] = _blocks()
        series()
        due = [next(frames)]

        def on_look(part):
            if due[0] is not None and part >= due[0]:
                series()
                due[0] = next(frames, None)

        path = slide_out(scene, result, on_look)
        self.picture["after"] = _blocks()
        regularisation = scene.functor.flatRegularisation
        raw = points_at_rest(scene, UNREGULARISED)
        held = points_at_rest(scene, regularisation)
        self.picture["rests"] = {
            f"at rest, flat_regularisation {UNREGULARISED:g}": raw[:2],
            f"at rest, flat_regularisation {regularisation:.2g}": held[:2],
        }
        self.picture["path"] = path
        limit = scene.blocks.limit
        self.studies["slide_out"] = {
            "friction_angle_degrees": path.friction_angle,
            "moved_over_size": path.moved[-1] / scene.case.size,
            "direction_error_degrees": float(path.angle[-1]),
            "largest_force_a_error": float(np.abs(path.forces[20:, 0] / limit.force_a - 1.0).max()),
            "largest_force_b_error": float(np.abs(path.forces[20:, 1] / limit.force_b - 1.0).max()),
            "frames": len(series.frames["bodies"]),
        }
        self.studies["at_rest"] = [
            {
                "flat_regularisation": value,
                "spread_of_point_over_size": float(max(np.ptp(p, axis=0).max() for p in rest[:2])) / scene.case.size,
                "mean_net_force_over_weight": rest[2],
            }
            for value, rest in ((UNREGULARISED, raw), (regularisation, held))
        ]


def main():
    """From environment to summary."""
    started = time.perf_counter()
    chosen = settings.choice("CASES", "all", tuple(CHOICES), "set of cases")
    out = settings.folder("OUTPUT", HERE.parent / "out" / "wedge")
    clear(out)
    run = Run(CHOICES[chosen], out, closer=chosen == "all" and not JOINTS)
    print(f"{len(run.cases)} wedges, friction lowered until they slide", flush=True)
    interrupted = run.go()
    if interrupted:
        print("interrupted: drawing and summing up what there is", flush=True)
    save_trials(out / "trials.csv", run.trials)
    try:
        draw(run)
    except KeyboardInterrupt:
        interrupted = True  # a picture less; the numbers are still to be written
    summary = {
        "interrupted": interrupted,
        "cases": run.rows,
        "all_within_target": all(row["within_target"] for row in run.rows),
        "targets": {
            "direction_degrees": DIRECTION_TARGET,
            "forces_relative": FORCE_TARGET,
            "bracket_degrees": WIDEST_BRACKET,
        },
        "others": {"paper_degrees": PAPER_ANGLE, "3DEC_degrees": THREE_DEC_ANGLE},
        "studies": run.studies,
        "verdicts": {
            "rest_force_over_weight": friction_reduction.REST_FORCE,
            "rest_speed_over_sqrt_g_overlap": friction_reduction.REST_SPEED,
            "slide_distance_over_overlap": friction_reduction.SLIDE_DISTANCE,
        },
        "failed_contacts": run.failed_contacts,
        "wall_seconds": time.perf_counter() - started,
        "threads": O.numThreads,
        "versions": {"yade": yade.config.version, "library": potential_particles.library_version(),
                     "glue": potential_particles.__version__},
        **made("make wedge"),
    }
    write_summary(out / "summary.json", summary)
    print_results(run, summary, out)
    finish(run, summary)


def clear(out):
    """An empty folder for the results: frames of an earlier run would mix with the new ones."""
    out.mkdir(parents=True, exist_ok=True)
    for old in [*out.glob("wedge.*"), *out.glob("study.png"), *out.glob("summary.json"), *out.glob("trials.csv")]:
        old.unlink()


def _row(case, scene, reduction, result, seconds):
    limit = scene.blocks.limit
    error = errors(result, limit, scene.weight)
    row = {
        "name": case.name,
        "group": case.group,
        "plane_a": str(case.plane_a),
        "plane_b": str(case.plane_b),
        "slope_face": str(scene.blocks.face),
        "line_plunge_degrees": limit.plunge,
        "line_trend_degrees": limit.trend,
        "size_m": case.size,
        "rounding_over_size": case.rounding,
        "sphericity": case.sphericity,
        "flat_regularisation": scene.functor.flatRegularisation,
        "density_kg_per_m3": case.density,
        "weight_N": scene.weight,
        "normal_stiffness_N_per_m": scene.stiffness,
        "shear_over_normal_stiffness": case.shear_ratio,
        "overlap_over_size": scene.overlap / case.size,
        "time_step_s": O.dt,
        "closed_form_degrees": limit.friction_angle,
        "slides_at_degrees": result.slides_at,
        "holds_at_degrees": result.holds_at,
        "angle_degrees": result.angle,
        "first_slide_degrees": result.first_slide,
        "error_degrees": error["angle"],
        "error_against_contact_normals_degrees": result.angle - angle_of_contact_normals(result),
        "target_degrees": case.target,
        "direction_error_degrees": error["direction"],
        "force_a_error": error["force_a"],
        "force_b_error": error["force_b"],
        "contact_point_a": result.joints[0].point.tolist(),
        "contact_point_b": result.joints[1].point.tolist(),
        "angles_tried": len(result.trials),
        "steps": reduction.steps,
        "wall_seconds": seconds,
    }
    row["within_target"] = within_target(row)
    return row


def within_target(row):
    """Angle and bracket; direction and forces too, except for the blocks that are curved on purpose."""
    good = abs(row["error_degrees"]) <= row["target_degrees"]
    good &= row["holds_at_degrees"] - row["slides_at_degrees"] <= WIDEST_BRACKET
    if row["group"] != "sweep":
        good &= row["direction_error_degrees"] <= DIRECTION_TARGET
        good &= max(abs(row["force_a_error"]), abs(row["force_b_error"])) <= FORCE_TARGET
    return bool(good)


def _blocks():
    """The blocks where they are, as triangles for a picture."""
    return drawn(O.bodies, ShapeMeshes(MESH_TOLERANCE))[0]


def save_trials(path, trials):
    """Each friction angle that was tried, one row."""
    with open(path, "w", newline="") as file:
        rows = csv.writer(file)
        rows.writerow("case stage friction_angle_degrees verdict moved_m moved_over_overlap steps".split())
        for name, t in trials:
            rows.writerow([name, t.stage, t.friction_angle, t.verdict, t.moved, t.moved_overlaps, t.steps])


def draw(run):
    """What there is enough for."""
    picture = run.picture
    if "path" not in picture:
        return
    blocks, path = run.blocks[PAPER.name], picture["path"]
    trials = [trial for name, trial in run.trials if name == PAPER.name]
    row = next(row for row in run.rows if row["name"] == PAPER.name)
    states = [
        (f"at rest, friction angle {row['holds_at_degrees']:.3f}°", picture["before"]),
        (f"after sliding by {path.moved[-1] / blocks.size:.2f} of its height", picture["after"]),
    ]
    note = (
        f"Joints {blocks.plane_a} and {blocks.plane_b}. Slides at {row['slides_at_degrees']:.4f}°, holds at "
        f"{row['holds_at_degrees']:.4f}°; closed form {row['closed_form_degrees']:.4f}°. "
        "W/k$_n$: overlap of a joint that carries the weight."
    )
    save_overview(run.out / "wedge.png", states, blocks, trials, note)
    sweep = [
        (
            r["sphericity"],
            r["rounding_over_size"],
            r["error_degrees"],
            r["error_degrees"] - r["error_against_contact_normals_degrees"],
            0.5 * (r["holds_at_degrees"] - r["slides_at_degrees"]),
        )
        for r in run.rows
        if r["sphericity"] > 0.0
    ]
    if len(sweep) > 2:
        note = "Faces of the paper's wedge (height 1); contact points over 600 steps at rest, and on the way out."
        save_study(run.out / "study.png", blocks, picture["rests"], path, sweep, note)


def print_results(run, summary, out):
    """The table, and the few lines that a person wants."""
    print_cases(run.rows)
    studies, lines = summary["studies"], []
    if "slide_out" in studies:
        slide = studies["slide_out"]
        forces = max(slide["largest_force_a_error"], slide["largest_force_b_error"])
        text = (
            f"by {slide['moved_over_size']:.2f} of the size: {slide['direction_error_degrees']:.0e} degrees off the "
            f"line, normal forces within {forces:.0e}"
        )
        lines.append(("sliding out", text))
    for rest in studies.get("at_rest", []):
        text = (
            f"the contact point wanders by {rest['spread_of_point_over_size']:.1e} of the size, net force "
            f"{rest['mean_net_force_over_weight']:.0e} of the weight"
        )
        lines.append((f"at rest, regularised {rest['flat_regularisation']:.2g}", text))
    if "not_run_in" in studies:
        rough = studies["not_run_in"]
        text = (
            f"set down at {rough['begin_degrees']:g} degrees, it slides at {rough['slides_at_degrees']:.3f} and holds "
            f"at {rough['holds_at_degrees']:.3f}: shear is locked in, N_B {rough['force_b_over_closed_form'] - 1:+.0%}"
        )
        lines.append(("not run in", text))
    lines += [
        ("others", f"paper {PAPER_ANGLE}, 3DEC {THREE_DEC_ANGLE} degrees, for the first wedge"),
        ("time", f"{summary['wall_seconds']:.0f} s in all"),
        ("machine", summary["machine"]),
        ("results", f"{out}: " + ", ".join(name for name in RESULTS if (out / name).exists())),
    ]
    print_table(lines)


def print_cases(rows):
    """One line a wedge."""
    heads = ("wedge", "joints", "closed form", "slides at", "holds at", "error", "target", "direction", "N_A", "N_B", "")
    print_columns([heads] + [
        (row["name"], f"{row['plane_a']} {row['plane_b']}",
         *(f"{row[f'{name}_degrees']:.4f}" for name in ("closed_form", "slides_at", "holds_at")),
         f"{row['error_degrees']:+.5f}", f"{row['target_degrees']:g}", f"{row['direction_error_degrees']:.0e}",
         f"{row['force_a_error']:+.0e}", f"{row['force_b_error']:+.0e}", "met" if row["within_target"] else "MISSED")
        for row in rows])
    print("  (degrees; direction: between sliding and the line of intersection; N: normal forces, relative)")


def finish(run, summary):
    """Ends with a failure status when a target was missed or a contact failed."""
    if summary["failed_contacts"]:
        raise SystemExit(f"{summary['failed_contacts']} contacts could not be computed: the run is not sound.")
    missed = [row["name"] for row in run.rows if not row["within_target"]]
    if missed:
        raise SystemExit(f"Targets missed by: {', '.join(missed)}.")
    if summary["interrupted"]:
        raise SystemExit(130)


main()
