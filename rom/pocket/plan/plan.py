"""The gap over a periodic rectangle: a wall with dimples under a flat sliding wall."""

from collections.abc import Callable
from dataclasses import dataclass

from roughfilm.contact.foundation.arrays import Array


@dataclass(frozen=True, kw_only=True)
class Plan:
    """One period of a gap h(x, y) in both directions of the film.

    The sliding wall is flat and moves along x at z = ``film``; the other wall is at rest at z = ``film`` - h(x, y). The
    period is -length/2 .. length/2 along x and -breadth/2 .. breadth/2 along y.

    Attributes
    ----------
    length, breadth : lengths of the period along and across the sliding direction, m.
    film : film thickness outside of the dimples, m; the unit of length inside the solvers.
    thickness : film thickness h(x, y), m, for x and y in m; vectorised; periodic.
    breaks_x, breaks_y : positions of the edges and middles of dimples in the period, m, increasing; grids have faces
        there.
    mirrored : whether the gap is symmetric about y = 0, and so about y = breadth/2.
    smallest : the least extent of a dimple or of the ramp or rounding at its rim, m.
    """

    length: float
    breadth: float
    film: float
    thickness: Callable[[Array, Array], Array]
    breaks_x: tuple[float, ...]
    breaks_y: tuple[float, ...]
    mirrored: bool
    smallest: float
