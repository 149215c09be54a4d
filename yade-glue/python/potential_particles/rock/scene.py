# SPDX-License-Identifier: GPL-3.0-or-later
"""Bodies of blocks, joints with the materials of their sets, excavation."""
import json
import math

import numpy as np

from ..arguments import LARGE, positive, radians, whole, within
from ..joints import FOLLOWS, of_engine, table
from ..polyhedron import principal_axes
from ..rounding import Rounding
from ..shape import Shape
from .loads import loads_of
from .mass import marked

TAG = "potential_particles.rock"
# After the tag of an engine: the step in which it ran last.
_RAN = ".ran"

#: Mask of fixed blocks; with avoidSelfInteractionMask=2 a collider passes over contacts between them.
FIXED_MASK = 3

# Of the size of a block, and of the distance from the origin: faces that touch to rounding alone have no patch, and to
# look for one takes long.
TOUCH, ROUNDING = 1e-10, 1e-13


class Ids(np.ndarray):
    """An array of ids that gives one of them as an int, which O.bodies takes, as it does no number of numpy's."""

    def __getitem__(self, which):
        found = super().__getitem__(which)
        return int(found) if isinstance(found, np.integer) else found

    def __iter__(self):
        return iter(self.tolist())


def bodies(mass, material=None, rounding=None, fixed=(), overlap=None, color=None, *, r=None, **more):
    """Appends the blocks of a RockMass to O.bodies; an array (blocks,) of the ids of their bodies, which gives a single
    one as an int.

    material: a Material, or the number or label of one in O.materials (None: the last). rounding: of edges and corners,
    as a share of twice the distance of the nearest face from the centroid (None: 0.05), or in its place r, a length for
    all blocks; faces are flat (k = 0) and stay where they are, but for `overlap`, length, by which each is moved out,
    so that neighbours touch from the start: by default 1e-10 of the size of a block, and above rounding. Mass and
    inertia are those of the sharp blocks, so that masses sum to that of the domain.
    fixed: blocks that no force moves, as numbers or (blocks,) of bool, as mass.on_domain gives them. Pieces of a block
    that regions parted are a clump, with the mass of their sum, and all fixed where one is. color: one for all, or a
    function of the number of a block; by default a shade for each.
    The mask of fixed blocks is 3: InsertionSortCollider(..., avoidSelfInteractionMask=2) leaves out contacts between
        them.
    more: further arguments of potential_particles.body.
    """
    import yade
    from ..bodies import body
    from ..clumps import clump
    wanted = Rounding(rounding, 0.0, r)
    size = np.median(np.cbrt(mass.blocks["volume"]))
    overlap = max(TOUCH * size,
                  ROUNDING
                  * np.abs(mass.corners).max()) if overlap is None else within(overlap, 0.0, math.inf, "overlap")
    still = marked(fixed, len(mass), "fixed")
    held = np.zeros(mass.pieces.max(initial=-1) + 1, bool)
    held[mass.pieces[still]] = True
    made = []
    for one in range(len(mass)):
        block = mass[one]
        shape, orientation = block_shape(block, wanted, overlap)
        shade = _shade(one) if color is None else color(one) if callable(color) else color
        is_held = bool(held[mass.pieces[one]])
        made.append(
            body(shape, material, block.centroid, orientation, fixed=is_held, color=shade,
                 **{**({"mask": FIXED_MASK} if is_held else {}), **more}))
    ids = np.array(yade.O.bodies.append(made), int).view(Ids)
    counts = np.bincount(mass.pieces, minlength=len(held))
    for piece in np.flatnonzero((counts > 1) & ~held):
        clump(ids[mass.pieces == piece].tolist(), lines=400)
    return ids


