# SPDX-License-Identifier: GPL-3.0-or-later
# Plain PotentialParticle bodies through the drop-in functor, against YADE's own functor.
import potential_particles
import yade
from harness import *

check = Checks()


def contact_of(functor_, shapes, poses):
    """Geometry and physics after two steps (in the first there is no physics yet)."""
    fresh_scene(functor_, dt=1e-12)
    for shape, (position, orientation) in zip(shapes, poses):
        add(shape, position, orientation, fixed=True, volume=1.0, inertia=Vector3(1, 1, 1))
    run(2)
    return O.interactions[0, 1]


def plain_cube():
    return plain(cube_planes(0.5, 0.1), r=0.1, k=0.2, R=0.9)


def plain_pyramid():
    return plain(pyramid_planes(0.6, 0.1), r=0.1, k=0.2, R=0.9)


cases = [
    (plain_cube, plain_cube, (Vector3(0.9, 0.1, 0.05), turned((1, 2, 3), 0.5))),
    (plain_cube, plain_cube, (Vector3(0.6, 0.7, 0.1), turned((0, 1, 3), 1.1))),
    (plain_cube, plain_pyramid, (Vector3(0.1, 0.05, 0.72), turned((1, 2, 0), 0.3))),
    (plain_pyramid, plain_pyramid, (Vector3(0.5, 0.3, 0.35), turned((3, 1, 1), 2.0))),
]
for number, (first, second, pose) in enumerate(cases):
    poses = [(Vector3.Zero, Quaternion.Identity), pose]
    theirs = contact_of(yade.Ig2_PP_PP_ScGeom(accuracyTol=1e-9, areaStep=1), [first(), second()], poses)
    # Only what is compared: the scene, and with it the interaction, is made anew for ours.
    normal, point, depth = theirs.geom.normal, theirs.geom.contactPoint, theirs.geom.penetrationDepth
    on1, on2, area = theirs.phys.ptOnP1, theirs.phys.ptOnP2, theirs.phys.contactArea
    check.true(depth > 0.001, f"case {number}: they overlap by {depth}")
    ours = contact_of(yade.Ig2_PP_PP_ScGeom_Conic(areaStep=1), [first(), second()], poses)
    check.close(ours.geom.contactPoint, point, 1e-5, f"case {number}: contact point")
    check.close(ours.geom.normal, normal, 1e-4, f"case {number}: normal")
    check.close(ours.geom.penetrationDepth, depth, 1e-5, f"case {number}: overlap")
    check.close(ours.phys.ptOnP1, on1, 1e-4, f"case {number}: point on body 1")
    check.close(ours.phys.ptOnP2, on2, 1e-4, f"case {number}: point on body 2")
    check.close(ours.phys.contactArea / area, 1, 0.01, f"case {number}: contact area (theirs is a polygon)")

# Prescribed normals of boundaries, on either body.
for fixed in (0, 1):
    outward = Vector3(0, 0.6, 0.8) * (1 if fixed == 0 else -1)
    shapes = lambda: [plain(cube_planes(0.5, 0.1), r=0.1, k=0.2, R=0.9, isBoundary=(i == fixed),
                            fixedNormal=(i == fixed), boundaryNormal=outward) for i in (0, 1)]
    poses = [(Vector3.Zero, Quaternion.Identity), (Vector3(0.1, 0.2, 0.9), turned((1, 2, 3), 0.1))]
    theirs = contact_of(yade.Ig2_PP_PP_ScGeom(accuracyTol=1e-9, calContactArea=False), shapes(), poses)
    normal, depth = theirs.geom.normal, theirs.geom.penetrationDepth
    ours = contact_of(yade.Ig2_PP_PP_ScGeom_Conic(calContactArea=False), shapes(), poses)
    check.close(ours.geom.normal, Vector3(0, 0.6, 0.8), 1e-12, f"prescribed normal, body {fixed}")
    check.close(ours.geom.normal, normal, 1e-9, f"prescribed normal, body {fixed}, as the built-in has it")
    check.close(ours.geom.penetrationDepth, depth, 1e-5, f"overlap along a prescribed normal, body {fixed}")
    check.equal((ours.phys.contactArea, ours.phys.jointLength), (1.0, 1.0), "area when none is computed")

# Two boundaries never touch.
walls = [plain(cube_planes(), r=0.05, k=0.05, R=0.9, isBoundary=True) for _ in (0, 1)]
both = contact_of(yade.Ig2_PP_PP_ScGeom_Conic(), walls,
                  [(Vector3.Zero, Quaternion.Identity), (Vector3(0.9, 0, 0), Quaternion.Identity)])
check.true(not both.isReal and both.geom is None, "no contact between two boundaries")
check.equal(functor().calls, 0, "nor a call")

# Two dimensions: a length times a width.
poses = [(Vector3.Zero, Quaternion.Identity), (Vector3(0.1, 0.0, 0.9), Quaternion.Identity)]
flat = dict(twoDimension=True, unitWidth2D=2.0)
theirs = contact_of(yade.Ig2_PP_PP_ScGeom(accuracyTol=1e-9, **flat), [plain_cube(), plain_cube()], poses)
area = theirs.phys.contactArea
ours = contact_of(yade.Ig2_PP_PP_ScGeom_Conic(**flat), [plain_cube(), plain_cube()], poses)
check.close(ours.phys.contactArea, area, 1e-4, "two-dimensional contact area")
check.close(ours.phys.jointLength * 2.0, ours.phys.contactArea, 1e-12, "joint length times width")

# Plain shapes that change are noticed, and ours mix with them.
fresh_scene(yade.Ig2_PP_PP_ScGeom_Conic(), dt=1e-12)
add(plain_cube(), Vector3(0, 0, 0), fixed=True, volume=1.0, inertia=Vector3(1, 1, 1))
add(cube(0.1, 0.2, 0.9), Vector3(0, 0, 0.9), fixed=True)
O.step()
before = O.interactions[0, 1].geom.penetrationDepth
O.bodies[0].shape.d = [d + 0.02 for d in O.bodies[0].shape.d]
O.step()
check.close(O.interactions[0, 1].geom.penetrationDepth - before, 0.02, 2e-3, "overlap after a plain shape grew")
O.bodies[0].shape.r = -1.0
run(3)
report = functor().failureReport
check.equal((functor().failures, len(report)), (3, 1), "invalid plain shape: counted each time, reported once")
check.true(report and "first body" in report[0]["message"], f"named in the report: {report}")
check.true(potential_particles._glue.stored_particles() >= 1, "plain particles are kept")

check.finish()
