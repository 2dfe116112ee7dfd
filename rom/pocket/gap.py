"""The gap between the walls, along the sliding direction: what every model of a line scene solves on."""

from collections.abc import Callable
from dataclasses import dataclass

from roughfilm.contact.foundation.arrays import Array


@dataclass(frozen=True, kw_only=True)
class Gap:
    """One period of a gap h(x), smooth on each piece between neighbouring ``breaks``.

    The upper wall is flat at y = ``film`` and slides; the lower one stands still at y = ``film`` - h(x).

    Parameters
    ----------
    film
        Film thickness where the walls are parallel, m; the unit of length inside the solvers.
    breaks
        Where h or a derivative of it is not smooth, from one end of the period to the other, m, increasing.
    corners
        Those breaks where the slope of h jumps, m; the end of the period, which is also its start, counts as its start.
    thickness
        h(x), m, for x in m; vectorised; periodic over ``length``.
    """

    film: float
    breaks: tuple[float, ...]
    corners: tuple[float, ...]
    thickness: Callable[[Array], Array]

    @property
    def length(self) -> float:
        """Length of the period, m."""
        return self.breaks[-1] - self.breaks[0]

    @property
    def pieces(self) -> tuple[tuple[float, float], ...]:
        """The intervals on which h is smooth, m."""
        return tuple(zip(self.breaks[:-1], self.breaks[1:], strict=True))
