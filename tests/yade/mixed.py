# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes in which potential particles meet YADE's own shapes, for the scripts in this folder."""
import yade
from harness import *
from potential_particles.unserved import REMEDIES


def bounds():
    return [yade.PotentialParticle2AABB()] + [getattr(yade, f"Bo1_{shape}_Aabb")() for shape in REMEDIES]


def contacts(**keywords):
    """Functors for every pair of a potential particle and a shape that it can touch."""
    return [yade.Ig2_PP_PP_ScGeom_Conic(**keywords)] + [getattr(yade, name)(**keywords) for name in REMEDIES.values()]


def friction_physics():
    """Stiffness and law of YADE's spheres."""
    return [yade.Ip2_FrictMat_FrictMat_FrictPhys()], [yade.Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)]


def area_physics(stiffness=1e7):
    """Stiffness by area: YADE's law of potential particles."""
    return ([yade.Ip2_FrictMat_FrictMat_KnKsPhys(kn_i=stiffness, ks_i=stiffness, Knormal=stiffness, Kshear=stiffness,
                                                 viscousDamping=0.0, useFaceProperties=False)],
            [yade.Law2_SCG_KnKsPhys_KnKsLaw(neverErase=False)])


def mixed_scene(functors=None, physics=None, loop=None, dt=1e-5, gravity=(0, 0, 0), friction=0.0, damping=0.0,
                young=1e7, periodic=False, verlet=0.0):
    O.reset()
    O.materials.append(yade.FrictMat(young=young, poisson=0.3, frictionAngle=friction, density=2000.0))
    O.periodic = periodic
    made, law = physics or friction_physics()
    O.engines = [
        yade.ForceResetter(),
        yade.InsertionSortCollider(bounds(), verletDist=verlet, allowBiggerThanPeriod=True),
        (loop or yade.InteractionLoop)(functors or contacts(), made, law),
        yade.NewtonIntegrator(damping=damping, exactAsphericalRot=True, gravity=gravity),
    ]
    O.dt = dt


def place(shape, position, orientation=Quaternion.Identity, fixed=True, mass=1.0):
    """A body with a shape of YADE's own, or any other whose mass does not matter."""
    body = yade.Body()
    body.shape = shape
    utils._commonBodySetup(body, 1.0, Vector3(1, 1, 1), material=-1, pos=position, fixed=fixed)
    body.state.mass, body.state.inertia = mass, Vector3(1, 1, 1) * mass
    body.state.pos, body.state.ori = position, orientation
    return O.bodies.append(body)


def facets(triangles, **keywords):
    """Ids of facets with these world vertices."""
    return O.bodies.append([utils.facet([Vector3(v) for v in vertices], fixed=True, material=-1, **keywords)
                            for vertices in triangles])


def floor(size, cells, height=0.0, flip=False):
    """Triangles of a square floor about the origin, two for each of cells x cells squares."""
    step = 2.0 * size / cells
    at = lambda i, j: (-size + i * step, -size + j * step, height)
    squares = [[at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)] for i in range(cells) for j in range(cells)]
    return [
        three for a, b, c, d in squares for three in (((a, b, c), (a, c, d)) if not flip else ((a, b, d), (b, c, d)))
    ]


def touching():
    return [i for i in O.interactions if i.isReal and i.geom.penetrationDepth > 0]


def failures():
    return sum(f.failures for f in engine_of(yade.InteractionLoop).geomDispatcher.functors if hasattr(f, "failures"))


def look():
    """One step, after which bodies stand (as good as) where they stood: the contacts of the scene."""
    run(1)
    return touching()


def ball(radius, **more):
    return yade.ConicPotentialParticle(planes=[], r=radius, k=1.0, R=radius, **more)


def sharp_cube(half=0.5, r=0.001, k=0.0, **more):
    return yade.ConicPotentialParticle(planes=cube_planes(half, r), r=r, k=k, R=2 * half, **more)
