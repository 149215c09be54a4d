# SPDX-License-Identifier: MIT OR Apache-2.0
"""Two hundred pyramids of random orientation fall on a floor and come to rest in a heap.

Simulation A of Boon, Houlsby & Utili. Run it inside YADE:

    yade -x -n -j1 studies/pyramids.py

Environment: STEPS (14000), BODIES (200), FUNCTOR (library, or builtin for YADE's own contact
detection). Results go to out/pyramids: pyramids.png, pyramids.bodies.pvd and pyramids.contacts.pvd with
their .vtp files for ParaView, summary.json, and history.csv with energies and overlaps. SI units throughout; world
frame with z up, floor at z = 0.
"""

import sys
import time
from pathlib import Path

# YADE runs a script without its folder on Python's path.
HERE = Path(sys.argv[0]).resolve().parent
sys.path.insert(0, str(HERE))

import matplotlib
import numpy as np
import yade
from potential_particles import Recorder
from potential_particles.output.drawn import ShapeMeshes, copies
from potential_particles.output.view import framing_view
from yade import O

import machine
import settings
from bodies import potential_body, reach
from box import BODY_MASK, SLAB_ONLY, Box
from contact_functor import BUILTIN, LIBRARY, ContactFunctor
from loose_grid import loose_grid
from panels import PANEL_PIXELS, save_panels
from pyramid import HEIGHT, ROUNDING, SPHERICITY, pyramid
from recorded_run import RecordedRun
from summary import print_table, write_summary
from watch import Watch, unbalanced_force

SIZE = 0.1  # base edge, m
DENSITY = 2600.0  # kg/m^3
FRICTION_ANGLE = 30.0  # degrees, everywhere
GRAVITY = 9.81  # m/s^2
SEED = 2012
JITTER = 0.03 * SIZE

# So stiff that the fastest impacts (some 4 m/s) overlap by about 1 % of the size.
NORMAL_STIFFNESS = 1.5e6  # N/m
SHEAR_STIFFNESS = 0.5 * NORMAL_STIFFNESS
# A fifth of sqrt(m/k_n), the critical step of a contact at a corner, where the effective mass is
# about m/4.
TIME_STEP = 1.5e-4  # s
# Impacts lose energy in dashpots along the normal. The law has none along the shear direction, so
# a little of YADE's local damping stills sliding and rocking. It acts on the acceleration, gravity
# included (bodies fall with 0.9 g), and so vanishes at rest; left off gravity, it would shift the
# balance of forces of resting bodies. What neither can still is the slow spin of a pyramid that
# lies flat: it meets what is below in one point, about which nothing resists turning.
VISCOUS_DAMPING = 0.3  # of critical
LOCAL_DAMPING = 0.1

# The boxes must be exact at every step: with a margin, YADE runs the collider when a centre has
# moved by it, but a body that tips moves its corners much further than its centre, and would meet
# the floor unseen. (BoundWatch would see it; for so few bodies it takes as long as the collider.)
VERLET_DISTANCE = 0.0
WATCH_STEPS = 20  # between looks at energies and overlaps; an impact lasts about 15 steps
VIEW_FROM, VIEW_ANGLE = np.array([0.46, -0.84, 0.42]), 0.42  # scene to eye; full height, radians
FRAMES = 28  # for ParaView, after the first
MESH_TOLERANCE = 2e-3  # of the picture, over the size
AT_REST = 0.9  # of the steps: from there on the pile counts as settled
PAPER_STEPS, PAPER_PICTURES = 14_000, (0, 4_000, 14_000)  # the paper's Fig. 3


