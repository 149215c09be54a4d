# SPDX-License-Identifier: MIT OR Apache-2.0
"""Progress through parts of different kinds, each of which knows how much of itself is done."""

from progress import Progress, clock_text

GRAIN = 100  # ticks a part


class Parts(Progress):
    """Shows the name of the part under way; parts count alike, so that the time left is a rough one."""

    def __init__(self, names):
        super().__init__(GRAIN * len(names))
        self.names, self.begun = names, self.clock()

    def of(self, part):
        """The function by which a part reports its share, 0 to 1."""
        return lambda share: self.update(int(GRAIN * (part + min(share, 1.0))))

    def _text(self, ticks):
        spent = self.clock() - self.begun
        left = clock_text(spent * (self.total - ticks) / ticks) if ticks else "?"
        name = self.names[min(ticks // GRAIN, len(self.names) - 1)]
        return f"{100 * ticks // self.total:3d}%  {clock_text(spent)} spent, about {left} left  {name}"
