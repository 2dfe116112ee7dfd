"""Meshes of the walls of a rough gap, and of the liquid between them, over one period."""

from enum import StrEnum

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.meshes.mesh import Mesh, grid
from roughfilm.rom.rough_gap.walls import Walls


class GapPart(StrEnum):
    """One of the walls of a gap, or the liquid between them."""

    LOWER = "lower"
    UPPER = "upper"
    GAP = "gap"


def wall_mesh(walls: Walls, part: GapPart) -> Mesh:
    """The mesh of one wall in quadrilaterals with normals into the liquid; data: the gap at each point, m.

    It is bilinear between the nodes, so second-order accurate in the spacing. The last points repeat the first, one
    period on.
    """
    heights = walls.lower if part is GapPart.LOWER else walls.upper
    places = np.stack([*_places(walls), periodic(heights)], axis=-1)
    if part is GapPart.UPPER:  # with y before x the normals point down
        mesh = grid(places.transpose(1, 0, 2))
        return _with_gap(mesh, periodic(walls.gap).T)
    return _with_gap(grid(places), periodic(walls.gap))


def gap_mesh(walls: Walls, layers: int) -> Mesh:
    """The mesh of the liquid in ``layers`` layers of hexahedra; data: the gap at each point, m.

    z = lower + Z gap with Z uniform from 0 to 1. Columns that are closed at all four corners are omitted; at the edge
    of contact some corners of a cell coincide, so that the cells have the volume of the gap, Σ gap dx dy.
    """
    x, y = _places(walls)
    lower, gap = periodic(walls.lower), periodic(walls.gap)
    across = np.linspace(0.0, 1.0, layers + 1)
    points = np.empty((*gap.shape, layers + 1, 3))
    points[..., 0], points[..., 1] = x[:, :, None], y[:, :, None]
    points[..., 2] = lower[:, :, None] + gap[:, :, None] * across
    mesh = _with_gap(grid(points), np.repeat(gap[:, :, None], layers + 1, axis=2))
    return mesh.kept(np.repeat(open_columns(gap).ravel(), layers))


def periodic(values: Array) -> Array:
    """The values at the nodes of one period and repeated at its end, shape (nx + 1, ny + 1)."""
    return np.pad(values, ((0, 1), (0, 1)), mode="wrap")


def open_columns(gap: Array) -> Array:
    """Whether any corner of a column is open, from the gap at the corners of shape (nx + 1, ny + 1); shape (nx, ny)."""
    is_open = gap > 0
    return np.asarray(is_open[1:, 1:] | is_open[:-1, 1:] | is_open[1:, :-1] | is_open[:-1, :-1])


def _places(walls: Walls) -> tuple[Array, Array]:
    (nx, ny), (dx, dy) = walls.lower.shape, walls.spacing
    x, y = np.meshgrid(np.arange(nx + 1) * dx, np.arange(ny + 1) * dy, indexing="ij")
    return x, y


def _with_gap(mesh: Mesh, gap: Array) -> Mesh:
    return Mesh(points=mesh.points, cell_type=mesh.cell_type, cells=mesh.cells, point_data={"gap (m)": gap.ravel()})
