# SPDX-License-Identifier: MIT OR Apache-2.0
"""Two hundred pyramids of random orientation fall on a floor and come to rest in a heap.

Simulation A of Boon, Houlsby & Utili. Run it inside YADE:

    yade -x -n -j1 studies/pyramids.py

Environment: STEPS (14000), BODIES (200), OUTPUT (out/pyramids). Writes pyramids.png, pyramids.bodies.pvd and
pyramids.contacts.pvd with their .vtp files for ParaView, summary.json, and history.csv with energies and overlaps.
studies/side_by_side runs the same pile with YADE's own contact functor. SI units; z up, floor at z = 0.
"""

import sys
import time
from pathlib import Path

# YADE runs a script without its folder on Python's path.
HERE = Path(sys.argv[0]).resolve().parent
sys.path.insert(0, str(HERE))

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import potential_particles
import yade
from potential_particles import Recorder
from potential_particles.output.drawn import ShapeMeshes, copies, floor
from potential_particles.output.picture import render
from potential_particles.output.view import framing_view
from yade import O

import pile
import settings
from bodies import reach
from progress import Progress
from stepping import advance
from summary import made, print_table, write_summary
from watch import Watch, unbalanced_force

# The walls only guard against losing a body that slides far: the heap stays clear of them.
ROOM = 1.0
WATCH_STEPS = 20  # between looks at energies and overlaps; an impact lasts about 15 steps
FRAMES = 28  # for ParaView, after the first
AT_REST = 0.9  # of the steps: from there on the pile counts as settled
PAPER_STEPS, PAPER_PICTURES = 14_000, (0, 4_000, 14_000)  # the paper's Fig. 3
VIEW_FROM, VIEW_ANGLE = np.array([0.46, -0.84, 0.42]), 0.42  # scene to eye; full height, radians
PANEL_PIXELS, DOTS_PER_INCH = (560, 620), 150  # width and height of a panel
MESH_TOLERANCE = 2e-3  # of the picture, over the size


class Run:
    """The pile with looks, frames and pictures at steps of their own choosing."""

    def __init__(self, heap, steps, out):
        self.heap, self.steps = heap, steps
        self.watch, self.series = Watch(heap.ids, pile.GRAVITY), Recorder(out / "pyramids", ids=heap.ids)
        self.frames = {round(i * steps / FRAMES) for i in range(FRAMES + 1)}
        self.pictures = {round(step * steps / PAPER_STEPS) for step in PAPER_PICTURES}
        self.mark = round(AT_REST * steps)
        self.drawn, self.seconds = [], 0.0

    def go(self):
        """True if Ctrl-C came before the end. What was written until then stays."""
        progress = Progress(self.steps)
        looks = range(0, self.steps + 1, WATCH_STEPS)
        try:
            for stop in sorted({*looks, *self.frames, *self.pictures, self.mark, self.steps}):
                if stop > O.iter:
                    self.seconds += advance(stop)
                self._look(stop)
                progress.update(stop)
        except KeyboardInterrupt:
            self._draw()
            return True
        finally:
            progress.close()
        return False

    def _look(self, step):
        self.watch.look()
        if step == self.mark:
            self.heap.contact.mark()
        if step in self.pictures:
            self._draw()
        if step in self.frames:
            self.series()

    def _draw(self):
        caption = f"step {O.iter:,}:  t = {O.time:.2f} s,  kinetic energy {self.watch.look().kinetic:.2g} J"
        self.drawn.append((caption, *self.watch.poses()))


