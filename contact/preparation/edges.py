"""Step 6: opposite edges made to meet, the middle left as it was measured."""

from typing import Literal

import numpy as np
from scipy.ndimage import correlate1d

from contact.errors import InputError
from contact.surface import Array, Surface

Direction = Literal["x", "y", "both", "none"]

REACH = 3
"""Standard deviations at which the Gaussian filter ends; its autocorrelation ends at twice as many."""

AXES: dict[Direction, tuple[int, ...]] = {"x": (0,), "y": (1,), "both": (0, 1), "none": ()}


def make_periodic(surface: Surface, direction: Direction, *, width: float) -> Surface:
    """Blend the heights near the edges into a low-passed copy that knows of the opposite edge.

    h' = (1 − w) h + w (g ∗ h), with g a Gaussian that ends at 3 standard deviations and is wrapped round, and
    1 − w = (1 − a(x)) (1 − a(y)), where a is the autocorrelation of g over the distance from the nearer edge: 1 at
    the edge, 0 beyond 6 standard deviations. There the heights stay untouched to the last bit. In one direction only,
    g and a act along that one alone, and ridges across it stay sharp; the edges of the other direction stay as they
    are.

    Parameters
    ----------
    direction : "x" joins the edges x = 0 and x = nx dx, "y" the others, "both" all, "none" nothing.
    width : standard deviation of g along each direction, m; at least half a pixel, at most a twelfth of the surface.

    Returns
    -------
    The surface, marked periodic.

    Raises
    ------
    InputError
        If the width is out of range or pixels are invalid.

    References
    ----------
    F. Sahlin, Luleå 2008, section E.3.1: weight from the autocorrelation of the filter; in one direction for a lay.
    """
    if surface.invalid.any():
        raise InputError(f"edges: {surface.invalid.sum()} pixels are invalid; fill them first")
    blurred, untouched = surface.heights, np.ones(surface.shape)
    for axis in AXES[direction]:
        spacing, count = surface.spacing[axis], surface.shape[axis]
        filter_ = _gaussian(width / spacing, count, axis)
        blurred = correlate1d(blurred, filter_, axis=axis, mode="wrap")
        weight = _weight(filter_, count)
        untouched = untouched * (1 - (weight[:, None] if axis == 0 else weight[None, :]))
    heights = np.where(untouched == 1, surface.heights, untouched * surface.heights + (1 - untouched) * blurred)
    return surface.with_heights(heights, periodic=True)


def _gaussian(sigma: float, count: int, axis: int) -> Array:
    if count < 2 * REACH:
        raise InputError(f"edges: got {count} pixels along {'xy'[axis]}; joining edges needs {2 * REACH} and more")
    if not 0.5 <= sigma <= count / (4 * REACH):
        raise InputError(
            f"edges: got a width of {sigma:.3g} pixels along {'xy'[axis]}; "
            f"give 0.5 to {count // (4 * REACH)} of the {count}"
        )
    reach = int(np.ceil(REACH * sigma))
    filter_ = np.exp(-0.5 * (np.arange(-reach, reach + 1) / sigma) ** 2)
    return np.asarray(filter_ / filter_.sum())


def _weight(filter_: Array, count: int) -> Array:
    """The filter's autocorrelation over the number of pixels to the nearer edge, 1 at both edge pixels."""
    reached = np.correlate(filter_, filter_, mode="full")[filter_.size - 1 :]
    distance = np.minimum(np.arange(count), np.arange(count)[::-1])
    reached = np.append(reached / reached[0], 0.0)
    return np.asarray(reached[np.minimum(distance, reached.size - 1)])