def joint_engine(mass, ids, materials, period=1):
    """An engine that gives contacts the friction, strength and stiffness of the joint on which they lie, to stand
    behind the contact loop.

    mass, ids: as of bodies(). materials: for entries of the `joints` of slice() a Material: of a ConicJointMat friction
    angles, cohesion, tensile strength, softening and, where they are above 0, both stiffnesses count, but with KnKsPhys
    neither softening nor stiffnesses; of another FrictMat the friction angle. Contacts between blocks that were
    neighbours on a joint of these sets take them in the first step after they are made, looked for every `period`
    steps; all others keep what their bodies give them. What a script makes of a joint later stays, also in a run that
    loads the scene. Saved with the scene, in O.tags; a script that loads it imports potential_particles. Each rock mass
    has an engine of its own.
    """
    import yade
    period = whole(period, 1, LARGE, "period")
    largest = {}
    sets, owners = mass.set_of_face, mass.faces["block"].astype(int)
    for (first, second), area in zip(mass.partners["faces"].astype(int), mass.partners["area"]):
        pair = tuple(sorted((int(ids[owners[first]]), int(ids[owners[second]]))))
        if int(sets[first]) in materials and area > largest.get(pair, (0.0,))[0]:
            largest[pair] = float(area), int(sets[first])
    for entry, material in materials.items():
        if not isinstance(material, yade.FrictMat):
            raise ValueError(
                f"materials[{entry!r}] is {type(material).__name__}: give a ConicJointMat or another FrictMat")
        radians(material.frictionAngle, f"frictionAngle of materials[{entry!r}]")
    written = {"pairs": [[*pair, entry] for pair, (_, entry) in largest.items()],
               "values": {str(int(entry)): _values(material) for entry, material in materials.items()}}
    # Ids tell masses apart; blocks that take the ids of others take their place here, too.
    tag = f"{TAG}.{int(min(ids, default=0))}"
    yade.O.tags[tag] = json.dumps(written)
    # Joints that there are take the new values.
    yade.O.tags[tag + _RAN] = "-1"
    return yade.PyRunner(command=f"import potential_particles.rock.scene; {FOLLOWS}({tag!r})", iterPeriod=period,
                         initRun=True)


_VALUES = ("frictionAngle", "residualFrictionAngle", "cohesion", "residualCohesion", "tensileStrength", "softening",
           "normalStiffness", "shearStiffness")


def _values(material):
    found = {name: getattr(material, name) for name in _VALUES if hasattr(material, name)}
    if found.get("residualFrictionAngle", -1.0) < 0.0:
        found["residualFrictionAngle"] = found["frictionAngle"]
    return found


def follow(tag=TAG):
    """What joint_engine() does when it runs; without a tag, in scenes of earlier versions."""
    import yade
    scene = yade.O
    pairs = table(tag, scene.tags[tag])
    # The step in which it ran last is saved with the scene: joints that have their values keep what a script has made
    # of them, in a loaded run, too.
    ran = tag + _RAN
    since = int(scene.tags[ran]) if scene.tags.has_key(ran) else -1
    if since > scene.iter:  # O.resetTime()
        since = 0
    for contact in scene.interactions:
        if contact.isReal and since <= contact.iterMadeReal <= scene.iter:
            values = pairs.get((min(contact.id1, contact.id2), max(contact.id1, contact.id2)))
            if values is not None:
                _give(contact.phys, values)
    scene.tags[ran] = str(scene.iter)


def _give(physics, values):
    import yade
    if not isinstance(physics, yade.KnKsPhys):
        for name, value in of_engine(values).items():
            if hasattr(physics, name):
                setattr(physics, name, value)
        return
    physics.tangensOfFrictionAngle = math.tan(values["frictionAngle"])
    # Its law takes angles in degrees, and strength only of contacts that say that they have some.
    physics.phi_b, physics.phi_r = (math.degrees(values[name]) for name in ("frictionAngle", "residualFrictionAngle"))
    physics.cohesion, physics.tension = values.get("cohesion", 0.0), values.get("tensileStrength", 0.0)
    physics.intactRock = physics.cohesion > 0.0
    physics.cohesionBroken, physics.tensionBroken = physics.cohesion <= 0.0, physics.tension <= 0.0


