# SPDX-License-Identifier: GPL-3.0-or-later
# Walls, and single facets with their edges and vertices, against potential particles: closed forms.
import potential_particles
import yade
from mixed import *
from potential_particles import boundaries

check = Checks()
TURN = turned((1, 2, 3), 0.7)
YOUNG = 1e7


def contact_of(first, second, physics=None, steps=1):
    """Contacts of two bodies appended by these callables."""
    mixed_scene(dt=1e-12, physics=physics, young=YOUNG)
    first(), second()
    run(steps)
    return touching()


def both_orders(boundary, particle, overlap, normal, text, point=None, radius=None, tolerance=1e-9):
    """`normal`: from the boundary to the particle."""
    for first, second in (boundary, particle), (particle, boundary):
        found = contact_of(first, second)
        check.equal((len(found), failures()), (1, 0), f"{text}: contacts and failures")
        if len(found) != 1:
            continue
        contact = found[0]
        # The functor is of (boundary, particle), so YADE has the boundary as body 1 whoever was there first.
        check.true(not isinstance(O.bodies[contact.id1].shape, yade.PotentialParticle),
                   f"{text}: the boundary is body 1")
        check.close(contact.geom.penetrationDepth, overlap, tolerance, f"{text}: overlap")
        check.close(contact.geom.normal, normal, tolerance, f"{text}: normal")
        if point is not None:
            check.close(contact.geom.contactPoint, point, tolerance, f"{text}: point")
        if radius is not None:
            # Two bodies of one material and radius: kn = E R, R the bounding radius, which rounding leaves a little
            # larger.
            bounding = O.bodies[contact.id2].shape.boundingRadius
            check.true(0 <= bounding - radius <= 2e-5 * radius, f"{text}: bounding radius {bounding}")
            force = YOUNG * bounding * overlap
            check.close(O.forces.f(contact.id2), normal * force, 1e-6 * force, f"{text}: force on the particle")
            check.close(O.forces.f(contact.id1), normal * -force, 1e-6 * force, f"{text}: force on the boundary")


def wall(axis, at, sense=0):
    return lambda: place(yade.Wall(axis=axis, sense=sense), at, TURN)


def rock(shape, at, turn=Quaternion.Identity):
    return lambda: add(shape(), at, turn, volume=1.0, inertia=Vector3(1, 1, 1))


def axis_vector(axis, length):
    return Vector3(*(length if i == axis else 0 for i in range(3)))


# --- walls ----------------------------------------------------------------------------------
for axis in range(3):
    for side in 1, -1:
        for far in Vector3.Zero, Vector3(1e5, -3e5, 2e5):
            out = axis_vector(axis, side)
            centre = far + Vector3(0.3, -0.2, 0.1)
            at = centre - axis_vector(axis, side * 0.47)
            off = at + Vector3(5, 6, 7) - axis_vector(axis, (5, 6, 7)[axis])  # anywhere in the plane
            for sense in 0, side:
                both_orders(wall(axis, off, sense), rock(lambda: ball(0.5), centre,
                                                         TURN), 0.03, out, f"ball on wall {axis}, {side}", at + out *
                            (-0.015), 0.5, 1e-10 if far != Vector3.Zero else 1e-14)
    # Behind a wall that pushes to one side only, the overlap is as deep as the particle reaches.
    both_orders(wall(axis, Vector3.Zero, 1), rock(lambda: ball(0.5), axis_vector(axis, -0.2)), 0.7,
                axis_vector(axis, 1), "behind the wall")
check.equal(contact_of(wall(2, Vector3.Zero, 1), rock(lambda: ball(0.5), Vector3(0, 0, -0.51))), [],
            "wholly behind the wall")
check.equal(contact_of(wall(2, Vector3.Zero), rock(lambda: ball(0.5), Vector3(0, 0, 0.500001))), [],
            "just off the wall")
check.equal(contact_of(wall(2, Vector3.Zero), rock(lambda: ball(0.5, isBoundary=True), Vector3(0, 0, 0.4))), [],
            "two boundaries")

# A cube whose corner points down reaches (half - r) sqrt 3 + r; one with an edge or a face down as much less.
half, r = 0.5, 0.01
on_corner = Quaternion.Identity
on_corner.setFromTwoVectors(Vector3(1, 1, 1).normalized(), Vector3(0, 0, -1))
on_edge = Quaternion.Identity
on_edge.setFromTwoVectors(Vector3(0, 1, 1).normalized(), Vector3(0, 0, -1))
for k in 0.0, 1e-12:
    for turn, reach in (Quaternion.Identity,
                        half), (on_edge, (half - r) * math.sqrt(2) + r), (on_corner, (half - r) * math.sqrt(3) + r):
        both_orders(wall(2, Vector3.Zero), rock(lambda: sharp_cube(half, r, k), Vector3(0.2, 0.1, reach - 1e-3), turn),
                    1e-3, Vector3(0, 0, 1), f"a cube that reaches {reach:.3f}", tolerance=1e-8)

# A wall moves with its body.
mixed_scene(dt=1e-3)
place(yade.Wall(axis=2), Vector3(0, 0, -1))
add(ball(0.5), Vector3(0, 0, 0.1), fixed=True)
O.bodies[0].state.vel = Vector3(0, 0, 1)
run(400)
check.equal(touching(), [], "the wall is still below")
run(300)
# The contact was found before the wall moved on in this step.
check.close(touching()[0].geom.penetrationDepth, O.bodies[0].state.pos[2] - 1e-3 + 0.4, 1e-9, "and now it overlaps")

