# SPDX-License-Identifier: MIT OR Apache-2.0
"""Which pairs touch at given poses: as a run had them, and as the paper's cone programs say."""

from dataclasses import dataclass, field

from yade import O

from cases import Springs, loop
from contact_functor import DROP_IN, ContactFunctor

# A contact shallower than this part of the particle's size is within the cone solver's own error:
# nobody can say that it was missed.
DOUBT = 1e-8


@dataclass
class Moment:
    """Poses of all bodies before a step, and the pairs that touched in it: (id1, id2) -> overlap, m."""

    step: int
    poses: list
    touching: dict = field(default_factory=dict)

    @classmethod
    def of_scene(cls):
        return cls(O.iter, [(body.state.pos, body.state.ori) for body in O.bodies])


def touching_now():
    """Pairs that overlap by the geometry of the last step."""
    return {
        (min(i.id1, i.id2), max(i.id1, i.id2)): i.geom.penetrationDepth
        for i in O.interactions
        if i.isReal and i.geom.penetrationDepth > 0.0
    }


@dataclass
class Misses:
    """Against the cone programs, over all moments of a run."""

    contacts: int = 0  # that there are
    missed: int = 0
    deepest: float = 0.0  # overlap of those missed, m
    invented: int = 0
    overlap_error: float = 0.0  # the largest, m


class ConeJudge:
    """Solves every pair of a scene by the cone programs, at poses of any run of that scene."""

    def __init__(self, case, area):
        contact = ContactFunctor(DROP_IN)
        contact.functor.backEnd = "cone_program"
        case.start(contact, area)
        # Nothing may move: one look at each moment.
        O.engines = loop(contact.functor, Springs(1.0, 1.0, 0.0), gravity=0.0)[:-1]
        O.dt = 0.0
        contact.prepare()
        self.doubt = DOUBT * case.size

    def judge(self, moments):
        result = Misses()
        for moment in moments:
            for body, (position, orientation) in zip(O.bodies, moment.poses):
                body.state.pos, body.state.ori = position, orientation
            O.interactions.clear()
            O.step()
            self._compare(result, touching_now(), moment.touching)
        return result

    def _compare(self, result, truth, found):
        result.contacts += len(truth)
        for pair, overlap in truth.items():
            if pair in found:
                result.overlap_error = max(result.overlap_error, abs(found[pair] - overlap))
            elif overlap > self.doubt:
                result.missed += 1
                result.deepest = max(result.deepest, overlap)
        result.invented += sum(found[pair] > self.doubt for pair in found if pair not in truth)
