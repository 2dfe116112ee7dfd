"""The five highest peaks and lowest valleys of a surface: Spm and Svm."""

import numpy as np
import scipy

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.parameters.heights import surface_deviations
from roughfilm.contact.surfaces.surface import Surface

PEAK_COUNT = 5
"""Number of peaks and of valleys that are averaged."""


def highest_peaks(surface: Surface, distance: float) -> Array:
    """Heights of the five highest peaks above the mean, descending, shape (5,) or fewer, m.

    A peak is the highest valid point of a square of half width ``distance`` around it; of equal points in one square
    only one counts. With the decay length Sal as distance, two peaks belong to different asperities. The square extends
    across the edges of a periodic surface.

    Parameters
    ----------
    distance : half width of the square, m; at least one pixel is used.

    Raises
    ------
    InputError
        If all heights are equal, or the distance is not positive.

    Notes
    -----
    The error of a peak height is of second order in the pixel. The five-point peak height S5p of ISO 25178-2 instead
    prunes hills lower than 5 % of Sz, so that a single spike changes S5p; here a spike is one peak of five.
    """
    return _highest(surface_deviations(surface), surface, distance)


def lowest_valleys(surface: Surface, distance: float) -> Array:
    """Depths of the five lowest valleys, shape (5,) or fewer, m, positive: `highest_peaks` of the inverted surface."""
    return _highest(-surface_deviations(surface), surface, distance)


def _highest(z: Array, surface: Surface, distance: float) -> Array:
    if not distance > 0:
        raise InputError(f"peaks: got a distance of {distance!r} m; give one above zero")
    z[surface.invalid] = -np.inf
    limit = [n // 2 if surface.periodic else n - 1 for n in surface.shape]
    half = [max(1, int(min(distance / d, top))) for d, top in zip(surface.spacing, limit, strict=True)]
    around = scipy.ndimage.maximum_filter(
        z, size=[2 * h + 1 for h in half], mode="wrap" if surface.periodic else "constant", cval=-np.inf
    )
    places = np.argwhere((z == around) & surface.valid)
    height = z[tuple(places.T)]
    peaks: list[float] = []
    while height.size and len(peaks) < PEAK_COUNT:
        top = height.argmax()
        peaks.append(float(height[top]))
        apart = np.abs(places - places[top])
        if surface.periodic:
            apart = np.minimum(apart, surface.shape - apart)
        others = (apart > half).any(axis=1)
        places, height = places[others], height[others]
    return np.array(peaks)
