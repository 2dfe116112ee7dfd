"""Polynomials across a film that vanish on both walls, ordered so that the flow fixes the first of them."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.polynomial import legendre

from roughfilm.contact.foundation.arrays import Array

STIFFNESS = 2.0
"""The integral ∫φ_k'² of every polynomial."""


@dataclass(frozen=True, kw_only=True)
class Basis:
    """The polynomials φ_k(Y), k = 0 .. n-1, between the fixed wall (Y = 0) and the sliding one (Y = 1), at points.

    φ_k ∝ P_k - P_{k+2} of s = 2Y - 1, so that ∫φ_j'φ_k' = 0 for j ≠ k and ∫φ_k = 0 for k > 0: viscosity does not
    couple them, and only φ_0 contributes to the flow and couples to the pressure gradient, which is uniform across.

    The scale is ∫φ_k'² = ``STIFFNESS``. ``shape`` (φ), ``slope`` (φ') and ``primitive`` (∫φ from Y = 0) have the shape
    (n, points); ``flow`` is ∫φ_0. At Gauss points f @ ``weights`` is ∫f, and f @ ``above`` the integral to Y = 1.
    """

    nodes: Array
    weights: Array
    shape: Array
    slope: Array
    primitive: Array
    above: Array
    flow: float


@lru_cache(maxsize=8)
def gauss_basis(modes: int) -> Basis:
    """The first ``modes`` polynomials at the Gauss points that integrate products of three of them exactly."""
    return _basis(modes, *legendre.leggauss((3 * modes + 5) // 2))


@lru_cache(maxsize=8)
def even_basis(modes: int, layers: int) -> Basis:
    """The first ``modes`` polynomials at the middles of equal layers, with the midpoint rule."""
    return _basis(modes, (2 * np.arange(layers) + 1) / layers - 1, np.full(layers, 2 / layers))


def _basis(modes: int, s: Array, weights: Array) -> Basis:
    k, degree = np.arange(modes), np.arange(s.size)
    series = np.zeros((modes, modes + 2))
    series[k, k] = 1 / np.sqrt(2 * (2 * k + 3))
    series[k, k + 2] = -series[k, k]
    to_series = (legendre.legvander(s, s.size - 1) * weights[:, None]).T * (degree[:, None] + 0.5)
    from_above = legendre.legval(s, legendre.legint(np.eye(s.size), lbnd=1))
    return Basis(
        nodes=(s + 1) / 2,
        weights=weights / 2,
        shape=np.asarray(legendre.legval(s, series.T)),
        slope=np.asarray(2 * legendre.legval(s, legendre.legder(series, axis=1).T)),
        primitive=np.asarray(legendre.legval(s, legendre.legint(series, lbnd=-1, axis=1).T) / 2),
        above=np.asarray(-(from_above.T @ to_series).T / 2),
        flow=float(series[0, 0]),
    )


def sliding_wall_slope(modes: int) -> Array:
    """The slopes φ_k'(1) at the sliding wall, shape (modes,)."""
    k = np.arange(modes)
    return np.asarray(-2 * np.sqrt((2 * k + 3) / 2))
