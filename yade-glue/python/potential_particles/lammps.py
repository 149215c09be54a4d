# SPDX-License-Identifier: GPL-3.0-or-later
"""A scene of YADE as files for LAMMPS with this project's plugin (docs/lammps.md)."""
from functools import lru_cache
from pathlib import Path

from . import lammps_joints
from .arguments import number, positive
from .bodies import is_free

PARTICLES = ("ConicPotentialParticle", "PotentialParticle")
SCRIPT = """# Written by potential_particles.to_lammps: include it, or go on from here.
units si
atom_style sphere
newton off
comm_modify vel yes
boundary {boundary}
fix orientation all property/atom d2_orientation 4 writedata yes
read_data {name}.data fix orientation NULL orientation
fix shapes all potential/particle/shapes {name}.shapes {types}
pair_style potential/particle{style}
{law}{walls}group free type {free}
fix move free nve/potential/particle
{gravity}neighbor {skin:.6g} bin
timestep {dt!r}
"""


def to_lammps(stem, normal_stiffness=None, shear_stiffness=None, friction=None, restitution=1.0, margin=1.0):
    """Writes the scene for LAMMPS: stem.shapes, stem.data, stem.lmp, and stem.stl if there are facets. Returns the paths.

    Potential particles become atoms, with positions, velocities, angular velocities and orientations as they are; those that no force moves are types
    of their own, which stay. Walls become planes, facets triangles. Other bodies: ValueError. Contacts begin without history. A scene with the law of
    joints keeps it, with what its materials say, its patchTolerance and its bonds (walls make none). Of other laws, normal_stiffness, shear_stiffness (force/length),
    friction (a coefficient) and restitution (0.01 to 1) are those of all contacts, since YADE's laws take theirs from
    materials and radii in ways of their own. margin: of the box of LAMMPS about the bodies, in sizes of the scene; a
    periodic scene keeps its cell, which must be a box along the axes.
    """
    import yade
    joints = lammps_joints.settings(yade.O)
    if joints and not (normal_stiffness is None and shear_stiffness is None and friction is None):
        raise ValueError("the scene has the law of joints, whose materials say stiffness and friction: leave normal_stiffness, shear_stiffness and friction out")
    if not joints:
        if normal_stiffness is None or shear_stiffness is None or friction is None:
            raise ValueError("normal_stiffness, shear_stiffness and friction are needed: those of YADE's laws come from materials and radii in ways of their own")
        law = (positive(normal_stiffness, "normal_stiffness"), positive(shear_stiffness, "shear_stiffness"), number(friction, "friction"),
               number(restitution, "restitution"))
        if law[2] < 0 or not 0.01 <= law[3] <= 1:
            raise ValueError(f"friction={friction:g} must not be below 0, and restitution={restitution:g} must lie in [0.01, 1]")
    stem = Path(stem)
    kinds, rows, walls, facets = {}, [], [], []
    for body in yade.O.bodies:
        shape = body.shape
        name = type(shape).__name__
        if name in PARTICLES:
            definition = (tuple(zip(*(map(float, column) for column in (shape.a, shape.b, shape.c, shape.d)))), shape.r, shape.k, shape.R)
            kind = (definition, body.state.mass / _volume(definition), is_free(body), body.mat.id if joints else None)
            rows.append((kinds.setdefault(kind, len(kinds) + 1), body.state))
        elif name == "Wall":
            normal = [0, 0, 0]
            normal[shape.axis] = 1
            walls.append((body.mat, "plane " + " ".join(map(repr, [*map(float, body.state.pos), *normal]))))
        elif name == "Facet":
            facets.append((body.mat, [body.state.pos + body.state.ori * vertex for vertex in shape.vertices]))
        elif not body.isClump and shape is not None:
            raise ValueError(f"body {body.id} is a {name}: only potential particles, walls and facets can go to LAMMPS; "
                             "take shapes.sphere() for a Sphere, for instance")
        if body.isClump or body.isClumpMember:
            raise ValueError(f"body {body.id} belongs to a clump: LAMMPS would take its members for single bodies")
    if not rows:
        raise ValueError("there is no potential particle in the scene")
    paths = [stem.with_name(stem.name + end) for end in (".shapes", ".data", ".lmp")]
    _write_shapes(paths[0], kinds)
    boundary = _write_data(paths[1], rows, len(kinds), margin)
    boundaries = [(walls and walls[0][0], "walls", " ".join(text for _, text in walls))] if walls else []
    if facets:
        paths.append(stem.with_name(stem.name + ".stl"))
        _write_stl(paths[-1], [triangle for _, triangle in facets])
        boundaries.append((facets[0][0], "facets", f"stl {paths[-1].name}"))
    if joints:
        if len({material.id for material, _ in walls}) > 1 or len({material.id for material, _ in facets}) > 1:
            raise ValueError("walls, or facets, have several materials: one fix of LAMMPS has one; give them the same ConicJointMat")
        style, coefficients, commands = _joint_commands(joints, kinds, boundaries)
    else:
        style, numbers = "", " ".join(map(repr, law))
        coefficients = f"pair_coeff * * {numbers}\n"
        commands = "".join(f"fix {name} all wall/potential/particle {numbers} {what}\n" for _, name, what in boundaries)
    gravity = next((engine.gravity for engine in yade.O.engines if type(engine).__name__ == "NewtonIntegrator"), yade.Vector3.Zero)
    size = min(_volume(definition) for definition, *_ in kinds) ** (1 / 3)
    paths[2].write_text(SCRIPT.format(
        name=stem.name, boundary=boundary, style=style, law=coefficients, walls=commands, dt=float(yade.O.dt), skin=0.2 * size,
        types=" ".join(f"type {n} shape{n} {density!r}" for (_, density, *_), n in kinds.items()),
        free=" ".join(str(n) for (_, _, free, _), n in kinds.items() if free) or "0",
        gravity=f"fix weight free gravity {gravity.norm()!r} vector {_text(gravity)}\n" if gravity.norm() > 0 else ""))
    return paths


