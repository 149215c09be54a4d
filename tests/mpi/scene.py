# SPDX-License-Identifier: GPL-3.0-or-later
"""One run of a small scene on the ranks that mpirun started; tests/mpi/test_mpi.py starts it and judges the results.

The case is the first argument, a folder the second. Cubes lie on a floor and on each other, slide against each other in
three rows, and are pushed together along x: there are contacts across the borders of workers at all times, but too
little time passes for rounding to grow.
"""
import json
import os
import resource
import sys
from pathlib import Path

# The folder of this script is not on Python's path in YADE; that of harness.py is given by test_mpi.py.
import numpy as np
import potential_particles  # noqa: F401 (a saved scene holds its classes)
import yade
from harness import add, cube, engine_of, fresh_scene, joint_scene, turned
from potential_particles import mpi
from potential_particles.mpi import stepping
from yade import O, Vector3

SIZE, STEPS, VERLET = 1.0, 400, 0.05
CASE, FOLDER = sys.argv[1], Path(sys.argv[2])


def build(gap=0.0, wall=False):
    """A floor, or a wall in its place, and 4 x 3 x 3 cubes above it, of which each touches some; ids of the cubes."""
    contact = yade.Ig2_ConicPP_ConicPP_ScGeom(calContactArea=False)
    fresh_scene(contact, dt=1e-3, damping=0.1, gravity=(0, 0, -9.81), stiffness=1e6, friction=0.5)
    if wall:
        engine_of(yade.InteractionLoop).geomDispatcher.functors = [
            contact, yade.Ig2_Wall_ConicPP_ScGeom(calContactArea=False)
        ]
        collider = engine_of(yade.InsertionSortCollider)
        collider.boundDispatcher.functors = collider.boundDispatcher.functors + [yade.Bo1_Wall_Aabb()]
        O.bodies.append(yade.utils.wall(0.0, axis=2))
    else:
        add(floor(), (0, 0, -0.5), fixed=True)
    ids, draw = [], np.random.default_rng(7)
    for x in range(4):
        for y in range(3):
            for z in range(3):
                place = Vector3(x - 1.5 + (gap if x > 1 else 0.0), y - 1.0, z + 0.5) * 0.99 * SIZE
                turn = turned(Vector3(*draw.normal(size=3)), 0.03)
                number = add(cube(), place, turn)
                O.bodies[number].state.vel = Vector3(0.5 * (y - 1.0) - 0.5 * place[0], 0.0, 0.0)
                ids.append(number)
    return ids


def build_joints():
    """4 x 3 x 3 cubes on a fixed row of others, bonded where they touch, that are pulled apart along x and pressed
    down: some bonds break.
    """
    O.reset()
    material = yade.ConicJointMat(normalStiffness=1e7, shearStiffness=5e6, frictionAngle=0.5, restitution=0.5,
                                  density=2000.0, cohesion=4e4, tensileStrength=3e4, softening=2e-3)
    joint_scene(yade.InteractionLoop, material, 0.0, (0, 0, -9.81), False, 5e-4, bonds=True)
    shape, edge = dict(r=0.02, k=0.0), SIZE - 1e-4
    add(floor(), (0, 0, -0.5), fixed=True)
    ids = []
    for x in range(4):
        for y in range(3):
            for z in range(3):
                number = add(cube(**shape), Vector3((x - 1.5) * edge, (y - 1.0) * edge, (z + 0.5) * edge))
                O.bodies[number].state.vel = Vector3(0.17 * (x - 1.5) * (1 + 0.3 * z), 0.1 * (y - 1), 0.0)
                ids.append(number)
    return ids


def floor():
    planes = [(1, 0, 0, 15), (-1, 0, 0, 15), (0, 1, 0, 15), (0, -1, 0, 15), (0, 0, 1, 0.25), (0, 0, -1, 0.25)]
    return yade.ConicPotentialParticle(planes=planes, r=0.25, k=1e-4, R=22.0)


def ids():
    return range(1, 37)


def result(name, **more):
    """What the judge reads: states, counters, and who had what."""
    states = mpi.states(ids())
    counters, failures = mpi.counters(), mpi.failures()
    parts = mpi.gather([len(mpi.owned_bodies()), len(mpi.owned_contacts())])
    if mpi.rank() == 0:
        np.savez(FOLDER / f"{name}.npz", **states)
        report = {"step": O.iter, "parts": parts, "counters": counters, "failures": failures, **more}
        (FOLDER / f"{name}.json").write_text(json.dumps(report))


def start(**more):
    if mpi.rank() == 0:
        mine = build(**more)
        mpi.safe_boxes(VERLET)
        mpi.divide(mine)
    mpi.run(0, reallocate=1)


def joints():
    """The same of bonds and joints."""
    whole(build_joints, "joints")


