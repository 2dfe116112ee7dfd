"""Step 9 of the preparation: reduce noise by a moving average."""

import scipy

from roughfilm.contact.foundation.arrays import beyond_rounding
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.surfaces.surface import Surface


def smooth(surface: Surface, points: int) -> Surface:
    """Replace each height by the mean of ``points`` by ``points`` heights around it, periodic across the edges.

    The mean height stays; the amplitude of a wave of wavelength λ along x is multiplied by
    sin(π n dx/λ) / (n sin(π dx/λ)), with n = ``points``. The surface is unchanged for n = 1.

    Raises
    ------
    InputError
        If ``points`` is even, below 1 or above the number of pixels in a direction, or pixels are invalid.

    References
    ----------
    F. Sahlin, Luleå 2008, section E.3.1 (three points).
    """
    if points == 1:
        return surface
    if points < 1 or points % 2 == 0 or points > min(surface.shape):
        raise InputError(f"smoothing: got {points} points; give an odd number up to the number of pixels, such as 3")
    if surface.invalid.any():
        raise InputError(f"smoothing: {surface.invalid.sum()} pixels are invalid; fill them first")
    heights = scipy.ndimage.uniform_filter(surface.heights, size=points, mode="wrap")
    return surface.with_heights(beyond_rounding(heights, surface.heights))
