"""Coarser grids of a gap, and interpolation to a finer grid."""

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.compiled import allocating

MIN_COARSENED_NODES = 8
"""Smallest number of nodes along a direction that is coarsened."""


def coarser_grids(gap: Array, spacing: tuple[float, float]) -> list[tuple[Array, tuple[float, float]]]:
    """The gap on up to three grids with their spacings, the coarsest first; coarse nodes are fine ones where they fit.

    Grids whose nodes are all closed are left out.
    """
    grids = [(gap, spacing)]
    while len(grids) < 3:
        h, steps = grids[0]
        counts = tuple(-(-n // 2) if n >= MIN_COARSENED_NODES else n for n in h.shape)
        if counts == h.shape:
            break
        coarser = (steps[0] * h.shape[0] / counts[0], steps[1] * h.shape[1] / counts[1])
        picked = sampled(sampled(h, counts[0], 0), counts[1], 1)
        if not picked.any():
            break
        grids.insert(0, (picked, coarser))
    return grids


def sampled(gap: Array, count: int, axis: int) -> Array:
    """The gap at ``count`` even positions along an axis, by linear interpolation."""
    own = gap.shape[axis]
    if own % count == 0:
        return np.take(gap, np.arange(0, own, own // count), axis=axis)
    place = np.arange(count) * (own / count)
    before = place.astype(np.int64)
    part = np.expand_dims(place - before, 1 - axis)
    after = np.take(gap, (before + 1) % own, axis=axis)
    return np.asarray(np.take(gap, before, axis=axis) * (1 - part) + after * part)


def refined(values: Array, shape: tuple[int, ...]) -> Array:
    """Periodic values interpolated linearly to a grid of the given shape (nx, ny)."""
    out = np.empty(shape)
    _draw(values, out)
    return out


@allocating
def _draw(values, out):  # type: ignore[no-untyped-def]
    (count, length), (rows, columns) = values.shape, out.shape
    for i in range(rows):
        before = i * count // rows
        own, next_one, part = values[before], values[(before + 1) % count], i * count / rows - before
        row = (1 - part) * own + part * next_one
        for j in range(columns):
            left = j * length // columns
            share = j * length / columns - left
            out[i, j] = (1 - share) * row[left] + share * row[left + 1 if left + 1 < length else 0]
