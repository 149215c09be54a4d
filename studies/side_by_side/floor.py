# SPDX-License-Identifier: MIT OR Apache-2.0
"""What a step of the demo's pile costs: by part, and beside a functor that returns at once.

Both functors of the library and of YADE, and one that does nothing, step the very same states of one
run. The one that does nothing is YADE's own with every body marked as a boundary: between two boundaries
it returns before it looks. Gravity is then off, since nothing carries the bodies: they move on with the
velocities that they have, so that collider and integrator have their usual work.
"""

import yade
from yade import O

from contact_functor import BUILTIN, ContactFunctor
from pile import Pile
from stepping import advance

# A measurement: so many windows of so many steps. They are so short that some run without another program
# between, and the fastest counts: other programs only slow a run down.
WINDOWS, WINDOW_STEPS = 20, 10
BUILTIN_WINDOWS, BUILTIN_STEPS = 4, 2
ROUNDS = 3  # in turn
WARM_UP = 2  # steps before
SLOT = "side by side"  # of YADE's memory for scenes


def measure_stages(count, stages, rounds=ROUNDS, progress=None):
    """stages: (name, step) in order. Lets `count` pyramids fall and stops to measure at each; a dictionary of each."""
    O.reset()
    pile = Pile(count, room=1.0, measure_time=False)
    pile.build()
    result = []
    for name, step in stages:
        while O.iter < step:
            advance(min(O.iter + 500, step))
            if progress:
                progress(O.iter)
        O.saveTmp(SLOT)
        turns = [(_library(pile.contact), _clocked(pile.contact), _idle()) for _ in range(rounds)]
        library, clocked, idle = ([cost for costs in group for cost in costs] for group in zip(*turns))
        result.append({"name": name, "step": step, **_compared(library, clocked, _best(idle), _builtin())})
        _back(pile.contact)
    return result


def _compared(library, clocked, idle, builtin):
    """Of one state: ratios, and each cost by part, us."""
    ours, theirs = _best(library), _best(builtin)
    # How much of the loop is the functor. Its clock takes time as well, half of it outside of what it reads.
    clock = max(_best(clocked)["loop"] - ours["loop"], 0.0)
    law = min(cost["loop"] - cost["functor"] for cost in clocked) - 0.5 * clock
    law = min(max(law, 0.0), ours["loop"])

    def parts(cost, law):
        whole = {name: cost[name] for name in ("collider", "integrator", "step")}
        return {**whole, "functor": cost["loop"] - law, "law": law}

    return {
        "over_floor": ours["step"] / idle["step"],
        # Of a step whose contacts are found at no cost: YADE's law and loop have their work all the same.
        "free_functor_over_floor": (idle["step"] - idle["loop"] + law) / idle["step"],
        "simulation_ratio": theirs["step"] / ours["step"],
        "functor_ratio": (theirs["loop"] - law) / (ours["loop"] - law),
        "pairs": sum(cost["pairs"] for cost in clocked) / len(clocked),
        "contacts": ours["contacts"],
        "library_microseconds": parts(ours, law),
        "built_in_microseconds": parts(theirs, law),
        "idle_microseconds": parts(idle, 0.0),
    }


def _back(contact):
    """The saved state, with the library's functor."""
    O.loadTmp(SLOT)
    contact.functor = _engine("contacts").geomDispatcher.functors[0]
    contact.prepare()


def _engine(label):
    return next(engine for engine in O.engines if engine.label == label)


def _replace(functor):
    """The saved state with another functor; what YADE remembers of functors is new after loading."""
    O.loadTmp(SLOT)
    _engine("contacts").geomDispatcher.functors = [functor]


def _library(contact):
    _back(contact)
    return _costs(WINDOWS, WINDOW_STEPS)


def _clocked(contact):
    """As _library, while the functor takes its own time."""
    _back(contact)
    contact.functor.measureTime = True
    return _costs(WINDOWS, WINDOW_STEPS, contact.functor)


def _builtin():
    _replace(ContactFunctor(BUILTIN).functor)
    return _costs(BUILTIN_WINDOWS, BUILTIN_STEPS)


def _idle():
    _replace(yade.Ig2_PP_PP_ScGeom())
    for body in O.bodies:
        body.shape.isBoundary = True
    _engine("motion").gravity = (0.0, 0.0, 0.0)
    # Contacts that were real would be reported as lost, one by one.
    O.interactions.clear()
    return _costs(WINDOWS, WINDOW_STEPS)


def _best(costs):
    return min(costs, key=lambda cost: cost["step"])


def _costs(windows, steps, clocked=None):
    """Of each window, us a step, after steps in which YADE finds its functors and sorts its boxes; clocked: a functor
    that takes its own time."""
    advance(O.iter + WARM_UP)
    costs = []
    for _ in range(windows):
        for engine in O.engines:
            engine.execTime = 0
        if clocked:
            clocked.resetCounters()
        advance(O.iter + steps)
        each = {engine.label: engine.execTime / 1e3 / steps for engine in O.engines}
        costs.append({"collider": each["collider"], "loop": each["contacts"], "integrator": each["motion"],
                      "step": sum(each.values()), "contacts": O.interactions.countReal()})
        if clocked:
            costs[-1].update(functor=clocked.seconds / steps * 1e6, pairs=clocked.calls / steps)
    return costs
