"""The autocorrelation of the heights of a surface, and its decay lengths Sal and Str."""

from dataclasses import dataclass

import numpy as np
import scipy

from roughfilm.contact.foundation.arrays import Array, Mask
from roughfilm.contact.parameters.heights import surface_deviations
from roughfilm.contact.surfaces.surface import Surface

DECAY_THRESHOLD = 0.2
"""Autocorrelation that defines the decay lengths (ISO 25178-3)."""

SPLINE_MARGIN = 24
"""Width of the margin around a patch, pixels; the edge error of a cubic spline falls by 0.27 a pixel."""


@dataclass(frozen=True, kw_only=True)
class DecayLengths:
    """Shortest and longest radius of the central lobe of an autocorrelation, where it exceeds 0.2.

    Attributes
    ----------
    shortest : Sal, m.
    longest : m.
    closed : whether the lobe lies inside the window of lags; otherwise ``longest`` is a lower bound, the distance to
        the edge of the window, and Str an upper bound.
    """

    shortest: float
    longest: float
    closed: bool

    @property
    def aspect(self) -> float:
        """The texture aspect ratio Str, from 0 (one direction) to 1 (isotropic)."""
        return self.shortest / self.longest


def autocorrelation(surface: Surface) -> Array:
    """The autocorrelation r(t) = ⟨z(x) z(x + t)⟩ / ⟨z²⟩ over all pairs of valid points.

    Pairs extend across the edges of a periodic surface; otherwise only pairs inside the surface count, which gives the
    unbiased estimate.

    Returns
    -------
    Array : shape (2 (nx//2) + 1, 2 (ny//2) + 1), at the lags ((i − nx//2) dx, (j − ny//2) dy); 1 in the middle, 0 at
        lags without a pair.

    Raises
    ------
    InputError
        If all heights are the same.
    """
    z = surface_deviations(surface)
    half = [n // 2 for n in surface.shape]
    lags = [np.arange(-h, h + 1) for h in half]
    grid = np.ix_(*lags)
    padded = [
        n if surface.periodic else scipy.fft.next_fast_len(n + h, real=True)
        for n, h in zip(surface.shape, half, strict=True)
    ]

    def sums(field: Array) -> Array:
        transform = scipy.fft.rfft2(field, s=padded)
        products: Array = scipy.fft.irfft2(transform.real**2 + transform.imag**2, s=padded)[grid]
        return products

    if surface.invalid.any():
        pairs = np.rint(sums(surface.valid.astype(np.float64)))
    elif surface.periodic:
        pairs = np.full([lag.size for lag in lags], float(z.size))
    else:
        pairs = np.outer(*(n - np.abs(lag) for n, lag in zip(surface.shape, lags, strict=True))).astype(np.float64)
    products = sums(z)
    r = np.divide(products, pairs, out=np.zeros_like(products), where=pairs > 0)
    r /= r[half[0], half[1]]
    return r


def decay_lengths(correlation: Array, spacing: tuple[float, float]) -> DecayLengths:
    """Shortest and longest distance at which an autocorrelation first drops to 0.2: Sal, and Str = Sal/longest.

    The lobe is the region above 0.2 that is connected to the middle. Its outline is located along lines of pixels by
    linear interpolation, then, near its nearest and farthest point, along rays by a cubic spline. If the lobe touches
    the edge of the window of lags (half the surface), the edge bounds it (see `DecayLengths`); if the autocorrelation
    drops to 0.2 nowhere, ``shortest`` is the distance to the nearest edge, a lower bound.

    Parameters
    ----------
    correlation : shape (2 hx + 1, 2 hy + 1), 1 in the middle, from `autocorrelation`.
    spacing : (dx, dy), m.

    Notes
    -----
    The relative error is below 10⁻³, 10⁻⁴ and 10⁻⁵ for a Gaussian whose shorter correlation length is 4, 8 and 16
    pixels. Source: ISO 25178-2:2021, 4.3.2 and 4.3.3.
    """
    middle = np.array(correlation.shape) // 2
    labels, _ = scipy.ndimage.label(correlation > DECAY_THRESHOLD)
    lobe = labels == labels[tuple(middle)]
    edge = np.argwhere(_border(lobe))
    ends = np.hypot(*((edge - middle) * spacing).T)
    outline = np.concatenate([_crossings(correlation, lobe, axis) for axis in (0, 1)])
    if outline.size == 0:
        return DecayLengths(shortest=float(min(middle * spacing)), longest=float(ends.max()), closed=False)
    distances = np.hypot(*((outline - middle) * spacing).T)
    near = _rays(correlation, spacing, outline[distances.argmin()])
    far = _rays(correlation, spacing, outline[distances.argmax()])
    return DecayLengths(
        shortest=float(near.min() if near.size else distances.min()),
        longest=float(max(far.max() if far.size else distances.max(), ends.max(initial=0.0))),
        closed=ends.size == 0,
    )


def _border(lobe: Mask) -> Mask:
    """Mask of the pixels of the lobe on the edge of the window."""
    border = lobe.copy()
    border[1:-1, 1:-1] = False
    return border


def _crossings(correlation: Array, lobe: Mask, axis: int) -> Array:
    """Points where lines of pixels along an axis leave the lobe, shape (n, 2), pixels."""
    inner = np.argwhere(np.diff(lobe, axis=axis))
    step = np.eye(2, dtype=np.intp)[axis]
    r, beyond = correlation[tuple(inner.T)], correlation[tuple((inner + step).T)]
    crossing: Array = inner + ((r - DECAY_THRESHOLD) / (r - beyond))[:, None] * step
    return crossing


def _rays(correlation: Array, spacing: tuple[float, float], point: Array) -> Array:
    """Distances at which rays near a point of the outline leave the lobe, shape (rays,), m."""
    middle = np.array(correlation.shape) // 2
    x, y = (point - middle) * spacing
    distance = np.hypot(x, y)
    pixel = min(np.hypot(*spacing), distance)
    offset = np.linspace(-pixel, pixel, 65)
    angle = np.arctan2(y, x) + offset / distance
    radius = distance + offset
    place = [
        m + np.outer(radius, direction) / d
        for m, direction, d in zip(middle, (np.cos(angle), np.sin(angle)), spacing, strict=True)
    ]
    low = [max(0, int(p.min()) - SPLINE_MARGIN) for p in place]
    patch = correlation[tuple(slice(a, int(p.max()) + SPLINE_MARGIN) for a, p in zip(low, place, strict=True))]
    r = scipy.ndimage.map_coordinates(patch, [p - a for p, a in zip(place, low, strict=True)], order=3, mode="constant")
    inside: Mask = r > DECAY_THRESHOLD
    leaves = inside[0] & ~inside.all(axis=0)
    last = inside.argmin(axis=0)[leaves] - 1
    rays = np.flatnonzero(leaves)
    before, after = r[last, rays], r[last + 1, rays]
    crossing: Array = radius[last] + (before - DECAY_THRESHOLD) / (before - after) * (radius[1] - radius[0])
    return crossing
