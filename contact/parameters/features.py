"""Feature parameters of a surface, which come from its significant peaks and pits: Spd, Spc, S5p, S5v and S10z."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.parameters.heights import surface_deviations
from roughfilm.contact.parameters.segmentation import hills
from roughfilm.contact.surfaces.surface import Surface

PRUNING = 0.05
"""Height of a hill above its highest saddle over Sz, below which it is merged with its neighbour (ISO 25178-3)."""

HIGHEST_COUNT = 5
"""Number of peaks and of pits that S5p and S5v average."""


@dataclass(frozen=True, kw_only=True)
class Features:
    """The significant peaks or pits of a surface.

    Attributes
    ----------
    density : number of peaks over the area of the valid points, 1/m².
    heights : height of each peak above the mean, or depth of each pit below it, shape (n,), m, descending.
    curvatures : mean of the two principal curvatures at each of them, shape (n,), 1/m, positive at a peak or a pit.
    """

    density: float
    heights: Array
    curvatures: Array

    @property
    def mean_curvature(self) -> float | None:
        """The mean curvature Spc, 1/m; None without a peak."""
        return float(self.curvatures.mean()) if self.curvatures.size else None

    @property
    def five_point_height(self) -> float | None:
        """The mean of the five greatest heights, or of all if they are fewer, m: S5p or S5v; None without a peak."""
        return float(self.heights[:HIGHEST_COUNT].mean()) if self.heights.size else None


def significant_peaks(surface: Surface, pruning: float = PRUNING) -> Features:
    """The peaks of the hills that Wolf pruning leaves.

    A peak counts if its height and its curvature are known: its hill does not touch the edge of the surface, beyond
    which it may be higher, and none of its eight neighbours is invalid. A periodic surface has no edge.

    Parameters
    ----------
    surface : the surface; its invalid points belong to no hill.
    pruning : height of a hill over Sz below which it is merged with the hill that it meets at its highest saddle.

    Returns
    -------
    Features : the curvature is −½ (∂²z/∂x² + ∂²z/∂y²) by second differences at the point of the peak.

    Raises
    ------
    InputError
        If all heights are the same, or the pruning is not a fraction from 0 to 1.

    Notes
    -----
    The error of a height is of second order in the spacing. The error of a curvature is of second order where the peak
    is a point of the grid or symmetric, and of first order elsewhere, with either sign, so that means over many peaks
    have smaller errors. Source: ISO 25178-2:2021, clause 5.
    """
    return _significant(surface_deviations(surface), surface, pruning)


def significant_pits(surface: Surface, pruning: float = PRUNING) -> Features:
    """The pits of the dales that Wolf pruning leaves: `significant_peaks` of the inverted surface."""
    return _significant(-surface_deviations(surface), surface, pruning)


def _significant(z: Array, surface: Surface, pruning: float) -> Features:
    if not 0 <= pruning <= 1:
        raise InputError(f"pruning: got {pruning!r}; give a fraction of Sz from 0 to 1")
    heights = z[surface.valid]
    found = hills(z, surface.valid, periodic=surface.periodic, pruning=pruning * float(np.ptp(heights)))
    peaks = found.peaks if surface.periodic else found.peaks[found.inside()]
    peaks = peaks[_around(surface.valid, peaks, surface.shape).all(axis=(0, 1))]
    near, (dx, dy) = _around(z, peaks, surface.shape), surface.spacing
    middle = near[1, 1]
    along_x, along_y = near[0, 1] - 2 * middle + near[2, 1], near[1, 0] - 2 * middle + near[1, 2]
    return Features(
        density=peaks.size / (heights.size * dx * dy),
        heights=middle,
        curvatures=-(along_x / dx**2 + along_y / dy**2) / 2,
    )


def _around(field: NDArray[Any], places: NDArray[np.intp], shape: tuple[int, int]) -> NDArray[Any]:
    """Values at the 3 x 3 points around each place, shape (3, 3, n), across the edges."""
    i, j = np.divmod(places, shape[1])
    steps = np.arange(-1, 2)
    near: NDArray[Any] = field[np.add.outer(steps, i)[:, None] % shape[0], np.add.outer(steps, j)[None] % shape[1]]
    return near