def main():
    """One run from environment to summary."""
    started = time.perf_counter()
    steps = settings.whole_number("STEPS", PAPER_STEPS, 1, "number of steps")
    count = settings.whole_number("BODIES", 200, 1, "number of pyramids")
    kind = settings.choice("FUNCTOR", LIBRARY, (LIBRARY, BUILTIN), "contact functor")
    out = settings.folder("OUTPUT", HERE.parent / "out" / "pyramids")
    contact = ContactFunctor(kind)
    shape = pyramid(SIZE)
    grid = loose_grid(count, reach(shape), JITTER, SEED)
    # The walls only guard against losing a body that slides far: the heap stays clear of them.
    half_width = grid.half_width + grid.height
    box = Box(half_width, half_width, grid.height + SIZE, thickness=SIZE)
    ids = build_scene(contact, shape, grid, box)
    clear(out)

    watch = Watch(ids, GRAVITY)
    series = Recorder(out / "pyramids", ids=ids)
    run = RecordedRun(
        steps,
        watch,
        series,
        watch_steps=WATCH_STEPS,
        frame_steps=[round(i * steps / FRAMES) for i in range(FRAMES + 1)],
        picture_steps=[round(step * steps / PAPER_STEPS) for step in PAPER_PICTURES],
        calls={round(AT_REST * steps): contact.mark},
    )
    print(f"{count} pyramids, {steps:,} steps of {TIME_STEP:g} s, contacts by {contact.name}", flush=True)
    interrupted = run.go()
    if interrupted:
        print(f"interrupted at step {O.iter:,}: drawing and summing up what there is", flush=True)
        run.keep_last()
    watch.save(out / "history.csv")
    draw(out / "pyramids.png", run.states, shape, grid)
    summary = summarise(run, contact, shape, box, count, steps, interrupted)
    summary["total_seconds"] = time.perf_counter() - started
    write_summary(out / "summary.json", summary)
    print_summary(summary, out)
    finish(summary)


def clear(out):
    """An empty folder for the results: frames of an earlier run would mix with the new ones."""
    out.mkdir(parents=True, exist_ok=True)
    for old in [*out.glob("pyramids.*"), *out.glob("summary.json"), *out.glob("history.csv")]:
        old.unlink()


def build_scene(contact, shape, grid, box):
    """Fills YADE's scene; returns the ids of the pyramids."""
    material = yade.FrictMat(young=-1, poisson=-1, frictionAngle=np.radians(FRICTION_ANGLE), density=DENSITY)
    O.materials.append(material)
    O.bodies.append(box.slabs(contact.shape_class, material))
    ids = [
        append(contact, shape, material, position, orientation)
        for position, orientation in zip(grid.positions, grid.orientations)
    ]
    O.engines = engines(contact)
    contact.prepare()
    O.dt = TIME_STEP
    O.timingEnabled = True
    return ids


def append(contact, shape, material, position, orientation):
    """Puts a body at `position`, m, with `orientation` w, x, y, z into YADE's scene; returns its id."""
    return O.bodies.append(potential_body(contact.shape_class, shape, material, position, orientation, mask=BODY_MASK))


def engines(contact):
    """YADE's loop: boxes, contacts, springs, motion."""
    return [
        yade.ForceResetter(),
        yade.InsertionSortCollider(
            [yade.PotentialParticle2AABB()],
            verletDist=VERLET_DISTANCE,
            avoidSelfInteractionMask=SLAB_ONLY,
            label="collider",
        ),
        contact.loop(
            [contact.functor],
            [
                # Without a contact area (the functor's switch) the stiffnesses are those of
                # springs, in N/m.
                yade.Ip2_FrictMat_FrictMat_KnKsPhys(
                    Knormal=NORMAL_STIFFNESS,
                    Kshear=SHEAR_STIFFNESS,
                    kn_i=NORMAL_STIFFNESS,
                    ks_i=SHEAR_STIFFNESS,
                    viscousDamping=VISCOUS_DAMPING,
                    useFaceProperties=False,
                    brittleLength=5.0,
                )
            ],
            [yade.Law2_SCG_KnKsPhys_KnKsLaw(allowViscousAttraction=False)],
            label="contacts",
        ),
        yade.NewtonIntegrator(
            damping=LOCAL_DAMPING,
            exactAsphericalRot=True,
            gravity=(0.0, 0.0, -GRAVITY),
            label="motion",
        ),
    ]


