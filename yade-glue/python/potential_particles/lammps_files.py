# SPDX-License-Identifier: GPL-3.0-or-later
"""A scene of YADE as files for LAMMPS with this project's plugin (docs/lammps.md)."""
from functools import lru_cache
from pathlib import Path
from typing import NamedTuple

from . import lammps_joints, lammps_limits
from .arguments import number, positive
from .bodies import is_free, lasting
from .files import written
from .joints import given_by_engines

PARTICLES = ("ConicPotentialParticle", "PotentialParticle")
SCRIPT = """# Written by potential_particles.to_lammps: include it, or go on from here.
units si
atom_style sphere
newton off
comm_modify vel yes
boundary {boundary}
fix orientation all property/atom d2_orientation 4 writedata yes
{loads}read_data {name}.data fix orientation NULL orientation{load_rows}
fix shapes all potential/particle/shapes {name}.shapes {types}
pair_style potential/particle{style}
{law}{walls}group free type {free}
fix move free nve/potential/particle
{moving}{gravity}{pushing}neighbor {skin:.6g} bin
timestep {dt!r}
"""
# Lasting forces are numbers of each atom, as the data file has them.
LOADS = "fix loads all property/atom d2_load 3 writedata yes\n"
PUSHING = ("compute loads free property/atom d2_load[1] d2_load[2] d2_load[3]\n"
           + "".join(f"variable load{i} atom c_loads[{i}]\n" for i in (1, 2, 3))
           + "fix pushing free addforce v_load1 v_load2 v_load3\n")


