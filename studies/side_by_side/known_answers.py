# SPDX-License-Identifier: MIT OR Apache-2.0
"""Both functors on pairs whose contact is known to 40 digits (tests/data/pairs.jsonl)."""

import contextlib
import json
import os
import sys
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import yade
from yade import O, Quaternion, Vector3, utils

from cases import Springs, loop
from contact_functor import ContactFunctor

PAIRS = Path(__file__).resolve().parents[2] / "tests" / "data" / "pairs.jsonl"
# YADE's own functor keeps its tables on the stack, which large particles overrun.
MOST_PLANES = 60


@dataclass
class KnownAnswers:
    """Of one functor on all pairs."""

    touching: int = 0
    missed: int = 0
    apart: int = 0
    invented: int = 0
    point_errors: list = field(default_factory=list)  # over the smaller R, of the contacts found

    def add(self, touching, point, depth, found_point, size):
        found = depth > 0.0
        self.touching += touching
        self.apart += not touching
        self.missed += touching and not found
        self.invented += found and not touching
        if touching and found:
            self.point_errors.append(float(np.linalg.norm(found_point - point) / size))

    def summary(self):
        return {
            "touching": self.touching,
            "missed": self.missed,
            "apart": self.apart,
            "invented": self.invented,
            "median_point_error_over_R": float(np.median(self.point_errors)),
            "worst_point_error_over_R": max(self.point_errors),
        }


def known_answers(kind, every=1):
    """Every `every`-th pair of particles with few enough planes for both functors."""
    result = KnownAnswers()
    with open(PAIRS) as lines:
        pairs = [json.loads(line) for line in lines][::every]
    for pair in pairs:
        if max(len(pair[body]["d"]) for body in "AB") > MOST_PLANES:
            continue
        # Strings of 40 digits, of which a double keeps 16.
        truth = pair["truth"]
        point = np.array([float(x) for x in truth["x4"]])
        size = min(pair[body]["R"] for body in "AB")
        result.add(float(truth["s4"]) < 1.0, point, *_contact(kind, pair), size)
    return result


def _contact(kind, pair):
    """Overlap (negative if apart) and contact point relative to the second body."""
    contact = ContactFunctor(kind)
    O.reset()
    O.materials.append(yade.FrictMat())
    ids = [_body(pair[shape], pair[place]) for shape, place in ("Aa", "Bb")]
    O.dt = 0.0
    O.engines = loop(contact.functor, Springs(1.0, 1.0, 0.0), gravity=0.0, never_erase=True)[:-1]
    contact.prepare()
    # YADE makes an interaction by hand only for bodies whose boxes exist.
    for body in O.bodies:
        body.shape.isBoundary = True
    O.step()
    for body in O.bodies:
        body.shape.isBoundary = False
    O.interactions.clear()
    made = utils.createInteraction(*ids)
    return made.geom.penetrationDepth, np.array(made.geom.contactPoint - O.bodies[ids[1]].state.pos)


def _body(shape, place):
    a, b, c = (list(column) for column in zip(*shape["n"])) if shape["n"] else ([], [], [])
    body = yade.Body()
    body.shape = yade.PotentialParticle(a=a, b=b, c=c, d=shape["d"], r=shape["r"], k=shape["k"], R=shape["R"])
    utils._commonBodySetup(body, 1.0, Vector3(1, 1, 1), material=-1, pos=Vector3(place["pos"]), fixed=True)
    w, x, y, z = place["q"]
    body.state.ori = Quaternion(w, x, y, z).normalized()
    return O.bodies.append(body)


@contextlib.contextmanager
def messages_to(path):
    """Within, standard output goes to the end of a file, that of compiled code included."""
    sys.stdout.flush()
    terminal = os.dup(1)
    try:
        with open(path, "a") as file:
            os.dup2(file.fileno(), 1)
            yield
            sys.stdout.flush()
    finally:
        os.dup2(terminal, 1)
        os.close(terminal)
