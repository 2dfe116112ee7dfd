"""Step 7 of the preparation: resample the surface to another number of pixels."""

from typing import Literal

import numpy as np
import scipy

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.surfaces.surface import Surface

Method = Literal["linear", "band-limited"]


def next_power_of_two(count: int) -> int:
    """The smallest power of two that is at least ``count``.

    >>> next_power_of_two(480), next_power_of_two(512)
    (512, 512)
    """
    return 1 << (count - 1).bit_length()


def resample(surface: Surface, points: tuple[int, int], method: Method = "linear") -> Surface:
    """Resample the surface over the same rectangle to ``points`` pixels along x and y.

    Parameters
    ----------
    points : (nx, ny), at least 2 each.
    method : "linear" interpolates linearly between the centres of pixels, and beyond the outermost ones towards the
        opposite edge if the surface is periodic, else constant; where pixels grow, each new height is the mean of the
        interpolant over the new pixel, which prevents aliasing. The error is of second order for smooth surfaces.
        "band-limited" is trigonometric interpolation of a periodic surface with pixel (0, 0) fixed, exact if every
        wave spans at least two new pixels.

    Raises
    ------
    InputError
        If a direction gets fewer than 2 pixels, pixels are invalid, or "band-limited" is asked for a surface that is
        not periodic.
    """
    if min(points) < 2:
        raise InputError(f"grid: got {points[0]} x {points[1]} points; at least 2 x 2 are needed")
    if surface.invalid.any():
        raise InputError(f"grid: {surface.invalid.sum()} pixels are invalid; fill them first")
    if method == "band-limited" and not surface.periodic:
        raise InputError("grid: 'band-limited' needs a periodic surface; use 'linear'")
    heights = surface.heights
    for axis, count in enumerate(points):
        if count != surface.shape[axis]:
            lines = np.moveaxis(heights, axis, 0)
            if method == "linear":
                around = lines if surface.periodic else lines[::-1]  # the lines before the first and behind the last
                resampled = _linear(np.concatenate([around[-1:], lines, around[:1]]), count)
            else:
                resampled = _band_limited(lines, count)
            heights = np.moveaxis(resampled, 0, axis)
    spacing = (surface.size[0] / points[0], surface.size[1] / points[1])
    return surface.with_heights(heights, spacing=spacing, invalid=np.zeros(points, dtype=bool))


def _linear(padded: Array, count: int) -> Array:
    """``count`` lines over the lines of ``padded`` without its first and last."""
    old = padded.shape[0] - 2
    if count > old:
        return _interpolated(padded, (np.arange(count) + 0.5) * old / count + 0.5)
    sums = np.concatenate([np.zeros_like(padded[:1]), np.cumsum((padded[1:] + padded[:-1]) / 2, axis=0)])
    edges = np.arange(count + 1) * old / count + 0.5  # in pixels from the centre of the first padded pixel
    whole = np.minimum(edges.astype(int), old)
    fraction = (edges - whole)[:, None]
    here, next_ = padded[whole], padded[whole + 1]
    integral = sums[whole] + fraction * (here + (next_ - here) * fraction / 2)
    return np.asarray(np.diff(integral, axis=0) * count / old)


def _interpolated(heights: Array, places: Array) -> Array:
    whole = places.astype(int)
    fraction = (places - whole)[:, None]
    return np.asarray((1 - fraction) * heights[whole] + fraction * heights[whole + 1])


def _band_limited(heights: Array, count: int) -> Array:
    old = heights.shape[0]
    waves = scipy.fft.rfft(heights, axis=0)
    kept = min(old, count) // 2 + 1
    spectrum = np.zeros((count // 2 + 1, heights.shape[1]), dtype=complex)
    spectrum[:kept] = waves[:kept]
    if min(old, count) % 2 == 0:
        spectrum[kept - 1] *= 0.5 if count > old else 2.0
        if count < old:
            spectrum[kept - 1] = spectrum[kept - 1].real
    return np.asarray(scipy.fft.irfft(spectrum, n=count, axis=0) * count / old)
