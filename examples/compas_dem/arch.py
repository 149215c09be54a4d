# SPDX-License-Identifier: MIT OR Apache-2.0
"""compas_dem's own arch, its ArchTemplate, by backend.py: thrust at the supports and how far the crown goes down.

    PYTHONPATH=yade-glue/build/python venv/bin/python examples/compas_dem/arch.py      # venv: pip install compas_dem
"""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

import backend
from compas_dem.analysis.resolve import _element_mass
from compas_dem.material import Stone
from compas_dem.models import BlockModel
from compas_dem.problem import Problem
from compas_dem.templates import ArchTemplate

template = ArchTemplate(rise=3.0, span=10.0, thickness=0.5, depth=0.5, n=20)
model = BlockModel()
for mesh in template.blocks():
    model.add_block_from_mesh(mesh)
stone = Stone.from_predefined_material("LIMESTONE")
model.add_material(stone)
blocks = list(model.elements())
model.assign_material(stone, elements=blocks)
for block in (blocks[0], blocks[-1]):
    block.is_support = True

problem = Problem(model)
problem.set_contact_model("MohrCoulomb", mu=0.7)
results = backend.solve(problem)

weight = sum(_element_mass(block) for block in model.blocks()) * backend.GRAVITY
supports = {blocks[0].graphnode, blocks[-1].graphnode}
reactions = []
for edge in results.edges():
    if supports & set(edge):
        sign = -1.0 if edge[0] in supports else 1.0
        reactions.append([sign * f for f in results.resultant_global(edge)])
total = [sum(one[i] for one in reactions) for i in range(3)]
crown = results.displacement(blocks[len(blocks) // 2].graphnode)
print(f"{results.metadata['steps']} steps, unbalanced force {results.metadata['unbalanced']:.1e}")
print(
    f"weight {weight:.0f} N, supports carry {total[2]:.0f} N, thrust {abs(reactions[0][0]):.0f} N, crown moves by {crown[2] * 1e6:.1f} um"
)
assert abs(total[2] / weight - 1.0) < 0.01
