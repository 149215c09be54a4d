# SPDX-License-Identifier: MIT OR Apache-2.0
"""One run of a pile of pyramids in YADE, by one kind of bodies. Environment: JOB, an object in JSON with

kind: ours, potential, polyhedra or levelset; count: bodies; task: see TASKS; start: file with the states to begin with;
settle: steps before anything is measured; windows and steps: of each; save: files for the states while falling and at
rest; result: where the JSON goes.

All kinds have the same mass, inertia, friction and time step; the springs are as near as the laws allow (`_material`,
`_loop`). SI units, z up.
"""

import json
import os
import sys
import time
from pathlib import Path

JOB = json.loads(os.environ["JOB"])
HERE = Path(sys.argv[0]).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[1] / "studies")]

import potential_particles  # noqa: F401 (the studies' pyramid takes its mass from it)
import numpy as np
import yade
import yade.log
from yade import O, Quaternion, Vector3, polyhedra_utils, utils

import pile
import yade_level_set
from bodies import potential_body, reach
from box import BODY_MASK, SLAB_MASK, SLAB_ONLY
from contact_functor import BUILTIN, LIBRARY
from polyhedron import Polyhedron

OURS, POTENTIAL, POLYHEDRA, LEVEL_SET = "ours", "potential", "polyhedra", "levelset"
SEED = 7
# Dissipation: the potential particles' law has dashpots, and YADE's local damping as little as in make demo; the laws
# of the others have none, and get more of YADE's.
LOCAL_DAMPING = {OURS: 0.1, POTENTIAL: 0.1, POLYHEDRA: 0.3, LEVEL_SET: 0.3}
FACE = 0.5 * pile.SIZE**2  # area on which the spring of a volume is as stiff as that of an overlap
BOUNCE_STEPS_PER_STEP = 20
DROP, TILT = 0.05, (0.9, 0.3, 0.2, 0.1)  # of the bouncing body: height in m, orientation


def planes_of(shape):
    """Normals (n, 3) and offsets (n,)."""
    planes = np.array(shape.planes)
    return planes[:, :3], planes[:, 3]


