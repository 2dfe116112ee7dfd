"""Nodes over the plane of a film, at every break of its thickness, and the control volumes round them."""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.cavitation.shape import Shape


@dataclass(frozen=True, kw_only=True)
class Grid:
    """Nodes at ``x`` (nx,) and ``y`` (ny,); a periodic direction lacks its last node, which is the first again.

    ``spacing_x`` (nx,) and ``spacing_y`` (ny,) lead to the next node; their last entry counts only if periodic, and is
    zero otherwise. ``share_x`` and ``share_y`` are the lengths of the control volumes. ``radius`` (ny,) is what turns
    dx into a length: r where x is an angle, else 1.
    """

    x: Array
    y: Array
    spacing_x: Array
    spacing_y: Array
    share_x: Array
    share_y: Array
    radius: Array

    @property
    def shape(self) -> tuple[int, int]:
        """(nx, ny)."""
        return self.x.size, self.y.size

    @property
    def areas(self) -> Array:
        """Of the control volumes, m² (m for an infinitely wide film), shape (nx, ny)."""
        return self.share_x[:, None] * (self.share_y * self.radius)


def grid(shape: Shape, cells: tuple[int, int]) -> Grid:
    """About ``cells`` equal cells in x and y; between neighbouring breaks at least one, and in y one node if wide."""
    x = _along(shape.breaks, cells[0])
    y = np.array([np.mean(shape.across)]) if shape.wide else np.linspace(*shape.across, cells[1] + 1)
    x, spacing_x, share_x = _volumes(x, periodic=shape.joined[0])
    y, spacing_y, share_y = _volumes(y, periodic=shape.joined[1]) if not shape.wide else (y, np.zeros(1), np.ones(1))
    return Grid(
        x=x,
        y=y,
        spacing_x=spacing_x,
        spacing_y=spacing_y,
        share_x=share_x,
        share_y=share_y,
        radius=y if shape.polar else np.ones_like(y),
    )


def _along(breaks: tuple[float, ...], cells: int) -> Array:
    """Equal cells in every piece, as nearly as may be the same in all."""
    size = (breaks[-1] - breaks[0]) / cells
    pieces = [np.linspace(a, b, max(1, round((b - a) / size)), endpoint=False) for a, b in pairwise(breaks)]
    return np.append(np.concatenate(pieces), breaks[-1])


def _volumes(places: Array, *, periodic: bool) -> tuple[Array, Array, Array]:
    spacing = np.diff(places)
    if periodic:
        return places[:-1], spacing, (spacing + np.roll(spacing, 1)) / 2
    spacing = np.append(spacing, 0.0)
    return places, spacing, (spacing + np.append(0.0, spacing[:-1])) / 2