def to_lammps(stem, normal_stiffness=None, shear_stiffness=None, friction=None, restitution=1.0, margin=1.0):
    """Writes the scene for LAMMPS: stem.shapes, stem.data, stem.lmp, and stem.stl if there are facets. Returns the
    paths.

    Potential particles become atoms, with positions, velocities, angular velocities and orientations as they are; those
    that no force moves are types of their own, which stay, or go on with the velocity that they have. Walls become
    planes, facets triangles, and go on so, too. Lasting forces are written.
    Other bodies, bodies of which some directions are blocked, and lasting torques: ValueError. Contacts begin without
    history. A scene with the law of joints keeps it, with what its materials and rock.joint_engine say, its
    patchTolerance and its bonds (walls make none), as they begin anew in their patches of
    now: a scene in which some joints have broken and others not, or bonds are damaged or open at an edge, is a
    ValueError, and shear in bonds a SceneWarning, as are damping and engines that move or load bodies. Of other laws,
    normal_stiffness, shear_stiffness (force/length), friction (a coefficient) and restitution (0.01 to 1) are those of
    all contacts, since YADE's laws take theirs from materials and radii in ways of their own. margin: of the box of
    LAMMPS about the bodies, in sizes of the scene; a periodic scene keeps its cell, which must be a box along the axes.
    """
    import yade
    given = given_by_engines(yade.O)
    joints = lammps_joints.settings(yade.O, given)
    if joints and not (normal_stiffness is None and shear_stiffness is None and friction is None):
        raise ValueError(
            "the scene has the law of joints, whose materials say stiffness and friction: leave normal_stiffness, shear_stiffness and friction out"
        )
    if not joints:
        if normal_stiffness is None or shear_stiffness is None or friction is None:
            raise ValueError(
                "normal_stiffness, shear_stiffness and friction are needed: those of YADE's laws come from materials and radii in ways of their own"
            )
        law = (positive(normal_stiffness, "normal_stiffness"), positive(shear_stiffness, "shear_stiffness"),
               number(friction, "friction"), number(restitution, "restitution"))
        if law[2] < 0 or not 0.01 <= law[3] <= 1:
            raise ValueError(
                f"friction={friction:g} must not be below 0, and restitution={restitution:g} must lie in [0.01, 1]")
    if given and not joints:
        raise ValueError(
            f"rock.joint_engine gives {len(given)} pairs of bodies numbers of their own, and with other laws than that of joints LAMMPS has one friction for all: "
            "take the law of joints, or the engine out of O.engines")
    stem = Path(stem)
    in_pairs = {one for pair in given for one in pair}
    kinds, rows, walls, facets = {}, [], {}, {}
    for body in yade.O.bodies:
        shape, state = body.shape, body.state
        name = type(shape).__name__
        if body.isClump or body.isClumpMember:
            raise ValueError(f"body {body.id} belongs to a clump: LAMMPS would take its members for single bodies")
        if name not in (*PARTICLES, "Wall", "Facet"):
            if shape is None:
                continue
            raise ValueError(
                f"body {body.id} is a {name}: only potential particles, walls and facets can go to LAMMPS; "
                "take shapes.sphere() for a Sphere, for instance")
        lammps_limits.require_motion(body, moves_freely=name in PARTICLES)
        velocity = tuple(map(float, state.vel))
        if name in PARTICLES:
            definition = (tuple(zip(*(map(float, column)
                                      for column in (shape.a, shape.b, shape.c, shape.d)))), shape.r, shape.k, shape.R)
            free = is_free(body)
            kind = Kind(definition, state.mass / _volume(definition), free, None if free else velocity,
                        body.mat.id if joints else None, body.id if body.id in in_pairs else None)
            rows.append((kinds.setdefault(kind, len(kinds) + 1), body))
        elif name == "Wall":
            normal = [0, 0, 0]
            normal[shape.axis] = 1
            walls.setdefault(velocity, []).append(
                (body.mat, "plane " + " ".join(map(repr, [*map(float, state.pos), *normal]))))
        else:
            facets.setdefault(velocity, []).append(
                (body.mat, [state.pos + state.ori * vertex for vertex in shape.vertices]))
    if not rows:
        raise ValueError("there is no potential particle in the scene")
    paths = [stem.with_name(stem.name + end) for end in (".shapes", ".data", ".lmp")]
    _write_shapes(paths[0], kinds)
    loaded = any(lasting(yade.O.forces.permF, body).norm() > 0 for _, body in rows)
    boundary = _write_data(paths[1], rows, len(kinds), margin, loaded)
    boundaries = [(group[0][0], name, " ".join(text for _, text in group) + motion)
                  for name, motion, group in _by_velocity("walls", walls)]
    for name, motion, group in _by_velocity("facets", facets):
        paths.append(stem.with_name(stem.name + name.removeprefix("facets") + ".stl"))
        _write_stl(paths[-1], [triangle for _, triangle in group])
        boundaries.append((group[0][0], name, f"stl {paths[-1].name}{motion}"))
    if joints:
        if any(
                len({material.id
                     for group in groups.values()
                     for material, _ in group}) > 1 for groups in (walls, facets)):
            raise ValueError(
                "walls, or facets, have several materials: one fix of LAMMPS has one; give them the same ConicJointMat")
        style, coefficients, commands = _joint_commands(joints, kinds, boundaries, given)
    else:
        style, numbers = "", " ".join(map(repr, law))
        coefficients = f"pair_coeff * * {numbers}\n"
        commands = "".join(f"fix {name} all wall/potential/particle {numbers} {what}\n" for _, name, what in boundaries)
    lammps_limits.warn_of_engines(yade.O)
    gravity = next((engine.gravity for engine in yade.O.engines if type(engine).__name__ == "NewtonIntegrator"),
                   yade.Vector3.Zero)
    size = min(_volume(kind.definition) for kind in kinds) ** (1 / 3)
    script = SCRIPT.format(
        name=stem.name, boundary=boundary, style=style, law=coefficients, walls=commands, dt=float(yade.O.dt),
        skin=0.2 * size, types=" ".join(f"type {n} shape{n} {kind.density!r}" for kind, n in kinds.items()),
        free=" ".join(str(n) for kind, n in kinds.items() if kind.free) or "0", moving=_moving(kinds),
        loads=LOADS if loaded else "", load_rows=" fix loads NULL loads" if loaded else "",
        pushing=PUSHING if loaded else "",
        gravity=f"fix weight free gravity {gravity.norm()!r} vector {_text(gravity)}\n" if gravity.norm() > 0 else "")
    with written(paths[2], text=True) as file:
        file.write(script)
    return paths


def _by_velocity(name, groups):
    """(name, how it moves, its members) of walls or facets of one velocity each."""
    letters = iter("abcdefghijklmnopqrstuvwxyz")
    if len(groups) > 26:
        raise ValueError(
            f"{name} have {len(groups)} velocities: LAMMPS has a fix for each, and no more than 26 are written")
    for velocity, group in groups.items():
        moves = any(velocity)
        yield (f"{name}_moving_{next(letters)}" if moves else name), (f" linear {_text(velocity)}"
                                                                      if moves else ""), group


def _moving(kinds):
    """Commands for bodies that no force moves and that have a velocity."""
    types = {}
    for kind, n in kinds.items():
        if kind.velocity and any(kind.velocity):
            types.setdefault(kind.velocity, []).append(str(n))
    if len(types) > 20:
        raise ValueError(
            f"bodies that no force moves have {len(types)} velocities: LAMMPS has a group for each, and no more than 20 are written"
        )
    return "".join(f"group held{i} type {' '.join(its)}\nfix held{i} held{i} move linear {_text(velocity)}\n"
                   for i, (velocity, its) in enumerate(types.items(), 1))


