# SPDX-License-Identifier: MIT OR Apache-2.0
"""Stepping a scene while watching it, writing frames and keeping the states to be drawn."""

from dataclasses import dataclass

import numpy as np
from yade import O

from progress import Progress
from stepping import advance


@dataclass
class State:
    """The free bodies at one step: positions (n, 3), m; rotations (n, 3, 3), local to world."""

    step: int
    time: float  # s
    kinetic: float  # energy, J
    positions: np.ndarray
    rotations: np.ndarray


class RecordedRun:
    """Steps from 0 to `steps`; looks, frames and pictures fall on steps of their own choosing.

    series: a Recorder. calls: functions to be called at a step, as {step: function}.
    """

    def __init__(self, steps, watch, series, watch_steps, frame_steps, picture_steps, calls=None):
        self.steps, self.watch, self.series = steps, watch, series
        self.frame_steps, self.picture_steps = set(frame_steps), set(picture_steps)
        self.calls = calls or {}
        looks = set(range(0, steps + 1, watch_steps))
        self.stops = sorted(looks | self.frame_steps | self.picture_steps | set(self.calls) | {steps})
        self.states = []  # at the picture steps that were reached
        self.stepping_seconds = 0.0

    def go(self):
        """Runs to the end; True if Ctrl-C came first. What was written until then stays."""
        progress = Progress(self.steps)
        try:
            for stop in self.stops:
                if stop > O.iter:
                    self.stepping_seconds += advance(stop)
                self._record(stop)
                progress.update(stop)
        except KeyboardInterrupt:
            return True
        finally:
            progress.close()
        return False

    def keep_last(self):
        """Adds the present state to the pictures, if it is not there yet."""
        if not self.states or self.states[-1].step != O.iter:
            self.states.append(self._state())

    def _record(self, step):
        self.watch.look()
        if step in self.calls:
            self.calls[step]()
        if step in self.picture_steps:
            self.states.append(self._state())
        if step in self.frame_steps:
            self.series()

    def _state(self):
        return State(O.iter, O.time, self.watch.look().kinetic, *self.watch.poses())
