"""The gap between an undeformed rough surface and a flat one, over the separation of their mean planes."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.surfaces.surface import MAX_LENGTH, MIN_SPACING
from roughfilm.rom.homogenization.paths import sealed


@dataclass(frozen=True, kw_only=True)
class Separations:
    """The gap h = max(α − z, 0) between an undeformed rough surface and a flat one, for separations α of mean planes.

    Attributes
    ----------
    heights : heights, m, shape (nx, ny), positive towards the flat surface.
    """

    heights: Array

    @cached_property
    def _above(self) -> Array:
        """Heights z above their mean, m."""
        return np.asarray(self.heights - self.heights.mean())

    @cached_property
    def _sorted(self) -> tuple[Array, Array]:
        """Heights z in increasing order, and the mean gap at the separation of each of them."""
        z = np.sort(self._above, axis=None)
        below = np.arange(z.size)
        return z, (below * z - np.concatenate([[0.0], np.cumsum(z)[:-1]])) / z.size

    @property
    def peak(self) -> float:
        """Highest point above the mean, Sp, m."""
        return float(self._above.max())

    @property
    def rms(self) -> float:
        """Rms height Sq, m."""
        return float(self._above.std())

    def gap(self, separation: float) -> Array:
        """The gap h at a separation, m, shape (nx, ny)."""
        return np.maximum(separation - self._above, 0.0)

    def at_mean_gap(self, mean_gap: float) -> float:
        """The separation α, m, at which <h> is ``mean_gap``.

        Raises
        ------
        InputError
            If the mean gap is not between 1e-15 m and 1000 km.
        """
        if not MIN_SPACING <= mean_gap <= MAX_LENGTH:
            raise InputError(f"mean gap: got {mean_gap!r} m; give {MIN_SPACING:g} to {MAX_LENGTH:g} m")
        z, means = self._sorted
        below = int(np.searchsorted(means, mean_gap, side="right"))
        return float(z[below - 1] + (mean_gap - means[below - 1]) * z.size / below)

    def sealing(self) -> tuple[float, float]:
        """The largest heights z at which, as separation, the gap is sealed in x and in y, m.

        They are at least the second lowest height, since at the lowest the gap is closed everywhere; at the second
        lowest a valley along a whole side may be open.
        """
        z = np.unique(self._above)
        heights = []
        for direction in (0, 1):
            shut, open_at = 1, z.size - 1
            if sealed(self.gap(z[-1]))[direction]:
                shut = open_at
            while open_at - shut > 1:
                middle = (shut + open_at) // 2
                if sealed(self.gap(z[middle]))[direction]:
                    shut = middle
                else:
                    open_at = middle
            heights.append(float(z[shut]))
        return heights[0], heights[1]
