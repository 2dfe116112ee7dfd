"""The fixed wall of a gap in film thicknesses: a flat land with grooves in it."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array

Indices = NDArray[np.intp]
"""An array of numbers of points, nodes or unknowns, of any shape."""


@dataclass(frozen=True, kw_only=True)
class Groove:
    """A groove in the wall y = 0; lengths in film thicknesses.

    Parameters
    ----------
    breaks
        Positions at which the depth or a derivative is not smooth, from one edge to the other, increasing.
    corners
        The breaks at which the slope jumps.
    depth
        Depth d(x) >= 0, vectorised; zero at both edges.
    """

    breaks: tuple[float, ...]
    corners: tuple[float, ...]
    depth: Callable[[Array], Array]

    def moved(self, distance: float) -> "Groove":
        """Return the groove at another place."""
        return Groove(
            breaks=tuple(place + distance for place in self.breaks),
            corners=tuple(place + distance for place in self.corners),
            depth=lambda x: self.depth(x - distance),
        )

    def sharp_corners(self) -> list[float]:
        """Return the corners at which the liquid fills more than a half circle: at the edges, and on ridges."""
        edges = (self.breaks[0], self.breaks[-1])
        step = 1e-6 * (edges[1] - edges[0])
        near = {place: self.depth(place + step * np.array([-1.0, 0.0, 1.0])) for place in self.corners}
        return [place for place, depth in near.items() if place in edges or depth[0] + depth[2] > 2 * depth[1]]


@dataclass(frozen=True, kw_only=True)
class Wall:
    """One period -length/2 .. length/2 of the wall, with its grooves from left to right, which do not overlap."""

    length: float
    grooves: tuple[Groove, ...]

    def begun_on_land(self) -> tuple["Wall", float]:
        """Return the wall whose period begins in the middle of the widest land, and the new place of its old ends."""
        if not self.grooves:
            return self, self.length / 2
        ends = [groove.breaks[-1] for groove in self.grooves]
        starts = [*(groove.breaks[0] for groove in self.grooves[1:]), self.grooves[0].breaks[0] + self.length]
        widest = max(range(len(ends)), key=lambda number: starts[number] - ends[number])
        cut = (starts[widest] + ends[widest]) / 2
        behind = [groove.moved(-cut - self.length / 2) for groove in self.grooves[widest + 1 :]]
        before = [groove.moved(-cut + self.length / 2) for groove in self.grooves[: widest + 1]]
        return Wall(length=self.length, grooves=(*behind, *before)), -cut + self.length * round(cut / self.length)
