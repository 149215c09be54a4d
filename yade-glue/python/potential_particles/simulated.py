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
# A leaning wall loses a part of its factor that falls with this power of the joints' stiffness.
LEANS = 1.0 / 3.0
# Marks of the scene as it was, and at rest with another stiffness.
BEFORE, AT_REST = "factor_by_simulation", "factor_by_simulation at rest"


@dataclasses.dataclass(frozen=True)
class Simulated:
    """What runs say of a factor: `stands` < factor < `falls`, with the first of the stiffnesses."""
    stands: float  #: the largest factor with which bodies came to rest; 0 without one
    falls: float  #: the least with which they did not; inf without one
    runs: list  #: (factor, "stands", "falls" or "undecided", the farthest that a body moved, stiffness)
    brackets: dict = dataclasses.field(default_factory=dict)  #: {stiffness: (stands, falls)}
    factor: float = math.nan  #: extrapolated to rigid joints; nan without two whole brackets
    uncertainty: float = math.nan  #: of that, by the brackets' widths and how far they are from one line

    def __repr__(self):
        said = f"<Simulated: stands at {self.stands:.5g}, falls at {self.falls:.5g}; {len(self.runs)} runs"
        return said + (f"; {self.factor:.4g} ± {self.uncertainty:.2g} of rigid joints>" if self.factor > 0.0 else ">")


def factor_by_simulation(question="strength", push=None, first=None, tolerance=0.02, patience=PATIENCE, progress=True,
                         stiffnesses=(1,)):
    """The factor of safety ("strength") or the load factor of a push ("load"), by runs of the scene as it is, at rest:
    each starts there, brings the factor on in steps, and goes on until all bodies rest or one has moved by 2 % of its
    size. The bracket is halved until its ends differ by less than tolerance, a part of the factor.

    push: (3,), as of limit_analysis(): the load, or what is there while strength falls. first: the factor to begin with;
    by default that of limit_analysis(). patience: the longest run, over sqrt(size / g) of the largest body; a run that
    neither rests nor falls until then is undecided, and counts for neither. Steps are O.dt. Ctrl-C ends the search, and
    the bracket so far is returned.
    stiffnesses: of all contacts, over that of the scene, each with a bracket of its own. Joints of finite stiffness are
    weaker: a wall that leans on K N/m^3 loses a part of its factor that goes with K^(-1/3), and is extrapolated from
    two or more, as (1, 8). Three say whether it goes so: if not, the uncertainty is large. It is some 3 times that of
    the brackets for (1, 8). As only the ratio of loads to stiffness counts, a run of 8 K has loads, cohesion and
    tensile strength of an eighth, and lasts sqrt(8) times as long.

    Returns a Simulated; the scene is again as it was. ValueError: as of limit_analysis(). RuntimeError: no factor to
    begin with; a scene that does not come to rest with another stiffness.
    """
    import yade
    tolerance, patience = positive(tolerance, "tolerance"), positive(patience, "patience")
    if question not in ("strength", "load"):
        raise ValueError(f"question={question!r} has no factor: give 'strength' or 'load'")
    stiffnesses = [positive(one, "stiffnesses") for one in stiffnesses]
    if not stiffnesses or len(set(stiffnesses)) < len(stiffnesses):
        raise ValueError(f"stiffnesses={stiffnesses} must be one or more, each another: give (1, 8)")
    direction = vector((0, 0, 0) if push is None else push, "push")
    if first is None:
        found = limit_analysis(question, push=push)
        if not found.stands:
            return Simulated(0.0, 0.0, [])
        first = found.factor
    first = positive(first, "first")
    brackets, runs = {}, []
    yade.O.saveTmp(BEFORE)
    bar = _bar(progress)

    def verdict(factor):
        yade.O.loadTmp(AT_REST)
        said, moved = _run(question, factor, direction, patience)
        runs.append((factor, said, moved, stiffness))
        if bar is not None:
            bar.set_postfix_str(f"{said} at {factor:.4g}")
            bar.update()
        return said

    try:
        for place, stiffness in enumerate(stiffnesses):
            guess = _guess(first, brackets, stiffness, stiffnesses[place - 1])
            brackets[stiffness] = [0.0, math.inf]
            yade.O.loadTmp(BEFORE)
            _stiffen(yade.O, stiffness, patience)
            yade.O.saveTmp(AT_REST)
            _search(brackets[stiffness], guess, tolerance, verdict)
    except KeyboardInterrupt:
        pass
    finally:
        if bar is not None:
            bar.close()
        yade.O.loadTmp(BEFORE)
    return Simulated(*brackets.get(stiffnesses[0], (0.0, math.inf)), runs,
                     {stiffness: tuple(bracket) for stiffness, bracket in brackets.items()}, *_extrapolated(brackets))


