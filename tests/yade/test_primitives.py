# SPDX-License-Identifier: GPL-3.0-or-later
# Spheres and boxes of YADE against potential particles: closed forms, either order of the bodies, either loop.
import potential_particles
import yade
from mixed import *

check = Checks()
TURN = turned((1, 2, 3), 0.7)


def pair(first, second, **scene):
    """The one contact of two bodies (callables that append them) in the order given; None if they do not touch."""
    mixed_scene(dt=1e-12, **scene)
    ids = [first(), second()]
    found = look()
    check.equal(failures(), 0, "no failure")
    check.true(len(found) <= 1, f"{len(found)} contacts of one pair")
    return (found[0], ids) if found else (None, ids)


def both_orders(one, other, overlap, normal, text, point=None, tolerance=1e-9, **scene):
    """`normal`: from one to other."""
    for first, second in (one, other), (other, one):
        contact, ids = pair(first, second, **scene)
        if not check.true(contact is not None, f"{text}: in contact"):
            continue
        sense = 1 if contact.id1 == ids[0 if first is one else 1] else -1
        check.close(contact.geom.penetrationDepth, overlap, tolerance, f"{text}: overlap")
        check.close(contact.geom.normal * sense, normal, max(tolerance, 1e-9), f"{text}: normal from body 1 to body 2")
        if point is not None:
            check.close(contact.geom.contactPoint, point, 1e-8, f"{text}: point")
        force = O.forces.f(ids[0]) + O.forces.f(ids[1])
        check.close(force, Vector3.Zero, 1e-9 * O.forces.f(ids[0]).norm(), f"{text}: action and reaction")
        check.true(O.forces.f(contact.id2).dot(contact.geom.normal) > 0, f"{text}: body 2 is pushed along the normal")


def sphere(radius, at):
    return lambda: place(yade.Sphere(radius=radius), at, TURN)


def particle(shape, at, turn=Quaternion.Identity, plain_shape=None):
    return lambda: add(plain_shape() if plain_shape else shape(), at, turn, volume=1.0, inertia=Vector3(1, 1, 1))


# --- spheres --------------------------------------------------------------------------------
for loop in yade.InteractionLoop, yade.ConicInteractionLoop:
    for far in Vector3.Zero, Vector3(1e4, -2e4, 3e4):
        away = Vector3(0.6, -0.5, 0.4) * (1.65 / Vector3(0.6, -0.5, 0.4).norm())
        both_orders(sphere(1.0, far), particle(lambda: ball(0.7), far + away,
                                               TURN), 0.05, away.normalized(), f"two balls, {loop.__name__}",
                    far + away / 1.7, tolerance=1e-11 if far == Vector3.Zero else 1e-10, loop=loop)
contact, _ = pair(sphere(1.0, Vector3.Zero), particle(lambda: ball(0.7), Vector3(1.70001, 0, 0)))
check.true(contact is None, "balls that are just apart do not touch")

# A cube of half size 0.5 whose edges are rounded by r: the core has half size 0.5 - r.
R, r = 0.4, 1e-3
for turn in Quaternion.Identity, TURN:
    for k, text in (0.0, "k = 0"), (1e-12, "k > 0"):
        cube_ = particle(lambda: sharp_cube(0.5, r, k), Vector3.Zero, turn)
        for corner, name in (Vector3(0.5, 0.1, 0.2), "face"), (Vector3(0.5 - r, 0.5 - r, 0.2), "edge"), \
                (Vector3(0.5 - r, 0.5 - r, 0.5 - r), "corner"):
            # From the nearest point of the core (or face) outwards, so far that the overlap is 0.01.
            out = Vector3(1, 0, 0) if name == "face" else Vector3(1, 1, 0) if name == "edge" else Vector3(1, 1, 1)
            reach = R - 0.01 if name == "face" else R + r - 0.01
            centre = corner + out.normalized() * reach
            both_orders(cube_, sphere(R, turn * centre), 0.01, turn * out.normalized(), f"sphere on the {name}, {text}",
                        tolerance=2e-9)
both_orders(
    particle(
        None, Vector3.Zero, plain_shape=lambda: plain(cube_planes(0.5, r), r=r, k=0.0, R=1.0, AabbMinMax=True,
                                                      minAabbRotated=(0.5, ) * 3, maxAabbRotated=(0.5, ) * 3)),
    sphere(R, Vector3(0, 0, 0.89)), 0.01, Vector3(0, 0, 1), "YADE's own PotentialParticle")

