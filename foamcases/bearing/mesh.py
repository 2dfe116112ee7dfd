"""The mesh of an infinitely wide pad: near-orthogonal, or with vertical columns where the wall has steps.

A step of the wall is a vertical side of cells. The film thickness is split into a continuous part c(x) and the heights
of the steps s(x), h = c + s with min s = 0. Layers follow y = -c(x) and, below it, y = -c(x) - s for each height s of
the steps; the cells below the wall are left out.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array, Mask
from roughfilm.contact.foundation.errors import InputError
from roughfilm.foamcases.conformal.orthogonal import between_ends
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.wide_pad.gap import pad_gap, steps
from roughfilm.rom.thin_film.columns import columns
from roughfilm.rom.thin_film.gap import Gap

DEFAULT_COLUMNS, MOST_COLUMNS = 240, 4000

COLUMNS_OF_FEATURE = 24
"""Number of columns over the shortest feature of the wall at the default resolution."""

DEFAULT_LAYERS, MIN_LAYERS = 48, 4
"""Number of cells across the minimum film thickness at the default resolution, and the smallest one."""

MIN_STEP_LAYERS = 2
"""Smallest number of cells over the height of a step."""

MAX_SLOPE = 0.5
"""Largest slope of a wall with steps beside them, as the columns of its mesh do not meet it at right angles."""

MIN_FILM = 0.1
"""Least continuous part of the film thickness beside steps, over the film."""

MAX_END_CELL = 0.3
"""Length of a column at the default resolution, in film thicknesses, above which ends get denser columns."""

SAME_HEIGHT = 1e-6
"""Difference of heights over the film below which two steps are equal, and of positions below which two are one."""

SAMPLES = 400
"""Number of positions on each piece of a wall at which its slope is taken."""

Indices = NDArray[np.int64]


@dataclass(frozen=True, kw_only=True)
class Plane:
    """The cells of a pad in the plane of its flow.

    Attributes
    ----------
    vertices : corners of the cells, shape (nx + 1, ny + 1, 2), in film thicknesses; layers count from the still wall.
    lowest : the lowest layer of each column that is in the liquid, shape (nx,).
    """

    vertices: Array
    lowest: Indices

    @property
    def kept(self) -> Mask:
        """Whether each cell is in the liquid, shape (nx, ny)."""
        return np.asarray(np.arange(self.vertices.shape[1] - 1) >= self.lowest[:, None])


def default_columns(scene: Bearing) -> int:
    """The default number of columns: at least ``COLUMNS_OF_FEATURE`` for the shortest feature of the wall."""
    features = scene.geometry.length / scene.geometry.film_shape().finest[0]
    return min(max(DEFAULT_COLUMNS, 8 * round(COLUMNS_OF_FEATURE * features / 8)), MOST_COLUMNS)


def layers_of(scene: Bearing, resolution: int) -> int:
    """The number of layers in the minimum film thickness, in proportion to the number of columns."""
    return max(MIN_LAYERS, round(DEFAULT_LAYERS * resolution / default_columns(scene)))


def plane_of(scene: Bearing, resolution: int) -> Plane:
    """The mesh of a scene.

    Parameters
    ----------
    scene : an infinitely wide pad.
    resolution : number of columns along the film, about.

    Raises
    ------
    InputError
        If cells of the mesh fold, or a cell lies over several steps.
    """
    gap, layers = _with_ends(pad_gap(scene), default_columns(scene)), layers_of(scene, resolution)
    if steps(gap):
        return _stepped(gap, resolution, layers)
    vertices = between_ends(gap, resolution, layers)
    return Plane(vertices=vertices, lowest=np.zeros(vertices.shape[0] - 1, dtype=np.int64))


def _with_ends(gap: Gap, default: int) -> Gap:
    """The gap with a corner at its ends, beside which columns are dense, where the flow needs them.

    The flow enters developed, and adapts to a wall that is inclined there within a film thickness. ``default`` is the
    default number of columns.
    """
    beside = np.array([0.0, gap.film])
    ends = gap.thickness(np.concatenate([gap.breaks[0] + beside, gap.breaks[-1] - beside])).reshape(2, 2)
    inclined = np.abs(np.diff(ends)).max() > SAME_HEIGHT * gap.film
    if not inclined or gap.length / gap.film <= MAX_END_CELL * default:
        return gap
    return replace(gap, corners=(gap.breaks[0], *gap.corners))


def step_obstacle(scene: Bearing) -> str | None:
    """The reason for which a wall with steps has no mesh; None for one without steps, or with a mesh."""
    gap = pad_gap(scene)
    if not steps(gap):
        return None
    parts = _Parts(gap)
    x = np.unique(np.concatenate([np.linspace(start, end, SAMPLES) for start, end in gap.pieces])) / gap.film
    smooth = parts.smooth(x)
    slope = float(np.abs(np.diff(smooth) / np.diff(x)).max())
    if slope > MAX_SLOPE:
        return f"the wall has steps and slopes of up to {slope:.2g}; with steps at most {MAX_SLOPE:g} are meshed"
    if smooth.min() < MIN_FILM:
        return f"the wall has a step of more than {1 - MIN_FILM:.0%} of the film above it, which is not meshed"
    return None


class _Parts:
    """The continuous part of a film thickness and the heights of its steps, in film thicknesses."""

    def __init__(self, gap: Gap) -> None:
        places = steps(gap)
        self.gap = gap
        self.places = np.array([place for place, _ in places]) / gap.film
        heights = np.concatenate([[0.0], np.cumsum([jump for _, jump in places])]) / gap.film
        self.heights = heights - heights.min()

    def step(self, x: Array) -> Array:
        """The height s(x) of the steps, at a step that of the wall behind it."""
        return np.asarray(self.heights[np.searchsorted(self.places, x, side="right")])

    def smooth(self, x: Array) -> Array:
        """The continuous part c(x)."""
        beside = SAME_HEIGHT / 10 * np.diff(np.concatenate([[x[0]], self.places, [x[-1]]])).min()
        at_step = (np.abs(x[:, None] - self.places) < beside).any(axis=1)
        inside = np.where(at_step, x + beside, x)
        return np.asarray(self.gap.thickness(inside * self.gap.film) / self.gap.film - self.step(inside))


def _stepped(gap: Gap, resolution: int, layers: int) -> Plane:
    """The mesh of a wall with steps, whose columns are vertical."""
    parts, x = _Parts(gap), columns(gap, resolution)
    nearest = np.abs(x[:, None] - parts.places).argmin(axis=0)
    if np.unique(nearest).size < nearest.size or np.abs(x[nearest] - parts.places).max() > SAME_HEIGHT:
        raise InputError(
            f"resolution: got {resolution}, by which a cell lies over several steps of the wall; take a greater one"
        )
    x[nearest] = parts.places
    levels = _levels(parts.heights)
    below = [max(MIN_STEP_LAYERS, round(layers * height)) for height in np.diff(levels)]
    depths = [
        np.linspace(deep, shallow, count, endpoint=False)
        for shallow, deep, count in zip(levels[:-1], levels[1:], below, strict=True)
    ]
    smooth = parts.smooth(x)[:, None]
    y = np.concatenate([1 - smooth - np.concatenate(depths[::-1]), 1 - smooth * np.linspace(1, 0, layers + 1)], axis=1)
    floors = np.concatenate([np.cumsum(below[::-1])[::-1], [0]])
    height = parts.step((x[1:] + x[:-1]) / 2)
    level = np.abs(height[:, None] - levels).argmin(axis=1)
    return Plane(
        vertices=np.stack([np.broadcast_to(x[:, None], y.shape), y], axis=-1),
        lowest=floors[level].astype(np.int64),
    )


def _levels(heights: Array) -> Array:
    """The different heights of steps, from 0 up."""
    ordered = np.unique(heights)
    return np.asarray(ordered[np.concatenate([[True], np.diff(ordered) > SAME_HEIGHT])])