def main():
    """One run from environment to summary."""
    started = time.perf_counter()
    steps = settings.whole_number("STEPS", PAPER_STEPS, 1, "number of steps")
    count = settings.whole_number("BODIES", 200, 1, "number of pyramids")
    out = settings.folder("OUTPUT", HERE.parent / "out" / "pyramids")
    # Frames of an earlier run would mix with the new ones.
    out.mkdir(parents=True, exist_ok=True)
    for old in [*out.glob("pyramids.*"), *out.glob("summary.json"), *out.glob("history.csv")]:
        old.unlink()
    heap = pile.Pile(count, room=ROOM)
    heap.build()
    run = Run(heap, steps, out)
    print(f"{count} pyramids, {steps:,} steps of {pile.TIME_STEP:g} s, contacts by {heap.contact.name}", flush=True)
    interrupted = run.go()
    if interrupted:
        print(f"interrupted at step {O.iter:,}: drawing and summing up what there is", flush=True)
    run.watch.save(out / "history.csv")
    draw(out / "pyramids.png", run.drawn, heap)
    summary = summarise(run, interrupted)
    summary["total_seconds"] = time.perf_counter() - started
    write_summary(out / "summary.json", summary)
    print_summary(summary, out)
    if summary["bodies_below_floor"] or summary["bodies_outside_walls"] or summary["failures"]:
        raise SystemExit("The run is not sound: bodies were lost or contacts failed; see above.")
    if interrupted:
        raise SystemExit(130)


def draw(path, states, heap):
    """The panels of the paper's Fig. 3; colour tells the layer in which a body started."""
    layers = heap.grid.layers
    colours = matplotlib.colormaps["viridis"](np.linspace(0.12, 0.9, layers[-1] + 1))[:, :3][layers]
    mesh, (width, height) = ShapeMeshes(MESH_TOLERANCE).of(potential_particles.conic_particle(heap.shape)), PANEL_PIXELS
    ends = [positions + side * axis for _, positions, _ in states for side in (-1, 1)
            for axis in reach(heap.shape) * np.eye(3)]
    view = framing_view(np.vstack(ends), VIEW_FROM, VIEW_ANGLE, width / height)
    inches = (len(states) * width / DOTS_PER_INCH, (height + 150) / DOTS_PER_INCH)
    figure, axes = plt.subplots(1, len(states), figsize=inches, dpi=DOTS_PER_INCH, squeeze=False)
    for letter, axis, (caption, *poses) in zip("abcdefgh", axes[0], states):
        bodies = copies(mesh, *poses, colours, np.arange(len(colours)))
        axis.imshow(render(bodies, floor(0.0, 2.0 * heap.grid.height), view, width, height),
                    interpolation="antialiased")
        axis.set_axis_off()
        axis.set_title(f"({letter}) {caption}", fontsize=9.5, y=-0.06)
    figure.suptitle(f"{len(colours)} pyramids, as potential particles, falling under gravity", fontsize=11, y=0.985)
    note = f"Surfaces f = 0, to {MESH_TOLERANCE:g} of the size. Colour: layer in which a body started."
    figure.text(0.5, 0.012, note, ha="center", va="bottom", fontsize=7.5, color="0.35")
    figure.subplots_adjust(left=0.0, right=1.0, bottom=0.105, top=0.93, wspace=0.02)
    figure.savefig(path)


def summarise(run, interrupted):
    """Everything worth keeping about the run, as plain values; units in the names."""
    heap, watch, last = run.heap, run.watch, run.watch.look()
    below, outside = heap.box.lost(watch.poses()[0])
    weight = len(heap.ids) * heap.shape.volume * pile.DENSITY * pile.GRAVITY
    counts = heap.contact.counts()
    return {
        "bodies": len(heap.ids),
        "steps": O.iter,
        "steps_asked_for": run.steps,
        "interrupted": interrupted,
        "simulated_seconds": O.time,
        "wall_seconds": run.seconds,
        "steps_per_second": O.iter / run.seconds if run.seconds else None,
        "contacts": last.contacts,
        "candidate_pairs": last.candidates,
        "largest_overlap_over_size": last.overlap / pile.SIZE,
        "largest_overlap_over_size_in_run": watch.largest_overlap() / pile.SIZE,
        "kinetic_energy_J": last.kinetic,
        "peak_kinetic_energy_J": watch.peak_kinetic(),
        "largest_energy_rise_J": watch.largest_rise(),
        "initial_potential_energy_J": watch.samples[0].potential,
        "unbalanced_force": unbalanced_force(),
        "support_over_weight": 0.0 - sum(O.forces.f(slab)[2] for slab in range(5)) / weight,
        "bodies_below_floor": int(below.sum()),
        "bodies_outside_walls": int(outside.sum()),
        "failures": counts["failures"],
        "contact_functor": {"name": heap.contact.name, **counts},
        "answers_at_rest": heap.contact.answers_since_mark(),
        "failure_report": heap.contact.failure_report(),
        "engine_seconds": {engine.label or type(engine).__name__: engine.execTime / 1e9 for engine in O.engines},
        "frames": len(run.series.frames["bodies"]),
        "threads": O.numThreads,
        "versions": {"yade": yade.config.version, **heap.contact.versions()},
        **made("make demo"),
        # Numbers of the scene, in SI units.
        "parameters": {name.lower(): value for name, value in vars(pile).items() if isinstance(value, float)},
    }


