# SPDX-License-Identifier: MIT OR Apache-2.0
"""A back end for compas_dem: its problem of a block model goes to YADE with contact patches, its Results come back.

    import backend
    results = backend.solve(problem)          # in the place of problem.solve()

compas_dem takes the names of its own solvers alone (Problem.solve), so that another one is called beside it. compas_dem
runs in an environment of its own, with its own numpy; YADE in another process, in the system's Python: blocks.py beside
this file. They talk by files.
"""
import json
import os
import subprocess
import tempfile
from pathlib import Path

import compas.geometry as cg
from compas_dem.analysis.resolve import resolve_centroidal_displacements, resolve_centroidal_loads
from compas_dem.interactions import EdgeContact, FrictionContact
from compas_dem.problem.results import Results

BLOCKS = Path(__file__).resolve().with_name("blocks.py")
GRAVITY = 9.81


def solve(problem, stiffness=1e10, rounding=0.002, rest=1e-4, longest=5.0, yade="yade"):
    """The Results of a Problem: how each block has moved when all are at rest, and the force in each joint.

    stiffness: of a joint per area, N/m^3. rounding: of edges and corners, m. rest: greatest unbalanced force over the
    mean force of the joints, at which the blocks are at rest. longest: seconds of the simulated time until then;
    RuntimeError where they are not at rest by then, as when they fall.
    """
    model, conditions = problem.model, problem.boundary_conditions
    problem._check_model_validity(model)
    if any(
            any(value) for one in resolve_centroidal_displacements(conditions).values() for part in one.values()
            for value in [part or []]):
        raise ValueError("prescribed displacements are not served: only loads, and supports that stay where they are")
    loads = resolve_centroidal_loads(model, conditions)
    friction = problem.contact_properties.contact_model
    if getattr(friction, "c", None) or getattr(friction, "t_c", None):
        raise ValueError("cohesion and tensile strength are not served: set c and t_c to 0")
    blocks = []
    for block in model.elements():
        vertices, _ = block.modelgeometry.to_vertices_and_faces()
        load = loads[block.graphnode]
        density = 1.0 if block.is_support and not block.material else block.material.density
        blocks.append({
            "node": block.graphnode, "vertices": [list(map(float, v)) for v in vertices],
            "fixed": bool(block.is_support), "density": density, "force": list(load["force"]),
            "moment": list(load["moment"])
        })
    task = {
        "blocks": blocks, "friction": friction.mu, "stiffness": stiffness, "rounding": rounding, "rest": rest,
        "longest": longest, "gravity": GRAVITY
    }
    with tempfile.TemporaryDirectory() as folder:
        given, found = Path(folder) / "task.json", Path(folder) / "answer.json"
        given.write_text(json.dumps(task))
        # The environment of compas_dem is none of YADE's.
        environment = {name: value for name, value in os.environ.items() if name not in ("VIRTUAL_ENV", "PYTHONHOME")}
        environment.update(TASK=str(given), ANSWER=str(found))
        ended = subprocess.run([yade, "-x", "-n", "-j1", BLOCKS], env=environment, capture_output=True, text=True)
        if not found.exists():
            raise RuntimeError(f"YADE ended without an answer: {(ended.stderr or ended.stdout).strip()[-500:]}")
        answer = json.loads(found.read_text())
    if answer["unbalanced"] > rest:
        raise RuntimeError(
            f"not at rest after {longest:g} s: unbalanced force {answer['unbalanced']:.1e} (rest={rest:g}), fastest block "
            f"{answer['fastest']:.1e} m/s; blocks that fall have no equilibrium")
    return _results(problem, model, answer)


def _results(problem, model, answer):
    results = Results(model_id=str(model.guid), problem_id=str(problem.guid))
    for block in answer["blocks"]:
        results.set_node(block["node"], "transformation", cg.Transformation(block["matrix"]))
    for joint in answer["joints"]:
        edge = tuple(joint["nodes"])
        corners, force = [cg.Point(*p) for p in joint["corners"]], cg.Vector(*joint["force"])
        point, normal = cg.Point(*joint["point"]), cg.Vector(*joint["normal"])
        frame = cg.Frame.from_plane(cg.Plane(point, normal))
        local = [force.dot(frame.xaxis), force.dot(frame.yaxis), force.dot(frame.zaxis)]
        is_face = len(corners) > 2
        results.set_edge(edge, "face_contact", is_face)
        results.set_edge(edge, "edge_contact", len(corners) == 2)
        results.set_edge(edge, "point_contact", len(corners) < 2)
        results.set_edge(edge, "contact_points", [list(p) for p in corners])
        results.set_edge(edge, "contact_frame", frame)
        # Of the whole joint at the centre of its pressure, on the first node of the edge.
        shares = [{
            "c_np": abs(local[2]) / max(len(corners), 1), "c_nn": 0.0, "c_u": local[0] / max(len(corners), 1),
            "c_v": local[1] / max(len(corners), 1)
        }] * len(corners)
        if is_face:
            results.set_edge(edge, "contact_polygon", cg.Polygon(corners))
            data = FrictionContact(points=corners, forces=shares)
            data._frame = frame
            results.set_edge(edge, "contact_data", data)
        elif len(corners) == 2:
            results.set_edge(edge, "contact_geometry", cg.Line(*corners))
            results.set_edge(edge, "contact_data", EdgeContact(points=corners, frame=frame, forces=shares))
        results.set_edge(edge, "force_point", point)
        results.set_edge(edge, "resultant_global", list(force))
        results.set_edge(edge, "resultant_local", local)
        results.set_edge(edge, "force_magnitude", force.length)
    results.metadata.update(mu=answer["friction"], seconds=answer["seconds"], steps=answer["steps"],
                            unbalanced=answer["unbalanced"])
    return results
