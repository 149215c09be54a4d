# SPDX-License-Identifier: GPL-3.0-or-later
"""Joints as surfaces: how far both sides of each have moved on each other, as a table and for ParaView."""
import os

import numpy as np

from .mass import OF_JOINT

#: Columns of joint_table(): two bodies, joint and its entry in the `joints` of slice(), lengths, area, forces.
COLUMNS = np.dtype([("id1", "i8"), ("id2", "i8"), ("joint", "i8"), ("set", "i8"), ("area", "f8"), ("opening", "f8"),
                    ("slip", "f8"), ("normal_force", "f8"), ("shear_force", "f8")])


def joint_table(mass, ids):
    """One row (COLUMNS) for each pair of faces that lay on each other on a joint when the mass was cut, and whose
    blocks are both there.

    mass, ids: as of bodies(). opening, slip: of the second block from the first, at the middle of the face, since the
    blocks were made: along the normal of the joint as its first block has carried it on, above 0 where it has opened,
    and across it. normal_force, shear_force: of the contact of the two bodies (which may have several such faces), 0
    without one.
    """
    return _rows(mass, ids)[0]


class JointRecorder:
    """Writes <name>.joints.<step>.vtp each time it is called, and the series <name>.joints.pvd: the surfaces of joints
    with the columns of joint_table().

        record = rock.JointRecorder(mass, ids, "out/slope")
        O.engines += [PyRunner(command="record()", iterPeriod=1000)]

    A surface is the smaller face of a pair, where its block is; it opens and slips with it.
    """

    def __init__(self, mass, ids, name):
        self.mass, self.ids, self.name, self.frames = mass, np.asarray(ids, int), os.fspath(name), []
        os.makedirs(os.path.dirname(self.name) or ".", exist_ok=True)

    def __call__(self):
        import yade
        from ..output import vtk_files
        table, outlines = _rows(self.mass, self.ids)
        fans = [np.stack([np.repeat(one[:1], len(one) - 2, 0), one[1:-1], one[2:]], 1) for one in outlines]
        corners = np.concatenate(fans) if fans else np.zeros((0, 3, 3))
        of = np.repeat(np.arange(len(fans)), [len(one) for one in fans])
        file = f"{self.name}.joints.{yade.O.iter:07d}.vtp"
        vtk_files.write(
            file,
            vtk_files.triangles(corners.reshape(-1, 3),
                                np.arange(3 * len(corners)).reshape(-1, 3), {}, {
                                    name: table[name][of].astype(float if table[name].dtype == float else np.int32)
                                    for name in COLUMNS.names
                                }))
        self.frames = [frame for frame in self.frames if frame[1] != os.path.basename(file)
                       ] + [(yade.O.time, os.path.basename(file))]
        vtk_files.write_index(f"{self.name}.joints.pvd", self.frames)


def _rows(mass, ids):
    """joint_table(), and the corners of each surface."""
    import yade
    owners, faces = mass.faces["block"].astype(int), mass.faces
    moves = {}

    def motion(block):
        """Rotation and shift of what belongs to a block, since it was cut; None if its body is gone."""
        if block not in moves:
            number = int(ids[block])
            body = yade.O.bodies[number] if number < len(yade.O.bodies) else None
            if body is None:
                moves[block] = None
            else:
                turn = np.array((body.state.ori * body.state.refOri.conjugate()).toRotationMatrix())
                moves[block] = turn, np.array(body.state.pos) - turn @ np.array(body.state.refPos)
        return moves[block]

    rows, outlines = [], []
    for (first, second), area in zip(mass.partners["faces"].astype(int), mass.partners["area"]):
        if faces["of"][first] != OF_JOINT:
            continue
        one, other = motion(owners[first]), motion(owners[second])
        if one is None or other is None:
            continue
        smaller = first if faces["area"][first] <= faces["area"][second] else second
        corners = mass.outline(smaller)
        middle, normal = corners.mean(0), one[0] @ faces["plane"][first, :3]
        apart = (other[0] @ middle + other[1]) - (one[0] @ middle + one[1])
        opening = apart @ normal
        id1, id2 = int(ids[owners[first]]), int(ids[owners[second]])
        contact = yade.O.interactions[id1, id2] if yade.O.interactions.has(id1, id2) else None
        forces = [
            getattr(contact.phys, name).norm() if contact is not None and contact.isReal else 0.0
            for name in ("normalForce", "shearForce")
        ]
        rows.append((id1, id2, faces["index"][first], mass.set_of_face[first], area, opening,
                     np.linalg.norm(apart - opening * normal), *forces))
        turn, shift = one if smaller == first else other
        outlines.append(corners @ turn.T + shift)
    return np.array(rows, COLUMNS), outlines
