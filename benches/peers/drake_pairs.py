# SPDX-License-Identifier: MIT OR Apache-2.0
"""Drake on the pairs of pairs.py, by the protocol of rust/src/server.rs; run by the Python that has its wheel.

All pairs of a group are one scene, far from each other, and one query answers for all: it first looks which boxes meet.
Poses are set from Python, which is measured with it, less than a microsecond a body.
"""

import json
import sys
import time
from pathlib import Path

import numpy as np
from pydrake.common.eigen_geometry import Quaternion
from pydrake.geometry import Convex, FramePoseVector, GeometryFrame, GeometryInstance, ProximityProperties, SceneGraph
from pydrake.math import RigidTransform

sys.path.insert(0, str(Path(__file__).resolve().parent))
import pair_file

APART = np.array([16.0, 0.0, 0.0])  # from pair to pair, so that none meets another
MOST_PAIRS = 20


class Scene:
    def __init__(self, group):
        self.pairs = group.pairs[:MOST_PAIRS]
        self.graph = SceneGraph()
        source = self.graph.RegisterSource("pairs")
        shape, self.frames, self.pair_of = Convex(np.array(group.corners).T, "body"), [], {}
        for number in range(2 * len(self.pairs)):
            frame = self.graph.RegisterFrame(source, GeometryFrame(f"body {number}"))
            instance = GeometryInstance(RigidTransform(), shape, f"shape {number}")
            instance.set_proximity_properties(ProximityProperties())
            self.pair_of[self.graph.RegisterGeometry(source, frame, instance).get_value()] = number
            self.frames.append(frame)
        self.context = self.graph.CreateDefaultContext()
        self.poses = [self.placed(time) for time in range(len(self.pairs[0][1]))]
        self.port, self.query = self.graph.get_source_pose_port(source), self.graph.get_query_output_port()
        self.found = []

    def placed(self, time):
        """A FramePoseVector of all bodies at one of the poses."""
        poses = FramePoseVector()
        for number, (first, seconds) in enumerate(self.pairs):
            for frame, pose in zip(self.frames[2 * number : 2 * number + 2], (first, seconds[time])):
                turn = np.array(pose[3:]) / np.linalg.norm(pose[3:])
                poses.set_value(frame, RigidTransform(Quaternion(turn), np.array(pose[:3]) + number * APART))
        return poses

    def go(self, time):
        self.port.FixValue(self.context, self.poses[time])
        self.found = self.query.Eval(self.context).ComputePointPairPenetration()

    def seconds(self, least):
        """Of a call; the first walk is untimed, as in rust/src/server.rs."""
        last = len(self.poses) - 1
        walk = [*range(last + 1), *range(last - 1, 0, -1)]
        for one in walk:
            self.go(one)
        begin, calls = time.perf_counter(), 0
        while time.perf_counter() - begin < least or not calls:
            for one in walk:
                self.go(one)
            calls += len(walk) * len(self.pairs)
        return (time.perf_counter() - begin) / calls

    def answers(self):
        """[overlap, point, normal from A to B] of each pair, [] of those that are apart."""
        for one in range(len(self.poses)):
            self.go(one)
        answers = [[] for _ in self.pairs]
        for contact in self.found:
            body_a, body_b = (self.pair_of[one.get_value()] for one in (contact.id_A, contact.id_B))
            normal = -contact.nhat_BA_W if body_a < body_b else contact.nhat_BA_W
            point = 0.5 * (contact.p_WCa + contact.p_WCb) - body_a // 2 * APART
            answers[body_a // 2] = [contact.depth, *point.tolist(), *normal.tolist()]
        return answers


def main():
    groups, scenes = pair_file.read(sys.argv[1]), {}
    for line in sys.stdin:
        request, name, _, _, *least = line.split()
        if name not in scenes:
            scenes.clear()
            scenes[name] = Scene(groups[name])
        scene = scenes[name]
        answer = scene.seconds(float(least[0])) if request == "time" else scene.answers()
        print(f">{json.dumps(answer)}", flush=True)


if __name__ == "__main__":
    main()
