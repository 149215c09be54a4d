# SPDX-License-Identifier: GPL-3.0-or-later
"""A factor by simulation: runs from the scene at rest, with friction and cohesion that fall, or a push that grows, until
bodies do not come to rest. The judge of limit_analysis(), and its answer for joints of finite stiffness.
"""
import dataclasses
import math

import numpy as np

from .arguments import positive, vector
from .bodies import is_free, lasting, owner, size_of
from .limit_analysis import gravity_of, limit_analysis

# Of the factor that is looked for, the first to try on each side, and the next if it does not bracket.
FIRST, WIDER = 0.02, 0.15
# Runs last so many times sqrt(size / g), of which the first part brings the loads on slowly.
PATIENCE, RAMP = 60.0, 10.0
# Steps of the ramp, and looks at a run.
PARTS = 20
# At rest bodies are slower than this part of sqrt(g size); they fall when one has moved by this part of its size.
SLOW, MOVED = 1e-4, 0.02
MOST_RUNS = 24


@dataclasses.dataclass(frozen=True)
class Simulated:
    """What runs say of a factor: `stands` < factor < `falls`."""
    stands: float  #: the largest factor with which bodies came to rest; 0 without one
    falls: float  #: the least with which they did not; inf without one
    runs: list  #: (factor, "stands", "falls" or "undecided", the farthest that a body moved)

    def __repr__(self):
        return f"<Simulated: stands at {self.stands:.5g}, falls at {self.falls:.5g}; {len(self.runs)} runs>"


def factor_by_simulation(question="strength", push=None, first=None, tolerance=0.02, patience=PATIENCE, progress=True):
    """The factor of safety ("strength") or the load factor of a push ("load"), by runs of the scene as it is, at rest:
    each starts there, brings the factor on in steps, and goes on until all bodies rest or one has moved by 2 % of its
    size. The bracket is halved until its ends differ by less than tolerance, a part of the factor.

    push: (3,), as of limit_analysis(): the load, or what is there while strength falls. first: the factor to begin with;
    by default that of limit_analysis(). patience: the longest run, over sqrt(size / g) of the largest body; a run that
    neither rests nor falls until then is undecided, and counts for neither. Steps are O.dt. Ctrl-C ends the search, and
    the bracket so far is returned.
    Joints of finite stiffness are weaker: a wall that leans on K N/m^3 by some (N/K)^(1/3), so that two stiffnesses are
    to be compared (docs/equilibrium.md).

    Returns a Simulated; the scene is again as it was. ValueError: as of limit_analysis(). RuntimeError: no factor to
    begin with.
    """
    import yade
    tolerance, patience = positive(tolerance, "tolerance"), positive(patience, "patience")
    if question not in ("strength", "load"):
        raise ValueError(f"question={question!r} has no factor: give 'strength' or 'load'")
    direction = vector((0, 0, 0) if push is None else push, "push")
    if first is None:
        found = limit_analysis(question, push=push)
        if not found.stands:
            return Simulated(0.0, 0.0, [])
        first = found.factor
    low, high, runs = 0.0, math.inf, []
    yade.O.saveTmp("factor_by_simulation")
    bar = _bar(progress)
    try:
        while len(runs) < MOST_RUNS and (math.isinf(high) or high - low > tolerance * high):
            factor = _next(low, high, positive(first, "first"), tolerance, runs)
            if factor is None:
                break
            yade.O.loadTmp("factor_by_simulation")
            verdict, moved = _run(question, factor, direction, patience)
            runs.append((factor, verdict, moved))
            if verdict == "stands":
                low = max(low, factor)
            elif verdict == "falls":
                high = min(high, factor)
            if bar is not None:
                bar.set_postfix_str(f"{low:.4g} to {high:.4g}, last {verdict}")
                bar.update()
    except KeyboardInterrupt:
        pass
    finally:
        if bar is not None:
            bar.close()
        yade.O.loadTmp("factor_by_simulation")
    return Simulated(low, high, runs)


def _next(low, high, first, tolerance, runs):
    """The factor of the next run; None if the bracket cannot be made narrower."""
    tried = {factor for factor, *_ in runs}
    if low == 0.0:
        guess = first * (1.0 - 0.5 * min(FIRST, tolerance)) if math.isinf(high) else high / (1.0 + WIDER)
    elif math.isinf(high):
        guess = max(first * (1.0 + 0.5 * min(FIRST, tolerance)), low * (1.0 + tolerance))
        guess = guess if len(runs) < 3 else low * (1.0 + WIDER)
    else:
        guess = 0.5 * (low + high)
    # Beside a run that was undecided.
    for share in (0.0, 0.25, -0.25):
        width = high - low if math.isfinite(high) and low else guess * WIDER
        other = guess + share * width
        if other not in tried and low < other < high:
            return other
    return None


def _run(question, factor, direction, patience):
    """("stands", "falls" or "undecided", the farthest that a body moved over its size)."""
    import yade
    omega = yade.O
    gravity = np.linalg.norm(gravity_of(omega.engines))
    bodies = [body for body in omega.bodies if body.id == owner(body).id and is_free(body)]
    sizes = [size_of(body) for body in bodies]
    places = [yade.Vector3(body.state.pos) for body in bodies]
    second = math.sqrt(max(sizes) / gravity)
    given = {body.id: yade.Vector3(lasting(omega.forces.permF, body)) for body in bodies}

    def moved():
        return max((body.state.pos - place).norm() / size for body, place, size in zip(bodies, places, sizes))

    def at_rest():
        speeds = (max(body.state.vel.norm(), size * body.state.angVel.norm()) for body, size in zip(bodies, sizes))
        return max(speeds) < SLOW * math.sqrt(gravity * max(sizes))

    def go(seconds):
        omega.run(max(int(seconds / omega.dt), 1), wait=True)

    before = 1.0
    for part in range(1, PARTS + 1):
        if direction.any():
            pushed = (factor if question == "load" else 1.0) * part / PARTS
            for body in bodies:
                along = body.state.mass * gravity * pushed
                omega.forces.setPermF(body.id, given[body.id] + yade.Vector3(*(along * direction)))
        if question == "strength":
            now = 1.0 + (factor - 1.0) * part / PARTS
            _weaken(omega, now / before)
            before = now
        go(RAMP * second / PARTS)
        if moved() > MOVED:
            return "falls", moved()
    for _ in range(PARTS):
        go((patience - RAMP) * second / PARTS)
        if moved() > MOVED:
            return "falls", moved()
        if at_rest():
            return "stands", moved()
    return "undecided", moved()


def _weaken(omega, by):
    """Divides tan φ and cohesion of all materials and contacts."""
    for material in omega.materials:
        material.frictionAngle = math.atan(math.tan(material.frictionAngle) / by)
        for name in ("cohesion", "residualCohesion"):
            if hasattr(material, name):
                setattr(material, name, getattr(material, name) / by)
    for physics in [contact.phys for contact in omega.interactions if contact.isReal]:
        for name in ("tangensOfFrictionAngle", "tangensOfResidualFrictionAngle", "cohesion", "residualCohesion"):
            if hasattr(physics, name):
                setattr(physics, name, getattr(physics, name) / by)


def _bar(progress):
    if not progress:
        return None
    from tqdm import tqdm
    return tqdm(total=None, unit=" runs", desc="factor by simulation")
