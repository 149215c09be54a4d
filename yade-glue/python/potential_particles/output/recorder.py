# SPDX-License-Identifier: GPL-3.0-or-later
"""Frames of the scene for ParaView, while it runs."""
import os
import sys

import numpy as np
import yade

from ..bodies import into_cell
from ..measures import body_stresses
from . import chains, vtk_files
from .drawn import ShapeMeshes, Triangles, drawn
from .patches import Patches, patches
from .values import generations

_BODY = {"id": 1, "material": 1, "mask": 1, "rank": 1, "generation": 1, "velocity": 3, "angular_velocity": 3,
         "colour": 3, "stress": 9}
_CONTACT = {"point": 3, "normal": 3, "overlap": 1, "normal_force": 3, "shear_force": 3, "id1": 1, "id2": 1,
            "begin": 3, "end": 3}
_WHOLE = {"id", "material", "mask", "rank", "generation", "id1", "id2"}


class Recorder:
    """Writes a frame each time it is called, of bodies of all shapes that `plot` draws, and of contacts.

        record = Recorder("out/pile")
        O.engines += [PyRunner(command="record()", iterPeriod=1000)]

    name: path without an ending; its folder is made. Each frame is <name>.bodies.<step>.vtp and
    <name>.contacts.<step>.vtp, and the series <name>.bodies.pvd and <name>.contacts.pvd, which ParaView opens, grow
    with it. Each file appears under its name when it is whole, so that a run may be interrupted at any time. Bodies are
    triangles, with id, material (its id, or -1), mask, rank, generation (how often what it was part of has broken),
    velocity, angular_velocity (world axes), colour and stress (body_stresses, Pa, the rows of a 3 x 3 matrix; 0 for
    what does not move) of their body.
    Contacts are the points of real interactions, with normal (from body id1 to id2), overlap, normal_force and
    shear_force (world axes, on body id2), id1 and id2; forces are 0 for physics without them. With patch=True the point
    is the centre of pressure. <name>.chains.<step>.vtp has the same contacts as lines between the centres of their
    bodies, from wall to centre at walls: force chains (in ParaView: Tube, by `push`, the normal force, above 0 where
    bodies push). Where a contact functor has patch=True there is <name>.patches.<step>.vtp, too, with its series: the
    contact patches and bonds as triangles with pressure (Pa, at their corners), id1 and id2. In a periodic cell all is
    drawn where the centres of the bodies lie in the cell, and <name>.cell.<step>.vtp has its edges.
    tolerance: of the meshes of particles (see `mesh`). ids: of the bodies that are wanted; without them, all.
    On several ranks (potential_particles.mpi) it is to be called by all of them, between two calls of mpi.run; rank 0
    writes.
    """

    def __init__(self, name, tolerance=0.02, ids=None):
        self.name, self.ids = os.fspath(name), ids
        self.meshes = ShapeMeshes(tolerance)
        self.frames = {"bodies": [], "contacts": [], "chains": [], "patches": [], "cell": []}
        os.makedirs(os.path.dirname(self.name) or ".", exist_ok=True)

    def __call__(self):
        rank, bodies, contacts, gather = _here()
        if self.ids is not None:
            chosen = set(self.ids)
            bodies = [body for body in bodies if body.id in chosen]
        wanted = _with_patches()
        rows = _rows(bodies, (rank, generations(), body_stresses()), _body, _BODY)
        parts = gather((Triangles.together(drawn(bodies, self.meshes)), rows,
                        _rows(contacts, rank, _contact, _CONTACT), patches(contacts if wanted else [])))
        if rank:
            return
        triangles = Triangles.together([part[0] for part in parts])
        of_bodies, of_contacts = (np.concatenate([part[i] for part in parts]) for i in (1, 2))
        self._write("bodies", self._bodies(triangles, _columns(of_bodies, _BODY)))
        columns = _columns(of_contacts, _CONTACT)
        if yade.O.periodic:
            self._write("cell", vtk_files.lines(_cell_edges()))
        self._write("chains", chains.lines(columns))
        if wanted:
            first = np.cumsum([0] + [len(part[2]) for part in parts])
            self._write("patches", self._patches([Patches(part[3].corners, part[3].pressure, part[3].contacts + begin)
                                                  for part, begin in zip(parts, first)], columns))
        del columns["begin"], columns["end"]
        self._write("contacts", vtk_files.vertices(columns.pop("point"), columns))

    @staticmethod
    def _bodies(triangles, columns):
        order = np.argsort(columns["id"])
        row = order[np.searchsorted(columns["id"], triangles.bodies, sorter=order)]
        count = len(triangles.bodies)
        points = triangles.corners.reshape(-1, 3).astype(np.float32)
        normals = triangles.normals.reshape(-1, 3).astype(np.float32)
        cells = {name: column[row] for name, column in columns.items()}
        return vtk_files.triangles(points,
                                   np.arange(3 * count).reshape(-1, 3), {"normal": normals}, cells, normals="normal")

    @staticmethod
    def _patches(parts, columns):
        made = Patches.together(parts)
        count = len(made.corners)
        return vtk_files.triangles(made.corners.reshape(-1, 3),
                                   np.arange(3 * count).reshape(-1, 3), {"pressure": made.pressure.ravel()},
                                   {name: columns[name][made.contacts]
                                    for name in ("id1", "id2")})

    def _write(self, kind, data):
        step = yade.O.iter
        file = f"{self.name}.{kind}.{step:07d}.vtp"
        vtk_files.write(file, data)
        # A step that is written again, after O.load, takes the place of the first.
        frames = [frame for frame in self.frames[kind] if frame[1] != os.path.basename(file)]
        self.frames[kind] = frames + [(yade.O.time, os.path.basename(file))]
        vtk_files.write_index(f"{self.name}.{kind}.pvd", self.frames[kind])


