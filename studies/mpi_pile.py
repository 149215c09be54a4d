# SPDX-License-Identifier: MIT OR Apache-2.0
"""The pile of pyramids.py on several ranks (processes), through YADE's module mpy.

    scripts/yade_mpi.sh 3 -j1 studies/mpi_pile.py

Rank 0 holds floor and walls, the other ranks divide the pyramids; with one rank it is a serial run. Environment: STEPS
(6000), BODIES (1000), FRAMES (10, files for ParaView), RESUME (1: go on from the last saved scene). Results go to
out/mpi: pile.png, pile.bodies.pvd and pile.contacts.pvd with their .vtp files, summary.json, and pile.yade.gz, saved
four times on the way. SI units; z up, floor at z = 0.
"""

import os
import sys
import time
from pathlib import Path

# YADE runs a script without its folder on Python's path.
HERE = Path(sys.argv[0]).resolve().parent
sys.path.insert(0, str(HERE))

import yade
from potential_particles import Recorder, mpi
from yade import O

import machine
import mpi_pile_report as report
import pyramids
import settings
from bodies import reach
from box import Box
from contact_functor import LIBRARY, ContactFunctor
from loose_grid import loose_grid
from progress import Progress
from pyramid import pyramid

# How far a centre moves before boxes and borders are made anew: large, it costs pairs; small, exchanges between ranks.
VERLET_DISTANCE = 0.06 * pyramids.SIZE
LOOK_STEPS = 50  # between looks at overlaps, and at Ctrl-C
SAVES = 4
SCENE = "pile.yade.gz"


class Pile:
    """The scene: what every rank knows of it, since the environment is the same for all."""

    def __init__(self, count):
        self.count = count
        self.shape = pyramid(pyramids.SIZE)
        self.grid = loose_grid(count, reach(self.shape), pyramids.JITTER, pyramids.SEED)
        half_width = self.grid.half_width + 0.3 * self.grid.height
        self.box = Box(half_width, half_width, self.grid.height + pyramids.SIZE, thickness=pyramids.SIZE)
        self.ids = range(5, 5 + count)

    def build(self):
        """Fills YADE's scene; on rank 0."""
        ids = pyramids.build_scene(ContactFunctor(LIBRARY), self.shape, self.grid, self.box)
        assert list(ids) == list(self.ids)
        mpi.safe_boxes(VERLET_DISTANCE)


def main():
    """One run from environment to summary, on every rank."""
    started = time.perf_counter()
    steps = settings.whole_number("STEPS", 6000, 1, "number of steps")
    count = settings.whole_number("BODIES", 1000, 1, "number of pyramids")
    frames = settings.whole_number("FRAMES", 10, 0, "number of frames")
    resume = settings.choice("RESUME", "0", ("0", "1"), "answer to whether to resume")
    out = settings.folder("OUTPUT", HERE.parent / "out" / "mpi")
    pile = Pile(count)
    if mpi.rank() == 0:
        start(pile, out, resume == "1")
        mpi.divide(pile.ids)
        print(f"{count:,} pyramids, {steps:,} steps of {pyramids.TIME_STEP:g} s, {mpi.ranks()} ranks", flush=True)
    mpi.run(0)
    run = Run(pile, out, steps, frames)
    run.go()
    result = run.result()
    if mpi.rank() == 0:
        result["total_seconds"] = time.perf_counter() - started
        report.write(out, pile, result, run.pictures)


def start(pile, out, resume):
    """A new scene, or the one that was saved last."""
    out.mkdir(parents=True, exist_ok=True)
    if resume:
        if not (out / SCENE).exists():
            raise SystemExit(f"There is no {out / SCENE} to resume: run once without RESUME.")
        mpi.load(out / SCENE)
        if len(O.bodies) < pile.ids[-1] + 1 or O.bodies[pile.ids[-1]] is None:
            raise SystemExit(
                f"{out / SCENE} holds another number of pyramids than {pile.count:,}: set BODIES as in that run.")
    else:
        for old in [*out.glob("pile.*"), *out.glob("summary.json")]:
            old.unlink()
        pile.build()


