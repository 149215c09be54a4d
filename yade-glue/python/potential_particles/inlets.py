# SPDX-License-Identifier: GPL-3.0-or-later
"""Inlets: bodies that keep coming while a scene runs, each at a place where it overlaps nothing.

    inlet = Inlet(packing.Cylinder((0, 0, 2), 0.5, 0.3), rocks, sizes=grading, shares="passing", rate=200, number=10_000)
    O.engines = [ForceResetter(), inlet.engine, ...]

The bodies are those of a packing's sequence, which a seed decides, placed in order; a body that finds no place waits.
All of an inlet is saved with the scene, in O.tags: a loaded scene goes on with the next body.
"""
import dataclasses
import json
import math

from ._core import _packing
from .arguments import LARGE, MANY, positive, vector, whole
from .bodies import body, material_of
from .materials import GRAVITY
from .packing import Box, Cylinder, Prism, Region, obstacles_of, placement, shapes_of, space_of, supply_of

TAG = "potential_particles.inlet"
_REGIONS = {kind.__name__: kind for kind in (Box, Cylinder, Prism)}
# Of this process, by tag: (definition, the inlet).
_known = {}


class Inlet:
    """Bodies that come into a region while the scene runs; `engine` goes into O.engines, before the collider.

    region: a packing.Box, Cylinder, Prism or Region, where they begin. shapes, sizes, shares, margin, seed, trials: as of
    pack(). rate: bodies/s; mass_rate: mass/s; neither: until full, as many as find a place. velocity, angular_velocity:
    at birth. It ends after a `number`, a `mass` or the `time` O.time; until full also when for `patience` s no body has
    found a place. period: s between two looks, by default until bodies have left half of the region. name: of this
    inlet, where a scene has several. material and `more` go to body().

    born, born_mass: how many bodies so far; finished: why there will be no more, "" before. A Region, a function, is not
    saved: the script that loads the scene makes the Inlet again, which goes on where it was, as every Inlet does whose
    name the scene knows.
    """

    def __init__(self, region, shapes, sizes=None, shares="number", rate=None, mass_rate=None, number=None, mass=None,
                 time=math.inf, velocity=(0.0, 0.0, 0.0), angular_velocity=(0.0, 0.0, 0.0), material=None, seed=0,
                 margin=0.0, trials=5_000, period=None, patience=None, name="1", **more):
        import yade
        if rate is not None and mass_rate is not None:
            raise ValueError(f"rate={rate!r} and mass_rate={mass_rate!r}: give one of them, or none for until full")
        self.shapes, self.region = shapes_of(shapes), region
        self._space = space_of(region)
        self._supply = supply_of(self.shapes, sizes, shares, margin)
        self._how = {"seed": whole(seed, 0, LARGE, "seed"), "trials": whole(trials, 1, LARGE, "trials"),
                     "arrangement": "in sequence", "threads": 1}
        self.rate, self.mass_rate = _or_none(rate, "rate"), _or_none(mass_rate, "mass_rate")
        self.number = None if number is None else whole(number, 1, 10 * MANY, "number")
        self.mass, self.time = _or_none(mass, "mass"), time
        self.velocity, self.angular_velocity = _three(velocity, "velocity"), _three(angular_velocity, "angular_velocity")
        material = material_of(material)
        self._material = material if material.id < 0 else material.id
        self._density, self._more, self.tag = material.density, more, f"{TAG}.{name}"
        self.period = self._half_way() if period is None else positive(period, "period")
        self.patience = 4.0 * self.period if patience is None else positive(patience, "patience")
        if yade.O.tags.has_key(self._count_tag):
            self._count = json.loads(yade.O.tags[self._count_tag])
        else:
            self._count = {"born": 0, "mass": 0.0, "begin": None, "last": None, "finished": ""}
        definition = self._written(sizes, shares, margin)
        yade.O.tags[self.tag] = definition
        _known[self.tag] = definition, self
        self._save()

    born = property(lambda self: self._count["born"], doc="Bodies so far.")
    born_mass = property(lambda self: self._count["mass"], doc="Their mass.")
    finished = property(lambda self: self._count["finished"], doc="Why there will be no more; \"\" before.")

    @classmethod
    def of(cls, name="1"):
        """The inlet of a scene that was loaded."""
        return _of(f"{TAG}.{name}")

    @property
    def engine(self):
        """The engine that feeds the scene: into O.engines, before the collider."""
        import yade
        return yade.PyRunner(command=f"import potential_particles.inlets; potential_particles.inlets.feed({self.tag!r})",
                             virtPeriod=self.period, initRun=True)

    def look(self):
        """Places the bodies that are due; their ids. The engine calls it, and a script may before the run, so that
        critical_time_step() knows bodies.
        """
        import yade
        if yade.O.periodic:
            raise ValueError("the scene is periodic, where images are obstacles, too: an Inlet needs one that is not")
        count = self._count
        if count["finished"]:
            return []
        if count["begin"] is None:
            count["begin"] = count["last"] = yade.O.time
        due = self._due()
        rows = self._place(due) if due != 0 else []
        ids = yade.O.bodies.append([self._body(*row) for row in rows]) if rows else []
        count["born"] += len(ids)
        count["mass"] += sum(yade.O.bodies[i].state.mass for i in ids)
        if ids or due == 0:
            count["last"] = yade.O.time
        count["finished"] = self._end()
        self._save()
        return ids

    def _place(self, due):
        import yade
        from . import _glue
        lower, upper = map(yade.Vector3, self._space[1:3])
        there = obstacles_of(yade.O.bodies[i] for i in _glue.bodies_near(lower, upper, True))
        rows = []
        _packing.pack(self._supply, *self._space, there, lambda new: rows.extend(new) or True, number=due,
                      first=self.born, **self._how)
        return rows

    def _due(self):
        """How many bodies are to come now; None: as many as find a place."""
        import yade
        if yade.O.time >= self.time:
            return 0
        elapsed = yade.O.time - self._count["begin"]
        left = math.inf if self.number is None else self.number - self.born
        if self.rate is not None:
            left = min(left, math.floor(self.rate * elapsed * (1.0 + 1e-12)) + 1 - self.born)
        heaviest = math.inf if self.mass_rate is None else self.mass_rate * elapsed
        if self.mass is not None:
            heaviest = min(heaviest, self.mass)
        if heaviest < math.inf:
            left = self._up_to(heaviest, left)
        return None if left == math.inf else max(left, 0)

    def _up_to(self, heaviest, most):
        """How many of the next bodies have their middle below a mass of all."""
        count, mass, some = 0, self.born_mass, 256
        while True:
            for shape, scale in self._supply.sequence(self._how["seed"], self.born + count, some):
                one = self._density * self.shapes[shape].volume * scale**3
                if mass + 0.5 * one > heaviest or count >= most:
                    return count
                mass, count = mass + one, count + 1

    def _end(self):
        import yade
        if self.number is not None and self.born >= self.number:
            return f"number: {self.born} bodies"
        if self.mass is not None and self._up_to(self.mass, 1) == 0:
            return f"mass: {self.born_mass:g}"
        if yade.O.time >= self.time:
            return f"time: {yade.O.time:g}"
        until_full = self.rate is None and self.mass_rate is None
        if until_full and yade.O.time - self._count["last"] >= self.patience:
            return f"full: no place for {self.patience:g} s"
        return ""

    def _body(self, index, scale, position, orientation):
        one = placement(self.shapes[index], scale, position, orientation)
        return body(one.shape.scaled(one.scale), self._material, one.position, one.orientation,
                    velocity=self.velocity, angular_velocity=self.angular_velocity, **self._more)

    def _half_way(self):
        """Time in which a body leaves half of the region, s: by its velocity and gravity."""
        import yade
        way = 0.5 * (self._space[2][2] - self._space[1][2])
        speed = max(map(abs, self.velocity))
        fall = max((one.gravity.norm() for one in yade.O.engines if isinstance(one, yade.NewtonIntegrator)),
                   default=GRAVITY)
        if not speed and not fall:
            raise ValueError("period: give one, as neither velocity nor gravity takes bodies out of the region")
        return 2.0 * way / (speed + math.sqrt(speed * speed + 2.0 * fall * way))

    @property
    def _count_tag(self):
        return self.tag + ".count"

    def _save(self):
        import yade
        yade.O.tags[self._count_tag] = json.dumps(self._count)

    def _written(self, sizes, shares, margin):
        """All but the counters, as JSON; of a Region, nothing of which it could be made again."""
        kind = type(self.region).__name__
        if isinstance(self.region, Region) or not isinstance(self._material, int):
            return json.dumps(None)
        return json.dumps({
            "region": [kind, *self.region], "shapes": [dataclasses.asdict(dataclasses.replace(one, fit=None))
                                                      for one in self.shapes],
            "sizes": sizes, "shares": shares, "margin": margin, "rate": self.rate, "mass_rate": self.mass_rate,
            "number": self.number, "mass": self.mass, "time": self.time, "velocity": self.velocity,
            "angular_velocity": self.angular_velocity, "material": self._material, "seed": self._how["seed"],
            "trials": self._how["trials"], "period": self.period, "patience": self.patience, **self._more,
        }, default=lambda value: value.tolist() if hasattr(value, "tolist") else list(value))


def feed(tag):
    """What the engine does when it runs."""
    _of(tag).look()


def _of(tag):
    import yade
    definition = yade.O.tags[tag]
    known, inlet = _known.get(tag, (None, None))
    name = tag[len(TAG) + 1:]
    if known == definition:
        # Of the same process, but perhaps of another time: O.load, O.loadTmp.
        inlet._count = json.loads(yade.O.tags[inlet._count_tag])
        return inlet
    written = json.loads(definition)
    if written is None:
        raise ValueError(f"the region (a function) or the material of inlet {name} is not saved with the scene: "
                         f"make the Inlet again, with name={name!r}, after O.load")
    from .shape import Shape
    kind, *values = written.pop("region")
    shapes = [Shape(**{key: _tuples(value) for key, value in one.items()}) for one in written.pop("shapes")]
    return Inlet(_REGIONS[kind](*values), shapes, name=name, **written)


def _tuples(value):
    return tuple(map(_tuples, value)) if isinstance(value, list) else value


def _or_none(value, name):
    return None if value is None else positive(value, name)


def _three(value, name):
    return [float(one) for one in vector(value, name)]
