# SPDX-License-Identifier: GPL-3.0-or-later
"""BlockGen under its own attributes: tables of joints, cut by potential_particles.rock, as a scene of PotentialBlocks.
"""
import math
import random
import sys

import numpy as np

from .. import rock
from ..arguments import number, positive, vector
from ..files import written
from .block import PotentialBlock

# Attributes of YADE's BlockGen, and their values before a script sets them.
_DEFAULTS = dict(
    dampingMomentum=0.2, unitWidth2D=1.0, density=2600.0, Kn=1e9, Ks=1e8, frictionDeg=30.0, globalOrigin=(0, 0, 0),
    inertiaFactor=1.0, rForPP=0.1, kForPP=0.0, RForPP=0.0, probabilisticOrientation=False, Talesnick=False,
    neverErase=False, calContactArea=True, twoDimension=False, shrinkFactor=1.0, viscousDamping=0.0,
    intactRockDegradation=False, initialOverlap=0.0, gravity=(0, -9.81, 0), traceEnergy=False, exactRotation=True,
    minSize=50.0, maxRatio=3.0, boundarySizeXmax=1.0, boundarySizeYmax=1.0, boundarySizeZmax=1.0, boundarySizeXmin=1.0,
    boundarySizeYmin=1.0, boundarySizeZmin=1.0, directionA=(1, 0, 0), directionB=(0, 1, 0), directionC=(0, 0, 1),
    useGlobalStiffnessTimeStepper=False, defaultDt=-1.0, timeStepUpdateInterval=50, useFaceProperties=False, joint_a=(),
    joint_b=(), joint_c=(), joint_d=(), persistentPlanes=False, jointProbabilistic=False, boundaries=False,
    opening=False, slopeFace=False, sliceBoundaries=False, filenamePersistentPlanes="", filenameProbabilistic="",
    filenameBoundaries="", filenameOpening="", filenameSlopeFace="", filenameSliceBoundaries="", color=(-1, -1, -1),
    saveBlockGenData=False, outputFile="")

_UNSERVED = {
    "opening": "an opening is a region of potential_particles.rock.slice",
    "slopeFace": "a slope face is a plane of the domain (potential_particles.rock.Domain.below), or a region of rock.slice",
    "probabilisticOrientation": "scatter of orientations is `fisher` of potential_particles.rock.JointSet",
    "Talesnick": "the law of YADE for potential particles does not have it",
}

BOUNDARY_COLOUR = (0.0, 0.4, 0.0)