class Scene(pile.Pile):
    """The pile with another kind of bodies, their walls and engines."""

    def __init__(self, kind, count, dissipation=True):
        super().__init__(count, LIBRARY if kind == OURS else BUILTIN, seed=SEED, measure_time=False)
        self.kind, self.dissipation, self.is_potential = kind, dissipation, kind in (OURS, POTENTIAL)
        self.angle = np.radians(pile.FRICTION_ANGLE) if dissipation else 0.0
        self.material = self._material()
        O.reset()
        self.start()

    def body(self, position, orientation):
        body = {
            OURS: self._potential, POTENTIAL: self._potential, POLYHEDRA: self._polyhedron, LEVEL_SET: self._level_set
        }[self.kind]()
        turn = Quaternion(*map(float, orientation)).normalized()
        own, offset = getattr(self, "own", (Quaternion.Identity, Vector3.Zero))
        body.state.pos = body.state.refPos = Vector3(*map(float, position)) + turn * offset
        body.state.ori = body.state.refOri = turn * own
        body.mask = BODY_MASK
        return body

    def states(self):
        bodies = [O.bodies[i].state for i in self.ids]
        own, offset = getattr(self, "own", (Quaternion.Identity, Vector3.Zero))
        turns = [state.ori * own.conjugate() for state in bodies]
        return {
            "pos": np.array([tuple(state.pos - turn * offset) for state, turn in zip(bodies, turns)]),
            "ori": np.array([[turn[i] for i in (3, 0, 1, 2)] for turn in turns]),
            "vel": np.array([tuple(state.vel) for state in bodies]),
            "angVel": np.array([tuple(state.angVel) for state in bodies]),
        }

    def energy(self):
        """Of motion and in the field of gravity, J."""
        bodies = [O.bodies[i].state for i in self.ids]
        return utils.kineticEnergy() + sum(state.mass * state.pos[2] for state in bodies) * pile.GRAVITY

    def contacts(self):
        measure = "penetrationVolume" if self.kind == POLYHEDRA else "penetrationDepth"
        return sum(1 for one in O.interactions if one.isReal and getattr(one.geom, measure) > 0)

    # --- parts ------------------------------------------------------------------------------

    def _material(self):
        common = dict(frictionAngle=self.angle, density=pile.DENSITY)
        if self.kind == POLYHEDRA:
            # The law takes the stiffness of two bodies in a row; N/m^3.
            return yade.PolyhedraMat(young=2.0 * pile.NORMAL_STIFFNESS / FACE, poisson=0.5, **common)
        return yade.FrictMat(young=1e8, poisson=0.5, **common)

    def walls(self):
        if self.is_potential:
            return super().walls()
        h = self.box.half_x
        walls = [utils.wall(place, axis, sense=sense, material=self.material)
                 for place, axis, sense in ((0.0, 2, 1), (-h, 0, 1), (h, 0, -1), (-h, 1, 1), (h, 1, -1))]
        for wall in walls:
            wall.mask = SLAB_MASK
        return walls

    def _potential(self):
        return potential_body(self.contact.shape_class, self.shape, self.material)

    def _polyhedron(self):
        """Sharp, and inside the rounded one: else its corners would stick out by a twentieth of the size."""
        corners = self._sharp()
        body = polyhedra_utils.polyhedra(self.material, v=[Vector3(*map(float, corner)) for corner in corners])
        self.own = (body.state.ori, body.state.pos)
        mass = self.shape.volume * pile.DENSITY
        body.state.inertia *= mass / body.state.mass
        body.state.mass = mass
        return body

    def _sharp(self):
        normals, offsets = planes_of(self.shape)
        corners = Polyhedron(normals, offsets + self.shape.r).corners
        lengths, ways = np.linalg.norm(corners, axis=1), [Vector3(*corner) for corner in corners]
        reach = self.shape.particle().surfaceDistance(ways) / lengths
        return reach.min() * corners

    def _level_set(self):
        if not hasattr(self, "field"):
            core = Polyhedron(*planes_of(self.shape))
            self.field = yade_level_set.signed_distances(core.corners, core.triangles, self.shape.r)
        body = yade_level_set.body(*self.field, self.material)
        body.state.mass = self.shape.volume * pile.DENSITY
        body.state.inertia = Vector3(*self.shape.inertia) * pile.DENSITY
        body.aspherical = True
        return body

    def engines(self):
        damping = LOCAL_DAMPING[self.kind] if self.dissipation else 0.0
        motion = yade.NewtonIntegrator(damping=damping, exactAsphericalRot=True, gravity=(0, 0, -pile.GRAVITY),
                                       label="motion")
        if self.is_potential:
            viscous = pile.VISCOUS_DAMPING if self.dissipation else 0.0
            engines = pile.engines(self.contact.functor, self.contact.loop, viscous=viscous, local=damping)
            # The others' boxes must be exact at every step.
            return pile.watched(engines) if self.kind == OURS else engines
        boxes = [{POLYHEDRA: yade.Bo1_Polyhedra_Aabb, LEVEL_SET: yade.Bo1_LevelSet_Aabb}[self.kind](),
                 yade.Bo1_Wall_Aabb()]
        collider = yade.InsertionSortCollider(boxes, verletDist=0.0, avoidSelfInteractionMask=SLAB_ONLY,
                                              label="collider")
        return [yade.ForceResetter(), collider, self._loop(), motion]

    def _loop(self):
        if self.kind == POLYHEDRA:
            return yade.InteractionLoop(
                [yade.Ig2_Polyhedra_Polyhedra_PolyhedraGeom(), yade.Ig2_Wall_Polyhedra_PolyhedraGeom()],
                [yade.Ip2_PolyhedraMat_PolyhedraMat_PolyhedraPhys()],
                [yade.Law2_PolyhedraGeom_PolyhedraPhys_Volumetric()],
                label="contacts",
            )
        springs = dict(kn=yade.MatchMaker(algo="val", val=pile.NORMAL_STIFFNESS),
                       ks=yade.MatchMaker(algo="val", val=pile.SHEAR_STIFFNESS))
        return yade.InteractionLoop(
            [yade.Ig2_LevelSet_LevelSet_ScGeom(), yade.Ig2_Wall_LevelSet_ScGeom()],
            [yade.Ip2_FrictMat_FrictMat_FrictPhys(**springs)],
            [yade.Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)],
            label="contacts",
        )


