"""Polynomials across a film on Gauss points: the nodal basis of the Legendre modes of the same degree."""

from dataclasses import dataclass
from functools import cache

import numpy as np

from roughfilm.contact.foundation.arrays import Array


@dataclass(frozen=True, kw_only=True)
class Basis:
    """The N Lagrange polynomials l_m of the Gauss points of ζ in (0, 1); ζ = 0 is the sliding wall.

    They span the Legendre modes of degrees 0 to N - 1. All integrals below are exact.

    Attributes
    ----------
    points, weights : Gauss points and weights, shape (N,); the weights sum to 1.
    ends : values at ζ = 0 and ζ = 1, shape (2, N).
    slopes : derivatives dl_n/dζ at the points, indices (point, n).
    integrals : integrals of l_n from 0 to the points, indices (point, n).
    stiffness : integrals of dl_m/dζ dl_n/dζ, shape (N, N).
    """

    points: Array
    weights: Array
    ends: Array
    slopes: Array
    integrals: Array
    stiffness: Array

    def values(self, places: Array) -> Array:
        """The polynomials at places ζ, indices (place, n)."""
        return _modes(self.points.size, np.asarray(places)) @ np.linalg.inv(_modes(self.points.size, self.points))


@cache
def basis(modes: int) -> Basis:
    """The basis of a number N >= 2 of Legendre modes."""
    nodes, weights = np.polynomial.legendre.leggauss(modes)
    points, half = (nodes + 1) / 2, weights / 2
    inverse = np.linalg.inv(_modes(modes, points))
    eye = np.eye(modes)
    derivative = (
        np.array([_padded(np.asarray(np.polynomial.legendre.legder(mode), dtype=float), modes) for mode in eye]).T * 2
    )
    integral = np.array([np.polynomial.legendre.legint(mode, lbnd=-1) for mode in eye]).T / 2
    slopes = _modes(modes, points) @ derivative @ inverse
    return Basis(
        points=points,
        weights=half,
        ends=_modes(modes, np.array([0.0, 1.0])) @ inverse,
        slopes=slopes,
        integrals=_modes(modes + 1, points) @ integral @ inverse,
        stiffness=slopes.T @ (half[:, None] * slopes),
    )


def _modes(modes: int, places: Array) -> Array:
    """The Legendre polynomials at places ζ, indices (place, mode)."""
    return np.asarray(np.polynomial.legendre.legvander(2 * places - 1, modes - 1), dtype=float)


def _padded(coefficients: Array, size: int) -> Array:
    return np.append(coefficients, np.zeros(size - len(coefficients)))
