# SPDX-License-Identifier: MIT OR Apache-2.0
"""The bodies of a file with their names there, and what became of their volume."""
from ..arguments import warn
from ..fitting import WARNED
from ..packing import Placement

# Of volume: below this share a difference is passed over.
TOLD = 1e-3
ORIGIN, UPRIGHT = (0.0, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0)


class Bodies(list):
    """Placements of the bodies of a file, in place.

    ids: their names or numbers in the file; volumes: of the bodies there, length^3, or of the convex hulls that they
    became.
    """

    def __init__(self, file, remedy="shapes.clump_from_mesh cuts a surface from a file (.stl, .obj) into convex parts"):
        super().__init__()
        self.file, self.ids, self.volumes, self._hulls, self._remedy = file, [], [], {}, remedy

    @property
    def shapes(self):
        """The Shape of each name or number."""
        return {name: one.shape for name, one in zip(self.ids, self)}

    @property
    def lost(self):
        """Share of the volume of all bodies that their shapes do not have; below 0 where they have more."""
        return 1.0 - sum(one.shape.volume for one in self) / sum(self.volumes)

    def __repr__(self):
        """One line; the placements are its items."""
        return f"<Bodies of {self.file}: {len(self)}, volume {sum(one.shape.volume for one in self):.4g}>"

    def put(self, name, shape, volume, excess, accepted, position=ORIGIN, orientation=UPRIGHT):
        """Adds a body.

        excess: of its convex hull over the body, a share of the body's volume, None where that is unknown. ValueError
        where that is not little, unless it is `accepted`.
        """
        is_convex = excess is not None and excess <= TOLD
        if not (is_convex or accepted or excess is not None and excess <= WARNED):
            said = "its faces are open, and the file states no volume of it" if excess is None else \
                f"its convex hull has {100.0 * excess:.3g} % more volume"
            raise ValueError(f"{shape.name} is not convex: {said}. hull=True takes the hull; {self._remedy}")
        if not is_convex:
            self._hulls[name] = excess
        self.ids.append(name)
        self.volumes.append(volume)
        self.append(Placement(shape, 1.0, tuple(position), tuple(orientation)))

    def told(self, why):
        """The bodies, with a SceneWarning of what they are off; `why`: they gain or lose."""
        off = [one.shape.volume / volume - 1.0 for one, volume in zip(self, self.volumes)]
        said = []
        if self._hulls:
            known = [(one, name) for name, one in self._hulls.items() if one is not None]
            most = f", of up to {100.0 * max(known)[0]:.3g} % more volume ({max(known)[1]})" if known else ""
            said.append(f"{len(self._hulls)} of {len(self)} bodies are not convex and became their hulls{most}")
        if off and max(map(abs, off)) > TOLD:
            worst = max(range(len(off)), key=lambda i: abs(off[i]))
            said.append(f"the shapes have {100.0 * abs(self.lost):.2g} % {'less' if self.lost > 0 else 'more'} volume "
                        f"than the bodies, {self.ids[worst]} {100.0 * off[worst]:+.2g} %: {why}")
        if said:
            warn(f"{self.file}: {'; '.join(said)}")
        return self
