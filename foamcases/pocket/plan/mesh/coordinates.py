"""The harmonic coordinates of a gap over a cell in plan, of which columns and layers are lines and surfaces.

ξ = x + u and η = y + v solve Laplace's equation in the gap without flux through the walls, ζ between 0 and 1 on them:

    ∇²ξ = ∇²η = ∇²ζ = 0,   ∂ξ/∂n = ∂η/∂n = 0 on both walls,   ζ = 0 and 1 on them,   u, v and ζ periodic.

Lines of constant ξ and η lie in both level surfaces, whose gradients are tangential at the walls, so that the lines
leave both walls along the normal. If the film changes along one direction alone, the level surfaces of ζ cross them at
right angles everywhere. With s = (1 - z)/h from the sliding wall (0) to the other one (1), u and v are even polynomials
of s, and ζ is 1 - s and odd polynomials that vanish on both walls; their amplitudes are bilinear in x and y, and solve
the weak form by Galerkin's method.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.polynomial import Legendre, legendre

from roughfilm.contact.foundation.arrays import Array

MODES = 5
"""Number of polynomials across the film for each coordinate."""

GAUSS_POINT = 1 / np.sqrt(3)

CORNERS = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
"""Corners of the reference square, in the order of a cell's nodes."""

EVEN = [Legendre.basis(2 * mode) for mode in range(MODES)]
ODD = [Legendre.basis(2 * mode + 1) - Legendre.basis(2 * mode + 3) for mode in range(MODES)]


@dataclass(frozen=True, kw_only=True)
class Coordinates:
    """The coordinates at the nodes of a grid, as amplitudes of polynomials across the film.

    Attributes
    ----------
    x, y : positions of the nodes over one period, shapes (nx + 1,) and (ny + 1,), in film thicknesses.
    lean : amplitudes of ξ - x and η - y, shape (nx + 1, ny + 1, ``MODES``, 2).
    rise : amplitudes of ζ - (1 - s), shape (nx + 1, ny + 1, ``MODES``).
    """

    x: Array
    y: Array
    lean: Array
    rise: Array

    def displacement(self, s: float) -> Array:
        """The displacements ξ - x and η - y at the nodes at s = (1 - z)/h, shape (nx + 1, ny + 1, 2)."""
        return np.asarray(np.einsum("xymc,m->xyc", self.lean, [one(s) for one in EVEN]))

    def height(self, s: float) -> Array:
        """ζ at the nodes at s = (1 - z)/h, shape (nx + 1, ny + 1, 1)."""
        return np.asarray(1 - s + self.rise @ np.array([one(s) for one in ODD]))[..., None]


def harmonic(x: Array, y: Array, thickness: Array) -> Coordinates:
    """The harmonic coordinates of a gap.

    Parameters
    ----------
    x, y : positions of the nodes over one period, in film thicknesses.
    thickness : film thickness at the nodes, periodic, shape (nx + 1, ny + 1), in film thicknesses.
    """
    film = _Film(x, y, thickness)
    return Coordinates(x=x, y=y, lean=film.solved(EVEN, (0, 1)), rise=film.solved(ODD, (2,))[..., 0])