def draw(path, states, shape, grid):
    """The panels of the paper's Fig. 3; colour tells the layer in which a body started."""
    shades = matplotlib.colormaps["viridis"](np.linspace(0.12, 0.9, grid.layers[-1] + 1))
    colours = shades[:, :3][grid.layers]
    mesh = ShapeMeshes(MESH_TOLERANCE).of(shape.particle())
    ends = [
        state.positions + side * axis
        for state in states
        for side in (-1, 1)
        for axis in reach(shape) * np.eye(3)
    ]
    view = framing_view(np.vstack(ends), VIEW_FROM, VIEW_ANGLE, PANEL_PIXELS[0] / PANEL_PIXELS[1])
    panels = [
        (
            f"step {state.step:,}:  t = {state.time:.2f} s,  kinetic energy {state.kinetic:.2g} J",
            copies(mesh, state.positions, state.rotations, colours, np.arange(len(colours))),
        )
        for state in states
    ]
    save_panels(
        path,
        panels,
        2.0 * grid.height,
        view,
        f"{len(colours)} pyramids, as potential particles, falling under gravity",
        f"Surfaces f = 0, to {MESH_TOLERANCE:g} of the size. Colour: layer in which a body started.",
    )


def summarise(run, contact, shape, box, count, steps, interrupted):
    """Everything worth keeping about the run, as plain values; units in the names."""
    watch = run.watch
    last = watch.look()
    below, outside = box.lost(watch.poses()[0])
    weight = count * shape.volume * DENSITY * GRAVITY
    support = sum(O.forces.f(slab)[2] for slab in range(5))
    return {
        "bodies": count,
        "steps": O.iter,
        "steps_asked_for": steps,
        "interrupted": interrupted,
        "simulated_seconds": O.time,
        "wall_seconds": run.stepping_seconds,
        "steps_per_second": O.iter / run.stepping_seconds if run.stepping_seconds else None,
        "contacts": last.contacts,
        "candidate_pairs": last.candidates,
        "largest_overlap_over_size": last.overlap / SIZE,
        "largest_overlap_over_size_in_run": watch.largest_overlap() / SIZE,
        "kinetic_energy_J": last.kinetic,
        "peak_kinetic_energy_J": watch.peak_kinetic(),
        "largest_energy_rise_J": watch.largest_rise(),
        "initial_potential_energy_J": watch.samples[0].potential,
        "unbalanced_force": unbalanced_force(),
        "support_over_weight": 0.0 - support / weight,
        "bodies_below_floor": int(below.sum()),
        "bodies_outside_walls": int(outside.sum()),
        "failures": contact.counts()["failures"],
        "contact_functor": {"name": contact.name, **contact.counts()},
        "answers_at_rest": contact.answers_since_mark(),
        "failure_report": contact.failure_report(),
        "engine_seconds": {
            engine.label or type(engine).__name__: engine.execTime / 1e9 for engine in O.engines
        },
        "frames": len(run.series.frames["bodies"]),
        "threads": O.numThreads,
        "versions": {"yade": yade.config.version, **contact.versions()},
        "machine": machine.machine_line(),
        "date": machine.now(),
        "seed": SEED,
        "parameters": {
            "size_m": SIZE,
            "height_over_size": HEIGHT,
            "rounding_over_size": ROUNDING,
            "sphericity": SPHERICITY,
            "mass_kg": shape.volume * DENSITY,
            "density_kg_per_m3": DENSITY,
            "friction_angle_degrees": FRICTION_ANGLE,
            "gravity_m_per_s2": GRAVITY,
            "normal_stiffness_N_per_m": NORMAL_STIFFNESS,
            "shear_stiffness_N_per_m": SHEAR_STIFFNESS,
            "time_step_s": TIME_STEP,
            "viscous_damping": VISCOUS_DAMPING,
            "local_damping": LOCAL_DAMPING,
            "box_half_width_m": box.half_x,
            "verlet_distance_m": VERLET_DISTANCE,
        },
    }


