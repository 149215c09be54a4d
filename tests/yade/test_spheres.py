# SPDX-License-Identifier: GPL-3.0-or-later
# threads
# The import of potential_particles leaves YADE as it is: a scene without potential particles may do all that it may do
# without the plugin, while O.run() steps too. (protect_runs(), which refuses some of that: test_outside.py.)
import builtins
import time

import yade
import yade.wrapper
from yade import utils


def attributes():
    """Of every class of YADE, and of its module of functions."""
    classes = {name: one for name, one in vars(yade.wrapper).items() if isinstance(one, type)}
    return {(name, key): value
            for name, one in [*classes.items(), ("utils", utils)]
            for key, value in vars(one).items()}


before = attributes()
import potential_particles
from harness import *

check = Checks()
ours = potential_particles._glue.class_names
replaced = {name for name, value in attributes().items() if before.get(name) is not value and name[0] not in ours}
expected = {"Body": ["shape"], "BodyContainer": ["append", "clump", "appendClumped"], "Omega": ["run", "step", "load"],
            "PotentialParticle": ["a", "b", "c", "d", "vertices", "updateAttrs"]}
check.equal(replaced, {(name, one) for name, parts in expected.items() for one in parts},
            "what the import replaces or adds")

# Spheres that fall on each other, while the prompt makes bodies that it does not add.
O.engines = [yade.ForceResetter(), yade.InsertionSortCollider([yade.Bo1_Sphere_Aabb()]),
             yade.InteractionLoop([yade.Ig2_Sphere_Sphere_ScGeom()], [yade.Ip2_FrictMat_FrictMat_FrictPhys()],
                                  [yade.Law2_ScGeom_FrictPhys_CundallStrack()]),
             yade.NewtonIntegrator(gravity=(0, 0, -9.81), damping=0.3)]
O.bodies.append([utils.sphere((0, 0, 0), 0.5, fixed=True)] + [utils.sphere((0, 0, z), 0.5) for z in (1.01, 2.02)])
O.dt = 0.1 * utils.PWaveTimeStep()
O.run()
for i in range(500):
    body = utils.sphere((0, 0, 10 + i), 0.5)
    body.shape = yade.Sphere(radius=0.25)
check.equal((body.shape.radius, O.running), (0.25, True), "bodies that are in no scene are made while it steps")
deadline = time.monotonic() + 60
while O.iter <= 10 and time.monotonic() < deadline:
    time.sleep(0.001)
halt()
check.true(O.iter > 10 and len(O.bodies) == 3, f"{O.iter} steps")

# Whatever no engine is reading may be changed in the midst of a step: this one does nothing but wait.
O.reset()
builtins.rest = lambda: time.sleep(0.005)
O.engines = [yade.PyRunner(command="rest()", iterPeriod=1, initRun=True)]
O.run()
ids = O.bodies.append([utils.sphere((2 * i, 0, 0), 0.5) for i in range(4)])
O.bodies[ids[0]].shape = yade.Sphere(radius=0.75)
check.true(O.bodies.erase(ids[3]), "a body is erased")
O.bodies.clump(ids[1:3])
O.interactions.clear()
check.equal((len([b for b in O.bodies]), O.bodies[ids[0]].shape.radius, O.running), (4, 0.75, True),
            "changed while it steps")
O.bodies.clear()
check.equal((len(O.bodies), O.running), (0, True), "and emptied")
halt()
check.true(not O.running, "and halted")

check.finish()
