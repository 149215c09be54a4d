# SPDX-License-Identifier: MIT OR Apache-2.0
"""Lowering friction under a resting wedge until it slides, and bracketing the angle at which it does.

1. The wedge is laid on its joints without friction, while a force along the line of intersection
   keeps it from sliding: gravity alone decides what the joints carry.
2. Friction is raised to an angle above the plunge, at which any wedge holds; the force is taken away.
3. Friction is lowered by STEP, and again, each time until the wedge rests, until it slides.
4. It slides a little way on, friction goes back up by STEP, and it rests again. This runs it in: shear
   across the line that was locked into the joints while the wedge settled is gone, and friction acts
   along the line, as the closed form has it. (Locked-in shear can hold a wedge at angles at which a
   moved one slides.)
5. From this rest the angle is bracketed by halving: every angle that holds is the next rest to start
   from, after every angle that slides the last rest is restored.

Rest and sliding are told apart by what the wedge does, never by the closed form:

- it rests when the net force is below REST_FORCE of its weight and its speed below REST_SPEED of
  sqrt(g W/k_n), the speed that belongs to the overlap;
- it slides when it has moved by more than SLIDE_DISTANCE W/k_n along the line since friction was
  lowered, and faster and faster: further in the second third of that time than in the first, and
  further yet in the last. (Shorter spans would see the small oscillations that ride on the motion.)
"""

from dataclasses import dataclass, field

import numpy as np
from yade import O

from joint_planes import sliding_on
from stepping import advance
from block_scene import GRAVITY

HEADROOM = 3.0  # degrees above the plunge to begin with
STEP = 1.0  # degrees
BRACKET = 1.0 / 2048.0  # degrees

WINDOW = 200  # steps between looks
RUN_IN = 0.01  # of the size
REST_FORCE, REST_SPEED = 1e-7, 1e-8
SLIDE_DISTANCE = 5.0
MOST_STEPS = 80_000  # of one angle; nearer to the limit than that the bracket stays as it is

LAYING_FORCE, LAYING_STEPS = 1e-5, 10_000  # without friction: balanced to this part of the weight, or so long
RELEASE_STAGES, RELEASE_STEPS = 40, 50

HOLDS, SLIDES, OPEN = "holds", "slides", "open"
REST = "rest"  # the saved scene
RUN_IN_STAGE = "run in"


@dataclass
class Trial:
    """One friction angle (degrees) and what the wedge did; lengths in m."""

    friction_angle: float
    verdict: str
    moved: float  # along the line since friction was set
    steps: int
    stage: str
    moved_overlaps: float = None  # the same in W/k_n
    direction: np.ndarray = None  # in which it moved during the last third, if it slides


@dataclass
class Result:
    """What a reduction found."""

    slides_at: float  # largest angle, degrees
    holds_at: float  # smallest angle
    first_slide: float  # angle at which it slid first, before it was run in
    joints: tuple  # Joint A, Joint B at rest at `holds_at`
    direction: np.ndarray  # of sliding at `slides_at`
    trials: list = field(default_factory=list)

    @property
    def angle(self):
        """Middle of the bracket."""
        return 0.5 * (self.slides_at + self.holds_at)


