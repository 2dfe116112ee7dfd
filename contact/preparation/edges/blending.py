"""Edges joined as in the source: blend the margin with a low-pass filtered copy; leave the interior."""

from typing import Literal

import numpy as np
import scipy

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.preparation.edges.joined import Joined
from roughfilm.contact.surfaces.surface import Surface

Direction = Literal["x", "y", "both", "none"]

TRUNCATION = 3
"""Distance, in standard deviations, at which the Gaussian filter is truncated."""

MIN_WIDTH = 0.5
"""Smallest standard deviation of the filter, pixels; a narrower filter has no effect."""

AXES: dict[Direction, tuple[int, ...]] = {"x": (0,), "y": (1,), "both": (0, 1), "none": ()}
"""Axes along which edges are joined, by direction."""


def blend_edges(surface: Surface, direction: Direction, *, width: tuple[float, float]) -> Joined:
    """Blend the heights near the edges with a periodic low-pass filtered copy, so that opposite edges match.

    h' = (1 − w) h + w (g ∗ h), with g a periodic Gaussian filter truncated at r = ⌈3 σ⌉ pixels and
    1 − w = (1 − a(x)) (1 − a(y)), where a is the autocorrelation of g at the distance from the nearer edge: 1 at the
    edge, 0 beyond 2 r pixels, where heights stay unchanged bit for bit. If one direction is joined, g and a act along
    this direction only, and ridges across it stay sharp. The margin is smoother than the interior and seals earlier:
    see ``roughfilm.contact.preparation.edges.seams``.

    Parameters
    ----------
    direction : "x" joins the edges x = 0 and x = nx dx, "y" those along y, "both" all, "none" none.
    width : standard deviation σ of g along x and y, m, with 0.5 ≤ σ and ⌈3 σ⌉ ≤ (n − 3)/4 in pixels; the width of a
        direction that is not joined is ignored.

    Returns
    -------
    Joined : periodic unless the direction is "none"; its weight is w.

    Raises
    ------
    InputError
        If a width is out of range, a direction to join has fewer than 11 pixels, or pixels are invalid.

    References
    ----------
    F. Sahlin, Luleå 2008, section E.3.1.
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
    joined = surface.with_heights(heights, periodic=surface.periodic or direction != "none")
    return Joined(surface=joined, weight=1 - untouched)


def largest_width(count: int) -> float:
    """The largest standard deviation, pixels, that leaves the middle of ``count`` pixels unchanged.

    >>> largest_width(240)
    19.666666666666668
    """
    return (count - 3) // 4 / TRUNCATION


def _gaussian(sigma: float, count: int, axis: int) -> Array:
    if largest_width(count) < MIN_WIDTH:
        raise InputError(f"edges: got {count} pixels along {'xy'[axis]}; joining edges needs 11 and more")
    if not MIN_WIDTH <= sigma <= largest_width(count) * (1 + 1e-12):
        raise InputError(
            f"edges: got a width of {sigma:.3g} pixels along {'xy'[axis]}; "
            f"give {MIN_WIDTH} to {largest_width(count):.4g} of the {count}"
        )
    radius = int(np.ceil(TRUNCATION * sigma * (1 - 1e-12)))
    filter_ = np.exp(-0.5 * (np.arange(-radius, radius + 1) / sigma) ** 2)
    return np.asarray(filter_ / filter_.sum())


def _weight(filter_: Array, count: int) -> Array:
    """Autocorrelation of the filter at the distance from the nearer edge, shape (count,); 1 at both edge pixels."""
    weight = np.correlate(filter_, filter_, mode="full")[filter_.size - 1 :]
    distance = np.minimum(np.arange(count), np.arange(count)[::-1])
    weight = np.append(weight / weight[0], 0.0)
    return np.asarray(weight[np.minimum(distance, weight.size - 1)])
