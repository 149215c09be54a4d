# SPDX-License-Identifier: MIT OR Apache-2.0
"""Friction between rocks from a measured angle of repose: heaps of repose.py at five coefficients, two seeds of each.

    yade -x -n -j1 examples/calibration.py

Environment: ANGLE (25 degrees, what was measured), FRICTIONS (0.2 0.35 0.5 0.65 0.8), SEEDS (2), BODIES (150),
OUTPUT (out/calibration). Two heaps are run at a time. Ctrl-C keeps those that are done. Writes calibration.png and
summary.json.
"""
import json
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

import numpy as np
from matplotlib import pyplot
from potential_particles import files, progress
from yade import config

ANGLE, FRICTIONS = float(os.environ.get("ANGLE", 25)), os.environ.get("FRICTIONS", "0.2 0.35 0.5 0.65 0.8").split()
SEEDS, COUNT = int(os.environ.get("SEEDS", 2)), os.environ.get("BODIES", "150")
OUT = os.environ.get("OUTPUT", "out/calibration")
REPOSE = os.path.join(os.path.dirname(os.path.abspath(sys.argv[0])), "repose.py")
YADE = f"{config.prefix}/bin/yade{config.suffix}"  # the one that runs this script


def heap(friction, seed):
    """(friction, angle of repose) of one heap, or None for one that was interrupted."""
    folder = os.path.join(OUT, f"heap_{friction}_{seed}")
    degrees = np.degrees(np.arctan(float(friction)))
    changed = {"OUTPUT": folder, "BODIES": COUNT, "SEED": str(seed), "FRICTION": str(degrees)}
    done = subprocess.run([YADE, "-x", "-n", "-j1", REPOSE], env={**os.environ, **changed}, capture_output=True,
                          stdin=subprocess.DEVNULL)
    if done.returncode and not stopped:
        raise RuntimeError(f"repose.py at a friction of {friction}: {done.stderr.decode()[-500:]}")
    if done.returncode:
        return None
    with open(os.path.join(folder, "summary.json")) as file:
        angle = json.load(file)["angle_of_repose"]
    print(f"friction {friction}, seed {seed}: {angle:.1f} degrees", flush=True)
    return float(friction), angle


def friction_at(heaps):
    """The coefficient at which the parabola through the heaps reaches the angle; the end of the range beyond it."""
    along = np.linspace(heaps[:, 0].min(), heaps[:, 0].max(), 1000)
    curve = np.polyval(np.polyfit(*heaps.T, 2), along)
    return along[np.abs(curve - ANGLE).argmin()]


jobs = [(friction, seed) for friction in FRICTIONS for seed in range(SEEDS)]
bar, heaps = progress.Bar(len(jobs), True, "heaps", "calibration"), []
with progress.Interrupts() as stopped, ThreadPoolExecutor(2) as pool:
    for one in pool.map(lambda job: None if stopped else heap(*job), jobs):
        heaps += [one] if one else []
        bar.reached(len(heaps))
bar.close()
heaps = np.array(heaps)
if len(set(heaps[:, 0]) if len(heaps) else ()) < 3 or len(heaps) < 4:
    raise SystemExit(f"{len(heaps)} heaps: a curve needs four of them, at three coefficients")
fit = np.polyfit(*heaps.T, 2)
along = np.linspace(heaps[:, 0].min(), heaps[:, 0].max())
curve = np.polyval(fit, along)
if not curve.min() <= ANGLE <= curve.max():
    raise SystemExit(f"ANGLE={ANGLE:g} is not within {curve.min():.1f} to {curve.max():.1f}: give other FRICTIONS")
# What the answer owes to each heap: the same fit without it (the jackknife).
others = np.array([friction_at(np.delete(heaps, i, axis=0)) for i in range(len(heaps))])
answer, scatter = friction_at(heaps), np.sqrt((len(heaps) - 1) * others.var())
summary = {
    "measured_angle": ANGLE, "friction": answer, "scatter": scatter, "heaps": heaps.tolist(),
    "scatter_of_a_heap_degrees": np.sqrt(np.square(np.polyval(fit, heaps[:, 0]) - heaps[:, 1]).sum() / (len(heaps) - 3))
}
picture, axes = pyplot.subplots(figsize=(7, 4), layout="constrained")
axes.plot(*heaps.T, "o", label="heaps")
axes.plot(along, curve, label="parabola through them")
axes.axhline(ANGLE, color="0.5", ls="--", label=f"measured: {ANGLE:g} degrees")
axes.axvspan(answer - scatter, answer + scatter, color="C2", alpha=0.3, label=f"friction {answer:.2f} ± {scatter:.2f}")
axes.set(xlabel="coefficient of friction between rocks", ylabel="angle of repose, degrees")
axes.legend()
picture.savefig(os.path.join(OUT, "calibration.png"), dpi=110)
files.write_summary(os.path.join(OUT, "summary.json"), summary)
print(f"a heap of {ANGLE:g} degrees: friction {answer:.2f} ± {scatter:.2f}")
