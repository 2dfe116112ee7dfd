"""The least thickness of a film, and its place."""

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.bearing.geometry.shapes import AnyShape
from roughfilm.rom.cavitation.grid import grid
from roughfilm.rom.cavitation.shape import Shape

CELLS = (256, 64)
"""Number of cells along and across of the grid on which the least film is first sought."""

MAX_CELLS = (4096, 512)
"""Largest number of cells along and across of that grid; below it a feature has at least ``CELLS_OF_FEATURE``."""

CELLS_OF_FEATURE = 8
"""Number of cells over the shortest feature of the wall."""

SAME = 1e-12
"""Relative difference below which two films are equally thin."""

ZOOMS, ZOOM_POINTS = 4, 17
"""Number of times that the surroundings of the thinnest node are refined, and points along each direction."""


@dataclass(frozen=True, kw_only=True)
class LeastFilm:
    """The least thickness of a film, m, and its place in the coordinates of the scene.

    ``x`` is in m from the inlet, in a journal bearing along the circumference from the widest place, and on a ring an
    angle in rad; ``y`` is in m across the sliding, and on a ring the radius.
    """

    thickness: float
    x: float
    y: float


@lru_cache(maxsize=64)
def least_film(geometry: AnyShape, *, turned: bool = False) -> LeastFilm:
    """The least thickness h(x, y) of a film without roughness, and where it is.

    Where the film is equally thin at several places, as on a land, the place is the first one along the sliding, and
    there the one nearest to the middle of the width.

    Parameters
    ----------
    turned : whether the wall slides towards decreasing x.
    """
    shape = geometry.film_shape()
    sides = (shape.length, shape.across[1] - shape.across[0])
    counts = zip(CELLS, MAX_CELLS, sides, shape.finest, strict=True)
    cells = [_count(round(CELLS_OF_FEATURE * side / fine), least, most) for least, most, side, fine in counts]
    nodes = grid(shape, (cells[0], cells[1]))
    x = np.append(nodes.x, shape.breaks[-1]) if shape.joined[0] else nodes.x
    beside = 1e-9 * np.array([-sides[0], sides[0]])
    x = np.unique(np.clip(np.concatenate([x, *(np.array(shape.breaks) + offset for offset in beside)]), x[0], x[-1]))
    y = nodes.y
    found = _thinnest(shape, x, y, turned=turned)
    step = np.array([np.diff(x).max(initial=0.0), np.diff(y).max(initial=0.0)])
    for _ in range(ZOOMS):
        offsets = np.linspace(-1, 1, ZOOM_POINTS)
        near = _thinnest(
            shape,
            np.clip(found.x + step[0] * offsets, x[0], x[-1]),
            np.clip(found.y + step[1] * offsets, y[0], y[-1]),
            turned=turned,
        )
        if near.thickness < found.thickness * (1 - SAME):
            found = near
        step = step * 2 / (ZOOM_POINTS - 1)
    return found


def _count(features: int, least: int, most: int) -> int:
    """A number of cells from ``least`` to ``most``, a multiple of ``features`` so that points of a file are nodes."""
    return min(features * math.ceil(least / features) if features else least, most)


def _thinnest(shape: Shape, x: Array, y: Array, *, turned: bool) -> LeastFilm:
    """The thinnest of the films at positions x and y; the first along the sliding, nearest to the middle across."""
    h = shape.thickness(*np.meshgrid(x, y, indexing="ij"))
    thin = h <= h.min() + SAME * abs(h.min())
    columns = np.flatnonzero(thin.any(axis=1))
    i = columns[-1 if turned else 0]
    rows = np.flatnonzero(thin[i])
    j = rows[np.argmin(np.abs(y[rows] - sum(shape.across) / 2))]
    return LeastFilm(thickness=float(h.min()), x=float(x[i]), y=float(y[j]))
