"""Nodes over the plane of a film, one at every break of its thickness, and their control volumes."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.cavitation.shape import Shape


@dataclass(frozen=True, kw_only=True)
class Grid:
    """Nodes at ``x`` (nx,) and ``y`` (ny,); a periodic direction omits its last node, which equals the first.

    ``spacing_x`` (nx,) and ``spacing_y`` (ny,) are the distances to the next node; the last entry is zero unless the
    direction is periodic. ``volume_x`` and ``volume_y`` are the lengths of the control volumes. ``radius`` (ny,)
    converts dx into a length: r where x is an angle, else 1.
    """

    x: Array
    y: Array
    spacing_x: Array
    spacing_y: Array
    volume_x: Array
    volume_y: Array
    radius: Array

    @property
    def shape(self) -> tuple[int, int]:
        """(nx, ny)."""
        return self.x.size, self.y.size

    @cached_property
    def areas(self) -> Array:
        """Areas of the control volumes, m² (m for an infinitely wide film), shape (nx, ny)."""
        return self.volume_x[:, None] * (self.volume_y * self.radius)


def grid(shape: Shape, cells: tuple[int, int]) -> Grid:
    """A grid of about ``cells`` equal cells in x and y, with at least one cell between neighbouring breaks.

    An infinitely wide film has one node in y.
    """
    low, high = shape.across
    x = _along(shape.breaks, cells[0], shape.least_share)
    steps = (low, *shape.steps_across, high)
    y = np.array([(low + high) / 2]) if shape.wide else _along(steps, cells[1], shape.least_share)
    x, spacing_x, volume_x = _volumes(x, periodic=shape.joined[0])
    y, spacing_y, volume_y = _volumes(y, periodic=shape.joined[1]) if not shape.wide else (y, np.zeros(1), np.ones(1))
    return Grid(
        x=x,
        y=y,
        spacing_x=spacing_x,
        spacing_y=spacing_y,
        volume_x=volume_x,
        volume_y=volume_y,
        radius=y if shape.polar else np.ones_like(y),
    )


def quarters(shape: Shape, grid: Grid) -> Iterator[tuple[Array, Array, Array]]:
    """The positions x and y of the centres of the quarters of the control volumes, and their areas, m².

    They lie inside cells, so that steps at nodes are exact. Control volumes of an infinitely wide film are divided into
    halves. Where there is no film, the area is 0.
    """
    for x, length_x in _halves(grid.x, grid.spacing_x):
        length_x = np.where(shape.is_idle(np.mod(x - grid.x[0], shape.length) + grid.x[0]), 0.0, length_x)
        for y, length_y in [(grid.y, grid.volume_y)] if shape.wide else _halves(grid.y, grid.spacing_y):
            area = length_x[:, None] * length_y * (y if shape.polar else 1.0)
            along, across = np.broadcast_arrays(x[:, None], y)
            yield along, across, np.broadcast_to(area, grid.shape)


def _halves(places: Array, spacing: Array) -> Iterator[tuple[Array, Array]]:
    """The centres and lengths of the halves of the control volumes before and behind the nodes."""
    before = np.append(spacing[-1], spacing[:-1])
    yield places - before / 4, before / 2
    yield places + spacing / 4, spacing / 2


def gaps(shape: Shape, grid: Grid) -> tuple[NDArray[np.int64], ...]:
    """The nodes along x of each gap between films, from the end of a film to the beginning of the next one.

    They are in the order of the films behind them.
    """
    within, count = shape.is_idle(grid.x + grid.spacing_x / 2), grid.x.size
    first, last = np.flatnonzero(within & ~np.roll(within, 1)), np.flatnonzero(~within & np.roll(within, 1))
    starts = first[np.searchsorted(first, last) - 1]
    return tuple(
        np.arange(begin, begin + (end - begin) % count + 1) % count for begin, end in zip(starts, last, strict=True)
    )


def film_areas(shape: Shape, grid: Grid) -> Array:
    """Areas of the control volumes without the parts of them in gaps, m² (m if infinitely wide), shape (nx, ny)."""
    if not shape.idle:
        return grid.areas
    spacing = np.where(shape.is_idle(grid.x + grid.spacing_x / 2), 0.0, grid.spacing_x)
    return (spacing + np.roll(spacing, 1))[:, None] / 2 * (grid.volume_y * grid.radius)


def doubled(half: Grid) -> Grid:
    """The grid over both halves of a film that is symmetric about the first row of nodes of one half."""
    return replace(
        half,
        y=np.concatenate([2 * half.y[0] - half.y[:0:-1], half.y]),
        spacing_y=np.concatenate([half.spacing_y[-2::-1], half.spacing_y]),
        volume_y=np.concatenate([half.volume_y[:0:-1], 2 * half.volume_y[:1], half.volume_y[1:]]),
        radius=np.concatenate([half.radius[:0:-1], half.radius]),
    )


def _along(breaks: tuple[float, ...], cells: int, least_share: float) -> Array:
    """Node positions with equal cells between neighbouring breaks, of nearly one size everywhere."""
    size, least = (breaks[-1] - breaks[0]) / cells, max(1, round(least_share * cells))
    pieces = [np.linspace(a, b, max(least, round((b - a) / size)), endpoint=False) for a, b in pairwise(breaks)]
    return np.append(np.concatenate(pieces), breaks[-1])


def _volumes(places: Array, *, periodic: bool) -> tuple[Array, Array, Array]:
    spacing = np.diff(places)
    if periodic:
        return places[:-1], spacing, (spacing + np.roll(spacing, 1)) / 2
    spacing = np.append(spacing, 0.0)
    return places, spacing, (spacing + np.append(0.0, spacing[:-1])) / 2
