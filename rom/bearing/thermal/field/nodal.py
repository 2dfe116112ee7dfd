"""Viscosities at the nodes of a film, as a field over its plane."""

from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.cavitation.fluid import Viscosities, ViscosityField
from roughfilm.rom.cavitation.grid import Grid
from roughfilm.rom.cavitation.interpolation import between
from roughfilm.rom.cavitation.solve import Solution


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
        grid, values, shape = self.grid, self.values, np.broadcast_shapes(x.shape, y.shape)
        along = between(grid.x, grid.spacing_x, np.broadcast_to(x, shape).ravel(), joined=self.joined[0])
        across = between(grid.y, grid.spacing_y, np.broadcast_to(y, shape).ravel(), joined=self.joined[1])
        (west, east, ahead), (south, north, beside) = along, across
        low = values[:, west, south] * (1 - beside) + values[:, west, north] * beside
        high = values[:, east, south] * (1 - beside) + values[:, east, north] * beside
        return np.asarray((low * (1 - ahead) + high * ahead).reshape(3, *shape))


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
