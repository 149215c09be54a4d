# SPDX-License-Identifier: GPL-3.0-or-later
# Contacts across the border of a periodic cell.
import potential_particles
import yade
from harness import *

check = Checks()


def across(functor_, positions, size=4.0):
    fresh_scene(functor_, dt=1e-7, periodic=True)
    O.cell.setBox(Vector3(size, size, size))
    for position in positions:
        add(cube(), position, turned((0, 0, 1), 0.1 * len(O.bodies)))
    run(3)
    return [c for c in O.interactions if c.isReal]


# The same two cubes: once side by side, once through the border.
inside = across(yade.Ig2_ConicPP_ConicPP_ScGeom(), [Vector3(1.5, 2, 2), Vector3(2.49, 2.05, 2)])
check.equal(len(inside), 1, "one contact inside")
geom = inside[0].geom
direct = (
    geom.normal,
    geom.penetrationDepth,
    geom.contactPoint - O.bodies[inside[0].id1].state.pos,
    inside[0].phys.contactArea,
)
forces = [O.forces.f(0), O.forces.f(1)]
check.true(forces[0].norm() > 1, "a force acts inside")
check.close(forces[0], -forces[1], 1e-9 * forces[0].norm(), "equal and opposite inside")

through = across(yade.Ig2_ConicPP_ConicPP_ScGeom(), [Vector3(3.5, 2, 2), Vector3(0.49, 2.05, 2)])
check.equal(len(through), 1, "one contact through the border")
contact = through[0]
check.true(contact.cellDist != (0, 0, 0), f"through the border: {contact.cellDist}")
first, second = O.bodies[contact.id1].state, O.bodies[contact.id2].state
sense = 1 if contact.id1 == 0 else -1
check.close(contact.geom.normal, sense * direct[0], 1e-6, "normal through the border")
check.close(contact.geom.penetrationDepth, direct[1], 1e-7, "overlap through the border")
if contact.id1 == 0:
    check.close(contact.geom.contactPoint - first.pos, direct[2], 1e-5, "contact point lies in the image of body 1")
check.close(contact.phys.contactArea, direct[3], 1e-4, "contact area through the border")
on0, on1 = O.forces.f(0), O.forces.f(1)
check.true(on0.norm() > 1, f"a force acts: {on0}")
check.close(on0, -on1, 1e-9 * on0.norm(), "equal and opposite through the border")
check.close(on0, forces[0], 1e-3 * forces[0].norm(), "the same force as inside")
check.equal(functor().failures, 0, "failures")

# Through createInteraction, which computes the shift by itself (of the second body, and only
# towards lower coordinates: it rounds towards zero).
fresh_scene(yade.Ig2_ConicPP_ConicPP_ScGeom(), dt=1e-7, periodic=True)
O.cell.setBox(Vector3(4, 4, 4))
for position in (Vector3(3.5, 2, 2), Vector3(0.49, 2.05, 2)):
    add(cube(), position, turned((0, 0, 1), 0.1 * len(O.bodies)))
forced = utils.createInteraction(1, 0)
check.close(forced.geom.penetrationDepth, direct[1], 1e-7, "forced through the border")


# A sheared cell that goes on shearing: the image of the second body is moved along, and its speed with it.
def sheared(kind, first, second):
    fresh_scene(kind(), dt=1e-7, periodic=True, friction=0.5)
    O.cell.hSize = yade.Matrix3(4, 0.5, 0, 0, 4, 0, 0, 0, 4)
    O.cell.velGrad = yade.Matrix3(0, 0.3, 0, 0, 0, 0, 0, 0, 0)
    for position in (first, second):
        shape = plain(cube_planes(0.5, 0.1), r=0.1, k=0.2, R=0.9)
        add(shape, position, turned((1, 2, 3), 0.1 * len(O.bodies)), volume=1.0, inertia=Vector3(1, 1, 1) / 6)
    run(3)
    contact = O.interactions[0, 1]
    geom, phys = contact.geom, contact.phys
    return dict(normal=geom.normal, overlap=geom.penetrationDepth, slip=geom.shearInc, area=phys.contactArea,
                force=phys.normalForce, friction=phys.shearForce, cell=contact.cellDist,
                point=geom.contactPoint - O.bodies[0].state.pos)


# The cell is 4 high and leans by 0.5: the second body's image at its foot is that of the one at its top.
across = Vector3(1.7, 0.45, 2), Vector3(2.2, 3.55, 2.05)
beside = Vector3(1.7, 1.45, 2), Vector3(1.7, 0.55, 2.05)
mine, theirs = (sheared(kind, *across) for kind in (yade.Ig2_PP_PP_ScGeom_Conic, yade.Ig2_PP_PP_ScGeom))
direct = sheared(yade.Ig2_PP_PP_ScGeom_Conic, *beside)
check.equal((mine["cell"], direct["cell"]), ((0, -1, 0), (0, 0, 0)),
            "once through the border of a sheared cell, once not")
for key, tolerance in dict(normal=1e-6, overlap=1e-6, point=1e-6, force=1e-6 * direct["force"].norm()).items():
    check.close(mine[key], direct[key], tolerance, f"sheared cell: {key} through the border and beside")
for key, tolerance in dict(normal=1e-4, overlap=1e-6, point=1e-4, area=0.01, slip=1e-3 * theirs["slip"].norm(),
                           force=0.01 * theirs["force"].norm(), friction=0.01 * theirs["friction"].norm()).items():
    check.close(mine[key], theirs[key], tolerance, f"sheared cell: {key}, as the built-in has it")
# The cell takes its bodies along: 0.3 / s over the 0.9 between the centres.
check.close(mine["slip"][0] / (-0.3 * 0.9 * 1e-7), 1, 0.01, "sheared cell: slip in a step")

check.finish()
