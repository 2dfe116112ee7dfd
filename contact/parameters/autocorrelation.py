"""How heights at a distance resemble each other, and the distance over which they cease to: Sal and Str."""

from dataclasses import dataclass

import numpy as np
import scipy

from roughfilm.contact.parameters.heights import surface_deviations
from roughfilm.contact.surfaces.surface import Array, Mask, Surface

DECAYED = 0.2
"""Autocorrelation at which heights count as no longer alike (ISO 25178-3)."""

MARGIN = 24
"""Pixels around a patch, over which the error a spline makes at its edge dies away (0.27 a pixel)."""


@dataclass(frozen=True, kw_only=True)
class DecayLengths:
    """How far the central lobe of an autocorrelation, where it is above 0.2, reaches from its middle.

    Attributes
    ----------
    shortest : Sal, m.
    longest : m.
    closed : whether the lobe ends inside the window of lags; else ``longest`` is where it meets the window's edge,
        a lower bound, and Str an upper bound.
    """

    shortest: float
    longest: float
    closed: bool

    @property
    def aspect(self) -> float:
        """Str, from 0 (all one direction) to 1 (isotropic)."""
        return self.shortest / self.longest


def autocorrelation(surface: Surface) -> Array:
    """Mean product of heights a lag apart, over all pairs of valid points, relative to their mean square.

    r(t) = ⟨z(x) z(x + t)⟩ / ⟨z²⟩. On a periodic surface pairs reach across its edges; otherwise only pairs within
    the surface count, which is the unbiased estimate.

    Returns
    -------
    shape (2 (nx//2) + 1, 2 (ny//2) + 1): lag ((i − nx//2) dx, (j − ny//2) dy); 1 in the middle, and 0 at lags
    of which there is no pair.

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

    The lobe is what is above 0.2 and connected to the middle. Its outline is found where lines of pixels cross it,
    then, around the nearest and the farthest of these points, on rays through a cubic spline. Where the lobe runs
    into the edge of the window of lags (half the surface), the edge is its end (see `DecayLengths`); if it drops to
    0.2 nowhere, ``shortest`` too is the nearest edge, a lower bound.

    Parameters
    ----------
    correlation : shape (2 hx + 1, 2 hy + 1), 1 in the middle, from `autocorrelation`.
    spacing : (dx, dy), m.

    Notes
    -----
    Within 10⁻³, 10⁻⁴ and 10⁻⁵ for a Gaussian whose shorter correlation length is 4, 8 and 16 pixels.
    ISO 25178-2:2021, 4.3.2 and 4.3.3.
    """
    middle = np.array(correlation.shape) // 2
    labels, _ = scipy.ndimage.label(correlation > DECAYED)
    lobe = labels == labels[tuple(middle)]
    edge = np.argwhere(_border(lobe))
    ends = np.hypot(*((edge - middle) * spacing).T)
    outline = np.concatenate([_crossings(correlation, lobe, axis) for axis in (0, 1)])
    if outline.size == 0:
        return DecayLengths(shortest=float(min(middle * spacing)), longest=float(ends.max()), closed=False)
    reach = np.hypot(*((outline - middle) * spacing).T)
    near = _rays(correlation, spacing, outline[reach.argmin()])
    far = _rays(correlation, spacing, outline[reach.argmax()])
    return DecayLengths(
        shortest=float(near.min() if near.size else reach.min()),
        longest=float(max(far.max() if far.size else reach.max(), ends.max(initial=0.0))),
        closed=ends.size == 0,
    )


def _border(lobe: Mask) -> Mask:
    """The part of the lobe on the edge of the window."""
    rim = np.ones_like(lobe)
    rim[1:-1, 1:-1] = False
    border: Mask = lobe & rim
    return border


def _crossings(correlation: Array, lobe: Mask, axis: int) -> Array:
    """Where lines of pixels along an axis leave the lobe, shape (n, 2), pixels."""
    inner = np.argwhere(np.diff(lobe, axis=axis))
    step = np.eye(2, dtype=np.intp)[axis]
    r, beyond = correlation[tuple(inner.T)], correlation[tuple((inner + step).T)]
    crossing: Array = inner + ((r - DECAYED) / (r - beyond))[:, None] * step
    return crossing


def _rays(correlation: Array, spacing: tuple[float, float], point: Array) -> Array:
    """Distances at which rays within a pixel of a point of the outline leave the lobe, m."""
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
    low = [max(0, int(p.min()) - MARGIN) for p in place]
    patch = correlation[tuple(slice(a, int(p.max()) + MARGIN) for a, p in zip(low, place, strict=True))]
    r = scipy.ndimage.map_coordinates(patch, [p - a for p, a in zip(place, low, strict=True)], order=3, mode="constant")
    inside: Mask = r > DECAYED
    leaves = inside[0] & ~inside.all(axis=0)
    last = inside.argmin(axis=0)[leaves] - 1
    rays = np.flatnonzero(leaves)
    before, after = r[last, rays], r[last + 1, rays]
    crossing: Array = radius[last] + (before - DECAYED) / (before - after) * (radius[1] - radius[0])
    return crossing
