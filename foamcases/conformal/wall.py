"""The grooved wall of a gap by its arc length, so that steep walls have as many points as flat ones."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.thin_film.columns import columns
from roughfilm.rom.thin_film.gap import Gap

POINTS = 4000
"""Number of points that are spread evenly over the arc length of the wall."""

CROWDED_POINTS = 1000
"""Number of points that are crowded at the breaks of the gap."""


@dataclass(frozen=True, kw_only=True)
class Wall:
    """The lower wall over one period of a gap, in film thicknesses.

    Attributes
    ----------
    gap : the gap.
    x : positions of points on the wall, increasing, shape (n,).
    arc : length of the wall up to these points, shape (n,).
    """

    gap: Gap
    x: Array
    arc: Array

    @property
    def period(self) -> float:
        """Length of the period along x."""
        return float(self.x[-1] - self.x[0])

    @cached_property
    def length(self) -> float:
        """Arc length of the wall over the period."""
        return float(self.arc[-1])

    def points(self, arc: Array) -> Array:
        """The points (x, y) at arc lengths in any period; the shape of ``arc`` and 2."""
        turns = np.floor(arc / self.length)
        x = np.interp(arc - turns * self.length, self.arc, self.x)
        return np.stack([x + turns * self.period, 1 - self.gap.thickness(x * self.gap.film) / self.gap.film], axis=-1)


def wall_of(gap: Gap) -> Wall:
    """The lower wall of a gap."""
    x = columns(gap, CROWDED_POINTS)
    for _ in range(2):  # the second time with the arc length of steep walls resolved
        arc = _arc(gap, x)
        x = np.unique(np.concatenate([x, np.interp(np.linspace(0, arc[-1], POINTS), arc, x)]))
    return Wall(gap=gap, x=x, arc=_arc(gap, x))


def _arc(gap: Gap, x: Array) -> Array:
    y = gap.thickness(x * gap.film) / gap.film
    return np.append(0.0, np.cumsum(np.hypot(np.diff(x), np.diff(y))))
