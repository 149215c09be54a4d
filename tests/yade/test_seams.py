# SPDX-License-Identifier: GPL-3.0-or-later
# Meshes of facets: a particle that slides over seams does not notice them, and touches each wall of a corner once.
import potential_particles
import yade
from mixed import *

check = Checks()


def slide(shape, height, triangles, physics, velocity, steps, text, turn=Quaternion.Identity, loop=None):
    """A body without friction and without turning that its weight holds at this height, with a push along the floor."""
    mixed_scene(dt=1e-4, physics=physics, loop=loop)
    facets(triangles)
    moving = add(shape, Vector3(-0.4, -0.17, height), turn, volume=1.0, inertia=Vector3(1, 1, 1), density=1.0)
    state = O.bodies[moving].state
    state.blockedDOFs = "xyzXYZ"
    run(2)  # the second step has forces for all laws
    check.equal(len(touching()), 1, f"{text}: one contact to begin with")
    force = O.forces.f(moving)
    check.close(force.normalized(), Vector3(0, 0, 1), 1e-12, f"{text}: held by the floor")
    O.engines[3].gravity = -force / state.mass
    state.blockedDOFs = "XYZ"
    state.vel = velocity
    owners, highest, fastest, number = set(), 0.0, 0.0, set()
    for _ in range(steps):
        run(1)
        highest = max(highest, abs(state.pos[2] - height))
        fastest = max(fastest, (state.vel - velocity).norm())
        pushing = [i for i in touching() if i.phys.normalForce.norm() > 1e-6 * force.norm()]
        number.add(len(pushing))
        owners.update(i.id1 for i in pushing)
    check.equal(failures(), 0, f"{text}: no failure")
    check.true(len(owners) > 3, f"{text}: it went over facets {sorted(owners)}")
    check.equal(number, {1}, f"{text}: numbers of contacts that push")
    check.true(highest < 1e-9, f"{text}: its height changes by {highest:.2g}")
    check.true(fastest < 1e-9, f"{text}: its velocity changes by {fastest:.2g}")


fine, coarse = floor(0.9, 12), floor(0.9, 4, flip=True)
way = Vector3(17, 9, 0)
for name, triangles in ("fine", fine), ("coarse", coarse):
    for law, physics in ("friction", friction_physics), ("area", area_physics):
        slide(ball(0.2), 0.19, triangles, physics(), way, 400, f"ball, {name} floor, law of {law}")
        slide(cube(0.05, 0.3, 0.3, 0.2),
              cube(0.05, 0.3, 0.3, 0.2).surfaceDistance([(0, 0, -1)])[0] - 1e-3, triangles, physics(), way, 400,
              f"rounded cube, {name} floor, law of {law}")
        slide(sharp_cube(0.1, 0.01), 0.099, triangles, physics(), way, 400,
              f"cube with k = 0, {name} floor, law of {law}", turned((0, 0, 1), 0.3))
slide(ball(0.2), 0.19, fine, friction_physics(), way, 400, "ball in the loop of ours", loop=yade.ConicInteractionLoop)


def resting(shape, at, triangles, text, count, depth=None, turn=Quaternion.Identity):
    """A body that stands in a mesh has so many contacts."""
    mixed_scene(dt=1e-12)
    facets(triangles)
    add(shape, Vector3(at), turn, volume=1.0, inertia=Vector3(1, 1, 1))
    found = look()
    check.equal(failures(), 0, f"{text}: no failure")
    check.equal(len(found), count, f"{text}: contacts")
    if depth is not None:
        for contact in found:
            check.close(contact.geom.penetrationDepth, depth, 1e-9, f"{text}: overlap")
    return found


# Exactly over an edge, and over a vertex with four and with six facets: symmetry is no reason for two contacts.
for triangles, text in (floor(1, 2), "six facets"), (floor(1, 2, flip=True), "four facets"), (floor(1, 1), "an edge"):
    for shape, height in (ball(0.3), 0.29), (sharp_cube(0.3, 0.02), 0.29), (cube(0.05, 0.05, 0.5, 0.3), None):
        height = height or shape.surfaceDistance([(0, 0, -1)])[0] - 0.01
        for offset in (0, 0, 0), (1e-17, -1e-17, 0), (1e-12, 3e-13, 0), (0.1, 0.1, 0):
            resting(shape,
                    Vector3(0, 0, height) + Vector3(offset), triangles, f"over {text}, offset {offset[0]}", 1, 0.01)

# On the ridge of a roof with slopes of 45 degrees, and on its way over it.
roof = [[(-2, -2, -2), (0, -2, 0), (0, 2, 0)], [(-2, -2, -2), (0, 2, 0), (-2, 2, -2)],
        [(0, -2, 0), (2, -2, -2), (2, 2, -2)], [(0, -2, 0), (2, 2, -2), (0, 2, 0)]]
