"""The coordinate ξ of a periodic gap whose lines meet both walls at right angles, on the walls."""

from dataclasses import dataclass
from functools import cache

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.foamcases.conformal import cells

CORNERS = ((-1, -1), (1, -1), (1, 1), (-1, 1))
"""Corners of the unit cell, in the order of a cell's nodes."""

MIN_RISE = 1e-8
"""Rise of ξ over a period that is added where the coarse solution on steep walls does not rise."""


@dataclass(frozen=True, kw_only=True)
class OnWalls:
    """The coordinate ξ at the wall nodes of a grid, and its energy.

    Attributes
    ----------
    lower, upper : ξ along each wall, increasing, shape (columns + 1,); it rises by 1 over the period, and is 0 at the
        start of the upper wall.
    energy : ∫ |∇ξ|² dA, which is the height of the rectangle (ξ, η) over its length if ∇η is normal to ∇ξ and as long.
    """

    lower: Array
    upper: Array
    energy: float


def solve(vertices: Array) -> OnWalls:
    """Solve ∇²ξ = 0 with ∂ξ/∂n = 0 on both walls and ξ(x + period) = ξ(x) + 1, by bilinear finite elements.

    Parameters
    ----------
    vertices : a structured grid of the gap, shape (columns + 1, layers + 1, 2), whose last column is the first one
        shifted by the period; layers count from the lower wall.
    """
    from scipy.sparse import csc_matrix  # slow to import
    from scipy.sparse.linalg import splu

    columns, rows = vertices.shape[0] - 1, vertices.shape[1]
    node = (np.arange(columns + 1) % columns)[:, None] * rows + np.arange(rows)
    nodes, stiffness = _cells(node), _stiffness(_cells(vertices))
    rise = _cells(np.repeat(np.arange(columns + 1)[:, None] == columns, rows, axis=1).astype(float))
    load = -np.bincount(nodes.ravel(), np.einsum("cij,cj->ci", stiffness, rise).ravel(), columns * rows)
    places = np.repeat(nodes, 4, axis=1).ravel(), np.tile(nodes, 4).ravel()
    matrix = csc_matrix((stiffness.ravel(), places))[1:, 1:]  # ξ is 0 at the first node, as a constant is free
    factors = splu(matrix, permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True})
    periodic = np.append(0.0, factors.solve(load[1:]))

    in_cells, xi = periodic[nodes] + rise, periodic[node]
    xi[-1] += 1
    lower, upper = _rising(xi[:, 0]), _rising(xi[:, -1])
    energy = float(np.einsum("ci,cij,cj", in_cells, stiffness, in_cells))
    return OnWalls(lower=lower - upper[0], upper=upper - upper[0], energy=energy)


def over_periods(values: Array, rise: float) -> Array:
    """Values at the nodes of one period, continued over the periods before and after it, which differ by ``rise``."""
    return np.concatenate([values[:-1] - rise, values, values[1:] + rise])


def _cells(values: Array) -> Array:
    """The values at the four corners of each cell, in the order of ``CORNERS``; shape (cells, 4, ...)."""
    return np.stack([corner.reshape(-1, *values.shape[2:]) for corner in cells.corners(values)], axis=1)


@cache
def _slopes() -> Array:
    """The slopes of the four bilinear functions at the four Gauss points, shape (points, 2, 4)."""
    places = [(s / np.sqrt(3), t / np.sqrt(3)) for s, t in CORNERS]
    return (
        np.array([[[a * (1 + b * t) for a, b in CORNERS], [b * (1 + a * s) for a, b in CORNERS]] for s, t in places])
        / 4
    )


def _stiffness(corners: Array) -> Array:
    """The integrals of ∇φ_i · ∇φ_j over each cell, shape (cells, 4, 4), from its corners, shape (cells, 4, 2)."""
    total = np.zeros((corners.shape[0], 4, 4))
    for slopes in _slopes():
        jacobian = np.einsum("dk,ckx->cdx", slopes, corners)
        (xs, ys), (xt, yt) = jacobian[:, 0].T, jacobian[:, 1].T
        along_x = yt[:, None] * slopes[0] - ys[:, None] * slopes[1]
        along_y = xs[:, None] * slopes[1] - xt[:, None] * slopes[0]
        products = along_x[:, :, None] * along_x[:, None] + along_y[:, :, None] * along_y[:, None]
        total += products / np.abs(xs * yt - xt * ys)[:, None, None]
    return total


def _rising(xi: Array) -> Array:
    """The values made increasing, with a rise of 1 over the period; the same from both directions."""
    period = slice(xi.size - 1, 2 * xi.size - 1)
    wide = over_periods(xi, 1.0)
    monotone = (np.maximum.accumulate(wide) + np.minimum.accumulate(wide[::-1])[::-1]) / 2
    return (monotone[period] + np.linspace(0, MIN_RISE, xi.size)) / (1 + MIN_RISE)
