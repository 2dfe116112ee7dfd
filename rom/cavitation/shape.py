"""The film thickness over a plane with Cartesian or polar coordinates."""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.homogenization.gap_factors import FactorsOverGap

Thickness = Callable[[Array, Array], Array]

CELLS_PER_FEATURE = 8
"""Number of cells over a wave or a pocket at which the error of the load is a few per cent."""


@dataclass(frozen=True, kw_only=True)
class Shape:
    """A film of thickness h(x, y), m, over a rectangle in (x, y) or in (angle, radius).

    Attributes
    ----------
    thickness : thickness(x, y), vectorised; x in m, or rad where ``polar``; y in m.
    breaks : increasing positions x of the two ends and of every jump of h or its slope; each gets a node.
    across : range of y, m; it has no effect on an infinitely wide film.
    steps_across : increasing positions y inside this range where h jumps; each gets a node.
    wide : whether the film is infinitely wide: h depends on x alone, and flow is per width.
    polar : x is an angle, rad, and y the radius, m.
    joined : whether the film is periodic in x, and in y.
    finest : length of the shortest feature of the wall along x and y, in their units; infinite where there is none.
    least_share : smallest number of cells between neighbouring breaks and steps over the number of cells of a grid.
    idle : intervals of x without a film, such as the gaps between pads, whose walls have no friction.
    roughness : flow factors over the mean gap ``thickness``, if roughness is averaged; None if ``thickness`` includes
        all roughness. The lay is fixed to the sliding direction x, so in polar coordinates it turns with the angle.
    """

    thickness: Thickness
    breaks: tuple[float, ...]
    across: tuple[float, float] = (0.0, 1.0)
    steps_across: tuple[float, ...] = ()
    wide: bool = True
    polar: bool = False
    joined: tuple[bool, bool] = (False, False)
    finest: tuple[float, float] = (math.inf, math.inf)
    least_share: float = 0.0
    idle: tuple[tuple[float, float], ...] = ()
    roughness: FactorsOverGap | None = None

    @property
    def length(self) -> float:
        """Length in x, m or rad."""
        return self.breaks[-1] - self.breaks[0]

    @property
    def film_fraction(self) -> float:
        """The length with a film over the length."""
        return 1 - sum(end - begin for begin, end in self.idle) / self.length

    def is_idle(self, x: Array) -> NDArray[np.bool_]:
        """Whether positions x lie in an interval without a film, vectorised."""
        within = np.zeros(x.shape, dtype=bool)
        for begin, end in self.idle:
            within |= (begin < x) & (x < end)
        return within
