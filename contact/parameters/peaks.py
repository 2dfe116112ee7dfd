"""The five highest peaks and lowest valleys of a surface: Spm and Svm."""

import numpy as np
import scipy

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.parameters.heights import surface_deviations
from roughfilm.contact.surfaces.surface import Array, Surface

COUNT = 5


def highest_peaks(surface: Surface, distance: float) -> Array:
    """Heights of the five highest peaks above the mean, from the highest down, shape (5,), m, or fewer if there are.

    A peak is a valid point that no valid one within ``distance`` in x and in y exceeds; of equal ones that near each
    other one counts. With the decay length Sal for the distance, two peaks belong to different bumps. A periodic
    surface goes on beyond its edges; beyond those of another nothing is higher.

    Heights are of second order in the pixel; a summit whose higher neighbour is just at the distance may come or go.

    Parameters
    ----------
    distance : m, half the sides of the square; at least one pixel is looked at on each side.

    Raises
    ------
    InputError
        If all heights are the same, or the distance is not positive.

    Notes
    -----
    ISO 25178-2's five-point peak height S5p prunes hills by height instead, at 5 % of Sz: a single spike makes that
    threshold, and so S5p, a matter of the spike. Here a spike counts as one of the five.
    """
    return _highest(surface_deviations(surface), surface, distance)


def lowest_valleys(surface: Surface, distance: float) -> Array:
    """Depths of the five lowest valleys below the mean, as `highest_peaks` of the surface upside down; positive."""
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
    while height.size and len(peaks) < COUNT:
        top = height.argmax()
        peaks.append(float(height[top]))
        apart = np.abs(places - places[top])
        if surface.periodic:
            apart = np.minimum(apart, surface.shape - apart)
        others = (apart > half).any(axis=1)
        places, height = places[others], height[others]
    return np.array(peaks)