def _here():
    """Number of this rank, its bodies and contacts, and a function that brings what all ranks have to rank 0."""
    mpi = sys.modules.get("potential_particles.mpi")
    if mpi is not None and mpi.ranks() > 1:
        return mpi.rank(), mpi.owned_bodies(), mpi.owned_contacts(), mpi.gather
    contacts = [contact for contact in yade.O.interactions if contact.isReal]
    return 0, [body for body in yade.O.bodies if body is not None], contacts, lambda value: [value]


def _cell_edges():
    """The twelve edges of the periodic cell, (12, 2, 3)."""
    sides = np.array([[yade.O.cell.hSize[i, j] for i in range(3)] for j in range(3)])
    corners = np.array([(i, j, k) for i in (0, 1) for j in (0, 1) for k in (0, 1)])
    pairs = [(one, other) for one in corners for other in corners if (other - one).sum() == 1
             and (other - one).min() >= 0]
    return np.array(pairs) @ sides


def _with_patches():
    """Whether a contact functor of the scene finds patches."""
    return any(getattr(functor, "patch", False) for engine in yade.O.engines if hasattr(engine, "geomDispatcher")
               for functor in engine.geomDispatcher.functors)


def _body(body, of):
    rank, generation, stresses = of
    material = body.material.id if body.material is not None else -1
    colour = body.shape.color if body.shape is not None else (1, 1, 1)
    stress = stresses.get(body.id)
    rows = [0.0] * 9 if stress is None else [stress[i, j] for i in range(3) for j in range(3)]
    return (body.id, material, body.mask, rank, generation.get(body.id, 0), *body.state.vel, *body.state.angVel,
            *colour, *rows)


def _contact(contact, rank):
    geometry, physics = contact.geom, contact.phys
    begin, end = chains.branch(contact)
    forces = [getattr(physics, name, (0.0, 0.0, 0.0)) for name in ("normalForce", "shearForce")]
    point = geometry.contactPoint + into_cell(yade.O.bodies[contact.id1])  # as body 1 is drawn
    return (*point, *geometry.normal, geometry.penetrationDepth, *forces[0], *forces[1], contact.id1,
            contact.id2, *begin, *end)


def _rows(things, rank, row, layout):
    return np.array([row(thing, rank) for thing in things], float).reshape(-1, sum(layout.values()))


def _columns(rows, layout):
    """Columns of rows by name, (n,) or (n, 3)."""
    columns, first = {}, 0
    for name, width in layout.items():
        column = rows[:, first] if width == 1 else rows[:, first:first + width]
        columns[name] = column.astype(np.int32 if name in _WHOLE else float)
        first += width
    return columns