# KnKsPhys: the area of the lens is that of its circle, and the points lie on both surfaces.
mixed_scene(physics=area_physics(), dt=1e-12)
place(yade.Sphere(radius=1.0), Vector3.Zero)
add(ball(0.7), Vector3(0, 0, 1.6))
run(2)
found, = touching()
half_way = 1.6 / 1.7
check.close(found.phys.contactArea, math.pi * min(1 - half_way**2, 0.49 - (1.6 - half_way)**2), 1e-9,
            "area of two balls")
check.close(found.phys.ptOnP1, Vector3(0, 0, 1), 1e-9, "point on the sphere")
check.close(found.phys.ptOnP2, Vector3(0, 0, 0.9), 1e-9, "point on the particle")
check.close(O.forces.f(1)[2], 1e7 * found.phys.contactArea * 0.1, 1e-3, "force = stiffness x area x overlap")

# A sphere that changes its size is another particle; one of no size is a failure, not an absence.
O.bodies[0].shape.radius = 1.05
run(1)
check.close(touching()[0].geom.penetrationDepth, 0.15, 1e-9, "a sphere that grew")
O.bodies[0].shape.radius = -1.0
O.engines[1].dead = True  # the collider would take the two apart
before = failures()
run(1)
check.true(failures() == before + 1 and abs(touching()[0].geom.penetrationDepth - 0.15) < 1e-9,
           "a sphere without size is counted as a failure, and the contact is kept")

# Across the border of a periodic cell.
for order in 0, 1:
    mixed_scene(dt=1e-12, periodic=True)
    O.cell.hSize = Matrix3(5, 0, 0, 0, 5, 0, 0, 0, 5)
    makers = [lambda: place(yade.Sphere(radius=0.5), Vector3(0.2, 1, 1)), lambda: add(ball(0.5), Vector3(4.3, 1, 1))]
    for make in makers[::-1] if order else makers:
        make()
    found = look()
    check.equal(len(found), 1, "one contact across the border")
    check.close(found[0].geom.penetrationDepth, 0.1, 1e-12, "its overlap")
    of_sphere = isinstance(O.bodies[found[0].id1].shape, yade.Sphere)
    check.close(found[0].geom.normal, Vector3(-1 if of_sphere else 1, 0, 0), 1e-12, "its normal")

# --- cylinders ------------------------------------------------------------------------------
SEGMENT, ROD = Vector3(0.3, -1.2, 0.8), 0.25
AXIS = SEGMENT.normalized()
ACROSS = AXIS.cross(Vector3(0.2, 0.1, 0.9)).normalized()


def rod(at, turn=Quaternion.Identity):
    return lambda: place(yade.Cylinder(radius=ROD, length=SEGMENT.norm(), segment=SEGMENT), at, turn)


# Nearest point of the segment, and the way from there to the centre of a ball: on its side, at its ends and beyond
# them.
for loop in yade.InteractionLoop, yade.ConicInteractionLoop:
    for turn in Quaternion.Identity, TURN:
        for nearest, out, name in ((SEGMENT * 0.3, ACROSS, "side"), (Vector3.Zero, ACROSS, "side at an end"),
                                   (SEGMENT, (AXIS + ACROSS).normalized(), "end"), (Vector3.Zero, -AXIS, "tip")):
            both_orders(rod(Vector3(1, 2, 3), turn),
                        particle(lambda: ball(0.7),
                                 Vector3(1, 2, 3) + turn * (nearest + out * 0.9)), 0.05, turn * out,
                        f"ball on the {name} of a cylinder",
                        Vector3(1, 2, 3) + turn * (nearest + out * (0.9 * ROD / 0.95)), loop=loop)
contact, _ = pair(rod(Vector3.Zero), particle(lambda: ball(0.7), SEGMENT + AXIS * 0.95001))
check.true(contact is None, "a ball just beyond the end")
# The nearest points of two segments that cross are known: a particle of the same kind, whose planes are given here.
other = yade.ConicPotentialParticle(
    planes=[(1, 0, 0, 2), (-1, 0, 0, 2), (0, 1, 0, 0), (0, -1, 0, 0), (0, 0, 1, 0), (0, 0, -1, 0)], r=0.5, k=0.0)