# KnKsPhys: the section of the particle, and points on both.
found, = contact_of(wall(2, Vector3.Zero), rock(lambda: ball(0.5), Vector3(1, 2, 0.4), TURN), area_physics(), 2)
check.close(found.phys.contactArea, math.pi * (0.25 - 0.45**2), 1e-9, "section of a ball")
check.close(found.phys.ptOnP1, Vector3(1, 2, 0), 1e-12, "point on the wall")
check.close(found.phys.ptOnP2, Vector3(1, 2, -0.1), 1e-12, "point on the particle")
check.close(O.forces.f(1)[2], 1e7 * found.phys.contactArea * 0.1, 1e-3, "force = stiffness x area x overlap")
found, = contact_of(wall(2, Vector3.Zero), rock(lambda: sharp_cube(half, r), Vector3(1, 2, 0.49), turned((0, 0, 1),
                                                                                                         0.4)),
                    area_physics(), 2)
check.close(found.phys.contactArea, 4 * (half - r)**2 + 8 * (half - r) * math.sqrt(r * r - 25e-6) + math.pi *
            (r * r - 25e-6), 1e-3, "section of a cube")

# --- one facet ------------------------------------------------------------------------------
corners = [Vector3(0, 0, 0), Vector3(2, 0, 0), Vector3(0, 2, 0)]
for turn in Quaternion.Identity, TURN:
    for shift in Vector3.Zero, Vector3(-1e3, 2e3, 1e3):
        facet = lambda: facets([[shift + turn * v for v in corners]])
        tolerance = 1e-12 if shift == Vector3.Zero else 2e-12 * 1e3
        for nearest, out, text in [(Vector3(0.5, 0.5, 0), (0, 0, 1), "front"), (Vector3(0.5, 0.5,
                                                                                        0), (0, 0, -1), "back"),
                                   (Vector3(0.7, 0, 0), (0, -1, 0), "edge"),
                                   (Vector3(0.7, 0, 0), (0, -1, 2), "edge, obliquely"),
                                   (Vector3(1, 1, 0), (1, 1, 0.5), "long edge"),
                                   (Vector3(2, 0, 0), (1, -0.2, 0.3), "vertex"),
                                   (Vector3(0, 0, 0), (-1, -1, -1), "vertex of the right angle")]:
            out = turn * Vector3(out).normalized()
            centre = shift + turn * nearest + out * 0.27
            both_orders(facet, rock(lambda: ball(0.3), centre, TURN), 0.03, out, f"ball on a facet: {text}",
                        centre - out * 0.285, 0.3, tolerance)
        gone = shift + turn * (Vector3(0.7, -0.3001, 0))
        check.equal(contact_of(facet, rock(lambda: ball(0.3), gone)), [], "just off an edge")

# The edge of a plate in the middle of a face of a cube, less deep than the cube is rounded.
both_orders(lambda: facets([[(0, -5, 0), (0, 5, 0), (9, 0, 0)]]),
            rock(lambda: sharp_cube(half, r), Vector3(-0.495, 0, 0.1)), 0.005, Vector3(-1, 0, 0), "an edge in a face",
            tolerance=1e-9)

# Walls that turn in the place where they stand: with BoundWatch the collider sees them.
def first_contact(paddle, verlet, watch):
    """The step in which a paddle that turns about its centre meets a ball, of 1,000 at most."""
    mixed_scene(dt=1e-3, verlet=verlet)
    body = O.bodies[paddle()]
    body.state.angVel = Vector3(0, 0, 2)
    add(ball(0.1), body.state.pos + turned((0, 0, 1), 1.2) * Vector3(1.5, 0, 0), fixed=True)
    # A body that moves a little: the collider of a scene at rest runs in each step.
    O.bodies[add(ball(0.1), Vector3(50, 0, 0))].state.vel = Vector3(1e-6, 0, 0)
    if watch:
        O.engines = O.engines[:1] + [yade.BoundWatch()] + O.engines[1:]
    while O.iter < 1000 and not touching():
        run(1)
    return O.iter


for paddle, text in (lambda: facets([[(-2, -0.1, -1), (2, 0, -1), (-2, 0.1, 2)]])[0], "facet"), \
        (lambda: place(yade.Box(extents=Vector3(2, 0.05, 0.5)), Vector3.Zero), "box"):
    expected = first_contact(paddle, 0.0, False)
    check.true(100 < expected < 900, f"a {text} that turns meets the ball in step {expected}")
    check.equal(first_contact(paddle, 0.3, True), expected, f"a {text} that turns, with a collider that rests")

# What cannot be solved is a failure, not an absence: a facet whose vertices lie on a line.
mixed_scene(dt=1e-12)
facets([corners])
add(ball(0.3), Vector3(0.5, 0.5, 0.27))
run(1)
overlap = touching()[0].geom.penetrationDepth
O.bodies[0].shape.vertices = [Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(2, 0, 0)]
run(1)
check.equal(failures(), 1, "a facet without area is counted as a failure")
check.equal([c.geom.penetrationDepth for c in touching()], [overlap], "and the contact is kept")
report, = O.engines[2].geomDispatcher.functors[4].failureReport
check.true("triangle" in report["message"] and report["id1"] == 0, f"with a sentence: {report['message']}")


# Loops that would not end.
for name, make, words in [
    ("facets", lambda: boundaries.box_walls((0, 0, 0), (1, 1, 1), facets=10**12), "facets=1000000000000"),
    ("a narrow plate", lambda: boundaries.plate((0, 0, 0), (1, 0, 0), (0, 1e-30, 0), facets=10), "so long and narrow"),
    ("sides", lambda: boundaries.funnel(1, 2, 1, sides=10**12), "sides=1000000000000"),
]:
    check.raises(ValueError, make, name, words)
check.finish()
