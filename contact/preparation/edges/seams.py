"""Edges joined along seams through an overlap, where the surface fits itself best."""

import math

import numpy as np
import scipy

from roughfilm.contact.foundation.arrays import Array, Mask
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.preparation.edges.blending import AXES, Direction
from roughfilm.contact.preparation.edges.joined import Joined
from roughfilm.contact.preparation.window import Window, cut_window
from roughfilm.contact.surfaces.periodicity import MISMATCH_THRESHOLD, mismatch_across, mismatches
from roughfilm.contact.surfaces.surface import Surface

OVERLAP, SHORT_OVERLAP = 8, 6
"""Length of the overlap over the width where the measurement continues, and where the cell is shortened by it."""

SEARCH = 2
"""Length of the overlap over the number of further lines by which the cell may be shortened for a better fit."""

MIN_OVERLAP = 4
"""Smallest length of the overlap, pixels."""

MAX_OVERLAP_OF_SIDE = 3
"""Length of the window over the longest overlap."""

BLENDS, USUAL_BLEND = (0.25, 0.5, 0.75), 0.5
"""Standard deviations of the Gaussian filter that blends across a seam, over the width, from the narrowest one on, and
that which is taken if none suffices."""

SUFFICIENT_MISMATCH = MISMATCH_THRESHOLD / 2
"""Mismatch at which edges match as measured, and at which no wider blend is tried along a seam."""

TRUNCATION = 3
"""Distance, in standard deviations, at which this filter is truncated."""

MAX_COMPARED = 256
"""Largest number of places along the joint at which lengths of the cell are compared."""

ROUNDING = 1e-12
"""Weight that is rounding of the filter; the smallest weight of the filter itself is above 1e-8."""


def join_by_seams(
    surface: Surface, window: Window, direction: Direction, *, width: tuple[float, float], filled: Mask
) -> tuple[Joined, Window]:
    """Join opposite edges of a window where the surface beyond an edge fits the surface behind the opposite one.

    Of n + m lines, the last m overlap the first m in the cell of n lines. A seam cuts through the overlap: in front of
    it heights h₁ are those beyond the end, behind it heights h₂ those behind the start, all as measured. The seam moves
    at most one pixel from line to line and minimises Σ (h₁ − h₂)² / ⟨(h − ⟨h⟩)²⟩ plus the number of filled points that
    it keeps. Across the seam the heights are (1 − w) h₁ + w h₂, with w the indicator of h₂ after a Gaussian filter;
    there h₁ ≈ h₂, so that little variance is lost, and no height is outside of the two. Beyond three standard
    deviations heights stay as measured, bit for bit. The standard deviation is 1/4, 1/2 or 3/4 of the width: the first
    with a mismatch of at most 0.05 along the seam, or 1/2 if none suffices.

    The overlap is 8 widths long, divided between both ends of the window where the measurement continues there, else
    taken at one end. Where the measurement has no n + m lines, it is 6 widths long, and the cell is shorter by the
    missing lines, and by up to half an overlap more where the overlap then fits better. The direction with the larger
    mismatch is joined first; the second seam is closed over the first. Directions whose edges match as measured, with a
    mismatch of at most 0.05, and periodic surfaces are left unchanged.

    Parameters
    ----------
    surface : the measurement around the window, without invalid pixels.
    window : window of the cell.
    direction : "x" joins the edges x = 0 and x = nx dx, "y" those along y, "both" all, "none" none.
    width : width along x and y, m, above 0 and at most 1/24 of the window; ignored in a direction that is not joined.
    filled : mask of the points that were invalid and filled, shape of the surface.

    Returns
    -------
    joined : the periodic cell; periodic unless the direction is "none".
    window : the window that the cell covers, shorter than the one given where the measurement ends.

    Raises
    ------
    InputError
        If the width is out of range, a direction to join has fewer than 12 pixels, the window is not inside the
        surface, or pixels are invalid.

    References
    ----------
    A. A. Efros and W. T. Freeman, Image quilting for texture synthesis and transfer, SIGGRAPH 2001, section 2.1.
    """
    if surface.invalid.any():
        raise InputError(f"edges: {surface.invalid.sum()} pixels are invalid; fill them first")
    cut = cut_window(surface, window)
    mismatch = mismatches(cut)
    axes = () if cut.periodic else tuple(axis for axis in AXES[direction] if mismatch[axis] > SUFFICIENT_MISMATCH)
    overlap, first, start, shape = [0, 0], list(window.start), list(window.start), list(window.shape)
    for axis in axes:
        overlap[axis] = _overlap(width[axis] / surface.spacing[axis], shape[axis], surface.shape[axis], axis)
        across = window.slices[1 - axis]
        lines = surface.heights[:, across] if axis == 0 else surface.heights.T[:, across]
        first[axis], start[axis], shape[axis] = _placed(window.start[axis], window.shape[axis], lines, overlap[axis])
    region = tuple(slice(f, f + n + m) for f, n, m in zip(first, shape, overlap, strict=True))
    layers = np.stack([surface.heights[region], np.zeros_like(surface.heights[region]), filled[region]])
    seams = [np.zeros(0, dtype=int)] * 2
    for axis in sorted(axes, key=lambda one: -mismatch[one]):
        other = 1 - axis
        widths = width[axis] / surface.spacing[axis], width[axis] / surface.spacing[other]
        closed = layers.shape[1 + other] == shape[other]
        seam, lines = _best_joined(np.moveaxis(layers, 1 + axis, 1), overlap[axis], widths, closed=closed)
        layers = np.moveaxis(lines, 1, 1 + axis)
        seams[axis] = seam
        if seams[other].size:
            seams[other] = _cut_by(seams[other], seam, shape[axis])
    back = [f - s for f, s in zip(first, start, strict=True)]
    heights, weight, _ = np.roll(layers, back, axis=(1, 2))
    steps = surface.spacing
    x, y = (
        np.roll((seams[axis] + back[axis]) % shape[axis], back[1 - axis]) * steps[axis] if axis in axes else None
        for axis in (0, 1)
    )
    cell = Surface(heights=heights, spacing=steps, periodic=cut.periodic or direction != "none", source=surface.source)
    (i, j), (nx, ny) = start, shape
    return Joined(surface=cell, weight=weight, seams=(x, y)), Window(start=(i, j), shape=(nx, ny))


