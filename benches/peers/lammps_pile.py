# SPDX-License-Identifier: MIT OR Apache-2.0
"""The pile of pyramids as rounded polyhedra of LAMMPS's BODY package: its files, its run, and what its log says. SI
units, z up.

The units are called lj, in which LAMMPS converts nothing. Damping and friction are as near to those of the others as
the style allows: friction has no memory there, so that bodies creep, and the force at several corners of a contact adds
up.
"""

import re
import subprocess

import numpy as np
from scipy.spatial.transform import Rotation

NEIGHBOUR_SKIN = 0.01  # m
NUMBERS = re.compile(r"\s*(?:-?\d[-+.\de]*\s*){4}")  # a line of the log's tables


class Pile:
    """core: a Polyhedron; faces: lists of corners, in order; all lengths in m."""

    def __init__(self, core, faces, rounding, mass, inertia, laws):
        """laws: stiffness, damping along and across the normal, friction, gravity, time step."""
        self.core, self.faces, self.rounding = core, faces, rounding
        self.mass, self.inertia, self.laws = mass, inertia, laws

    def write(self, folder, states, box):
        """data.pile: bodies at `states` (pos, ori w x y z, vel, angVel); box: half width and height."""
        half, height = box
        lines = ["pyramids", f"{len(states['pos'])} atoms", f"{len(states['pos'])} bodies", "1 atom types"]
        lines += [f"{-half!r} {half!r} {axis}lo {axis}hi"
                  for axis in "xy"] + [f"-0.1 {2.0 * height!r} zlo zhi", "", "Atoms", ""]
        for number, position in enumerate(states["pos"].tolist()):
            lines.append(f"{number + 1} 1 1 {self.mass!r} " + " ".join(map(repr, position)))
        lines += ["", "Bodies", ""]
        for number, (w, x, y, z) in enumerate(states["ori"]):
            lines += self._body(number + 1, Rotation.from_quat((x, y, z, w)).as_matrix())
        lines += ["", "Velocities", ""]
        spins = self._angular_momenta(states)
        for number, (velocity, momentum) in enumerate(zip(states["vel"].tolist(), spins.tolist())):
            lines.append(f"{number + 1} " + " ".join(map(repr, [*velocity, *momentum])))
        (folder / "data.pile").write_text("\n".join(lines) + "\n")

    def run(self, folder, command, half_width, steps, windows):
        """Seconds of each window of steps, after one untimed; energies between them; bodies left."""
        (folder / "in.pile").write_text(self._script(half_width, steps, windows))
        done = subprocess.run([*command, "-in", "in.pile", "-log", "log.pile"], cwd=folder, capture_output=True,
                              text=True, timeout=600)
        log = (folder / "log.pile").read_text()
        if done.returncode:
            raise RuntimeError(
                next((line for line in log.splitlines() if line.startswith("ERROR")), f"exit code {done.returncode}"))
        seconds = [float(found) for found in re.findall(r"Loop time of (\S+) on", log)]
        rows = [[float(word) for word in line.split()] for line in log.splitlines() if NUMBERS.fullmatch(line)]
        return seconds[1:], rows

    def _body(self, number, turn):
        corners, tensor = self.core.corners @ turn.T, turn @ np.diag(self.inertia) @ turn.T
        edges, faces = self.core.edges.tolist(), [face + [-1] * (4 - len(face)) for face in self.faces]
        count = 6 + 3 * len(corners) + 2 * len(edges) + 4 * len(faces) + 1
        moments = [tensor[0, 0], tensor[1, 1], tensor[2, 2], tensor[0, 1], tensor[0, 2], tensor[1, 2]]
        rows = [[f"{number} 3 {count}"], [len(corners), len(edges), len(faces)],
                [repr(float(moment)) for moment in moments]]
        rows += [
            *map(lambda corner: [repr(value) for value in corner], corners.tolist()), *edges, *faces,
            [repr(2.0 * self.rounding)]
        ]
        return [" ".join(map(str, row)) for row in rows]

    def _angular_momenta(self, states):
        turns = Rotation.from_quat(states["ori"][:, [1, 2, 3, 0]])
        return turns.apply(turns.inv().apply(states["angVel"]) * self.inertia)

    def _script(self, half, steps, windows):
        stiffness, along, across, friction, gravity, time_step = self.laws
        walls = [
            f"fix {axis}side all wall/body/polyhedron {stiffness} {along} {across} {axis}plane {-half!r} {half!r}"
            for axis in "xy"
        ]
        return "\n".join([
            "units lj",
            "boundary f f f",
            "comm_modify vel yes",
            "newton on",
            "atom_style body rounded/polyhedron 1 20",
            "atom_modify map array",
            "read_data data.pile",
            f"pair_style body/rounded/polyhedron {along} {across} {friction} 1.0 0.0",
            f"pair_coeff * * {stiffness} 0.0",
            f"neighbor {NEIGHBOUR_SKIN} bin",
            "neigh_modify every 1 delay 0 check yes",
            f"timestep {time_step}",
            "fix motion all nve/body",
            f"fix weight all gravity {gravity} vector 0 0 -1",
            "fix_modify weight energy yes",
            f"fix floor all wall/body/polyhedron {stiffness} {along} {across} zplane 0.0 NULL",
            *walls,
            "compute turning all temp/body",
            "compute_modify turning extra/dof 0",
            "variable kinetic equal c_turning*3*atoms",
            "variable weight equal f_weight",
            "thermo_style custom step atoms v_kinetic v_weight",
            "thermo_modify lost ignore norm no",
            f"thermo {steps}",
            *[f"run {steps}"] * (windows + 1),
            "",
        ])
