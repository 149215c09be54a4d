# SPDX-License-Identifier: MIT OR Apache-2.0
"""In YADE, with the plugin and the wheel on the path: both sets of names are there, and both find the same contact."""
import os
import sys
import traceback

import numpy as np


def main():
    import potential_particles
    from potential_particles import rock, shapes
    from yade import FrictMat, O
    # One package, whose names are those of one _core.
    from potential_particles import _core, polyhedron, yade as host
    assert potential_particles.Particle is _core.Particle and polyhedron.Polyhedron is _core._shapes.Polyhedron
    assert potential_particles.body is host.body
    O.materials.append(FrictMat())
    places = (0, 0, 0), (0.1, 0.2, 0.45)
    O.bodies.append([potential_particles.body(shapes.cuboid((1, 1, 0.5)), position=place) for place in places])
    shape = O.bodies[0].shape
    particle = potential_particles.Particle(shape.planes, shape.r, shape.k, shape.R)
    poses = [
        potential_particles.Pose(tuple(O.bodies[i].state.pos), [O.bodies[i].state.ori[j] for j in (3, 0, 1, 2)])
        for i in (0, 1)
    ]
    contact = potential_particles.detect(particle, poses[0], particle, poses[1])
    made = shapes.cuboid((1, 1, 0.5))
    np.testing.assert_allclose(np.sort(made.particle.planes[:, 3]), np.sort(particle.planes[:, 3]), rtol=1e-6)
    assert hasattr(rock, "Domain") and callable(rock.bodies)
    import yade
    O.engines = [yade.InsertionSortCollider([yade.Bo1_ConicPP_Aabb()], verletDist=0), loop(yade)]
    O.step()
    geometry = O.interactions[0, 1].geom
    assert abs(geometry.penetrationDepth - contact.overlap) < 1e-9, (geometry.penetrationDepth, contact.overlap)
    print("both packages in", os.environ["PYTHONPATH"])


def loop(yade):
    return yade.InteractionLoop([yade.Ig2_ConicPP_ConicPP_ScGeom()], [yade.Ip2_FrictMat_FrictMat_FrictPhys()],
                                [yade.Law2_ScGeom_FrictPhys_CundallStrack()])


try:
    main()
except BaseException:
    traceback.print_exc()
    sys.stderr.flush()
    os._exit(1)
os._exit(0)