def _joint_commands(joints, kinds, boundaries):
    """Words after the pair style, pair_coeff of all types, and fixes of the walls, one for the types of one law."""
    import yade
    tolerance, bonds, whole = joints
    types = [(n, yade.O.materials[material], _radius(definition)) for (definition, _, _, material), n in kinds.items()]
    style = f" patch {tolerance!r} whole {whole}" + (" bonds yes" if bonds else "")
    coefficients = "".join(f"pair_coeff {n} {m} {lammps_joints.law(one, other, (radius, its))}\n"
                           for n, one, radius in types for m, other, its in types if n <= m)
    commands = ""
    for material, name, what in boundaries:
        laws = {}
        for n, own, radius in types:
            laws.setdefault(lammps_joints.law(own, material, (radius, radius), of_wall=True), []).append(str(n))
        for number_, (words, its) in enumerate(laws.items(), 1):
            commands += f"group at_{name}{number_} type {' '.join(its)}\n"
            commands += f"fix {name}{number_} at_{name}{number_} wall/potential/particle {words} {what} patch {tolerance!r} whole {whole}\n"
    return style, coefficients, commands


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
    with open(path, "w") as file:
        for ((planes, r, k, R), *_), n in kinds.items():
            file.write(f"shape shape{n}\nr {r!r}\nk {k!r}\nR {R!r}\n")
            file.writelines(f"plane {_text(row)}\n" for row in planes)
            file.write("end\n")


def _text(values):
    return " ".join(repr(float(x)) for x in values)


def _write_data(path, rows, types, margin):
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
    with open(path, "w") as file:
        file.write(f"a scene of YADE, step {yade.O.iter}\n\n{len(rows)} atoms\n{types} atom types\n"
                   + "".join(f"{l!r} {h!r} {axis}lo {axis}hi\n" for axis, l, h in zip("xyz", map(float, low), map(float, high))))
        # The diameter and density are replaced by those of the shape.
        file.write("\nAtoms # sphere\n\n" + "".join(f"{i} {kind} 1.0 1.0 {_text(yade.O.cell.wrap(state.pos) if yade.O.periodic else state.pos)}\n"
                                                   for i, (kind, state) in enumerate(rows, 1)))
        file.write("\nVelocities\n\n" + "".join(f"{i} {_text(state.vel)} {_text(state.angVel)}\n" for i, (_, state) in enumerate(rows, 1)))
        file.write("\norientation\n\n" + "".join(f"{i} {_text([state.ori[n] for n in (3, 0, 1, 2)])}\n" for i, (_, state) in enumerate(rows, 1)))
    return boundary


def _write_stl(path, facets):
    with open(path, "w") as file:
        file.write("solid facets\n")
        for facet in facets:
            file.write("facet normal 0 0 0\nouter loop\n" + "".join(f"vertex {_text(vertex)}\n" for vertex in facet) + "endloop\nendfacet\n")
        file.write("endsolid facets\n")