def fall():
    """From the loose grid to rest: keeps the states while the bodies fall onto each other, and those at rest."""
    scene = Scene(JOB["kind"], JOB["count"])
    scene.lay(scene.grid.positions, scene.grid.orientations)
    scene.finish()
    O.run(JOB["falling_step"], True)
    np.savez(JOB["save"][0], **scene.states())
    # As in the scale bench, rest comes sooner with more of YADE's damping.
    O.engines[-1].damping = 0.3
    O.run(JOB["settle"] - JOB["falling_step"], True)
    np.savez(JOB["save"][1], **scene.states())
    return {"kinetic_J": utils.kineticEnergy()}


def windows():
    """Milliseconds a step, in windows; contacts, energy and who is lost."""
    scene = Scene(JOB["kind"], JOB["count"])
    started = np.load(JOB["start"])
    scene.lay(*(started[name] for name in pile.STATES))
    scene.finish()
    budget = time.perf_counter() + JOB["seconds"]
    energies = [scene.energy()]
    settled = 0
    # In pieces, so that a slow kind ends in time; the first step also makes YADE's boxes.
    while settled < JOB["settle"] and time.perf_counter() < budget:
        O.run(min(10, JOB["settle"] - settled), True)
        settled += 10
        energies.append(scene.energy())
    rows = []
    for number in range(JOB["windows"]):
        if number >= 2 and time.perf_counter() > budget + JOB["seconds"]:
            break
        before = sum(engine.execTime for engine in O.engines)
        O.run(JOB["steps"], True)
        # O.run waits in pieces of many milliseconds; the engines know better.
        rows.append((sum(engine.execTime for engine in O.engines) - before) * 1e-6 / JOB["steps"])
        energies.append(scene.energy())
    below, outside = scene.box.lost(scene.states()["pos"])
    return {
        "kind": scene.kind, "bodies": len(scene.ids), "fastest_ms": min(rows), "median_ms": float(np.median(rows)),
        "contacts": scene.contacts(), "pairs": len(O.interactions), "lost": int((below | outside).sum()),
        "steps": O.iter, "settled": settled >= JOB["settle"], "kinetic_J": utils.kineticEnergy(),
        "largest_rise_J": max([0.0, *(later - earlier for earlier, later in zip(energies, energies[1:]))]),
        "failures": scene.contact.functor.failures if scene.kind == OURS else None,
    }


def bounce():
    """One pyramid dropped onto the floor, without friction or damping: how far its energy in flight strays from that at
    the start.
    """
    scene = Scene(JOB["kind"], 1, dissipation=False)
    scene.lay([(0, 0, reach(scene.shape) + DROP)], [TILT])
    scene.finish()
    # So short a step that what is left is the geometry's: the laws give no force in the first step of a contact.
    O.dt /= BOUNCE_STEPS_PER_STEP
    start, worst, bounces, touched = scene.energy(), 0.0, 0, False
    for _ in range(JOB["steps"]):
        O.step()
        touching = scene.contacts() > 0
        bounces += touching and not touched
        touched = touching
        if not touching:
            worst = max(worst, abs(scene.energy() / start - 1.0))
    return {"energy_error": worst if bounces else None, "bounces": bounces}


def describe():
    """Shape, mass and laws, for those who are not YADE."""
    scene = Scene(OURS, JOB["count"])
    (normals, offsets), mass = planes_of(scene.shape), scene.shape.volume * pile.DENSITY
    # Of the critical damping of two bodies, whose effective mass at a corner is about a quarter.
    damping = 2.0 * pile.VISCOUS_DAMPING * np.sqrt(pile.NORMAL_STIFFNESS * 0.25 * mass)
    return {
        "normals": normals.tolist(),
        "offsets": offsets.tolist(),
        "r": scene.shape.r,
        "mass": mass,
        "inertia": [value * pile.DENSITY for value in scene.shape.inertia],
        "half_width": float(scene.box.half_x),
        "height": float(scene.box.height),
        "laws": [
            pile.NORMAL_STIFFNESS, damping, 0.5 * damping,
            float(np.tan(scene.angle)), pile.GRAVITY, pile.TIME_STEP
        ],
    }


TASKS = {"describe": describe, "fall": fall, "windows": windows, "bounce": bounce}
yade.log.setDefaultLogLevel(1)  # fatal errors only: some functors write a line a call, which takes longer than the call
Path(JOB["result"]).write_text(json.dumps(TASKS[JOB["task"]]()))