def print_summary(summary, out):
    """The few lines that a person wants."""
    functor = summary["contact_functor"]
    rate = summary["steps_per_second"]
    unbalanced = summary["unbalanced_force"]
    rise = summary["largest_energy_rise_J"]
    rows = [
        ("bodies", f"{summary['bodies']:,} pyramids"),
        (
            "steps",
            f"{summary['steps']:,} of {summary['steps_asked_for']:,}"
            + (" (interrupted)" if summary["interrupted"] else "")
            + f", {summary['simulated_seconds']:.2f} s simulated",
        ),
        (
            "time",
            f"{summary['wall_seconds']:.1f} s stepping"
            + (f", {rate:,.0f} steps/s" if rate else "")
            + f"; {summary['total_seconds']:.1f} s in all",
        ),
        ("contact functor", contact_line(functor)),
        *[("answers at rest", line) for line in answer_lines(summary["answers_at_rest"])],
        ("contacts", f"{summary['contacts']:,} of {summary['candidate_pairs']:,} candidate pairs"),
        (
            "largest overlap",
            f"{summary['largest_overlap_over_size']:.3%} of the size at the end, "
            f"{summary['largest_overlap_over_size_in_run']:.2%} in the run",
        ),
        (
            "kinetic energy",
            f"{summary['kinetic_energy_J']:.2e} J, at its peak {summary['peak_kinetic_energy_J']:.3g} J",
        ),
        (
            "total energy",
            "never rose between looks" if rise == 0.0 else f"rose by up to {rise:.1e} J between looks",
        ),
        (
            "unbalanced force",
            "no contact yet" if unbalanced is None else f"{unbalanced:.1e} of the mean contact force",
        ),
        ("box carries", f"{summary['support_over_weight']:.2%} of the weight"),
        (
            "bodies lost",
            f"{summary['bodies_below_floor']} below the floor, "
            f"{summary['bodies_outside_walls']} outside the walls",
        ),
        (
            "failures",
            "not reported by this functor" if summary["failures"] is None else str(summary["failures"]),
        ),
        ("versions", ", ".join(f"{name} {version}" for name, version in summary["versions"].items())),
        ("machine", summary["machine"]),
        ("results", f"{out}: pyramids.png, pyramids.bodies.pvd (ParaView), summary.json"),
    ]
    print_table(rows)


def contact_line(functor):
    """Calls and time of the contact functor in one phrase."""
    if functor["calls"] is None:
        return f"{functor['name']} (counts nothing)"
    each = functor["seconds"] / functor["calls"] * 1e6 if functor["calls"] else 0.0
    return (
        f"{functor['name']}: {functor['seconds']:.1f} s for {functor['calls']:,} calls, {each:.2f} us each; "
        f"{functor['rejected']:,} rejected cheaply"
    )


def answer_lines(answers):
    """How pairs were answered in the last tenth of the run."""
    if not answers:
        return
    paths = {name: count for name, count in answers.items() if name != "overlapping"}
    total = sum(paths.values())
    apart = total - answers["overlapping"]
    skipped = sum(paths[name] for name in ("motion", "spheres", "face", "memory"))
    if not apart:
        return
    yield f"{skipped / apart:.1%} of the pairs that do not touch needed no solve; of all pairs: " + (
        ", ".join(f"{name} {count / total:.1%}" for name, count in paths.items() if count)
    )


def finish(summary):
    """Ends with a failure status when the run proved unsound."""
    if summary["bodies_below_floor"] or summary["bodies_outside_walls"] or summary["failures"]:
        raise SystemExit("The run is not sound: bodies were lost or contacts failed; see above.")
    if summary["interrupted"]:
        raise SystemExit(130)


if __name__ == "__main__":
    main()
