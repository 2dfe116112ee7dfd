"""Meshes of one cell type with point and cell data, and the boundary of a solid mesh."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from enum import StrEnum
from typing import Self

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array, Mask

Indices = NDArray[np.int64]

_FACES = ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))
"""Corners of the six faces of a hexahedron, ordered so that normals point outward."""


class CellType(StrEnum):
    """Type of the cells; corners are ordered as in VTK."""

    LINE = "line"
    TRIANGLE = "triangle"
    QUAD = "quad"
    HEXAHEDRON = "hexahedron"


@dataclass(frozen=True, kw_only=True)
class Mesh:
    """Points, cells of one type between them, and data on both.

    Attributes
    ----------
    points : shape (n, 3), m.
    cell_type : type of all cells.
    cells : shape (m, corners), indices of points; quads and triangles turn counterclockwise about their normal.
    point_data, cell_data : arrays by name, shape (n,) or (n, 3), and (m,) or (m, 3).
    """

    points: Array
    cell_type: CellType
    cells: Indices
    point_data: Mapping[str, Array] = field(default_factory=dict)
    cell_data: Mapping[str, Array] = field(default_factory=dict)

    @property
    def content(self) -> float:
        """Total length, area or volume of the cells, m, m² or m³; a volume is that inside the triangulated boundary."""
        if self.cell_type is CellType.HEXAHEDRON:
            first, second, third = np.moveaxis(_corners(boundary(self)), 1, 0)
            origin = self.points.mean(axis=0)
            return float(np.einsum("ni,ni->", first - origin, np.cross(second - origin, third - origin))) / 6
        if self.cell_type is CellType.LINE:
            start, end = np.moveaxis(_corners(self), 1, 0)
            return float(np.linalg.norm(end - start, axis=1).sum())
        first, second, third = np.moveaxis(_corners(in_triangles(self)), 1, 0)
        return float(np.linalg.norm(np.cross(second - first, third - first), axis=1).sum()) / 2

    def kept(self, keep: Mask) -> Self:
        """The mesh of the cells selected by a mask, shape (m,), and of the points that they use."""
        cells = self.cells[keep]
        used = np.unique(cells)
        return replace(
            self,
            points=self.points[used],
            cells=np.searchsorted(used, cells),
            point_data={name: values[used] for name, values in self.point_data.items()},
            cell_data={name: values[keep] for name, values in self.cell_data.items()},
        )


def grid(points: Array) -> Mesh:
    """The mesh of lines, quads or hexahedra between the points of a structured grid.

    Cell [i, j, k] lies between the points i and i + 1, j and j + 1, k and k + 1; cells are in C order. Normals of quads
    point along the third axis of a right-handed grid.

    Parameters
    ----------
    points : shape (nx, 3), (nx, ny, 3) or (nx, ny, nz, 3), m.
    """
    shape = points.shape[:-1]
    number = np.arange(np.prod(shape)).reshape(shape)
    flat = ((0,), (1,)) if len(shape) == 1 else ((0, 0), (1, 0), (1, 1), (0, 1))
    steps = flat if len(shape) < 3 else tuple((*step, up) for up in (0, 1) for step in flat)
    corners = [
        number[tuple(slice(n, n + size - 1) for n, size in zip(step, shape, strict=True))].ravel() for step in steps
    ]
    cell_type = (CellType.LINE, CellType.QUAD, CellType.HEXAHEDRON)[len(shape) - 1]
    return Mesh(points=points.reshape(-1, 3), cell_type=cell_type, cells=np.column_stack(corners))


def in_triangles(mesh: Mesh) -> Mesh:
    """The mesh with quads split along the diagonal from corner 1 to 3; halves keep the data of their quad."""
    if mesh.cell_type is CellType.TRIANGLE:
        return mesh
    halves = np.stack([mesh.cells[:, [0, 1, 2]], mesh.cells[:, [0, 2, 3]]], axis=1).reshape(-1, 3)
    data = {name: np.repeat(values, 2, axis=0) for name, values in mesh.cell_data.items()}
    return replace(mesh, cell_type=CellType.TRIANGLE, cells=halves, cell_data=data)


def boundary(mesh: Mesh) -> Mesh:
    """The closed boundary of a mesh of hexahedra, in triangles with outward normals.

    Coincident points are merged; triangles with coincident corners and pairs of coincident triangles are left out, so
    that an edge where two walls meet belongs to two triangles, one on each wall.
    """
    points, number = np.unique(mesh.points, axis=0, return_inverse=True)
    faces = number.ravel()[mesh.cells[:, np.array(_FACES)]].reshape(-1, 4)
    faces = faces[_occurs_once(faces)]
    cells = np.concatenate([faces[:, [0, 1, 2]], faces[:, [0, 2, 3]]])
    different = (cells[:, 0] != cells[:, 1]) & (cells[:, 1] != cells[:, 2]) & (cells[:, 2] != cells[:, 0])
    cells = cells[different]
    cells = cells[_occurs_once(cells)]
    return Mesh(points=points, cell_type=CellType.TRIANGLE, cells=cells).kept(np.ones(len(cells), dtype=bool))


def _occurs_once(cells: Indices) -> Mask:
    _, which, times = np.unique(np.sort(cells, axis=1), axis=0, return_inverse=True, return_counts=True)
    return np.asarray(times[which.ravel()] == 1)


def _corners(mesh: Mesh) -> Array:
    return mesh.points[mesh.cells]