class BlockGen:
    """Cuts a box by joints and makes a scene of the blocks, by load(); attributes as of YADE's BlockGen, which also may
    be keyword arguments.

    The box goes from -boundarySizeXmin to boundarySizeXmax, and so on. Joints come from joint_a, joint_b, joint_c,
    joint_d (a x + b y + c z = d, from globalOrigin) and from the tables whose switch is on and whose name is not empty
    (potential_particles.rock.read_blockgen). Blocks beyond a plane of filenameBoundaries, on the side to which its
    normal (-sin d cos a, -sin d sin a, cos d) points, are boundaries: fixed, and cut by joints of
    filenameSliceBoundaries alone. A joint leaves a block whole where the largest ball in a part would have a diameter
    below minSize, or the part an extent above maxRatio times that. With useFaceProperties contacts on a joint take
    friction, cohesion and tension of its row; otherwise frictionDeg. ValueError for what is not served, which says what
    is there instead; AttributeError for a name that BlockGen does not have.
    """

    def __init__(self, **attributes):
        for name, value in {**_DEFAULTS, **attributes}.items():
            setattr(self, name, value)

    def __setattr__(self, name, value):
        if name not in _DEFAULTS:
            raise AttributeError(f"BlockGen has no attribute {name}")
        object.__setattr__(self, name, value)

    def load(self):
        """Replaces the present scene: four engines, as in YADE's BlockGen, and the blocks."""
        import yade
        for name, instead in _UNSERVED.items():
            if getattr(self, name):
                raise ValueError(f"{name}=True is not served: {instead}")
        for name, axis in zip(("directionA", "directionB", "directionC"), np.eye(3)):
            if np.abs(np.abs(vector(getattr(self, name), name)) - axis).max() > 1e-9:
                raise ValueError(
                    f"{name}={tuple(getattr(self, name))} is not served: extents for maxRatio are those along x, y and z"
                )
        joints, strengths, sides, of_sides = self._joints()
        pieces = [(piece, of_sides if fixed else joints, fixed) for piece, fixed in self._domains(sides)]
        limits = dict(least_width=number(self.minSize, "minSize"),
                      largest_aspect=max(1.0, number(self.maxRatio, "maxRatio")))
        masses = [(rock.slice(piece, list(cutting), **limits), fixed) for piece, cutting, fixed in pieces]
        yade.O.reset()
        yade.O.materials.append(
            yade.FrictMat(density=positive(self.density, "density"), frictionAngle=math.radians(self.frictionDeg)))
        yade.O.engines = self._engines()
        if self.defaultDt > 0.0:
            yade.O.dt = self.defaultDt
        for mass, fixed in masses:
            ids = np.array([yade.O.bodies.append(self._body(mass, one, fixed)) for one in range(len(mass))], int)
            if self.useFaceProperties and not fixed:
                yade.O.engines = yade.O.engines + [rock.joint_engine(mass, ids, dict(enumerate(strengths)))]
        self._tell(masses)

    def _joints(self):
        """Joints, a material of each, boundaries, and joints of boundaries."""
        import yade
        origin = vector(self.globalOrigin, "globalOrigin")
        read = []
        for row in zip(self.joint_a, self.joint_b, self.joint_c, self.joint_d):
            normal = np.array(row[:3], float)
            length = positive(np.linalg.norm(normal), "the length of the normal of a joint")
            read.append((rock.Joint(tuple(origin + normal * (row[3] / length**2)), tuple(normal / length)), {}))
        size = max(self.boundarySizeXmin + self.boundarySizeXmax, self.boundarySizeYmin + self.boundarySizeYmax,
                   self.boundarySizeZmin + self.boundarySizeZmax)
        if self.persistentPlanes and self.filenamePersistentPlanes:
            read += rock.files.rows_of_blockgen(self.filenamePersistentPlanes, "persistent", size)
        if self.jointProbabilistic and self.filenameProbabilistic:
            read += rock.files.rows_of_blockgen(self.filenameProbabilistic, "probabilistic")
        strengths = [
            yade.ConicJointMat(**{"frictionAngle": math.radians(self.frictionDeg), **strength}) for _, strength in read
        ]
        sides = rock.read_blockgen(self.filenameBoundaries,
                                   "boundary") if self.boundaries and self.filenameBoundaries else []
        of_sides = rock.read_blockgen(self.filenameSliceBoundaries,
                                      "boundary") if self.sliceBoundaries and self.filenameSliceBoundaries else []
        return [joint for joint, _ in read], strengths, sides, of_sides

    def _domains(self, sides):
        """(Domain, whether it is a boundary): what lies below all planes of boundaries, and what lies beyond each but
        below those before it.
        """
        axes = "XYZ"
        left = rock.Domain.box([-abs(getattr(self, f"boundarySize{axis}min")) for axis in axes],
                               [abs(getattr(self, f"boundarySize{axis}max")) for axis in axes])
        found = []
        for side in sides:
            row = np.array([*side.normal, np.dot(side.normal, side.point)])
            try:
                beyond = rock.Domain(np.vstack([left.planes, -row]))
                beyond.ball()
            except ValueError:
                continue
            found.append((beyond, True))
            left = rock.Domain(np.vstack([left.planes, row]))
        return [(left, False), *found]

    def _engines(self):
        import yade
        from . import Ig2_PB_PB_ScGeom
        ip2 = yade.wrapper.Ip2_FrictMat_FrictMat_KnKsPhys_Block(Knormal=self.Kn, Kshear=self.Ks, kn_i=self.Kn,
                                                                ks_i=self.Ks, viscousDamping=self.viscousDamping)
        law = yade.wrapper.Law2_SCG_KnKsPhys_KnKsLaw(traceEnergy=self.traceEnergy, neverErase=self.neverErase)
        return [
            yade.ForceResetter(),
            yade.InsertionSortCollider([yade.PotentialParticle2AABB()], verletDist=0),
            yade.InteractionLoop([
                Ig2_PB_PB_ScGeom(twoDimension=self.twoDimension, unitWidth2D=self.unitWidth2D,
                                 calContactArea=self.calContactArea)
            ], [ip2], [law]),
            yade.NewtonIntegrator(damping=self.dampingMomentum, gravity=yade.Vector3(*map(float, self.gravity)),
                                  exactAsphericalRot=self.exactRotation)
        ]

    def _body(self, mass, one, fixed):
        import yade
        block, r = mass[one], positive(self.rForPP, "rForPP")
        on_joint = mass.faces["of"][block.faces] == 1
        heights = block.planes[:, 3] - block.planes[:, :3] @ block.centroid + self.initialOverlap + on_joint * (
            1.0 - self.shrinkFactor) * r
        given = [random.random() for _ in range(3)] if min(self.color) < 0.0 else self.color
        shape = PotentialBlock(**dict(zip("abc", block.planes[:, :3].T)), d=heights - r, r=r, R=self.RForPP,
                               id=len(yade.O.bodies), isBoundary=fixed,
                               color=yade.Vector3(*(BOUNDARY_COLOUR if fixed else map(float, given))))
        made = yade.Body()
        made.shape, made.mat = shape, yade.O.materials[0]
        made.state = made.mat.newAssocState()
        made.state.mass = block.volume * self.density
        inertia = shape.inertia
        if not self.exactRotation:
            inertia = yade.Vector3(1, 1, 1) * max(*inertia, 0.4 * block.volume * self.minSize**2)
        made.state.inertia = inertia * (self.density * self.inertiaFactor)
        made.state.pos = made.state.refPos = yade.Vector3(*block.centroid.tolist()) + shape.position
        made.state.ori = made.state.refOri = shape.orientation
        made.aspherical = True
        if fixed:
            made.dynamic = False
        return made

    def _tell(self, masses):
        lines = [
            f"{mass!r}{', boundary' if fixed else ''}: {len(mass.missing)} joints met no block, {mass.too_small} cuts were left out"
            for mass, fixed in masses
        ]
        if not self.saveBlockGenData:
            print("\n".join(lines), file=sys.stderr)
        elif self.outputFile:
            with written(self.outputFile, text=True) as file:
                file.write("\n".join(lines) + "\n")
