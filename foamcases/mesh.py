"""Gap → structured hexahedral mesh → the files of ``constant/polyMesh``."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from foamlib import FoamFile
from numpy.typing import NDArray

from rom.gap import Array, Gap
from rom.grid import columns

LAYERS_PER_COLUMN = 1 / 5
"""Cells across the film for each cell along it."""

ARCHITECTURE = '"LSB;label=32;scalar=64"'


def layered(gap: Gap, resolution: int) -> Array:
    """Vertices of the mesh of a gap, shape (columns + 1, layers + 1, 2, 3), in film thicknesses.

    Layers follow the walls: y = 1 - h(x) (1 - Y) with Y uniform from the lower wall (0) to the upper (1).
    """
    x = columns(gap, resolution)
    h = gap.thickness(x * gap.film) / gap.film
    layers = max(4, round(resolution * LAYERS_PER_COLUMN))
    y = 1 - h[:, None] * (1 - np.linspace(0, 1, layers + 1))
    vertices = np.empty((x.size, layers + 1, 2, 3))
    vertices[..., 0] = x[:, None, None]
    vertices[..., 1] = y[:, :, None]
    vertices[..., 2] = [0.0, 1.0]
    return vertices


@dataclass(frozen=True, kw_only=True)
class Patch:
    """One side of the block: its name in the case, and what OpenFOAM's boundary file says of it."""

    name: str
    entries: dict[str, str]


def write_block(vertices: Array, sides: tuple[Patch, ...], directory: Path) -> None:
    """Write one block of hexahedra as ``constant/polyMesh`` below ``directory``, binary.

    Parameters
    ----------
    vertices
        Shape (nx + 1, ny + 1, nz + 1, 3). Cell (i, j, k) gets the number i + nx (j + ny k).
    sides
        The patches at x-, x+, y-, y+, z-, z+, in this order; opposite patches have matching face order, as cyclic
        patches need.
    """
    points_shape = vertices.shape[:3]
    cells_shape = tuple(n - 1 for n in points_shape)
    point = np.arange(np.prod(points_shape)).reshape(points_shape, order="F")
    cell = np.arange(np.prod(cells_shape)).reshape(cells_shape, order="F")

    inner: list[NDArray[np.int64]] = []
    outer: list[tuple[NDArray[np.int64], NDArray[np.int64]]] = []
    for axis in range(3):
        quads = _quads(point, axis)
        inner.append(
            np.column_stack(
                [
                    _flat(cell, axis, slice(None, -1)),
                    _flat(cell, axis, slice(1, None)),
                    *(_flat(corner, axis, slice(1, -1)) for corner in quads),
                ]
            )
        )
        for place, order in ((slice(0, 1), (0, 3, 2, 1)), (slice(-1, None), (0, 1, 2, 3))):
            faces = np.column_stack([_flat(quads[n], axis, place) for n in order])
            outer.append((_flat(cell, axis, place), faces))

    rows = np.concatenate(inner)
    rows = rows[np.lexsort((rows[:, 1], rows[:, 0]))]
    owner = np.concatenate([rows[:, 0], *(cells for cells, _ in outer)])
    faces = np.concatenate([rows[:, 2:], *(quads for _, quads in outer)])

    boundary: Any = []
    start = len(rows)
    for patch, (cells, _) in zip(sides, outer, strict=True):
        boundary.append((patch.name, {**patch.entries, "nFaces": len(cells), "startFace": start}))
        start += len(cells)

    mesh = directory / "constant" / "polyMesh"
    mesh.mkdir(parents=True, exist_ok=True)
    flat_points = vertices.reshape(-1, 3, order="F")
    (mesh / "points").write_bytes(_dump("vectorField", "points", flat_points))
    (mesh / "owner").write_bytes(_dump("labelList", "owner", owner.astype(np.int32)))
    (mesh / "neighbour").write_bytes(_dump("labelList", "neighbour", rows[:, 1].astype(np.int32)))
    offsets = np.arange(0, faces.size + 1, 4, dtype=np.int32)
    corners = FoamFile.dumps({"FoamFile": {"format": "binary"}, None: faces.astype(np.int32).ravel()})
    (mesh / "faces").write_bytes(_dump("faceCompactList", "faces", offsets) + b"\n" + corners.split(b"}", 1)[1])
    header: Any = {"version": 2.0, "format": "ascii", "class": "polyBoundaryMesh", "object": "boundary"}
    (mesh / "boundary").write_bytes(FoamFile.dumps({"FoamFile": header, None: boundary}))


def _flat(grid: NDArray[np.int64], axis: int, place: slice) -> NDArray[np.int64]:
    return np.take(grid, range(*place.indices(grid.shape[axis])), axis=axis).ravel(order="F")


def _quads(point: NDArray[np.int64], axis: int) -> list[NDArray[np.int64]]:
    """The four corners of every face normal to ``axis``, turning so that the normal points along it."""
    first, second = [(1, 2), (2, 0), (0, 1)][axis]
    corners = []
    for a, b in ((0, 0), (1, 0), (1, 1), (0, 1)):
        cut: list[slice] = [slice(None)] * 3
        cut[first] = slice(a, point.shape[first] - 1 + a)
        cut[second] = slice(b, point.shape[second] - 1 + b)
        corners.append(point[tuple(cut)])
    return corners


def _dump(kind: str, name: str, values: Any) -> bytes:
    header: Any = {"version": 2.0, "format": "binary", "arch": ARCHITECTURE, "class": kind, "object": name}
    return FoamFile.dumps({"FoamFile": header, None: values})