class FrictionReduction:
    """The procedure on one scene; `look`, if given, is called after each window and each trial."""

    def __init__(self, scene, bracket=BRACKET, look=None, highest=None):
        self.scene, self.bracket = scene, bracket
        self.look = look or (lambda trial: None)
        # Friction angle to begin with, whole degrees: any wedge holds at its plunge.
        self.highest = highest or _highest(scene.blocks.limit)
        self.line = scene.blocks.limit.line
        self.speed_unit = np.sqrt(GRAVITY * scene.overlap)
        self.trials = []
        self.steps = 0

    def run(self):
        """All five stages."""
        self.lay()
        self.begin()
        return self.halve_run_in(self.lower())

    def begin(self):
        """To rest at the highest angle."""
        if self.try_angle(self.highest, "begin").verdict != HOLDS:
            self._give_up(f"does not come to rest at {self.highest:g} degrees, above the plunge of its line")

    def halve_run_in(self, slid):
        """Stages 4 and 5, from a wedge that slides."""
        self.run_in()
        rested = slid.friction_angle + STEP
        if self.try_angle(rested, RUN_IN_STAGE, SLIDES).verdict != HOLDS:
            self._give_up(f"slid at {slid.friction_angle:g} degrees and does not rest again at {rested:g}")
        self.scene.save(REST)
        return self.halve(rested, slid)

    def drop(self):
        """In place of stages 1 and 2: set down with friction and with equal overlaps, which lock in shear."""
        self.scene.lay_down()
        self.scene.set_friction(self.highest)

    def lay(self):
        """Stages 1 and 2."""
        scene = self.scene
        scene.lay_down()
        scene.set_friction(0.0)
        hold = scene.weight * self.line[2] * self.line
        scene.push(hold)
        until = O.iter + LAYING_STEPS
        while O.iter < until:
            self._advance(WINDOW)
            if scene.out_of_balance() < LAYING_FORCE:
                break
        scene.joints()
        scene.set_friction(self.highest)
        for stage in range(RELEASE_STAGES, 0, -1):
            scene.push((stage - 1) / RELEASE_STAGES * hold)
            self._advance(RELEASE_STEPS)

    def lower(self):
        """Stage 3: the first trial that slides. The rest before it stays saved."""
        angle = self.highest
        while angle > STEP:
            self.scene.save(REST)
            angle -= STEP
            trial = self.try_angle(angle, "lower")
            if trial.verdict == SLIDES:
                return trial
            if trial.verdict == OPEN:
                self._give_up(f"neither rests nor slides at {angle:g} degrees")
        self._give_up(f"holds at {angle:g} degrees still")

    def run_in(self):
        """Stage 4, up to where friction is raised again."""
        start, distance = self.scene.position(), RUN_IN * self.scene.case.size
        until = O.iter + MOST_STEPS
        while (self.scene.position() - start) @ self.line < distance:
            if O.iter >= until:
                self._give_up(f"does not slide on by {RUN_IN:g} of its size")
            self._advance(WINDOW)

    def halve(self, holds, slid):
        """Stage 5, from the saved rest at `holds` degrees and a trial that slid at less.

        The scene ends in the rest at the smallest angle that holds.
        """
        slides = slid.friction_angle
        while holds - slides > self.bracket:
            trial = self.try_angle(0.5 * (holds + slides), "halve")
            if trial.verdict == HOLDS:
                holds = trial.friction_angle
                self.scene.save(REST)
                continue
            self.scene.restore(REST)
            if trial.verdict == OPEN:
                break
            slides, slid = trial.friction_angle, trial
        first = next(trial for trial in self.trials if trial.verdict == SLIDES)
        return Result(
            slides_at=slides,
            holds_at=holds,
            first_slide=first.friction_angle,
            joints=self.scene.joints(),
            direction=slid.direction,
            trials=self.trials,
        )

    def try_angle(self, angle, stage, *ignored):
        """Sets the friction angle and waits for a verdict, of which those in `ignored` do not count."""
        scene = self.scene
        scene.set_friction(angle)
        places = [scene.position()]
        verdict, done = OPEN, 0
        while done < MOST_STEPS and verdict == OPEN:
            self._advance(WINDOW)
            done += WINDOW
            places.append(scene.position())
            verdict = self._verdict(places)
            if verdict in ignored:
                verdict = OPEN
        scene.joints()
        moved = float((places[-1] - places[0]) @ self.line)
        trial = Trial(angle, verdict, moved, done, stage, moved / scene.overlap)
        if verdict == SLIDES:
            trial.direction = places[-1] - places[_thirds(len(places))[-2]]
        self.trials.append(trial)
        self.look(trial)
        return trial

    def _verdict(self, places):
        speed = self.scene.state.vel.norm()
        if speed < REST_SPEED * self.speed_unit and self.scene.out_of_balance() < REST_FORCE:
            return HOLDS
        if len(places) < 4:
            return OPEN
        along = (np.array(places) - places[0]) @ self.line
        first, second, last = np.diff(along[_thirds(len(places))])
        growing = 0.0 < first < second < last
        return SLIDES if along[-1] > SLIDE_DISTANCE * self.scene.overlap and growing else OPEN

    def _advance(self, steps):
        advance(O.iter + steps)
        self.steps += steps

    def _give_up(self, what):
        raise SystemExit(f"{self.scene.case.name}: the wedge {what}; see friction_reduction.py for the verdicts")


def _highest(limit):
    return float(np.ceil(limit.plunge) + HEADROOM)


def expected_trials(limit, bracket=BRACKET):
    """About how many angles will be tried; for a progress bar only, since it asks the closed form."""
    return int(_highest(limit) - limit.friction_angle) + 3 + int(np.log2(STEP / bracket))


def _thirds(count):
    """Where `count` looks begin, are a third and two thirds through, and end."""
    return [round(i * (count - 1) / 3.0) for i in range(4)]


def errors(result, limit, weight):
    """Against the closed form: angle (degrees), direction of sliding (degrees), both forces (relative)."""
    cosine = result.direction @ limit.line / np.linalg.norm(result.direction)
    across = np.linalg.norm(np.cross(result.direction, limit.line)) / np.linalg.norm(result.direction)
    forces = [
        joint.normal_force / (weight * force) - 1.0
        for joint, force in zip(result.joints, (limit.force_a, limit.force_b))
    ]
    return {
        "angle": result.angle - limit.friction_angle,
        "direction": float(np.degrees(np.arctan2(across, cosine))),
        "force_a": float(forces[0]),
        "force_b": float(forces[1]),
    }


def angle_of_contact_normals(result):
    """Critical angle of the closed form for the normals that the contacts had, degrees.

    What remains between it and the bracket is not the shape of the blocks.
    """
    return sliding_on(*(joint.normal for joint in result.joints)).friction_angle
