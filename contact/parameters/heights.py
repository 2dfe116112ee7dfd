"""Height parameters of a surface or profile: means and moments of the heights about their mean."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from roughfilm.contact.foundation.arrays import Array, unmasked
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.surfaces.surface import MAX_LENGTH, Surface

ROUNDING = 32 * np.finfo(np.float64).eps
"""Relative rounding error; heights that differ by less than this fraction of the largest height are equal."""

MIN_HEIGHT_DIFFERENCE = 1e-30
"""Height difference, m, below which heights count as equal, as their powers underflow."""


@dataclass(frozen=True, kw_only=True)
class HeightStatistics:
    """Means and moments of heights about their mean: S... for surfaces, R... for profiles.

    Attributes
    ----------
    mean : mean height, m; all others are measured from it.
    average : Sa, m; mean absolute height.
    rms : Sq, m; root mean square height.
    peak : Sp, m; largest height.
    valley : Sv, m; largest depth, positive.
    skewness : Ssk, ⟨z³⟩/Sq³.
    kurtosis : Sku, ⟨z⁴⟩/Sq⁴; 3 for Gaussian heights.
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
        """The total height Sz = Sp + Sv, m, which the thesis calls St."""
        return self.peak + self.valley


def checked(heights: ArrayLike) -> Array:
    """The heights as an array of floats, any shape, m.

    Raises
    ------
    InputError
        If there are no heights, one is not finite or above 1e6 m, or all are equal to rounding.
    """
    z = np.asarray(unmasked("heights", heights), dtype=np.float64)
    low, high = (z.min(), z.max()) if z.size else (0.0, 0.0)
    largest = max(-low, high)
    if not largest <= MAX_LENGTH:
        raise InputError(f"heights: got {largest:.3g} m; leave out what was not measured and look at the unit")
    if high - low <= max(ROUNDING * largest, MIN_HEIGHT_DIFFERENCE):
        raise InputError(f"heights: got {z.size} of {high:.3g} m, all the same; roughness needs at least two heights")
    return z


def deviations(heights: ArrayLike) -> Array:
    """The heights minus their mean, any shape, m; raises InputError as `checked` does."""
    z = checked(heights)
    deviation: Array = z - z.mean()
    deviation -= deviation.mean()
    return deviation


def surface_deviations(surface: Surface) -> Array:
    """Heights minus the mean of the valid ones, 0 where invalid, shape (nx, ny), m; raises as `checked` does."""
    z = np.zeros(surface.shape)
    z[surface.valid] = deviations(surface.heights[surface.valid])
    return z


def height_statistics(heights: ArrayLike) -> HeightStatistics:
    """Height parameters of a surface (ISO 25178-2, 4.2) or a profile (ISO 21920-2); all points have the same weight.

    Sa = ⟨|z|⟩, Sq² = ⟨z²⟩, Ssk = ⟨z³⟩/Sq³, Sku = ⟨z⁴⟩/Sq⁴ with z measured from the mean.

    Parameters
    ----------
    heights : any shape, m; valid points only.

    Raises
    ------
    InputError
        If there are no heights, one is not finite or above 1e6 m, or all are equal to rounding.

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