def print_summary(summary, out):
    """The few lines that a person wants."""
    functor, rate, rise = summary["contact_functor"], summary["steps_per_second"], summary["largest_energy_rise_J"]
    unbalanced, calls = summary["unbalanced_force"], max(functor["calls"], 1)
    stopped = " (interrupted)" if summary["interrupted"] else ""
    print_table([
        ("bodies", f"{summary['bodies']:,} pyramids"),
        ("steps", f"{summary['steps']:,} of {summary['steps_asked_for']:,}{stopped}, "
                  f"{summary['simulated_seconds']:.2f} s simulated"),
        ("time", f"{summary['wall_seconds']:.1f} s stepping" + (f", {rate:,.0f} steps/s" if rate else "")
         + f"; {summary['total_seconds']:.1f} s in all"),
        ("contact functor", f"{functor['name']}: {functor['seconds']:.1f} s for {functor['calls']:,} calls, "
                            f"{functor['seconds'] / calls * 1e6:.2f} us each; {functor['rejected']:,} rejected cheaply"),
        *[("answers at rest", line) for line in answer_lines(summary["answers_at_rest"])],
        ("contacts", f"{summary['contacts']:,} of {summary['candidate_pairs']:,} candidate pairs"),
        ("largest overlap", f"{summary['largest_overlap_over_size']:.3%} of the size at the end, "
                            f"{summary['largest_overlap_over_size_in_run']:.2%} in the run"),
        ("kinetic energy",
         f"{summary['kinetic_energy_J']:.2e} J, at its peak {summary['peak_kinetic_energy_J']:.3g} J"),
        ("total energy", "never rose between looks" if rise == 0.0 else f"rose by up to {rise:.1e} J between looks"),
        ("unbalanced force",
         "no contact yet" if unbalanced is None else f"{unbalanced:.1e} of the mean contact force"),
        ("box carries", f"{summary['support_over_weight']:.2%} of the weight"),
        ("bodies lost", f"{summary['bodies_below_floor']} below the floor, "
                        f"{summary['bodies_outside_walls']} outside the walls"),
        ("failures", str(summary["failures"])),
        ("versions", ", ".join(f"{name} {version}" for name, version in summary["versions"].items())),
        ("machine", summary["machine"]),
        ("results", f"{out}: pyramids.png, pyramids.bodies.pvd (ParaView), summary.json"),
    ])  # fmt: skip


def answer_lines(answers):
    """How pairs were answered in the last tenth of the run."""
    paths = {name: count for name, count in (answers or {"overlapping": 0}).items() if name != "overlapping"}
    total = sum(paths.values())
    apart = total - (answers or {}).get("overlapping", 0)
    skipped = sum(paths.get(name, 0) for name in ("motion", "spheres", "face", "memory"))
    if apart:
        yield f"{skipped / apart:.1%} of the pairs that do not touch needed no solve; of all pairs: " + (
            ", ".join(f"{name} {count / total:.1%}" for name, count in paths.items() if count))


main()
