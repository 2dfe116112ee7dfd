"""The two walls of a rough gap over one period."""

from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from roughfilm.contact.foundation.arrays import Array

TOUCHING = "friction does not converge where the walls touch: it grows as the grid is refined"
"""The reason for which friction has no known error."""


@dataclass(frozen=True, kw_only=True)
class Walls:
    """Heights of both walls at the same nodes of one period in x and y.

    The lower wall is at rest; the upper one slides along x if it is flat. The walls touch where the heights are equal.

    Attributes
    ----------
    lower, upper : heights, m, shape (nx, ny); the upper wall is nowhere below the lower one.
    spacing : (dx, dy) of the nodes, m.
    """

    lower: Array
    upper: Array
    spacing: tuple[float, float]

    @property
    def gap(self) -> Array:
        """Upper minus lower height, m, shape (nx, ny); 0 in contact."""
        return np.asarray(self.upper - self.lower)

    @property
    def mean_gap(self) -> float:
        """Mean gap over all nodes, including contact, m."""
        return float(self.gap.mean())

    @property
    def size(self) -> tuple[float, float]:
        """Length and width of the period, m."""
        (nx, ny), (dx, dy) = self.lower.shape, self.spacing
        return nx * dx, ny * dy

    @property
    def slides(self) -> bool:
        """Whether the upper wall is flat, so that the flow is steady while it slides."""
        return bool(np.ptp(self.upper) == 0)

    @property
    def touch(self) -> bool:
        """Whether the walls are in contact somewhere."""
        return bool((self.gap == 0).any())

    def closed_below(self, smallest: float) -> Self:
        """The walls with contact wherever the gap is smaller than ``smallest``, m."""
        return replace(self, lower=np.where(self.gap < smallest, self.upper, self.lower))