class Run:
    """Stepping from the present step to `steps`, with looks, frames, pictures and saves on the way."""

    def __init__(self, pile, out, steps, frames):
        self.pile, self.out, self.steps = pile, out, steps
        self.first = O.iter
        share = [round(i * steps / frames) for i in range(frames + 1)] if frames else []
        self.frame_steps = set(share)
        self.picture_steps = {0, steps}
        self.save_steps = {round(i * steps / SAVES) for i in range(1, SAVES + 1)}
        looks = set(range(0, steps, LOOK_STEPS)) | self.frame_steps | self.picture_steps | self.save_steps
        self.stops = sorted(stop for stop in looks if stop >= self.first)
        self.series = Recorder(out / "pile", tolerance=0.05, ids=pile.ids)
        self.pictures = []
        self.overlap, self.stepping_seconds, self.interrupted, self.kinetic_peak = 0.0, 0.0, False, 0.0

    def go(self):
        progress = report.progress(Progress, self.steps) if mpi.rank() == 0 else None
        for stop in self.stops:
            begin = time.perf_counter()
            if stop > O.iter:
                mpi.run(stop - O.iter)
            self.stepping_seconds += time.perf_counter() - begin
            self._record(stop)
            if progress:
                progress.update(stop)
            if mpi.interrupted():
                self.interrupted = True
                mpi.save(self.out / SCENE)
                break
        if progress:
            progress.close()

    def _record(self, step):
        mine = max((contact.geom.penetrationDepth for contact in mpi.owned_contacts()), default=0.0)
        overlaps = mpi.gather(mine)
        if overlaps:
            self.overlap = max(self.overlap, *overlaps)
        if step in self.frame_steps:
            self.series()
        if step in self.frame_steps or step in self.picture_steps:
            states = mpi.states(self.pile.ids)
            if states:
                self._draw(step, states)
        if step in self.save_steps and step > self.first:
            mpi.save(self.out / SCENE)

    def _draw(self, step, states):
        if step in self.picture_steps:
            self.pictures.append((step, O.time, states))
        self.kinetic_peak = max(self.kinetic_peak, report.kinetic(self.pile, states))

    def result(self):
        """What the summary says of the run; on rank 0. Collective."""
        states = mpi.states(self.pile.ids)
        counters, failures = mpi.counters(), mpi.failures()
        parts = mpi.gather((len(mpi.owned_bodies()), len(mpi.owned_contacts()), len(O.interactions)))
        if mpi.rank():
            return None
        below, outside = self.pile.box.lost(states["position"])
        weight = self.pile.count * self.pile.shape.volume * pyramids.DENSITY * pyramids.GRAVITY
        return {
            "bodies": self.pile.count,
            "ranks": mpi.ranks(),
            "threads_a_rank": O.numThreads,
            "steps": O.iter,
            "steps_asked_for": self.steps,
            "first_step": self.first,
            "interrupted": self.interrupted,
            "stepping_seconds": self.stepping_seconds,
            "bodies_of_ranks": [part[0] for part in parts],
            "contacts_of_ranks": [part[1] for part in parts],
            "pairs_of_ranks": [part[2] for part in parts],
            "contacts": sum(part[1] for part in parts),
            "mean_height_m": float(states["position"][:, 2].mean()),
            "kinetic_energy_J": report.kinetic(self.pile, states),
            "peak_kinetic_energy_J": self.kinetic_peak,
            "largest_overlap_over_size_in_run": self.overlap / pyramids.SIZE,
            "support_over_weight": 0.0 - sum(O.forces.f(slab)[2] for slab in range(5)) / weight,
            "bodies_below_floor": int(below.sum()),
            "bodies_outside_walls": int(outside.sum()),
            "counters": counters,
            "failures": counters["failures"],
            "failure_report": failures,
            "frames": len(self.series.frames["bodies"]),
            "versions": {"yade": yade.config.version, **ContactFunctor(LIBRARY).versions()},
            "machine": machine.machine_line(),
            "date": machine.now(),
            "verlet_distance_m": VERLET_DISTANCE,
            "final": states,
        }


if __name__ == "__main__":
    mpi.launch(main)