class _Film:
    """The film over a grid at the Gauss points of its cells, and Laplace's equation in it.

    With g = ∇h/h the gradient of a function φ(x, y, s) is (∇φ - s g ∂φ/∂s, -∂φ/∂s / h), and dV = h dx dy ds.
    """

    def __init__(self, x: Array, y: Array, thickness: Array) -> None:
        self.shape = x.size - 1, y.size - 1
        numbers = np.arange(self.shape[0] * self.shape[1]).reshape(self.shape)
        around = ((0, 0), (1, 0), (1, 1), (0, 1))
        self.nodes = np.stack([np.roll(numbers, (-a, -b), (0, 1)) for a, b in around], axis=-1).reshape(-1, 4)
        corners = [thickness[:-1, :-1], thickness[1:, :-1], thickness[1:, 1:], thickness[:-1, 1:]]
        self.height = np.stack(corners, axis=-1).reshape(-1, 4)
        self.sizes = np.stack(np.meshgrid(np.diff(x), np.diff(y), indexing="ij"), axis=-1).reshape(-1, 2)

    def solved(self, basis: Sequence[Legendre], bases: tuple[int, ...]) -> Array:
        """The amplitudes of a basis that make harmonic the functions x (0), y (1) or 1 - s (2) plus their sum.

        Returns
        -------
        Array
            Amplitudes at the nodes, shape (nx + 1, ny + 1, modes, functions).
        """
        from scipy.sparse import coo_matrix  # slow to import
        from scipy.sparse.linalg import splu

        modes = len(basis)
        unknowns = (self.nodes[..., None] * modes + np.arange(modes)).reshape(-1, 4 * modes)
        stiffness, load = self._elements(basis, bases)
        rows = np.repeat(unknowns, 4 * modes, axis=1).ravel()
        columns = np.tile(unknowns, (1, 4 * modes)).ravel()
        count = self.shape[0] * self.shape[1] * modes
        fixed = stiffness[0, 0, 0]  # fixes the constant part of x and y, which is arbitrary
        if bases != (2,):
            entries, rows, columns = np.append(stiffness, fixed), np.append(rows, 0), np.append(columns, 0)
        else:
            entries = stiffness.ravel()
        matrix = coo_matrix((entries, (rows, columns)), shape=(count, count)).tocsc()
        right = np.stack([np.bincount(unknowns.ravel(), one.ravel(), count) for one in load], axis=1)
        factors = splu(matrix, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
        found = factors.solve(right).reshape(*self.shape, modes, len(bases))
        return np.pad(found, ((0, 1), (0, 1), (0, 0), (0, 0)), mode="wrap")

    def _elements(self, basis: Sequence[Legendre], bases: tuple[int, ...]) -> tuple[Array, Array]:
        """The matrices of the cells, (cells, 4 modes, 4 modes), and the right sides, (functions, cells, 4 modes)."""
        modes, count = len(basis), len(self.height)
        nodes, weights = legendre.leggauss(2 * modes + 3)
        s, weights = (nodes + 1) / 2, weights / 2
        value = np.array([one(s) for one in basis])
        slope = np.array([one.deriv()(s) + 0 * s for one in basis])
        products, mixed = (value * weights) @ value.T, (value * weights * s) @ slope.T
        slopes, weighted = (slope * weights) @ slope.T, (slope * weights * s**2) @ slope.T
        stiffness, load = np.zeros((count, 4, modes, 4, modes)), np.zeros((len(bases), count, 4, modes))
        for point in CORNERS * GAUSS_POINT:
            shape = (1 + CORNERS * point).prod(axis=1) / 4
            gradient = CORNERS * (1 + CORNERS * point)[:, ::-1] / 4 * (2 / self.sizes)[:, None]
            film = self.height @ shape
            steepness = np.einsum("ea,eac->ec", self.height, gradient) / film[:, None]
            volume = self.sizes.prod(axis=1) / 4 * film
            along = np.einsum("ec,eac->ea", steepness, gradient)
            squared = (steepness**2).sum(axis=1)
            coupling = np.einsum("ea,b,mn->eambn", volume[:, None] * along, shape, mixed)
            stiffness += np.einsum("e,eac,ebc,mn->eambn", volume, gradient, gradient, products, optimize=True)
            stiffness -= coupling + coupling.transpose(0, 3, 4, 1, 2)
            across = (volume * squared)[:, None, None] * weighted + (volume / film**2)[:, None, None] * slopes
            stiffness += np.einsum("a,b,emn->eambn", shape, shape, across)
            for number, function in enumerate(bases):
                if function < 2:
                    flux = gradient[:, :, function, None] * (value @ weights)
                    flux -= steepness[:, None, None, function] * shape[:, None] * (slope @ (weights * s))
                else:
                    flux = along[:, :, None] * (value @ (weights * s))
                    flux -= squared[:, None, None] * shape[:, None] * (slope @ (weights * s**2))
                load[number] -= volume[:, None, None] * flux
        return stiffness.reshape(count, 4 * modes, 4 * modes), load.reshape(len(bases), count, 4 * modes)
