"""The harmonic coordinates of a gap over a cell in plan, whose level surfaces meet both walls at right angles.

The coordinates ξ = x + u and η = y + v solve Laplace's equation in the gap without flux through the walls:

    ∇²ξ = ∇²η = 0,   ∂ξ/∂n = ∂η/∂n = 0 on both walls,   u and v periodic.

Lines of constant ξ and η lie in both level surfaces, whose gradients are tangential at the walls, so that the lines
leave both walls along the normal. u and v are even polynomials of s = (1 - z)/h from the sliding wall (0) to the other
one (1), and bilinear in x and y; the weak form is solved by Galerkin's method.
"""

from dataclasses import dataclass

import numpy as np
from numpy.polynomial import legendre

from roughfilm.contact.foundation.arrays import Array

MODES = 5
"""Number of even Legendre polynomials across the film."""

GAUSS_POINT = 1 / np.sqrt(3)

CORNERS = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
"""Corners of the reference square, in the order of a cell's nodes."""


@dataclass(frozen=True, kw_only=True)
class Coordinates:
    """The displacements ξ - x and η - y at the nodes of a grid, as amplitudes of polynomials across the film.

    Attributes
    ----------
    x, y : positions of the nodes over one period, shapes (nx + 1,) and (ny + 1,), in film thicknesses.
    amplitudes : amplitudes of the even Legendre polynomials of s, shape (nx + 1, ny + 1, ``MODES``, 2).
    """

    x: Array
    y: Array
    amplitudes: Array

    def displacement(self, s: float) -> Array:
        """The displacements at the nodes at s = (1 - z)/h, shape (nx + 1, ny + 1, 2)."""
        return np.asarray(np.einsum("xymc,m->xyc", self.amplitudes, _polynomials(np.array([s]))[0][:, 0]))


def harmonic(x: Array, y: Array, thickness: Array) -> Coordinates:
    """The harmonic coordinates of a gap.

    Parameters
    ----------
    x, y : positions of the nodes over one period, in film thicknesses.
    thickness : film thickness at the nodes, periodic, shape (nx + 1, ny + 1), in film thicknesses.
    """
    from scipy.sparse import coo_matrix  # slow to import
    from scipy.sparse.linalg import splu

    shape = x.size - 1, y.size - 1
    numbers = np.arange(shape[0] * shape[1]).reshape(shape)
    nodes = np.stack([np.roll(numbers, (-a, -b), (0, 1)) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))], axis=-1)
    unknowns = (nodes.reshape(-1, 4, 1) * MODES + np.arange(MODES)).reshape(-1, 4 * MODES)
    stiffness, load = _elements(x, y, thickness)
    rows = np.repeat(unknowns, 4 * MODES, axis=1).ravel()
    columns = np.tile(unknowns, (1, 4 * MODES)).ravel()
    count = numbers.size * MODES
    rigid = stiffness[0, 0, 0]  # holds the constant, which is arbitrary
    matrix = coo_matrix(
        (np.append(stiffness.ravel(), rigid), (np.append(rows, 0), np.append(columns, 0))), shape=(count, count)
    ).tocsc()
    right = np.stack([np.bincount(unknowns.ravel(), one.ravel(), count) for one in load], axis=1)
    factors = splu(matrix, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
    solved = factors.solve(right).reshape(*shape, MODES, 2)
    return Coordinates(x=x, y=y, amplitudes=np.pad(solved, ((0, 1), (0, 1), (0, 0), (0, 0)), mode="wrap"))


def _polynomials(s: Array) -> tuple[Array, Array]:
    """The even Legendre polynomials of s and their derivatives, shape (``MODES``, n)."""
    series = [legendre.Legendre.basis(2 * mode) for mode in range(MODES)]
    return np.array([one(s) for one in series]), np.array([one.deriv()(s) + 0 * s for one in series])


def _elements(x: Array, y: Array, thickness: Array) -> tuple[Array, Array]:
    """The matrices of the cells, (cells, 4 modes, 4 modes), and the right sides for ξ and η, (2, cells, 4 modes).

    With g = ∇h/h the gradient of a function φ(x, y, s) is (∇φ - s g ∂φ/∂s, -∂φ/∂s / h), and dV = h dx dy ds.
    """
    nodes, weights = legendre.leggauss(2 * MODES + 2)
    s, weights = (nodes + 1) / 2, weights / 2
    value, slope = _polynomials(s)
    products = (value * weights) @ value.T
    mixed = (value * weights * s) @ slope.T
    slopes, weighted = (slope * weights) @ slope.T, (slope * weights * s**2) @ slope.T
    means, moments = value @ weights, slope @ (weights * s)

    corners = [thickness[:-1, :-1], thickness[1:, :-1], thickness[1:, 1:], thickness[:-1, 1:]]
    height = np.stack(corners, axis=-1).reshape(-1, 4)
    sizes = np.stack(np.meshgrid(np.diff(x), np.diff(y), indexing="ij"), axis=-1).reshape(-1, 2)
    count = len(height)
    stiffness, load = np.zeros((count, 4, MODES, 4, MODES)), np.zeros((2, count, 4, MODES))
    for point in CORNERS * GAUSS_POINT:
        shape = (1 + CORNERS * point).prod(axis=1) / 4
        gradient = CORNERS * (1 + CORNERS * point)[:, ::-1] / 4 * (2 / sizes)[:, None]
        film = height @ shape
        steepness = np.einsum("ea,eac->ec", height, gradient) / film[:, None]
        volume = sizes.prod(axis=1) / 4 * film
        along = np.einsum("ec,eac->ea", steepness, gradient)
        coupling = np.einsum("ea,b,mn->eambn", volume[:, None] * along, shape, mixed)
        stiffness += np.einsum("e,eac,ebc,mn->eambn", volume, gradient, gradient, products, optimize=True)
        stiffness -= coupling + coupling.transpose(0, 3, 4, 1, 2)
        squared = (steepness**2).sum(axis=1)
        across = (volume * squared)[:, None, None] * weighted + (volume / film**2)[:, None, None] * slopes
        stiffness += np.einsum("a,b,emn->eambn", shape, shape, across)
        for axis in range(2):
            load[axis] -= volume[:, None, None] * (
                gradient[:, :, axis, None] * means - steepness[:, None, None, axis] * shape[:, None] * moments
            )
    return stiffness.reshape(count, 4 * MODES, 4 * MODES), load.reshape(2, count, 4 * MODES)