found = resting(ball(0.3), (0, 0.3, 0.29), roof, "on a ridge", 1, 0.01)
check.close(found[0].geom.normal, Vector3(0, 0, 1), 1e-9, "its normal")
for x in (-0.3, -0.2, -0.1, -1e-3, -1e-11, 1e-11, 1e-3, 0.1, 0.2, 0.3):
    # At 0.29 from the roof: from the ridge where the normal lies between those of the slopes, else from a slope.
    slope = Vector3(1 if x > 0 else -1, 0, 1).normalized()
    out = Vector3(x, 0, 1).normalized() if abs(x) < 0.21 else slope
    ridge = Vector3(0, 0.3, 0) if abs(x) < 0.21 else Vector3(x, 0.3, -abs(x))
    found = resting(ball(0.3), ridge + out * 0.29, roof, f"over a ridge, {x}", 1, 0.01)
    check.close(found[0].geom.normal, out, 1e-9, "its normal")

# In a valley, which is the roof upside down, and in a corner of three walls of many facets.
valley = [[(x, y, -z) for x, y, z in three] for three in roof]
for y in (0.0, 0.3, 1.0):
    resting(ball(0.3), (0, y, math.sqrt(2) * 0.29), valley, f"in a valley, {y}", 2, 0.01)
    resting(ball(0.3), (0.1, y, 0.1 + math.sqrt(2) * 0.29), valley, "off its middle", 1, 0.01)
base = floor(1, 4)
walls = base + [[(-1, y, x + 1) for x, y, z in three] for three in base] + [[(x, -1, y + 1) for x, y, z in three]
                                                                            for three in base]
resting(ball(0.3), (-0.71, -0.71, 0.29), walls, "in a corner of three walls", 3, 0.01)
resting(sharp_cube(0.3, 0.02), (-0.71, -0.71, 0.29), walls, "a cube in that corner", 3, 0.01)
resting(ball(0.3), (-0.71, 0.1, 0.29), walls, "at the edge of two walls", 2, 0.01)
resting(ball(0.3), (0.1, -0.05, 0.29), walls, "on the floor", 1, 0.01)

# The tip of a cone of eight facets.
rim = [(math.cos(a * math.pi / 4), math.sin(a * math.pi / 4), -1) for a in range(8)]
cone = [[(0, 0, 0), rim[i], rim[(i + 1) % 8]] for i in range(8)]
for x in (0.0, 1e-12, 0.05):
    out = Vector3(x, 0.3 * x, 1).normalized()
    found = resting(ball(0.3), out * 0.29, cone, f"on the tip of a cone, {x}", 1, 0.01)
    check.close(found[0].geom.normal, out, 1e-9, "its normal")

# Facets of a mesh that move apart are no neighbours any more: a gap has two edges.
mixed_scene(dt=1e-12)
left, right = facets([[(-2, -2, 0), (0, -2, 0), (0, 2, 0)], [(0, -2, 0), (2, -2, 0), (0, 2, 0)]])
add(ball(0.3), Vector3(0, 0, 0.29), volume=1.0, inertia=Vector3(1, 1, 1))
check.equal(len(look()), 1, "one contact over a closed seam")
O.bodies[right].state.pos += Vector3(0.02, 0, 0)
check.equal(len(look()), 2, "two over a gap")
O.bodies[right].state.pos -= Vector3(0.02, 0, 0)
check.equal(len(look()), 1, "and one again")
# So are facets that are erased, and that come.
O.bodies.erase(min(i.id1 for i in touching()))
check.equal(len(look()), 1, "the other facet takes over")
facets([[(-2, -2, 0), (0, -2, 0), (0, 2, 0)]])
check.equal(len(look()), 1, "a new neighbour is known as such")

# A gate that closes: its facets become neighbours, at once where they stop, and before long while they move on.
mixed_scene(dt=1e-12)
left, right = facets([[(-2, -2, 0), (0, -2, 0), (0, 2, 0)], [(0.1, -2, 0), (2.1, -2, 0), (0.1, 2, 0)]])
add(ball(0.3), Vector3(0, 0, 0.29), volume=1.0, inertia=Vector3(1, 1, 1))
check.equal(len(look()), 1, "the edge of an open gate")
O.bodies[right].state.pos -= Vector3(0.1, 0, 0)
look()
check.equal(len(look()), 1, "a gate that has closed")
for one in (left, right):
    O.bodies[one].state.pos += Vector3(0, 0, 1e-4)
    O.bodies[one].state.vel = Vector3(0, 0, 1e-9)
O.bodies[right].state.pos += Vector3(0.1, 0, 0)
look()
O.bodies[right].state.pos -= Vector3(0.1, 0, 0)
run(60)
check.equal(len(look()), 1, "a gate that closes and moves on")

check.finish()
