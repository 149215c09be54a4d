# SPDX-License-Identifier: MIT OR Apache-2.0
"""A wall at its limit, moved along its mechanism, with forces and the use of friction: python3
benches/equilibrium/plot.py; reads and writes out/equilibrium.
"""
import json
import sys
from pathlib import Path

import numpy as np

ROOT, OUT = Path(__file__).resolve().parents[2], Path("out/equilibrium")
sys.path.append(str(ROOT / "yade-glue/python/potential_particles/output"))
from equilibrium_picture import Block, picture

SIDE = 0.5 * np.array([[-1, 0, -1], [1, 0, -1], [1, 0, 1], [-1, 0, 1]])

answers = []
for name, wall in json.loads((OUT / "wall.json").read_text()).items():
    blocks = [Block([np.array(body["centre"]) + SIDE * (body["length"], 0, 1)], np.array(body["centre"]),
                    np.array(body["linear"]), np.array(body["angular"])) for body in wall["bodies"]]
    corners = [(at, force, contact["use"]) for contact in wall["contacts"] for at, force in contact["corners"]]
    answers.append((f"{name}: load factor {wall['factor']:.4f}", blocks, *map(np.array, zip(*corners))))
picture(answers).savefig(OUT / "equilibrium.png", dpi=110)
