"""Walls of a rough gap → columns of hexahedra between them, contact cut out."""

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
    vertices : shape (nx + 1, ny + 1, layers + 1, 3), in units of length; the last of a row is the first, a period on.
    kept : mask of the columns that the mesh has, shape (nx, ny).
    closed_in : volume of the columns that contact closes in, over that of all open ones; the mesh leaves them out.
    """

    vertices: Array
    kept: Mask
    closed_in: float

    @property
    def height(self) -> Array:
        """Mean height of each column, shape (nx, ny)."""
        return column_heights(self.vertices)

    @property
    def squared_height(self) -> Array:
        """Mean over each column of the height squared, shape (nx, ny); exact, the height being bilinear."""
        h = _heights(self.vertices)
        a, b, c, d = h[:-1, :-1], h[1:, :-1], h[:-1, 1:], h[1:, 1:]
        squares = a * a + b * b + c * c + d * d + a * b + a * c + b * d + c * d + (a * d + b * c) / 2
        return np.asarray(squares / 9)


def columns_between(walls: Walls, unit: float, layers: int) -> Columns:
    """The mesh of a gap with its nodes as the corners of the columns, cells across each being equally thick.

    A column with a corner in contact is left out, and so is one from which liquid cannot flow on and on: it would stand
    still under any gradient, at a pressure that nothing fixes.

    Parameters
    ----------
    unit : of length, m.
    layers : cells across the gap.
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
    """Mean height of each column of a mesh, shape (nx, ny)."""
    height = _heights(vertices)
    return np.asarray((height[1:, 1:] + height[1:, :-1] + height[:-1, 1:] + height[:-1, :-1]) / 4)


def _heights(vertices: Array) -> Array:
    return np.asarray(vertices[:, :, -1, 2] - vertices[:, :, 0, 2])


def _with_first_again(values: Array) -> Array:
    return np.pad(values, ((0, 1), (0, 1)), mode="wrap")
