"""Taylor-Hood elements of a mesh: their integrals, and the numbers of the unknowns of a periodic gap."""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from scipy.sparse import coo_matrix, csc_matrix
from skfem import Basis, ElementTriP2, ElementTriP3, MeshTri2

from roughfilm.contact.foundation.arrays import Array, Mask
from scripts.studies.coverage.finite_elements.wall import Indices

QUADRATURE_ORDER = 9
"""Degree of the polynomials that the quadrature integrates exactly: one above that of u grad(u) times u, of cubics."""

SAME_PLACE = 1e-9
"""Distance over the length of the period below which two positions are equal."""


@dataclass(frozen=True, kw_only=True)
class Fields:
    """Nodal values of the velocities u and v, shape (n,), and of the pressure p, shape (m,)."""

    u: Array
    v: Array
    p: Array


class Spaces:
    """Continuous cubics for the velocities and quadratics for the pressure on a mesh of one period of a gap.

    The velocities on both walls, and the pressure at the periodic boundary on the sliding wall, are given. Values on
    the right side are those on the left side.

    Parameters
    ----------
    mesh : triangles between x = -L/2 and x = L/2; the sliding wall is y = 1.
    """

    def __init__(self, mesh: MeshTri2):
        velocity = Basis(mesh, ElementTriP3(), intorder=QUADRATURE_ORDER)
        pressure = velocity.with_element(ElementTriP2())
        self.weights: Array = velocity.dx
        self.nodes: Array = velocity.doflocs
        self.pressure_nodes: Array = pressure.doflocs
        self.points: Array = np.asarray(velocity.global_coordinates())
        self.of_element: Indices = velocity.element_dofs.T
        self.pressure_of_element: Indices = pressure.element_dofs.T
        self.shapes = _values(velocity)
        self.pressure_shapes = _values(pressure)
        self.slopes = np.ascontiguousarray(np.stack([one[0].grad for one in velocity.basis]).transpose(1, 2, 0, 3))
        self.length = float(np.ptp(mesh.p[0]))
        facets = mesh.boundary_facets()
        middles = mesh.p[:, mesh.facets[:, facets]].mean(axis=1)
        self.top: Indices = velocity.get_dofs(facets[np.abs(middles[1] - 1) < SAME_PLACE]).all()
        self.top = self.top[np.argsort(self.nodes[0, self.top])]
        sides = np.abs(np.abs(middles[0]) - self.length / 2) < SAME_PLACE * self.length
        walls = np.zeros(len(self.nodes[0]), dtype=bool)
        walls[velocity.get_dofs(facets[~sides]).all()] = True
        self.walls = np.flatnonzero(walls)
        pinned = np.zeros(len(self.pressure_nodes[0]), dtype=bool)
        pinned[_sides(self.pressure_nodes, self.length)[0][-1]] = True
        self.number_u, count = _numbers(self.nodes, self.length, walls, 0)
        self.number_v, count = _numbers(self.nodes, self.length, walls, count)
        self.number_p, self.unknowns = _numbers(self.pressure_nodes, self.length, pinned, count)

    @cached_property
    def stiffness(self) -> Array:
        """The integrals of grad(shape) · grad(shape) by element, shape (elements, 10, 10)."""
        x, y = self.slopes
        return self.product(x, x) + self.product(y, y)

    @cached_property
    def divergence(self) -> tuple[Array, Array]:
        """The integrals of pressure shape times d(shape)/dx and d/dy by element, shape (elements, 6, 10)."""
        first, second = (self.product(self.pressure_shapes, slope) for slope in self.slopes)
        return first, second

    @cached_property
    def volume(self) -> tuple[tuple[Array, Array], tuple[Array, Array]]:
        """The integrals of d(shape)/da times d(shape)/db by element, with a and b either x or y."""
        x, y = self.slopes
        return (self.product(x, x), self.product(x, y)), (self.product(y, x), self.product(y, y))

    def product(self, tests: Array, trials: Array) -> Array:
        """Return the integrals of tests times trials by element, from values of shape (elements, n, points)."""
        return np.asarray(np.matmul(tests * self.weights[:, None, :], trials.transpose(0, 2, 1)))

    def at_points(self, nodal: Array, shapes: Array) -> Array:
        """Return a field at the quadrature points, shape (elements, points), or its slope with ``slopes``."""
        return np.asarray(np.einsum("ei,eiq->eq", nodal[self.of_element], shapes))

    def vector(self, by_element: Array, pressure: bool = False) -> Array:
        """Return the sum over the elements of integrals with each shape, shape (elements, 10) or (elements, 6)."""
        nodes = self.pressure_of_element if pressure else self.of_element
        count = (self.pressure_nodes if pressure else self.nodes).shape[1]
        return np.bincount(nodes.ravel(), by_element.ravel(), count).astype(float)

    def reduced(self, u: Array, v: Array, p: Array) -> Array:
        """Return the sums of nodal values that belong to one unknown."""
        found = np.zeros(self.unknowns)
        for number, values in self._pairs(u, v, p):
            np.add.at(found, number[number >= 0], values[number >= 0])
        return found

    def expanded(self, unknowns: Array) -> Fields:
        """Return nodal values of the unknowns, with zero where values are given."""
        padded = np.append(unknowns, 0.0)  # number -1 is the given value
        return Fields(u=padded[self.number_u], v=padded[self.number_v], p=padded[self.number_p])

    def matrix(self, blocks: dict[tuple[str, str], Array]) -> csc_matrix:
        """Return the matrix of the unknowns from integrals by element, by the rows and columns "u", "v" or "p"."""
        numbers = {
            "u": self.number_u[self.of_element],
            "v": self.number_v[self.of_element],
            "p": self.number_p[self.pressure_of_element],
        }
        rows, columns, values = [], [], []
        for (row, column), block in blocks.items():
            i = np.broadcast_to(numbers[row][:, :, None], block.shape)
            j = np.broadcast_to(numbers[column][:, None, :], block.shape)
            kept = (i >= 0) & (j >= 0)
            rows.append(i[kept])
            columns.append(j[kept])
            values.append(block[kept])
        place = np.concatenate(rows), np.concatenate(columns)
        return coo_matrix((np.concatenate(values), place), shape=(self.unknowns, self.unknowns)).tocsc()

    def _pairs(self, u: Array, v: Array, p: Array) -> tuple[tuple[Indices, Array], ...]:
        return (self.number_u, u), (self.number_v, v), (self.number_p, p)


def _values(basis: Any) -> Array:
    return np.stack([np.broadcast_to(one[0], basis.dx.shape) for one in basis.basis], axis=1)


def _sides(nodes: Array, length: float) -> tuple[Indices, Indices]:
    """Return the numbers of the nodes on the left and right sides, each from the lowest to the highest."""
    found = []
    for end in (-length / 2, length / 2):
        here = np.flatnonzero(np.abs(nodes[0] - end) < SAME_PLACE * length)
        found.append(here[np.argsort(nodes[1, here])])
    return found[0], found[1]


def _numbers(nodes: Array, length: float, given: Mask, first: int) -> tuple[Indices, int]:
    """Return the number of the unknown of every node, from ``first`` on, and the next free one; -1 where given."""
    left, right = _sides(nodes, length)
    given = given.copy()
    given[right] |= given[left]
    own = ~given
    own[right] = False
    number = np.full(nodes.shape[1], -1)
    number[own] = first + np.arange(own.sum())
    number[right] = number[left]
    return number, first + int(own.sum())