def _search(bracket, first, tolerance, verdict):
    """Narrows [stands, falls], which is there to be read at any time."""
    tried = []
    while len(tried) < MOST_RUNS and (math.isinf(bracket[1]) or bracket[1] - bracket[0] > tolerance * bracket[1]):
        factor = _next(*bracket, first, tolerance, tried)
        if factor is None:
            break
        tried.append(factor)
        said = verdict(factor)
        if said == "stands":
            bracket[0] = max(bracket[0], factor)
        elif said == "falls":
            bracket[1] = min(bracket[1], factor)


def _whole(bracket):
    return bracket[0] > 0.0 and math.isfinite(bracket[1])


def _guess(first, brackets, stiffness, before):
    """The factor to begin with: between that of the stiffness before and that of rigid joints."""
    if before not in brackets or not _whole(brackets[before]):
        return first
    middle = 0.5 * sum(brackets[before])
    return middle + (first - middle) * (1.0 - min(before / stiffness, 1.0)**LEANS)


def _extrapolated(brackets):
    """(factor, uncertainty) of rigid joints: the straight line over K^(-1/3), by least squares."""
    whole = {stiffness: bracket for stiffness, bracket in brackets.items() if _whole(bracket)}
    if len(whole) < 2:
        return math.nan, math.nan
    low, high = np.array(list(whole.values())).T
    middle = 0.5 * (low + high)
    rows = np.array([(1.0, stiffness**-LEANS) for stiffness in whole])
    inverse = np.linalg.pinv(rows)
    line = inverse @ middle
    return float(line[0]), float(np.abs(inverse[0]) @ (0.5 * (high - low)) + np.abs(rows @ line - middle).max())


def _next(low, high, first, tolerance, tried):
    """The factor of the next run; None if the bracket cannot be made narrower."""
    if low == 0.0:
        guess = first * (1.0 - 0.5 * min(FIRST, tolerance)) if math.isinf(high) else high / (1.0 + WIDER)
    elif math.isinf(high):
        guess = max(first * (1.0 + 0.5 * min(FIRST, tolerance)), low * (1.0 + tolerance))
        guess = guess if len(tried) < 3 else low * (1.0 + WIDER)
    else:
        guess = 0.5 * (low + high)
    # Beside a run that was undecided.
    for share in (0.0, 0.25, -0.25):
        width = high - low if math.isfinite(high) and low else guess * WIDER
        other = guess + share * width
        if other not in tried and low < other < high:
            return other
    return None


