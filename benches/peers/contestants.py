# SPDX-License-Identifier: MIT OR Apache-2.0
"""Who takes part: what each computes, its settings and stop rule, what a contact law gets of it; and the process that
answers for it.
"""

import json
import os
import select
import subprocess
from dataclasses import dataclass

# What is measured. Two rows are the same work when they ask the same of the same bodies.
CONTACT = "contact"  # point, normal and overlap of bodies that touch; of others: that they do not
DISTANCE = "distance"  # distance and closest points of bodies apart

OURS, PARRY, COAL, BULLET, YADE = "ours", "parry", "coal", "bullet", "yade"
PATIENCE = 120  # seconds for an answer


@dataclass(frozen=True)
class Contestant:
    program: str
    way: str
    label: str
    work: str
    computes: str
    settings: str
    gives: str
    places: tuple = ("touching", "lying", "near", "far")
    edges: tuple = ("sharp", "rounded", "potential")
    most_planes: int = 1000
    warmths: tuple = ("cold", "warm")
    # Whether a peer on the same work as our contact call: one with point, normal and overlap, in the same time scale of
    # a step.
    rival: bool = False

    @property
    def ours(self):
        return self.program == OURS

    def takes(self, group):
        return group.edges in self.edges and group.place in self.places and group.planes <= self.most_planes


POINT = "point, normal, overlap"
BOTH = POINT + ", surface points"
OWN = BOTH + "; area by a second call; bound on the error"
GJK = "GJK; EPA where the cores meet"
COALS = "tolerances of GJK and EPA 1e-6, 128 and 64 iterations (defaults), distance_upper_bound 0; cached guess when warm"
PARRYS = "tolerance 4.7e-8 relative (fixed), 100 iterations; contacts of the cores up to 2r apart"
BULLETS = "relative 1e-12 of the squared distance (fixed); separating axis kept when warm"
CARRIED = "gap_tolerance 1e-12, point to 1e-9 of the size (the plugin's default)"
MIDWAY, DEFAULT = "midway problem", "gap_tolerance 1e-12 (default)"
TOUCH, APART, WARM = ("touching", "lying"), ("near", "far"), ("warm",)


def _one(program, way, label, computes, settings, gives, work=CONTACT, **limits):
    return Contestant(program, way, label, work, computes, settings, gives, **limits)


CONTESTANTS = (
    _one(OURS, "midway", "this library, midway", MIDWAY, DEFAULT, OWN),
    _one(OURS, "carried", "this library, midway in a batch", MIDWAY + "; the last contact is carried on", CARRIED, OWN),
    _one(OURS, "closest", "this library, closest", "closest problem, both points", DEFAULT, OWN),
    _one(OURS, "cone_program", "clarabel", "the paper's cone program of midway", "its defaults, through this library",
         POINT, places=TOUCH, most_planes=20, warmths=("cold", ), rival=True),
    _one(PARRY, "contact", "parry", GJK, PARRYS, BOTH, rival=True),
    _one(PARRY, "intersection", "parry, yes or no", "GJK until a plane separates", PARRYS, "yes or no", places=APART,
         edges=("sharp", ), rival=True),
    _one(PARRY, "distance", "parry, distance", "GJK to the end", PARRYS, "distance, closest points", DISTANCE,
         places=("near", )),
    _one(COAL, "contact", "Coal", GJK, COALS, BOTH, rival=True),
    _one(COAL, "contact-nesterov", "Coal, Nesterov", GJK + "; Nesterov acceleration", COALS, BOTH, rival=True),
    _one(COAL, "distance", "Coal, distance", "GJK to the end", COALS, "distance, closest points", DISTANCE,
         places=("near", )),
    _one(BULLET, "contact", "Bullet, double precision", GJK, BULLETS, BOTH, rival=True),
    _one(YADE, "potential", "YADE's PotentialParticle", "least f_A + f_B with f_A = f_B, by Newton",
         "accuracyTol 1e-7 (default), no contact area", POINT + "; area by rays", places=TOUCH, edges=("potential", ),
         most_planes=12, warmths=WARM, rival=True),
)


class Server:
    """A driver's process, started when first asked and again after each crash."""

    def __init__(self, command, environment=None):
        self.command, self.environment = [str(part) for part in command], environment
        self.process = None

    def ask(self, *words):
        """The answer as Python value; RuntimeError where there is none."""
        if self.process is None:
            environment = dict(os.environ, **(self.environment or {}))
            self.process = subprocess.Popen(self.command, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                            stderr=subprocess.DEVNULL, env=environment)
            self.rest = b""
        self.process.stdin.write((" ".join(map(str, words)) + "\n").encode())
        self.process.stdin.flush()
        while True:
            line = self._line()
            # YADE's own messages share the stream; answers are marked.
            if line.startswith(b">"):
                return json.loads(line[1:].replace(b"NaN", b"null").replace(b"nan", b"null"))

    def stop(self):
        if self.process is not None:
            self.process.kill()
            self.process.wait()
            self.process.stdin.close()
            self.process.stdout.close()
            self.process = None

    def _line(self):
        output = self.process.stdout
        while b"\n" not in self.rest:
            ready, _, _ = select.select([output], [], [], PATIENCE)
            more = os.read(output.fileno(), 1 << 16) if ready else b""
            if not more:
                why = f"no answer in {PATIENCE} s" if not ready else "it stopped"
                self.stop()
                raise RuntimeError(why)
            self.rest += more
        line, self.rest = self.rest.split(b"\n", 1)
        return line
