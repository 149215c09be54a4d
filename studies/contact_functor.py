# SPDX-License-Identifier: MIT OR Apache-2.0
"""Which functor finds the contacts: that of this library, or the one built into YADE."""

import potential_particles
import yade
from yade import PotentialParticle

# The drop-in serves YADE's own shapes with this library.
LIBRARY, DROP_IN, BUILTIN = "library", "drop-in", "builtin"


class ContactFunctor:
    """The Ig2 functor, the shape class that it serves, and what it counted."""

    _answers_at_mark = None

    def __init__(self, kind, area=False, measure_time=True):
        """area: whether stiffness is per contact area; measure_time: whether the functor, if it
        can, adds up its own time, at the price of two looks at the clock in each call."""
        self.is_ours = kind != BUILTIN
        self.shape_class = potential_particles.ConicPotentialParticle if kind == LIBRARY else PotentialParticle
        timed = {"measureTime": measure_time} if self.is_ours else {}
        functor = {LIBRARY: yade.Ig2_ConicPP_ConicPP_ScGeom, DROP_IN: yade.Ig2_PP_PP_ScGeom_Conic,
                   BUILTIN: yade.Ig2_PP_PP_ScGeom}[kind]
        self.functor = functor(calContactArea=area, **timed)

    @property
    def loop(self):
        """The contact loop that goes with the functor."""
        return potential_particles.ConicInteractionLoop if self.is_ours else yade.InteractionLoop

    @property
    def name(self):
        return type(self.functor).__name__

    def prepare(self):
        """To be called once YADE's engines and bodies are in place."""
        if self.is_ours:
            potential_particles.prepare()

    def counts(self):
        """Calls, pairs solved, cheaply rejected, answered in extended precision, failed; seconds inside.

        None where the functor keeps no count.
        """
        names = ("calls", "overlapping", "solved", "rejected", "extended", "failures", "seconds")
        return {name: getattr(self.functor, name, None) for name in names}

    def mark(self):
        """From here on counts the answers of `answers_since_mark`."""
        self._answers_at_mark = self._answers()

    def answers_since_mark(self):
        """How many pairs were answered in which way since the mark, and how many of them touch.

        None where the functor keeps no count, or when the mark was never reached.
        """
        if self._answers_at_mark is None:
            return None
        return {name: count - self._answers_at_mark[name] for name, count in self._answers().items()}

    def _answers(self):
        if not self.is_ours:
            return None
        return {**self.functor.answers, "overlapping": self.functor.overlapping}

    def failure_report(self):
        """The first failure of each pair, as dictionaries with ids, poses and a message."""
        return list(getattr(self.functor, "failureReport", []))

    def versions(self):
        """Of the library and the plugin; nothing for the functor built into YADE."""
        if not self.is_ours:
            return {}
        return {"library": potential_particles.library_version(), "glue": potential_particles.__version__}
