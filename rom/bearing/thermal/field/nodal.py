"""Viscosities at the nodes of a film, as a field over its plane."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.cavitation.fluid import Viscosities, ViscosityField
from roughfilm.rom.cavitation.grid import Grid
from roughfilm.rom.cavitation.interpolation import between
from roughfilm.rom.cavitation.solve import Solution

LEAST_ROWS = 4
"""Smallest number of rows of nodes of a film from which values are extrapolated to its sides."""


@dataclass(frozen=True, kw_only=True)
class NodalField:
    """Viscosities between the nodes of a grid: linear in ln η_p, ln η_s and s.

    Attributes
    ----------
    grid : the grid.
    joined : whether the film is periodic in x, and in y.
    values : ln η_p, ln η_s and s at the nodes, shape (3, nx, ny).
    """

    grid: Grid
    joined: tuple[bool, bool]
    values: Array

    def __call__(self, x: Array, y: Array) -> Viscosities:
        """The viscosities at positions of one shape; outside of the grid those of its edge."""
        return _viscosities(self.values if self._is_at_nodes(x, y) else self._between(x, y))

    def _is_at_nodes(self, x: Array, y: Array) -> bool:
        nodes = self.grid.shape
        return x.shape == nodes and np.array_equal(x[:, 0], self.grid.x) and np.array_equal(y[0], self.grid.y)

    def _between(self, x: Array, y: Array) -> Array:
        x, y = np.broadcast_arrays(x, y)
        found = between_nodes(self.values, self.grid, self.joined, x.ravel(), y.ravel())
        return np.asarray(found.reshape(3, *x.shape))


def between_nodes(values: Array, grid: Grid, joined: tuple[bool, bool], x: Array, y: Array) -> Array:
    """Values at positions between the nodes of a grid, shape (..., positions), linear along and across.

    The nodes on the sides of a film belong to the bath there. Beside them values are extrapolated from the film, as
    they jump where lubricant enters a cavity.

    Parameters
    ----------
    values : values at the nodes, shape (..., nx, ny).
    joined : whether the film is periodic in x, and in y.
    x, y : positions, shape (positions,).
    """
    inner = values
    if grid.y.size >= LEAST_ROWS and not joined[1]:
        inner = values.copy()
        for side, one, two in ((0, 1, 2), (-1, -2, -3)):
            reach = (grid.y[one] - grid.y[side]) / (grid.y[two] - grid.y[one])
            inner[..., side] = values[..., one] + reach * (values[..., one] - values[..., two])
    west, east, ahead = between(grid.x, grid.spacing_x, x, joined=joined[0])
    south, north, beside = between(grid.y, grid.spacing_y, y, joined=joined[1])

    def linear(known: Array, at: slice | NDArray[np.bool_]) -> Array:
        low = known[..., west[at], south[at]] * (1 - beside[at]) + known[..., west[at], north[at]] * beside[at]
        high = known[..., east[at], south[at]] * (1 - beside[at]) + known[..., east[at], north[at]] * beside[at]
        return np.asarray(low * (1 - ahead[at]) + high * ahead[at])

    found = linear(inner, slice(None))
    if inner is not values:
        on_side = (y <= grid.y[0]) | (y >= grid.y[-1])
        found[..., on_side] = linear(values, on_side)
    return found


def _viscosities(values: Array) -> Viscosities:
    return Viscosities(flow=np.exp(values[0]), shear=np.exp(values[1]), carried=values[2])


def logarithms(viscosities: Viscosities) -> Array:
    """The logarithms of viscosities (ln η_p, ln η_s, s), shape (3, nx, ny)."""
    return np.stack([np.log(viscosities.flow), np.log(viscosities.shear), viscosities.carried])


def own_logarithms(solution: Solution) -> Array:
    """The logarithms (ln η_p, ln η_s, s) of the viscosities with which a film was solved, shape (3, nx, ny)."""
    own = solution.problem.at_nodes
    if own is not None:
        return logarithms(own)
    even = np.full(solution.grid.shape, np.log(solution.problem.viscosity))
    return np.stack([even, even, np.ones(solution.grid.shape)])


def nodal_field(solution: Solution, values: Array) -> NodalField:
    """The field with ln η_p, ln η_s and s at the nodes of a film, in the coordinates of its problem."""
    return NodalField(grid=solution.grid, joined=solution.problem.shape.joined, values=values)


def in_scene(solution: Solution, values: Array) -> ViscosityField:
    """The same field in the coordinates of the scene, in which a wall that slides back is not mirrored."""
    field, breaks = nodal_field(solution, values), solution.problem.shape.breaks
    if not solution.turned:
        return field
    ends = breaks[0] + breaks[-1]
    return lambda x, y: field(ends - x, y)
