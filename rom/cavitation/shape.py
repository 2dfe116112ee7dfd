"""Where the film is: its thickness over the plane that both walls share, cartesian or polar."""

import math
from collections.abc import Callable
from dataclasses import dataclass

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.homogenization.gap_factors import FactorsOverGap

Thickness = Callable[[Array, Array], Array]


@dataclass(frozen=True, kw_only=True)
class Shape:
    """A film of thickness h(x, y), m, over a rectangle of the plane, or of (angle, radius).

    Attributes
    ----------
    thickness : thickness(x, y), vectorised; x in m, or rad where ``polar``; y in m.
    breaks : where h or its slope jumps in x, from one end to the other, increasing; a node stands at each.
    across : the range of y, m; for an infinitely wide film any range, over which nothing is cut.
    wide : infinitely wide: h(x) alone counts, and flow is per width.
    polar : x is an angle, rad, and y the radius, m.
    joined : whether the ends in x are the same place, and those in y.
    finest : the shortest feature of the wall along x and y, in their units; infinite where there is none.
    roughness : of a film whose roughness is averaged, the flow factors where its mean gap is ``thickness``; x is the
        sliding direction everywhere, so that where ``polar`` the lay turns with it. None of a film that is all told.
    """

    thickness: Thickness
    breaks: tuple[float, ...]
    across: tuple[float, float] = (0.0, 1.0)
    wide: bool = True
    polar: bool = False
    joined: tuple[bool, bool] = (False, False)
    finest: tuple[float, float] = (math.inf, math.inf)
    roughness: FactorsOverGap | None = None

    @property
    def length(self) -> float:
        """Extent in x, m or rad."""
        return self.breaks[-1] - self.breaks[0]