def excavate(ids, settle=0, slow=1e-3, check_every=100):
    """Takes bodies out of the scene, clumps with all their members, and runs up to `settle` steps until none is faster
    than `slow` (length per time).

    ids: of the bodies, as ids[mass.inside(0)]; one that is gone already is passed over, one that never was is a
    ValueError. Returns the steps that were run. A sequence is a loop over regions.
    """
    import yade
    scene, settle, slow = yade.O, whole(settle, 0, LARGE, "settle"), positive(slow, "slow")
    if np.asarray(ids).dtype == bool:
        raise ValueError("ids is an array of bool: give ids of bodies, as in excavate(ids[mass.inside(0)])")
    wanted = sorted({_id(one) for one in np.atleast_1d(ids)})
    unknown = [one for one in wanted if not 0 <= one < len(scene.bodies)]
    if unknown:
        raise ValueError(
            f"ids holds {', '.join(map(str, unknown[:5]))}{' ...' if len(unknown) > 5 else ''}: there is no such body among the {len(scene.bodies)} of O.bodies; "
            "give ids as bodies() returned them, as in excavate(ids[mass.inside(0)])")
    chosen = [body for body in (scene.bodies[one] for one in wanted) if body is not None]
    carriers = {body.clumpId if body.isClumpMember else body.id for body in chosen}
    gone = carriers | {
        member
        for one in carriers if scene.bodies[one].isClump for member in scene.bodies[one].shape.members
    }
    # YADE would leave their contacts until the next step.
    for pair in [(contact.id1, contact.id2) for contact in scene.interactions
                 if not gone.isdisjoint((contact.id1, contact.id2))]:
        scene.interactions.erase(*pair)
    for one in carriers:
        scene.bodies.erase(one, True)
    done = 0
    while done < settle:
        scene.run(min(check_every, settle - done), True)
        done += min(check_every, settle - done)
        if max((body.state.vel.norm() for body in scene.bodies if body.state.mass > 0.0), default=0.0) < slow:
            break
    return done


def _id(given):
    try:
        if given == int(given):
            return int(given)
    except (TypeError, ValueError):
        pass
    raise ValueError(f"ids holds {given}: an id is a whole number")


def block_shape(block, wanted, overlap, more=None):
    """The Shape of a block in its principal axes, and the orientation of these. more: planes beside those of its faces.
    """
    orientation, axes, moments = principal_axes(block.inertia)
    faces = block.planes if more is None else np.vstack([block.planes, more])
    heights = faces[:, 3] - faces[:, :3] @ block.centroid
    r = wanted.lengths(2.0 * float(heights.min()))[0]
    planes = np.column_stack([faces[:, :3] @ axes, heights + overlap - r])
    reach = float(np.linalg.norm(block.corners - block.centroid, axis=1).max())
    shape = Shape(planes=tuple(map(tuple, planes.tolist())), r=r, k=0.0, R=reach, volume=block.volume,
                  inertia=tuple(map(float, moments)), error=1e-12, centroid=(0.0, 0.0, 0.0),
                  orientation=(1.0, 0.0, 0.0, 0.0), bounding_radius=reach, name=f"block {block.number}")
    return shape, orientation


def apply_loads(ids, loads):
    """Gives bodies lasting forces and torques, in the place of those that they have: ids (blocks,) of bodies(), loads
    (blocks, 6). On a clump, those of its members.

    YADE does not save lasting forces: call it again after O.load(), and O.forces.reset(resetAll=True) where other
        bodies take the ids.
    """
    import yade
    from ..bodies import owner
    forces, loads = {}, loads_of(loads, len(ids))
    for one, load in zip(ids, loads):
        body = yade.O.bodies[int(one)]
        if body is None:
            continue
        carrier = owner(body)
        arm = np.array(body.state.pos) - np.array(carrier.state.pos)
        turned = np.concatenate([load[:3], load[3:] + np.cross(arm, load[:3])])
        forces[carrier.id] = forces.get(carrier.id, 0.0) + turned
    for one, load in forces.items():
        yade.O.forces.setPermF(one, yade.Vector3(*load[:3]))
        yade.O.forces.setPermT(one, yade.Vector3(*load[3:]))


def _shade(number):
    """Of stone; a little lighter or darker from block to block."""
    shift = 0.14 * ((number * 0.618034) % 1.0 - 0.5)
    return tuple(one + shift for one in (0.72, 0.68, 0.6))
