# SPDX-License-Identifier: MIT OR Apache-2.0
"""Looking at a YADE scene now and then: energies, overlaps, balance, and who is where."""

import csv
from dataclasses import astuple, dataclass, fields

import numpy as np
from yade import O, utils


@dataclass
class Sample:
    """One look; time in s, energies in J, overlap in m."""

    step: int
    time: float
    kinetic: float
    potential: float  # of gravity, zero at the floor
    elastic: float  # stored in normal and shear springs
    contacts: int
    candidates: int  # pairs whose boxes overlap
    overlap: float  # the largest

    @property
    def energy(self):
        return self.kinetic + self.potential + self.elastic


class Watch:
    """Samples of the free bodies `ids`; gravity (m/s^2) points down z."""

    def __init__(self, ids, gravity):
        self.states = [O.bodies[i].state for i in ids]
        self.gravity = gravity
        self.samples = []

    def look(self):
        """Takes a sample of the present step."""
        if self.samples and self.samples[-1].step == O.iter:
            return self.samples[-1]
        contacts, overlap, elastic = 0, 0.0, 0.0
        for interaction in O.interactions:
            if not interaction.isReal:
                continue
            depth, spring = interaction.geom.penetrationDepth, interaction.phys
            if depth <= 0.0 or spring.kn <= 0.0 or spring.ks <= 0.0:
                continue
            contacts += 1
            overlap = max(overlap, depth)
            elastic += 0.5 * (spring.kn * depth**2 + spring.shearForce.squaredNorm() / spring.ks)
        potential = sum(state.mass * state.pos[2] for state in self.states) * self.gravity
        self.samples.append(
            Sample(
                step=O.iter,
                time=O.time,
                kinetic=utils.kineticEnergy(),
                potential=potential,
                elastic=elastic,
                contacts=contacts,
                candidates=len(O.interactions),
                overlap=overlap,
            )
        )
        return self.samples[-1]

    def largest_overlap(self):
        """Over all samples, m."""
        return max(sample.overlap for sample in self.samples)

    def peak_kinetic(self):
        """Over all samples, J."""
        return max(sample.kinetic for sample in self.samples)

    def largest_rise(self):
        """Largest growth of the total energy from one sample to the next, J; damping only takes."""
        energies = np.array([sample.energy for sample in self.samples])
        return float(max(np.diff(energies).max(initial=0.0), 0.0))

    def save(self, path):
        """All samples as a table, one row a look, names and units as in Sample."""
        with open(path, "w", newline="") as file:
            rows = csv.writer(file)
            rows.writerow([field.name for field in fields(Sample)])
            rows.writerows(astuple(sample) for sample in self.samples)

    def poses(self):
        """Positions (n, 3), m, and rotations (n, 3, 3), local to world."""
        positions = np.array([tuple(state.pos) for state in self.states])
        rotations = np.array([[tuple(row) for row in state.ori.toRotationMatrix()] for state in self.states])
        return positions, rotations

    def speeds(self):
        """Of the centroids, m/s."""
        return np.array([state.vel.norm() for state in self.states])


def unbalanced_force():
    """Mean net force on bodies over mean contact force; None before the first contact."""
    value = utils.unbalancedForce()
    return value if np.isfinite(value) else None