def largest_width(count: int) -> float:
    """The largest width, pixels, whose overlap is at most a third of ``count`` pixels.

    >>> largest_width(240)
    10.0
    """
    return count // MAX_OVERLAP_OF_SIDE / OVERLAP


def _overlap(width: float, count: int, most: int, axis: int) -> int:
    if count < MIN_OVERLAP * MAX_OVERLAP_OF_SIDE:
        least = MIN_OVERLAP * MAX_OVERLAP_OF_SIDE
        raise InputError(f"edges: got {count} pixels along {'xy'[axis]}; joining edges needs {least} and more")
    if not 0 < width <= largest_width(count) * (1 + 1e-12):
        raise InputError(
            f"edges: got a width of {width:.3g} pixels along {'xy'[axis]}; "
            f"give at most {largest_width(count):.4g} of the {count}"
        )
    long, short = (max(MIN_OVERLAP, math.ceil(part * width * (1 - 1e-12))) for part in (OVERLAP, SHORT_OVERLAP))
    return long if count + long <= most else short


def _placed(start: int, count: int, lines: Array, overlap: int) -> tuple[int, int, int]:
    """The first line of the region of cell and overlap, and start and number of lines of the cell."""
    most = len(lines)
    if count + overlap <= most:
        return min(max(start - overlap // 2, 0), most - count - overlap), start, count
    shorter = _best_count(lines, overlap)
    return 0, min(max(overlap // 2, start), start + count - shorter), shorter


def _best_count(lines: Array, overlap: int) -> int:
    """The number of lines n of the cell, at most N of them, that minimises ⟨(h₁ − h₂)²⟩ + 2 Sq² (1 − n/N)."""
    sample = lines[:, :: 1 + lines.shape[1] // MAX_COMPARED]
    most, variance = len(lines) - overlap, float(sample.var())

    def cost(count: int) -> float:
        apart = np.mean((sample[count : count + overlap] - sample[:overlap]) ** 2)
        return float(apart) + 2 * variance * (1 - count / most)

    return min(range(most, most - 1 - overlap // SEARCH, -1), key=cost)


def _best_joined(layers: Array, overlap: int, width: tuple[float, float], *, closed: bool) -> tuple[Array, Array]:
    """The seam on every line, and heights, weight and filled points without the last ``overlap`` lines.

    ``layers`` holds these three, shape (3, lines, places along the seam); the width is in pixels along both axes.
    """
    variance, found = float(layers[0].var()), {}
    for part in BLENDS:
        blend = part * width[0], part * width[1]
        seam, lines = found[part] = _joined(layers, overlap, blend, variance, closed=closed)
        if mismatch_across(lines[0], seam) <= 2 * variance * SUFFICIENT_MISMATCH:
            return seam, lines
    return found[USUAL_BLEND]


def _joined(
    layers: Array, overlap: int, blend: tuple[float, float], variance: float, *, closed: bool
) -> tuple[Array, Array]:
    count = layers.shape[1] - overlap
    front, behind = layers[:, count:], layers[:, :overlap]
    guard = int(TRUNCATION * blend[0] + 0.5)
    apart = (front[0] - behind[0]) ** 2 / variance
    kept = np.cumsum(front[2], axis=0)[:-1] + behind[2].sum(axis=0) - np.cumsum(behind[2], axis=0)[:-1]
    cost = (apart[1:] + apart[:-1]) / 2 + kept  # of a seam in front of line 1, 2 ...
    places = slice(max(guard, 1) - 1, overlap - max(guard, 1))
    seam = _cheapest_path(cost[places], closed=closed) + places.start + 1
    part = (np.arange(overlap)[:, None] >= seam).astype(float)
    part = scipy.ndimage.gaussian_filter1d(part, blend[0], axis=0, mode="nearest", truncate=TRUNCATION)
    around = "wrap" if closed else "nearest"
    part = scipy.ndimage.gaussian_filter1d(part, blend[1], axis=1, mode=around, truncate=TRUNCATION)
    whole, none = part > 1 - ROUNDING, part < ROUNDING
    mixed = np.where(whole, behind, np.where(none, front, front + part * (behind - front)))
    own = np.where(whole | none, 0.0, np.minimum(part, 1 - part))
    mixed[1] = 1 - (1 - mixed[1]) * (1 - own)
    return seam, np.concatenate([mixed, layers[:, overlap:count]], axis=1)


def _cheapest_path(cost: Array, *, closed: bool) -> Array:
    """The row on every column of the path of least cost that moves at most one row from column to column.

    A closed path returns to its first row: that on which the path of least cost over two periods enters the second one.
    """
    if not closed:
        return _path(cost)
    count = cost.shape[1]
    return _path(np.concatenate([cost, cost[:, :1]], axis=1), end=int(_path(np.tile(cost, 2))[count]))[:count]


def _path(cost: Array, end: int | None = None) -> Array:
    """The cheapest path, or that which starts and ends on the row ``end``."""
    rows, columns = cost.shape
    total = cost[:, 0].copy()
    if end is not None:
        total[np.arange(rows) != end] = np.inf
    moves = np.zeros((columns, rows), dtype=int)
    near = np.full(rows + 2, np.inf)
    for column in range(1, columns):
        near[1:-1] = total
        before = np.stack([near[1:-1], near[:-2], near[2:]])
        least = before.argmin(axis=0)
        moves[column] = least
        total = np.take_along_axis(before, least[None], axis=0)[0] + cost[:, column]
    path = np.empty(columns, dtype=int)
    path[-1] = np.argmin(total) if end is None else end
    for column in range(columns - 1, 0, -1):
        path[column - 1] = path[column] + (0, -1, 1)[moves[column, path[column]]]
    return path


def _cut_by(seam: Array, crossing: Array, count: int) -> Array:
    """A seam over n + m lines, of which a crossing one keeps n: in front of it those beyond the end."""
    beyond = seam[count:]
    here = np.arange(beyond.size) < crossing[beyond]
    return np.concatenate([np.where(here, beyond, seam[: beyond.size]), seam[beyond.size : count]])
