"""Step 6: opposite edges made to meet, the middle left as it was measured."""

from typing import Literal

import numpy as np
import scipy

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.surfaces.surface import Array, Surface

Direction = Literal["x", "y", "both", "none"]

REACH = 3
"""Standard deviations at which the Gaussian filter ends; its autocorrelation ends at twice as many."""

LEAST_WIDTH = 0.5
"""Pixels: a finer filter blurs nothing."""

AXES: dict[Direction, tuple[int, ...]] = {"x": (0,), "y": (1,), "both": (0, 1), "none": ()}


def make_periodic(surface: Surface, direction: Direction, *, width: tuple[float, float]) -> Surface:
    """Blend the heights near the edges into a low-passed copy that knows of the opposite edge.

    h' = (1 − w) h + w (g ∗ h), with g a Gaussian that is cut at r = ⌈3 σ⌉ pixels and wrapped round, and
    1 − w = (1 − a(x)) (1 − a(y)), where a is the autocorrelation of g over the distance from the nearer edge: 1 at
    the edge, 0 beyond 2 r pixels, from where on heights stay untouched to the last bit. In one direction only, g and
    a act along that one alone, and ridges across it stay sharp; the edges of the other direction stay as they are.

    Parameters
    ----------
    direction : "x" joins the edges x = 0 and x = nx dx, "y" the others, "both" all, "none" nothing.
    width : standard deviation σ of g along x and y, m: from half a pixel to what leaves pixels untouched in the middle,
        ⌈3 σ⌉ ≤ (n − 3)/4. That of a direction which is not joined does not count.

    Returns
    -------
    The surface, marked periodic unless nothing was joined.

    Raises
    ------
    InputError
        If a width is out of range, there are fewer than 11 pixels to join, or pixels are invalid.

    References
    ----------
    F. Sahlin, Luleå 2008, section E.3.1: weight from the autocorrelation of the filter; in one direction for a lay.
    """
    if surface.invalid.any():
        raise InputError(f"edges: {surface.invalid.sum()} pixels are invalid; fill them first")
    blurred, untouched = surface.heights, np.ones(surface.shape)
    for axis in AXES[direction]:
        spacing, count = surface.spacing[axis], surface.shape[axis]
        filter_ = _gaussian(width[axis] / spacing, count, axis)
        blurred = scipy.ndimage.correlate1d(blurred, filter_, axis=axis, mode="wrap")
        weight = _weight(filter_, count)
        untouched = untouched * (1 - (weight[:, None] if axis == 0 else weight[None, :]))
    heights = np.where(untouched == 1, surface.heights, untouched * surface.heights + (1 - untouched) * blurred)
    return surface.with_heights(heights, periodic=surface.periodic or direction != "none")


def widest(count: int) -> float:
    """The largest standard deviation, in pixels, that leaves the middle of so many pixels untouched.

    >>> widest(240)
    19.666666666666668
    """
    return (count - 3) // 4 / REACH


def _gaussian(sigma: float, count: int, axis: int) -> Array:
    if widest(count) < LEAST_WIDTH:
        raise InputError(f"edges: got {count} pixels along {'xy'[axis]}; joining edges needs 11 and more")
    if not LEAST_WIDTH <= sigma <= widest(count) * (1 + 1e-12):
        raise InputError(
            f"edges: got a width of {sigma:.3g} pixels along {'xy'[axis]}; "
            f"give {LEAST_WIDTH} to {widest(count):.4g} of the {count}"
        )
    reach = int(np.ceil(REACH * sigma * (1 - 1e-12)))
    filter_ = np.exp(-0.5 * (np.arange(-reach, reach + 1) / sigma) ** 2)
    return np.asarray(filter_ / filter_.sum())


def _weight(filter_: Array, count: int) -> Array:
    """The filter's autocorrelation over the number of pixels to the nearer edge, 1 at both edge pixels."""
    reached = np.correlate(filter_, filter_, mode="full")[filter_.size - 1 :]
    distance = np.minimum(np.arange(count), np.arange(count)[::-1])
    reached = np.append(reached / reached[0], 0.0)
    return np.asarray(reached[np.minimum(distance, reached.size - 1)])
