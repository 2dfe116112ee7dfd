"""Blocks of hexahedra, written as the files of ``constant/polyMesh``."""

from dataclasses import dataclass
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array, Mask

Labels = NDArray[np.int64]
"""Numbers of cells or points in the mesh, from 0."""

ALONG = (0, 1, 2, 3)
"""Order of the corners of a face whose normal points along its axis."""

AGAINST = (0, 3, 2, 1)
"""Order of the corners of a face whose normal points against its axis."""

ARCHITECTURE = '"LSB;label=32;scalar=64"'
"""Layout of binary files in OpenFOAM's words: little-endian, labels of 32 bits, numbers of 64 bits."""


@dataclass(frozen=True, kw_only=True)
class Patch:
    """A side of the block as a patch: its name in the case, and its entries in OpenFOAM's boundary file."""

    name: str
    entries: dict[str, str]


def in_space(plane: Array) -> Array:
    """The vertices of a mesh that is one cell wide, shape (nx + 1, ny + 1, 2, 3), from those in a plane."""
    return np.stack([np.pad(plane, ((0, 0), (0, 0), (0, 1)), constant_values=z) for z in (0.0, 1.0)], axis=2)


def write_block(
    vertices: Array,
    sides: tuple[Patch, ...],
    directory: Path,
    *,
    kept: Mask | None = None,
    cut: Patch | None = None,
) -> None:
    """Write one block of hexahedra, or some of its cells, as ``constant/polyMesh`` below ``directory``, binary.

    Parameters
    ----------
    vertices
        Corners of the cells, shape (nx + 1, ny + 1, nz + 1, 3). Cell (i, j, k) gets the number i + nx (j + ny k),
        less the number of cells before it that are not kept.
    sides
        The patches at x-, x+, y-, y+, z-, z+, in this order; opposite patches have matching face order, as cyclic
        patches need. A cyclic patch has faces only where the cells on both sides of it are kept.
    directory
        The directory of the case; its ``constant/polyMesh`` is made if it is missing.
    kept
        Mask of the cells that the mesh has, shape (nx, ny, nz); all cells by default.
    cut
        The patch of the faces towards cells that are not kept, written as the last patch. It must be given if ``kept``
        leaves cells out.
    """
    from foamlib import FoamFile  # slow to import

    shape = tuple(n - 1 for n in vertices.shape[:3])
    kept = np.ones(shape, dtype=bool) if kept is None else kept
    used = used_points(kept)
    cell, point = _numbers(kept), _numbers(used)

    inner: list[Labels] = []
    outer: list[tuple[Labels, Labels]] = []
    bare: list[tuple[Labels, Labels]] = []
    for axis in range(3):
        quads = _quads(point, axis)

        def faces_of(
            cells: slice, place: slice, order: tuple[int, ...], there: Mask, axis: int = axis, quads: Any = quads
        ) -> tuple[Labels, Labels]:
            corners = np.column_stack([_flat(quads[n], axis, place)[there] for n in order])
            return _flat(cell, axis, cells)[there], corners

        before, after, between = slice(None, -1), slice(1, None), slice(1, -1)
        behind, ahead = _flat(kept, axis, before), _flat(kept, axis, after)
        owner, corners = faces_of(before, between, ALONG, behind & ahead)
        neighbour, _ = faces_of(after, between, ALONG, behind & ahead)
        inner.append(np.column_stack([owner, neighbour, corners]))
        bare += [faces_of(before, between, ALONG, behind & ~ahead), faces_of(after, between, AGAINST, ahead & ~behind)]

        first, last = slice(0, 1), slice(-1, None)
        ends = [_flat(kept, axis, place) for place in (first, last)]
        through = ends[0] & ends[1] if sides[2 * axis].entries["type"] == "cyclic" else ends[0] | ends[1]
        for place, order, there in zip((first, last), (AGAINST, ALONG), ends, strict=True):
            outer.append(faces_of(place, place, order, there & through))
            bare.append(faces_of(place, place, order, there & ~through))

    patches = list(sides)
    if cut is not None and not kept.all():
        patches.append(cut)
        outer.append((np.concatenate([cells for cells, _ in bare]), np.concatenate([quads for _, quads in bare])))
    rows = np.concatenate(inner)
    rows = rows[np.lexsort((rows[:, 1], rows[:, 0]))]
    owner = np.concatenate([rows[:, 0], *(cells for cells, _ in outer)])
    faces = np.concatenate([rows[:, 2:], *(quads for _, quads in outer)])

    boundary: Any = []
    start = len(rows)
    for patch, (cells, _) in zip(patches, outer, strict=True):
        boundary.append((patch.name, {**patch.entries, "nFaces": len(cells), "startFace": start}))
        start += len(cells)

    mesh = directory / "constant" / "polyMesh"
    mesh.mkdir(parents=True, exist_ok=True)
    flat_points = vertices.reshape(-1, 3, order="F")[used.ravel(order="F")]
    (mesh / "points").write_bytes(_dump("vectorField", "points", flat_points))
    (mesh / "owner").write_bytes(_dump("labelList", "owner", owner.astype(np.int32)))
    (mesh / "neighbour").write_bytes(_dump("labelList", "neighbour", rows[:, 1].astype(np.int32)))
    offsets = np.arange(0, faces.size + 1, 4, dtype=np.int32)
    corners_text = FoamFile.dumps({"FoamFile": {"format": "binary"}, None: faces.astype(np.int32).ravel()})
    (mesh / "faces").write_bytes(_dump("faceCompactList", "faces", offsets) + b"\n" + corners_text.split(b"}", 1)[1])
    header: Any = {"version": 2.0, "format": "ascii", "class": "polyBoundaryMesh", "object": "boundary"}
    (mesh / "boundary").write_bytes(FoamFile.dumps({"FoamFile": header, None: boundary}))


def _numbers(there: Mask) -> Labels:
    """The number of each marked cell among the marked ones, x fastest; the numbers of other cells have no meaning."""
    return np.asarray(np.cumsum(there.ravel(order="F")) - 1).reshape(there.shape, order="F")


def used_points(kept: Mask) -> Mask:
    """The mask of the points that are a corner of a kept cell."""
    used = np.zeros([n + 1 for n in kept.shape], dtype=bool)
    for low in product((0, 1), repeat=3):
        used[tuple(slice(a, a + n) for a, n in zip(low, kept.shape, strict=True))] |= kept
    return used


def _flat(grid: NDArray[Any], axis: int, place: slice) -> NDArray[Any]:
    return np.take(grid, range(*place.indices(grid.shape[axis])), axis=axis).ravel(order="F")


def _quads(point: Labels, axis: int) -> list[Labels]:
    """The four corners of every face normal to ``axis``, in the order for which the normal points along the axis."""
    first, second = [(1, 2), (2, 0), (0, 1)][axis]
    corners = []
    for a, b in ((0, 0), (1, 0), (1, 1), (0, 1)):
        cut: list[slice] = [slice(None)] * 3
        cut[first] = slice(a, point.shape[first] - 1 + a)
        cut[second] = slice(b, point.shape[second] - 1 + b)
        corners.append(point[tuple(cut)])
    return corners


def _dump(kind: str, name: str, values: Any) -> bytes:
    from foamlib import FoamFile  # slow to import

    header: Any = {"version": 2.0, "format": "binary", "arch": ARCHITECTURE, "class": kind, "object": name}
    return FoamFile.dumps({"FoamFile": header, None: values})
