"""The cells of a plane structured mesh: their corners, centres, and whether they are convex."""

import numpy as np

from roughfilm.contact.foundation.arrays import Array, Mask


def corners(values: Array) -> tuple[Array, Array, Array, Array]:
    """The values at the corners of each cell, counterclockwise, each of shape (nx, ny, ...)."""
    return values[:-1, :-1], values[1:, :-1], values[1:, 1:], values[:-1, 1:]


def centres(vertices: Array) -> Array:
    """The centroids of the cells, shape (nx, ny, 2), from their vertices, shape (nx + 1, ny + 1, 2)."""
    a, b, c, d = corners(vertices)
    lower, upper = _cross(b - a, c - a)[..., None], _cross(c - a, d - a)[..., None]
    return np.asarray((lower * (a + b + c) + upper * (a + c + d)) / (3 * (lower + upper)))


def convex(vertices: Array) -> Mask:
    """Whether each cell turns left at each of its corners, so that it is convex and not folded; shape (nx, ny)."""
    points = corners(vertices)
    sides = [points[(n + 1) % 4] - points[n] for n in range(4)]
    return np.asarray(np.min([_cross(sides[n - 1], sides[n]) for n in range(4)], axis=0) > 0)


def _cross(one: Array, other: Array) -> Array:
    return np.asarray(one[..., 0] * other[..., 1] - one[..., 1] * other[..., 0])
