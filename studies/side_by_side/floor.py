# SPDX-License-Identifier: MIT OR Apache-2.0
"""What a step of the demo's pile costs: by part, and beside a functor that returns at once.

Both functors of the library and of YADE, and one that does nothing, step the very same states of one
run. The one that does nothing is YADE's own with every body marked as a boundary: between two boundaries
it returns before it looks. Gravity is then off, since nothing carries the bodies: they move on with the
velocities that they have, so that collider and integrator have their usual work.
"""

from dataclasses import dataclass

import yade
from yade import O

import pyramids
from bodies import reach
from box import Box
from contact_functor import BUILTIN, LIBRARY, ContactFunctor
from loose_grid import loose_grid
from pyramid import pyramid
from stepping import advance

# A measurement: so many windows of so many steps. They are so short that some run without another program
# between, and the fastest counts: other programs only slow a run down.
WINDOWS, WINDOW_STEPS = 20, 10
BUILTIN_WINDOWS, BUILTIN_STEPS = 4, 2
ROUNDS = 3  # in turn
WARM_UP = 2  # steps before
SLOT = "side by side"  # of YADE's memory for scenes


@dataclass
class Cost:
    """Of one step, us."""

    collider: float
    loop: float  # contacts: functor, physics, law
    motion: float
    whole: float  # all engines
    contacts: int  # at the end
    functor: float = None  # of the loop
    pairs: float = None  # calls of the functor in a step

    @property
    def law(self):
        """Of the loop: all but the functor, us."""
        return self.loop - self.functor


@dataclass
class Stage:
    """One state of the pile, stepped by everyone."""

    name: str
    step: int
    library: Cost
    builtin: Cost
    idle: Cost

    @property
    def over_floor(self):
        return self.library.whole / self.idle.whole

    @property
    def free_functor_over_floor(self):
        """Of a step whose contacts are found at no cost: YADE's law and loop have their work all the same."""
        return (self.idle.whole - self.idle.loop + self.library.law) / self.idle.whole

    @property
    def simulation_ratio(self):
        return self.builtin.whole / self.library.whole

    @property
    def functor_ratio(self):
        return (self.builtin.loop - self.library.law) / self.library.functor


def measure_stages(count, stages, rounds=ROUNDS, progress=None):
    """stages: (name, step) in order. Lets `count` pyramids fall and stops to measure at each."""
    contact = ContactFunctor(LIBRARY, measure_time=False)
    shape = pyramid(pyramids.SIZE)
    grid = loose_grid(count, reach(shape), pyramids.JITTER, pyramids.SEED)
    half_width = grid.half_width + grid.height
    box = Box(half_width, half_width, grid.height + pyramids.SIZE, thickness=pyramids.SIZE)
    O.reset()
    pyramids.build_scene(contact, shape, grid, box)
    result = []
    for name, step in stages:
        while O.iter < step:
            advance(min(O.iter + 500, step))
            if progress:
                progress(O.iter)
        O.saveTmp(SLOT)
        turns = [(_library(contact), _clocked(contact), _idle()) for _ in range(rounds)]
        library, clocked, idle = ([cost for costs in group for cost in costs] for group in zip(*turns))
        library, idle = _best(library), _best(idle)
        _split_loop(library, clocked)
        result.append(Stage(name, step, library, _best(_builtin()), idle))
        _back(contact)
    return result


def _back(contact):
    """The saved state, with the library's functor."""
    O.loadTmp(SLOT)
    contact.functor = _loop().geomDispatcher.functors[0]
    contact.prepare()


def _loop():
    return next(engine for engine in O.engines if engine.label == "contacts")


def _replace(functor):
    """The saved state with another functor; what YADE remembers of functors is new after loading."""
    O.loadTmp(SLOT)
    _loop().geomDispatcher.functors = [functor]


def _library(contact):
    _back(contact)
    return _costs(WINDOWS, WINDOW_STEPS)


def _clocked(contact):
    """As _library, while the functor takes its own time."""
    _back(contact)
    contact.functor.measureTime = True
    return _costs(WINDOWS, WINDOW_STEPS, contact.functor)


def _split_loop(library, clocked):
    """How much of the loop is the functor. Its clock takes time as well, half of it outside of what it reads."""
    clock = max(_best(clocked).loop - library.loop, 0.0)
    beside = min(cost.loop - cost.functor for cost in clocked) - 0.5 * clock
    library.functor = library.loop - min(max(beside, 0.0), library.loop)
    library.pairs = sum(cost.pairs for cost in clocked) / len(clocked)


def _builtin():
    _replace(ContactFunctor(BUILTIN).functor)
    return _costs(BUILTIN_WINDOWS, BUILTIN_STEPS)


def _idle():
    _replace(yade.Ig2_PP_PP_ScGeom())
    for body in O.bodies:
        body.shape.isBoundary = True
    next(engine for engine in O.engines if engine.label == "motion").gravity = (0.0, 0.0, 0.0)
    # Contacts that were real would be reported as lost, one by one.
    O.interactions.clear()
    return _costs(WINDOWS, WINDOW_STEPS)


def _best(costs):
    return min(costs, key=lambda cost: cost.whole)


def _costs(windows, steps, clocked=None):
    """Of each window, after steps in which YADE finds its functors and sorts its boxes; clocked: a functor that
    takes its own time."""
    advance(O.iter + WARM_UP)
    costs = []
    for _ in range(windows):
        for engine in O.engines:
            engine.execTime = 0
        if clocked:
            clocked.resetCounters()
        advance(O.iter + steps)
        each = {engine.label: engine.execTime / 1e3 / steps for engine in O.engines}
        cost = Cost(
            each["collider"],
            each["contacts"],
            each["motion"],
            sum(each.values()),
            contacts=O.interactions.countReal(),
        )
        if clocked:
            cost.functor, cost.pairs = clocked.seconds / steps * 1e6, clocked.calls / steps
        costs.append(cost)
    return costs
