# SPDX-License-Identifier: GPL-3.0-or-later
"""What LAMMPS cannot take of a scene: refused where bodies would move otherwise from the start, warned of where a
script can act.
"""
from . import arguments
from .bodies import is_free, lasting


def warn(text):
    arguments.warn(f"to_lammps: {text}")


def require_motion(body, moves_freely):
    """ValueError for a body that LAMMPS cannot move as YADE does. moves_freely: not so for walls and facets."""
    import yade
    state = body.state
    if moves_freely and is_free(body) and state.blockedDOFs:
        raise ValueError(
            f"body {body.id} has blockedDOFs='{state.blockedDOFs}': LAMMPS moves a body in all directions or in none; block all of them, or none"
        )
    if not (moves_freely and is_free(body)) and state.angVel.norm() > 0:
        raise ValueError(
            f"body {body.id} is held and turns with angVel={tuple(state.angVel)}: such bodies move along lines alone in what is written; set angVel to 0 here, and give "
            "the fix in LAMMPS 'rotate', for a wall or a mesh")
    if moves_freely and lasting(yade.O.forces.permT, body).norm() > 0:
        raise ValueError(
            f"body {body.id} has a lasting torque: LAMMPS has none for single bodies; take it off by O.forces.setPermT")


def warn_of_engines(scene):
    """Warns of damping, of engines that move or load bodies, and of a cell that deforms."""
    import yade
    # What a script sets is the next one until a step is made.
    if scene.periodic and max(scene.cell.velGrad.norm(), scene.cell.nextVelGrad.norm()) > 0:
        warn(
            "the periodic cell deforms, and that of LAMMPS stays as it is: add 'fix deform' to the script that is written"
        )
    for engine in scene.engines:
        if engine.dead:
            continue
        name = type(engine).__name__
        if name == "NewtonIntegrator" and engine.damping != 0:
            warn(
                f"NewtonIntegrator(damping={engine.damping:g}): LAMMPS has no such damping, and bodies move without it; give restitution below 1 in its place, and damping=0"
            )
        elif isinstance(
                engine,
            (yade.PartialEngine, yade.BoundaryController, yade.FieldApplier)) and name != "NewtonIntegrator":
            warn(
                f"{name} is not written: what it does to bodies from now on is missing in LAMMPS; add it to the script that is written"
            )