def _joint_commands(joints, kinds, boundaries, given):
    """Words after the pair style, pair_coeff of all types, and fixes of the walls, one for the types of one law."""
    import yade
    tolerance, bonds, whole, whole_at_walls = joints
    types = [(n, yade.O.materials[kind.material], _radius(kind.definition), kind.body) for kind, n in kinds.items()]
    style = f" patch {tolerance!r} whole {whole}" + (" bonds yes" if bonds else "")
    coefficients = "".join(
        f"pair_coeff {n} {m} {lammps_joints.law(one, other, (radius, its), given=given.get((min(a, b), max(a, b))) if a is not None and b is not None else None)}\n"
        for n, one, radius, a in types for m, other, its, b in types if n <= m)
    commands = ""
    for material, name, what in boundaries:
        laws = {}
        for n, own, radius, _ in types:
            laws.setdefault(lammps_joints.law(own, material, (radius, radius), of_wall=True), []).append(str(n))
        for number_, (words, its) in enumerate(laws.items(), 1):
            commands += f"group at_{name}{number_} type {' '.join(its)}\n"
            commands += f"fix {name}{number_} at_{name}{number_} wall/potential/particle {words} {what} patch {tolerance!r} whole {whole_at_walls}\n"
    return style, coefficients, commands


class Kind(NamedTuple):
    """What atoms of one type share. velocity: of bodies that no force moves; body: its id where rock.joint_engine gives
    it joints of their own.
    """

    definition: tuple
    density: float
    free: bool
    velocity: tuple
    material: int
    body: int


@lru_cache(maxsize=None)
def _radius(definition):
    from yade.wrapper import ConicPotentialParticle
    planes, r, k, R = definition
    return ConicPotentialParticle(planes=list(planes), r=r, k=k, R=R).boundingRadius


@lru_cache(maxsize=None)
def _volume(definition):
    from yade.wrapper import ConicPotentialParticle
    planes, r, k, R = definition
    return ConicPotentialParticle(planes=list(planes), r=r, k=k, R=R).massProperties()[0]


def _write_shapes(path, kinds):
    with written(path, text=True) as file:
        for kind, n in kinds.items():
            planes, r, k, R = kind.definition
            file.write(f"shape shape{n}\nr {r!r}\nk {k!r}\nR {R!r}\n")
            file.writelines(f"plane {_text(row)}\n" for row in planes)
            file.write("end\n")


def _text(values):
    return " ".join(repr(float(x)) for x in values)


def _write_data(path, rows, types, margin, loaded):
    import yade
    if yade.O.periodic:
        size = yade.O.cell.size
        if (yade.O.cell.hSize - yade.Matrix3(size[0], 0, 0, 0, size[1], 0, 0, 0, size[2])).norm() > 1e-12 * size.norm():
            raise ValueError("the periodic cell is not a box along the axes: a triclinic box of LAMMPS is not written")
        low, high, boundary = yade.Vector3.Zero, size, "p p p"
    else:
        from .measures import extrema
        low, high = extrema()
        space = yade.Vector3.Ones * (margin * (high - low).norm())
        low, high, boundary = low - space, high + space, "f f f"
    with written(path, text=True) as file:
        file.write(f"a scene of YADE, step {yade.O.iter}\n\n{len(rows)} atoms\n{types} atom types\n"
                   + "".join(f"{l!r} {h!r} {axis}lo {axis}hi\n"
                             for axis, l, h in zip("xyz", map(float, low), map(float, high))))
        # The diameter and density are replaced by those of the shape.
        states = [body.state for _, body in rows]
        file.write("\nAtoms # sphere\n\n" + "".join(
            f"{i} {kind} 1.0 1.0 {_text(yade.O.cell.wrap(body.state.pos) if yade.O.periodic else body.state.pos)}\n"
            for i, (kind, body) in enumerate(rows, 1)))
        file.write("\nVelocities\n\n" + "".join(f"{i} {_text(state.vel)} {_text(state.angVel)}\n"
                                                for i, state in enumerate(states, 1)))
        file.write("\norientation\n\n" + "".join(f"{i} {_text([state.ori[n] for n in (3, 0, 1, 2)])}\n"
                                                 for i, state in enumerate(states, 1)))
        if loaded:
            file.write("\nloads\n\n" + "".join(f"{i} {_text(lasting(yade.O.forces.permF, body))}\n"
                                               for i, (_, body) in enumerate(rows, 1)))
    return boundary


def _write_stl(path, facets):
    with written(path, text=True) as file:
        file.write("solid facets\n")
        for facet in facets:
            file.write("facet normal 0 0 0\nouter loop\n" + "".join(f"vertex {_text(vertex)}\n"
                                                                    for vertex in facet) + "endloop\nendfacet\n")
        file.write("endsolid facets\n")
