"""The cells of a structured mesh of hexahedra: volumes, centroids and faces as OpenFOAM computes them."""

from itertools import product

import numpy as np

from roughfilm.contact.foundation.arrays import Array, Mask


def quads(vertices: Array, axis: int) -> tuple[Array, Array]:
    """The area vectors along ``axis`` and the centres of the faces normal to it.

    A face is divided into four triangles about the mean of its corners; the centre is their mean by area.

    Parameters
    ----------
    vertices : corners of the cells, shape (nx + 1, ny + 1, nz + 1, 3).
    axis : 0, 1 or 2.

    Returns
    -------
    tuple[Array, Array]
        Area vectors and centres, both with one more face along ``axis`` than there are cells.
    """
    moved = np.moveaxis(vertices, (axis, (axis + 1) % 3, (axis + 2) % 3), (0, 1, 2))
    corners = [moved[:, :-1, :-1], moved[:, 1:, :-1], moved[:, 1:, 1:], moved[:, :-1, 1:]]
    middle = np.mean(corners, axis=0)
    area, moment, weight = np.zeros_like(middle), np.zeros_like(middle), np.zeros(middle.shape[:-1])
    for one, other in zip(corners, [*corners[1:], corners[0]], strict=True):
        triangle = np.cross(one - middle, other - middle) / 2
        size = np.linalg.norm(triangle, axis=-1)
        area += triangle
        weight += size
        moment += size[..., None] * (one + other + middle) / 3
    back = (0, 1, 2), (axis, (axis + 1) % 3, (axis + 2) % 3)
    return np.moveaxis(area, *back), np.moveaxis(moment / weight[..., None], *back)


def cells(vertices: Array) -> tuple[Array, Array]:
    """The volumes, shape (nx, ny, nz), and the centroids, shape (nx, ny, nz, 3), of the cells.

    A cell is divided into pyramids over its faces, with the mean of the centres of the faces as their tip.

    Parameters
    ----------
    vertices : corners of the cells, shape (nx + 1, ny + 1, nz + 1, 3).
    """
    faces = []
    for axis in range(3):
        area, centre = quads(vertices, axis)
        for sign, place in ((-1.0, slice(None, -1)), (1.0, slice(1, None))):
            at = (slice(None),) * axis + (place,)
            faces.append((sign * area[at], centre[at]))
    tip = np.mean([centre for _, centre in faces], axis=0)
    volume, moment = np.zeros(tip.shape[:-1]), np.zeros_like(tip)
    for area, centre in faces:
        pyramid = (area * (centre - tip)).sum(axis=-1) / 3
        volume += pyramid
        moment += pyramid[..., None] * (0.75 * centre + 0.25 * tip)
    return volume, moment / volume[..., None]


def upright(vertices: Array) -> Mask:
    """Whether the edges at each corner of each cell are right-handed, as in cells that do not fold; (nx, ny, nz)."""
    shape = [n - 1 for n in vertices.shape[:3]]
    found = np.ones(shape, dtype=bool)

    def at(*corner: int) -> Array:
        return vertices[tuple(slice(a, a + n) for a, n in zip(corner, shape, strict=True))]

    for i, j, k in product((0, 1), repeat=3):
        along, across, up = at(1, j, k) - at(0, j, k), at(i, 1, k) - at(i, 0, k), at(i, j, 1) - at(i, j, 0)
        found &= (np.cross(along, across) * up).sum(axis=-1) > 0
    return found