def bonds():
    """How many there are, of all ranks, and how many joints have broken."""
    mine = [contact.phys for contact in mpi.owned_contacts() if isinstance(contact.phys, yade.ConicJointPhys)]
    parts = mpi.gather([sum(phys.bonded for phys in mine), sum(phys.broken for phys in mine)])
    return [sum(part[i] for part in parts or []) for i in (0, 1)]


def whole(build=build, name="whole"):
    """All steps, with a save in the middle, after which the run goes on. The last worker begins with too many cubes."""
    if mpi.rank() == 0:
        mine = build()
        mpi.safe_boxes(VERLET)
        mpi.divide(mine)
        for number in mine[9:18] if mpi.ranks() > 2 else []:
            O.bodies[number].subdomain = mpi.ranks() - 1
    across, bonded = 0, []
    for look in range(4):
        mpi.run(STEPS // 4, reallocate=1)
        across += contacts_across()
        bonded.append(bonds())
        if look == 1:
            saved = FOLDER / f"{name}_half{mpi.ranks()}.yade.gz"
            mpi.save(saved)
            full = full_disk(saved)
    result(f"{name}{mpi.ranks()}", across=across, bonds=bonded, full=full)


def full_disk(file):
    """What a save there says where no file may have a byte, of each rank; and whether the file stays as it is. The run
    goes on.
    """
    mpi.gather(None)
    content, told = file.read_bytes(), "nothing"
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (0, before[1]))
    try:
        mpi.save(file)
    except OSError as error:
        told = str(error)
    resource.setrlimit(resource.RLIMIT_FSIZE, before)
    return mpi.gather([told, file.read_bytes() == content])


def contacts_across():
    """Between bodies of two workers, of all ranks."""
    mine = sum(
        min(O.bodies[c.id1].subdomain, O.bodies[c.id2].subdomain) not in (0, mpi.rank()) for c in mpi.owned_contacts())
    return sum(mpi.gather(mine) or [])


def resumed():
    """The second half, from the file that a run of the case `whole`, `joints` or `killed` (fourth argument) with as
    many ranks as the third says has saved.
    """
    if mpi.rank() == 0:
        mpi.load(FOLDER / f"{sys.argv[4]}_half{sys.argv[3]}.yade.gz")
        mpi.divide(ids())
    mpi.run(STEPS - STEPS // 2)
    result(f"{sys.argv[4]}_resumed{mpi.ranks()}_of_{sys.argv[3]}", bonds=bonds())


def apart():
    """The two halves of the scene lie far from each other: YADE's own exchange aborts here."""
    start(gap=8.0, wall=True)
    mpi.run(50)
    calls = mpi.gather([functor.calls for functor in engine_of(yade.InteractionLoop).geomDispatcher.functors])
    result(f"apart{mpi.ranks()}", calls=calls)


def recorders():
    """YADE's recorder on every rank."""
    if mpi.rank() == 0:
        mine = build()
        mpi.safe_boxes(VERLET)
        name = str(FOLDER / "own-")
        O.engines += [yade.PotentialParticleVTKRecorder(fileName=name, iterPeriod=5, sampleX=4, sampleY=4, sampleZ=4)]
        mpi.divide(mine)
    mpi.run(10)
    mpi.gather(None)


def say_pid():
    """For test_mpi.py, which reads the file as soon as it is there."""
    unfinished = FOLDER / f"part{mpi.rank()}"
    unfinished.write_text(str(os.getpid()))
    unfinished.rename(FOLDER / f"pid{mpi.rank()}")


def killed():
    """Saves, says so, and steps until it is ended."""
    start()
    mpi.run(20)
    mpi.save(FOLDER / "killed.yade.gz")
    say_pid()
    for _ in range(10_000):
        mpi.run(50)


def interrupted():
    """Steps until it is asked to stop."""
    start()
    say_pid()
    for _ in range(10_000):
        mpi.run(10)
        if mpi.interrupted():
            break
    result("interrupted")


def raising():
    """One worker fails while the others step."""
    start()
    mpi.run(10)
    if mpi.rank() == mpi.ranks() - 1:
        raise RuntimeError("this worker has had enough")
    mpi.run(10)


def raising_in_step():
    """One worker's step fails."""
    start()
    if mpi.rank() == 1:
        O.engines += [yade.PyRunner(iterPeriod=1, firstIterRun=5, command="1 / 0")]
    mpi.run(10)


def refusals():
    """What rank 0 is told before anything is divided: more workers than bodies, no margin, a free body that was left
    over.
    """
    if mpi.rank() == 0:
        mine, said = build(), []
        for attempt in (lambda: mpi.divide(mine[:1]), lambda: mpi.safe_boxes(0.0), lambda: left_over(mine)):
            try:
                attempt()
            except ValueError as error:
                said.append(str(error))
        (FOLDER / "refusals.json").write_text(json.dumps(said))


def left_over(mine):
    mpi.divide(mine[:-1])
    stepping._check_division()


mpi.launch(globals()[CASE])
