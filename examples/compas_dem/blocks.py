# SPDX-License-Identifier: MIT OR Apache-2.0
"""The blocks of backend.py come to rest in YADE; reads the file TASK and writes the file ANSWER. Run it inside YADE:
yade -x -n -j1 blocks.py
"""
import json
import math
import os

import numpy as np
import potential_particles
from potential_particles import shapes
from potential_particles.output.patches import patches
from scipy.spatial import ConvexHull
from yade import utils

PART = 0.02  # s of the simulated time between looks whether the blocks are at rest
# Between faces at the start, as a share of the size: no contact is then one of rounding, there in one step and gone in
# the next.
GAP = 1e-7
RISE = 0.2  # s in which weight and loads come up

task = json.load(open(os.environ["TASK"]))
size = lambda corners: potential_particles.polyhedron.Polyhedron.of_points(corners).size
materials, nodes, frames = {}, {}, {}
for block in task["blocks"]:
    density = block["density"]
    if density not in materials:
        materials[density] = O.materials.append(
            ConicJointMat(density=density, normalStiffness=task["stiffness"], shearStiffness=0.5 * task["stiffness"],
                          frictionAngle=math.atan(task["friction"]), restitution=0.3))
    corners = np.array(block["vertices"])
    corners = corners.mean(0) + (1.0 - GAP) * (corners - corners.mean(0))
    shape = shapes.from_vertices(corners, rounding=task["rounding"] / size(corners), k=0)
    made = potential_particles.body(shape, O.materials[materials[density]], fixed=block["fixed"])
    nodes[O.bodies.append(made)] = block
    frames[made.id] = (Vector3(made.state.pos), Quaternion(made.state.ori))
O.engines = [
    ForceResetter(),
    InsertionSortCollider([PotentialParticle2AABB()], verletDist=0),
    ConicInteractionLoop([Ig2_ConicPP_ConicPP_ScGeom(patch=True)], [Ip2_ConicJointMat_ConicJointMat_ConicJointPhys()],
                         [Law2_ScGeomConicPP_ConicJointPhys()]),
    NewtonIntegrator(damping=0.4, exactAsphericalRot=True),
]
O.dt = potential_particles.critical_time_step()
O.step()
O.dt = potential_particles.critical_time_step()
unbalanced = math.inf
while O.time < task["longest"]:
    share = min((O.time + PART) / RISE, 1.0)
    O.engines[-1].gravity = Vector3(0, 0, -share * task["gravity"])
    for number, block in nodes.items():
        O.forces.setPermF(number, share * Vector3(*block["force"]))
        O.forces.setPermT(number, share * Vector3(*block["moment"]))
    O.run(max(int(PART / O.dt), 1), wait=True)
    O.dt = potential_particles.critical_time_step()
    unbalanced = utils.unbalancedForce(useMaxForce=True)
    if share == 1.0 and O.time > 2.0 * RISE and unbalanced <= task["rest"]:
        break


def outline_of(contact, normal):
    """Of the patch: its convex outline, without points that lie on a line with their neighbours."""
    points = patches([contact]).corners.reshape(-1, 3)
    if len(points) < 3:
        return points
    first = np.cross(normal, np.eye(3)[np.argmin(abs(normal))])
    first /= np.linalg.norm(first)
    plane = points @ np.column_stack([first, np.cross(normal, first)])
    outline = ConvexHull(plane).vertices
    before, after = (np.roll(plane[outline], turn, axis=0) - plane[outline] for turn in (1, -1))
    bend = abs(np.cross(before, after)) > 1e-2 * np.linalg.norm(before, axis=1) * np.linalg.norm(after, axis=1)
    return points[outline[bend]]


blocks = []
for number, block in nodes.items():
    (place, turn), state = frames[number], O.bodies[number].state
    rotation = state.ori * turn.conjugate()
    matrix = np.eye(4)
    matrix[:3, :3] = np.array([rotation * Vector3.Unit(i) for i in range(3)]).T
    matrix[:3, 3] = state.pos - rotation * place
    blocks.append({"node": block["node"], "matrix": matrix.tolist()})
joints = []
for contact in O.interactions:
    if not contact.isReal or not contact.phys.normalForce.norm() > 0:
        continue
    normal = Vector3(contact.geom.normal)
    rim = outline_of(contact, np.array(normal))
    # On the first block: what pushes it away from the second one.
    force = -(contact.phys.normalForce + contact.phys.shearForce)
    joints.append({
        "nodes": [nodes[contact.id1]["node"], nodes[contact.id2]["node"]], "corners": rim.tolist(),
        "point": list(contact.geom.contactPoint), "normal": list(-normal), "force": list(force)
    })
answer = {
    "blocks": blocks, "joints": joints, "friction": task["friction"], "unbalanced": unbalanced, "seconds": O.time,
    "steps": O.iter, "fastest": max(body.state.vel.norm() for body in O.bodies)
}
with open(os.environ["ANSWER"], "w") as file:
    json.dump(answer, file)
