"""The gap between two walls along the sliding direction."""

from collections.abc import Callable
from dataclasses import dataclass

from roughfilm.contact.foundation.arrays import Array


@dataclass(frozen=True, kw_only=True)
class Gap:
    """One period of a gap h(x), smooth on each piece between neighbouring ``breaks``.

    The upper wall is flat at y = ``film`` and slides; the lower one is fixed at y = ``film`` - h(x).

    Parameters
    ----------
    film
        Film thickness where the walls are parallel, m; the unit of length inside the solvers.
    breaks
        Positions at which h or a derivative is not smooth, and both ends of the period, m, increasing.
    corners
        The breaks at which the slope of h jumps, m; the start stands for both ends of the period.
    thickness
        Film thickness h(x), m, for x in m; vectorised; periodic over ``length``.
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
