# SPDX-License-Identifier: MIT OR Apache-2.0
"""Drake's hydroelastic contact on the cases of patches.py; run by the Python that has its wheel: `drake_patches.py
CASES SECONDS`.

A line of JSON for each case: for each resolution force, torque, torque from the middles of polygons, area, number of
polygons and seconds a pair. Copies of the case stand far from each other in one scene, and one query answers for all.
It ends with the surfaces and their pressures: forces are summed here, untimed.
"""

import json
import sys
import time

import numpy as np
from pydrake.common.eigen_geometry import Quaternion
from pydrake.geometry import (
    AddCompliantHydroelasticProperties,
    AddCompliantHydroelasticPropertiesForHalfSpace,
    AddRigidHydroelasticProperties,
    Box,
    FramePoseVector,
    GeometryFrame,
    GeometryInstance,
    HalfSpace,
    HydroelasticContactRepresentation,
    ProximityProperties,
    SceneGraph,
    Sphere,
)
from pydrake.math import RigidTransform

APART = np.array([16.0, 0.0, 0.0])
COPIES, COPIES_OF_FINE, FINE = 20, 2, 0.03
COARSE = 1.0  # where a shape has no resolution


class Scene:
    def __init__(self, case, hint):
        self.graph, self.about = SceneGraph(), np.array(case["about"])
        source = self.graph.RegisterSource("cases")
        # The ground is one for all copies.
        on_ground = case["bodies"][0][0] == "ground"
        self.copies = COPIES_OF_FINE if hint and hint < FINE else COPIES
        self.frames, self.pair_of = [], {}
        if on_ground:
            geometry = self.instance(case["bodies"][0], hint, "ground")
            self.graph.RegisterAnchoredGeometry(source, geometry)
        for copy in range(self.copies):
            for number, body in enumerate(case["bodies"]):
                if body[0] != "ground":
                    frame = self.graph.RegisterFrame(source, GeometryFrame(f"body {copy} {number}"))
                    identity = self.graph.RegisterGeometry(source, frame,
                                                           self.instance(body, hint, f"shape {copy} {number}"))
                    self.pair_of[identity.get_value()] = (copy, number)
                    self.frames.append((frame, copy, case["poses"][number]))
        self.context = self.graph.CreateDefaultContext()
        self.port, self.query = self.graph.get_source_pose_port(source), self.graph.get_query_output_port()
        self.poses = FramePoseVector()
        for frame, copy, (position, turn) in self.frames:
            turn = np.array(turn) / np.linalg.norm(turn)
            self.poses.set_value(frame, RigidTransform(Quaternion(turn), np.array(position) + copy * APART))

    @staticmethod
    def instance(body, hint, name):
        kind, size, modulus = body
        shape = {"ball": Sphere(size), "box": Box(*[2 * size or 1.0]
                                                  * 3), "ground": HalfSpace()}[kind] if size else HalfSpace()
        properties = ProximityProperties()
        if modulus is None:
            AddRigidHydroelasticProperties(properties)
        else:
            AddCompliantHydroelasticProperties(hint or COARSE, modulus, properties)
        instance = GeometryInstance(RigidTransform(), shape, name)
        instance.set_proximity_properties(properties)
        return instance

    def go(self):
        self.port.FixValue(self.context, self.poses)
        return self.query.Eval(self.context).ComputeContactSurfaces(HydroelasticContactRepresentation.kPolygon)

    def answer(self):
        """Of the first copy: force and torque on the upper body; the torque with the force of each polygon at its
        middle, as contacts are made of them; area, number of polygons.
        """
        for surface in self.go():
            first, second = (self.pair_of.get(one.get_value(), (None, 0)) for one in (surface.id_M(), surface.id_N()))
            if 0 not in (first[0], second[0]):
                continue
            # Normals point out of N into M.
            sign = 1.0 if first[1] == 1 else -1.0
            mesh, pressure = surface.poly_mesh_W(), surface.poly_e_MN()
            force, torque, at_middles = np.zeros(3), np.zeros(3), np.zeros(3)
            for i in range(mesh.num_faces()):
                middle, normal, polygon = np.array(
                    mesh.element_centroid(i)), sign * np.array(mesh.face_normal(i)), mesh.element(i)
                push = mesh.area(i) * pressure.EvaluateCartesian(i, middle) * normal
                force += push
                at_middles += np.cross(middle - self.about, push)
                corners = [np.array(mesh.vertex(polygon.vertex(j))) for j in range(polygon.num_vertices())]
                for second, third in zip(corners[1:], corners[2:]):
                    triangle = (corners[0], second, third)
                    area = 0.5 * abs(normal @ np.cross(second - corners[0], third - corners[0]))
                    for j in range(3):
                        # The middles of the sides: exact for a linear pressure times the arm.
                        point = 0.5 * (triangle[j] + triangle[j - 1])
                        torque += np.cross(point - self.about, area / 3 * pressure.EvaluateCartesian(i, point) * normal)
            return force.tolist(), torque.tolist(), at_middles.tolist(), mesh.total_area(), mesh.num_faces()
        return [0.0] * 3, [0.0] * 3, [0.0] * 3, 0.0, 0

    def seconds(self, least):
        """A pair, the fastest of several windows."""
        self.go()
        fastest = float("inf")
        for _ in range(10):
            begin, calls = time.perf_counter(), 0
            while not calls or time.perf_counter() - begin < 0.1 * least:
                self.go()
                calls += self.copies
            fastest = min(fastest, (time.perf_counter() - begin) / calls)
        return fastest


def main():
    for case in json.loads(sys.argv[1]):
        scenes = [Scene(case, hint) for hint in case["hints"]]
        print(json.dumps([[*scene.answer(), scene.seconds(float(sys.argv[2]))] for scene in scenes]), flush=True)


if __name__ == "__main__":
    main()
