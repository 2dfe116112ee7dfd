"""Depths of dimples over the distances s along and t across from their middle, before rotation; lengths in m."""

from collections.abc import Callable
from functools import cache

import numpy as np

from roughfilm.contact.foundation.arrays import Array

Depth = Callable[[Array, Array], Array]
"""Function d(s, t) >= 0, m, zero outside of the outline; s and t are broadcast."""

STEEPEST = 1e3
"""Largest slope of a wall at its rim by which a rim is rounded; a half ellipsoid is vertical there."""


def _rounded(signed: Array, *, slope: float, edge: float) -> Array:
    """The depth max(f, 0) of f, which is negative outside of the outline, with the rim rounded over the width ``edge``.

        d = (f + e)²/4e   for |f| < e = slope edge / 2,

    a parabola that joins both sides with continuous slope.
    """
    half = slope * edge / 2
    if half == 0:
        return np.maximum(signed, 0.0)
    return np.where(np.abs(signed) < half, (signed + half) ** 2 / (4 * half), np.maximum(signed, 0.0))


def ellipsoidal(*, width: float, breadth: float, depth: float, edge: float = 0.0) -> Depth:
    """A spherical cap that is stretched to an ellipse as outline; a spherical cap if width and breadth are equal.

    With ρ² = (2s/width)² + (2t/breadth)², a half of the smaller extent, and R = (a² + d²)/2d, 0 < d <= a,

        d(s, t) = sqrt(R² - a²ρ²) - (R - d)   for ρ < 1.

    ``edge`` is the width over which the rim is rounded, where the smaller extent lies.
    """
    a = min(width, breadth) / 2
    radius = (a**2 + depth**2) / (2 * depth)
    slope = min(a / max(radius - depth, a / STEEPEST), STEEPEST)

    def depth_at(s: Array, t: Array) -> Array:
        rho = np.hypot(2 * s / width, 2 * t / breadth)
        inside = a * np.minimum(rho, 1.0)
        numerator = a**2 - inside**2
        denominator = np.sqrt(np.maximum(radius**2 - inside**2, 0.0)) + radius - depth
        cap = np.divide(numerator, denominator, out=np.zeros_like(inside), where=numerator > 0)
        return _rounded(np.where(rho < 1, cap, slope * a * (1 - rho)), slope=slope, edge=edge)

    return depth_at


def conical(*, width: float, depth: float, edge: float = 0.0) -> Depth:
    """A cone, d(s, t) = d (1 - 2r/width) with r² = s² + t², its rim rounded over ``edge``."""
    slope = 2 * depth / width
    return lambda s, t: _rounded(depth - slope * np.hypot(s, t), slope=slope, edge=edge)


def _floor(inside: Array, *, depth: float, edge: float) -> Array:
    """The depth over the distance from the outline inwards: a ramp of the width ``edge``, then a flat floor."""
    return np.asarray(depth * np.clip(inside / edge, 0.0, 1.0))


def box(*, width: float, breadth: float, depth: float, edge: float) -> Depth:
    """A rectangle with a flat floor and ramps of the width ``edge`` inside its outline."""
    return lambda s, t: _floor(np.minimum(width / 2 - np.abs(s), breadth / 2 - np.abs(t)), depth=depth, edge=edge)


def chevron(*, width: float, breadth: float, depth: float, edge: float, angle: float) -> Depth:
    """A V of two arms with a flat floor, ramps of the width ``edge``, and its tip towards negative s.

    The arms have the width ``width`` along s, lie at ``angle``, rad, to the axis t, and span ``breadth`` along t.
    """
    rise, thin = np.tan(angle), np.cos(angle)

    def depth_at(s: Array, t: Array) -> Array:
        across = s - rise * (np.abs(t) - breadth / 4)
        inside = np.minimum((width / 2 - np.abs(across)) * thin, breadth / 2 - np.abs(t))
        return _floor(inside, depth=depth, edge=edge)

    return depth_at


def mapped(*, width: float, breadth: float, depths: tuple[tuple[float, ...], ...]) -> Depth:
    """A map of depths over the rectangle of width and breadth, bilinear between its points and zero outside.

    The rows of ``depths`` lie along s from -width/2 to width/2, and their numbers along t.
    """

    def depth_at(s: Array, t: Array) -> Array:
        s, t = np.broadcast_arrays(2 * s / width, 2 * t / breadth)
        return np.asarray(_interpolator(depths)(np.stack([s, t], axis=-1)))

    return depth_at


@cache
def _interpolator(depths: tuple[tuple[float, ...], ...]) -> Callable[[Array], Array]:
    from scipy.interpolate import RegularGridInterpolator  # slow to import

    values = np.array(depths)
    places = tuple(np.linspace(-1, 1, number) for number in values.shape)
    interpolator: Callable[[Array], Array] = RegularGridInterpolator(places, values, bounds_error=False, fill_value=0.0)
    return interpolator