class _Watch:
    """The free bodies, and how far they have gone."""

    def __init__(self, omega):
        import yade
        self.omega, self.gravity = omega, np.linalg.norm(gravity_of(omega.engines))
        self.bodies = [body for body in omega.bodies if body.id == owner(body).id and is_free(body)]
        self.sizes = [size_of(body) for body in self.bodies]
        self.places = [yade.Vector3(body.state.pos) for body in self.bodies]

    @property
    def second(self):
        return math.sqrt(max(self.sizes) / self.gravity)

    def moved(self):
        """The farthest that a body moved over its size."""
        ways = zip(self.bodies, self.places, self.sizes)
        return max((body.state.pos - place).norm() / size for body, place, size in ways)

    def goes_on(self, seconds):
        """None while they move, else how it ended, after so many more."""
        self.omega.run(max(int(seconds / self.omega.dt), 1), wait=True)
        if self.moved() > MOVED:
            return "falls"
        speeds = (max(body.state.vel.norm(), size * body.state.angVel.norm())
                  for body, size in zip(self.bodies, self.sizes))
        return "stands" if max(speeds) < SLOW * math.sqrt(self.gravity * max(self.sizes)) else None

    def ends(self, patience):
        """How a run ends whose loads are there: "stands", "falls" or "undecided"."""
        for _ in range(PARTS):
            ended = self.goes_on((patience - RAMP) * self.second / PARTS)
            if ended is not None:
                return ended
        return "undecided"


def _run(question, factor, direction, patience):
    """("stands", "falls" or "undecided", the farthest that a body moved over its size)."""
    import yade
    watch = _Watch(yade.O)
    forces = yade.O.forces
    given = {body.id: yade.Vector3(lasting(forces.permF, body)) for body in watch.bodies}
    before = 1.0
    for part in range(1, PARTS + 1):
        if direction.any():
            pushed = (factor if question == "load" else 1.0) * part / PARTS
            for body in watch.bodies:
                along = body.state.mass * watch.gravity * pushed
                forces.setPermF(body.id, given[body.id] + yade.Vector3(*(along * direction)))
        if question == "strength":
            now = 1.0 + (factor - 1.0) * part / PARTS
            by, before = now / before, now
            _divide(yade.O, by, cohesion=by, residualCohesion=by)
        if watch.goes_on(RAMP * watch.second / PARTS) == "falls":
            return "falls", watch.moved()
    return watch.ends(patience), watch.moved()


def _stiffen(omega, stiffness, patience):
    """Brings the scene to rest with so many times the stiffness, which loads and strengths of that part stand for."""
    if stiffness == 1.0:
        return
    by, watch = stiffness**(1.0 / PARTS), _Watch(omega)
    for _ in range(PARTS):
        for engine in omega.engines:
            if hasattr(engine, "gravity"):
                engine.gravity /= by
        for body in watch.bodies:
            for of, put in ((omega.forces.permF, omega.forces.setPermF), (omega.forces.permT, omega.forces.setPermT)):
                load = lasting(of, body)
                if load.norm() > 0.0:
                    put(body.id, load / by)
        _divide(omega, 1.0, cohesion=by, residualCohesion=by, tensileStrength=by, softening=by)
        watch.gravity /= by
        watch.goes_on(RAMP * watch.second / PARTS)
    if (ended := watch.ends(patience)) != "stands":
        raise RuntimeError(f"with {stiffness:g} times the stiffness bodies do not come to rest ({ended}): give them "
                           "damping or a restitution below 1, or leave this stiffness out")


def _divide(omega, friction, **others):
    """Divides tan φ of all materials and contacts by `friction`, and other attributes by theirs."""
    for material in omega.materials:
        for name in ("frictionAngle", "residualFrictionAngle"):
            # Below 0: as the friction angle.
            if (angle := getattr(material, name, -1.0)) > 0.0:
                setattr(material, name, math.atan(math.tan(angle) / friction))
    contacts = [contact.phys for contact in omega.interactions if contact.isReal]
    by = dict(tangensOfFrictionAngle=friction, tangensOfResidualFrictionAngle=friction, **others)
    for one in [*omega.materials, *contacts]:
        for name in by:
            if hasattr(one, name):
                setattr(one, name, getattr(one, name) / by[name])


def _bar(progress):
    if not progress:
        return None
    from tqdm import tqdm
    return tqdm(total=None, unit=" runs", desc="factor by simulation")
