"""What the heights of a surface or profile are like, wherever they lie: means and moments about their mean."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.surfaces.surface import MAX_LENGTH, Surface

ROUNDING = 32 * np.finfo(np.float64).eps
"""Of the largest height: heights that differ by less are the same number, rounded."""

SMALLEST_DIFFERENCE = 1e-30
"""m; powers of what is below vanish."""


@dataclass(frozen=True, kw_only=True)
class HeightStatistics:
    """Means and moments of heights about their mean: S... for surfaces, R... for profiles.

    Attributes
    ----------
    mean : m, from which all others are taken.
    average : Sa, m, mean of the distances from it.
    rms : Sq, m.
    peak : Sp, m, the highest point above it.
    valley : Sv, m, the lowest point below it; positive.
    skewness : Ssk, mean cube over Sq³.
    kurtosis : Sku, mean fourth power over Sq⁴; 3 for a Gaussian.
    """

    mean: float
    average: float
    rms: float
    peak: float
    valley: float
    skewness: float
    kurtosis: float

    @property
    def total(self) -> float:
        """Sz, which the thesis calls St: from the lowest point to the highest, m."""
        return self.peak + self.valley


def checked(heights: ArrayLike) -> Array:
    """The heights as they are, any shape, m.

    Raises
    ------
    InputError
        If there are none, one is not finite or beyond 1000 km, or all are the same but for rounding.
    """
    z = np.asarray(heights, dtype=np.float64)
    low, high = (z.min(), z.max()) if z.size else (0.0, 0.0)
    largest = max(-low, high)
    if not largest <= MAX_LENGTH:
        raise InputError(f"heights: got {largest:.3g} m; leave out what was not measured and look at the unit")
    if high - low <= max(ROUNDING * largest, SMALLEST_DIFFERENCE):
        raise InputError(f"heights: got {z.size} of {high:.3g} m, all the same; roughness needs at least two heights")
    return z


def deviations(heights: ArrayLike) -> Array:
    """Heights less their mean, any shape, m; raises as `checked`."""
    z = checked(heights)
    deviation: Array = z - z.mean()
    deviation -= deviation.mean()
    return deviation


def surface_deviations(surface: Surface) -> Array:
    """Heights less the mean of the valid ones, and 0 where invalid, shape (nx, ny), m; raises as `checked`."""
    z = np.zeros(surface.shape)
    z[surface.valid] = deviations(surface.heights[surface.valid])
    return z


def height_statistics(heights: ArrayLike) -> HeightStatistics:
    """Height parameters of ISO 25178-2, 4.2 (of ISO 21920-2 for a profile): each point has the same weight.

    Sa = ⟨|z|⟩, Sq² = ⟨z²⟩, Ssk = ⟨z³⟩/Sq³, Sku = ⟨z⁴⟩/Sq⁴ with z measured from the mean; no point is left out.

    Parameters
    ----------
    heights : any shape, m: valid points only.

    Raises
    ------
    InputError
        If there are none, one is not finite or beyond 1000 km, or all are the same but for rounding.

    Examples
    --------
    >>> two = height_statistics([1.0, 3.0])
    >>> two.mean, two.rms, two.total, two.kurtosis
    (2.0, 1.0, 2.0, 1.0)
    """
    z = deviations(heights)
    square = z * z
    variance = float(square.mean())
    return HeightStatistics(
        mean=float(np.asarray(heights, dtype=np.float64).mean()),
        average=float(np.abs(z).mean()),
        rms=variance**0.5,
        peak=float(z.max()),
        valley=float(-z.min()),
        skewness=float((square * z).mean()) / variance**1.5,
        kurtosis=float((square * square).mean()) / variance**2,
    )
