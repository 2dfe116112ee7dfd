"""Mesh a rough gap with columns of hexahedra between its walls, without the regions of contact."""

from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array, Mask
from roughfilm.rom.homogenization.paths import leads_round
from roughfilm.rom.rough_gap.walls import Walls


@dataclass(frozen=True, kw_only=True)
class Columns:
    """The mesh of a gap.

    Attributes
    ----------
    vertices : corners of the cells, shape (nx + 1, ny + 1, layers + 1, 3), in the unit of the mesh; the last corners
        along x and y are the first ones, moved by a period.
    kept : mask of the columns that the mesh has, shape (nx, ny).
    closed_in : volume of the columns that contact closes in, which the mesh leaves out, over that of all open columns.
    """

    vertices: Array
    kept: Mask
    closed_in: float

    @property
    def height(self) -> Array:
        """The mean height of each column, shape (nx, ny)."""
        return column_heights(self.vertices)

    @property
    def squared_height(self) -> Array:
        """The mean of the squared height over each column, exact for a bilinear height, shape (nx, ny)."""
        h = _heights(self.vertices)
        a, b, c, d = h[:-1, :-1], h[1:, :-1], h[:-1, 1:], h[1:, 1:]
        squares = a * a + b * b + c * c + d * d + a * b + a * c + b * d + c * d + (a * d + b * c) / 2
        return np.asarray(squares / 9)


def columns_between(walls: Walls, unit: float, layers: int) -> Columns:
    """The mesh of a gap, whose columns have the nodes of the walls as corners and cells of equal thickness.

    The mesh leaves out columns with a corner in contact, and columns that are not connected to an open path around the
    period: the liquid in them would be at rest under any gradient, and its pressure would not be determined.

    Parameters
    ----------
    walls : heights of the walls on the nodes.
    unit : unit of length of the mesh, m.
    layers : number of cells across the gap.
    """
    lower, upper = (_with_first_again(heights) / unit for heights in (walls.lower, walls.upper))
    (nx, ny), (dx, dy) = walls.lower.shape, walls.spacing
    across = np.linspace(0, 1, layers + 1)
    vertices = np.empty((nx + 1, ny + 1, layers + 1, 3))
    vertices[..., 0] = (np.arange(nx + 1) * dx / unit)[:, None, None]
    vertices[..., 1] = (np.arange(ny + 1) * dy / unit)[None, :, None]
    vertices[..., 2] = lower[..., None] * (1 - across) + upper[..., None] * across
    touching = _with_first_again(walls.gap) == 0
    opened = ~(touching[1:, 1:] | touching[1:, :-1] | touching[:-1, 1:] | touching[:-1, :-1])
    kept = leads_round(opened)
    height = column_heights(vertices)
    lost = float(height[opened & ~kept].sum())
    return Columns(vertices=vertices, kept=kept, closed_in=lost / (float(height[opened].sum()) or 1.0))


def column_heights(vertices: Array) -> Array:
    """The mean height of each column of a mesh with the given vertices, shape (nx, ny)."""
    height = _heights(vertices)
    return np.asarray((height[1:, 1:] + height[1:, :-1] + height[:-1, 1:] + height[:-1, :-1]) / 4)


def _heights(vertices: Array) -> Array:
    return np.asarray(vertices[:, :, -1, 2] - vertices[:, :, 0, 2])


def _with_first_again(values: Array) -> Array:
    return np.pad(values, ((0, 1), (0, 1)), mode="wrap")