across_both = AXIS.cross(Vector3(1, 0, 0)).normalized()
both_orders(rod(-0.4 * SEGMENT), particle(lambda: other, across_both * 0.7), 0.05, across_both, "two rods that cross",
            across_both * (0.7 * ROD / 0.75))
# YADE's Cylinder derives from Sphere: in one scene each pair finds its own functor.
mixed_scene(dt=1e-12)
for body in (sphere(1.0, Vector3(0, 0, 1.65)), particle(lambda: ball(0.7), Vector3.Zero), rod(-ACROSS * 0.9)):
    body()
look()
check.equal(sorted(type(f).__name__ for f in O.engines[2].geomDispatcher.functors if f.overlapping),
            ["Ig2_Cylinder_ConicPP_ScGeom", "Ig2_Sphere_ConicPP_ScGeom"], "a sphere and a cylinder in one scene")
# One without length is a ball, and one that turns about its end within its old bound is seen by the watch.
both_orders(lambda: place(yade.Cylinder(radius=1.0, length=0.0, segment=(0, 0, 0)), Vector3.Zero),
            particle(lambda: ball(0.7), Vector3(0, 0, 1.65)), 0.05, Vector3(0, 0, 1), "a cylinder without length",
            Vector3(0, 0, 1.65 / 1.7))
contact, ids = pair(rod(Vector3.Zero), particle(lambda: ball(0.7), ACROSS * 0.9))
watch = yade.BoundWatch()
O.engines = [O.engines[0], watch] + O.engines[1:]
O.engines[2].verletDist = 0.1
run(2)
asked = watch.requests
O.bodies[ids[0]].state.ori = Quaternion(ACROSS, 1.0)
run(1)
check.equal(watch.requests, asked + 1, "a cylinder that turned")

# --- boxes ----------------------------------------------------------------------------------
extents = Vector3(0.6, 0.4, 0.5)


def box(at, turn=Quaternion.Identity):
    return lambda: place(yade.Box(extents=extents), at, turn)


def cuboid(at, turn=Quaternion.Identity):
    """The same as a potential particle."""
    round_ = 1e-6 * min(extents)
    planes = [(*(s * (j == i) for j in range(3)), extents[i] - round_) for i in range(3) for s in (1, -1)]
    return particle(lambda: yade.ConicPotentialParticle(planes=planes, r=round_, k=0.0, R=extents.norm()), at, turn)


for turn in Quaternion.Identity, TURN:
    rock = particle(lambda: cube(0.05, 0.05, 0.9), turn * Vector3(0.1, 0.05, 0.97), turn)
    both_orders(box(Vector3.Zero, turn), rock, 0.03, turn * Vector3(0, 0, 1), "a cube on a box", tolerance=2e-3)
    # A corner of a sharp cuboid in a face of the box, which is as deep as it reaches.
    on_corner = Quaternion.Identity
    on_corner.setFromTwoVectors(Vector3(1, 1, 1).normalized(), Vector3(0, 0, -1))
    reach = (0.5 - r) * math.sqrt(3) + r
    both_orders(box(Vector3.Zero, turn),
                particle(lambda: sharp_cube(0.5, r), turn * Vector3(0.05, 0.02, 0.5 + reach - 0.01), turn * on_corner),
                0.01, turn * Vector3(0, 0, 1), "a corner in a box", tolerance=1e-6)
    # Ball on face, edge and corner.
    for corner, out in (Vector3(0.6, 0.1, 0.2), (1, 0, 0)), (Vector3(0.6, 0.4, 0.1), (1, 1, 0)), (extents, (1, 1, 1)):
        out = Vector3(out).normalized()
        both_orders(box(Vector3.Zero, turn), particle(lambda: ball(0.3), turn * (corner + 0.29 * out)), 0.01,
                    turn * out, "a ball on a box", tolerance=2e-6)
    as_box, _ = pair(box(Vector3.Zero, turn), rock)
    as_particle, _ = pair(cuboid(Vector3.Zero, turn), rock)
    for name in "normal", "contactPoint":
        check.close(getattr(as_box.geom, name), getattr(as_particle.geom, name), 1e-12,
                    f"a box is a cuboid of planes: {name}")
    check.close(as_box.geom.penetrationDepth, as_particle.geom.penetrationDepth, 1e-12, "and so is its overlap")

check.finish()
