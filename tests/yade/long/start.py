# SPDX-License-Identifier: GPL-3.0-or-later
"""A tiny scene from start to end, shorter than YADE takes to start. Run by tests/yade/long/run.py, many times."""
import math

import potential_particles
import yade
from harness import *

fresh_scene(yade.Ig2_PP_PP_ScGeom_Conic(), dt=1e-4, damping=0.2, gravity=(0, 0, -9.81), friction=0.5)
add(cube(half=1.5, R=2.6, isBoundary=True), Vector3(0, 0, -1.5), fixed=True)
for i in range(8):
    shape = pyramid() if i % 2 else cube(half=0.4, R=0.7)
    add(shape, Vector3(0.7 * (i % 2), 0.7 * (i // 2 % 2), 0.45 + 0.8 * (i // 4)), turned((1, i, 2), 0.3 * i))
run(60)
real = sum(c.isReal for c in O.interactions)
assert real > 3 and functor().failures == 0 and all(map(math.isfinite, state_numbers()))
print(f"ended with {real} contacts, positions {sum(state_numbers()):.12g}", flush=True)
