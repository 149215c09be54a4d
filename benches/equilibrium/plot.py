# SPDX-License-Identifier: MIT OR Apache-2.0
"""A wall and a slope at their limits, moved along their mechanisms, with forces and the use of friction: python3
benches/equilibrium/plot.py; reads and writes out/equilibrium.
"""
import json
import sys
from pathlib import Path

import numpy as np

ROOT, OUT = Path(__file__).resolve().parents[2], Path("out/equilibrium")
sys.path.append(str(ROOT / "python/potential_particles"))
from equilibrium_picture import Block, picture

for name, flows in json.loads((OUT / "drawn.json").read_text()).items():
    answers = []
    for flow, found in flows.items():
        blocks = [Block([np.array(face) for face in body["faces"]], *(np.array(body[of]) for of in
                        ("centre", "linear", "angular")), body["held"]) for body in found["bodies"] if body["faces"]]
        answers.append((f"{flow}: {found['title']}", blocks,
                        *(np.array(found[of]) for of in ("corners", "forces", "used"))))
    # The slope's face looks to the right of the picture.
    towards = (0, -1, 0) if name == "wall" else (0.5, -1, 0.4)
    picture(answers, towards).savefig(OUT / f"{name}.png", dpi=110)
