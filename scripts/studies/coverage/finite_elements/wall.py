"""The fixed wall of a gap in film thicknesses: a flat land with grooves in it."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array


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
