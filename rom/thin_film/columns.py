"""Positions of mesh columns along a gap, denser where its walls bend."""

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.thin_film.gap import Gap

CORNER_DENSITY = 10.0
"""Density of columns at a corner of the gap over that far from one."""

BEND_DENSITY = 4.0
"""Density of columns at the other breaks of the gap, where the slope is continuous, over that far from one."""

DENSITY_DECAY_LENGTH = 1.0
"""Decay length of the density beside a break, in film thicknesses: about the decay length of the flow."""

MIN_CORNER_DISTANCE = 1e-3
"""Distance in film thicknesses below which two corners share one column."""

SHARED_CELLS = 1.0
"""Number of cells between two corners below which they share one column."""

MIN_CELLS = 2
"""Smallest number of cells between two columns at corners."""


def columns(gap: Gap, resolution: int, *, corner_density: float = CORNER_DENSITY) -> Array:
    """The positions of about ``resolution`` + 1 mesh columns over the period, in film thicknesses.

    The density of columns is

        1 + (corner_density - 1) Σ w / (1 + s²) + (BEND_DENSITY - 1) / (1 + b²)

    with the distances s to the corners and b to the nearest other break, in this period and its neighbours, in units of
    DENSITY_DECAY_LENGTH. The weight w of a corner is 1, or less where the next corners are near, so that rows of them
    have at most ``corner_density``. Each piece between corners has a whole number of cells, so that every corner is a
    column, except where corners are so near that less than a cell would lie between them.
    """
    start, end = gap.breaks[0] / gap.film, gap.breaks[-1] / gap.film
    periods = np.array([-1.0, 0.0, 1.0]) * gap.length
    corners = np.add.outer(periods, gap.corners).ravel() / gap.film
    weights = np.tile(_weights(np.array(gap.corners) / gap.film, end - start), periods.size)
    smooth = [place for place in gap.breaks[1:-1] if place not in gap.corners]
    bends = np.add.outer(periods, smooth).ravel() / gap.film

    def cells_up_to(x: Array) -> Array:
        at_corners = DENSITY_DECAY_LENGTH * np.arctan((x[:, None] - corners) / DENSITY_DECAY_LENGTH) @ weights
        at_bends = _nearest_integral(bends, x) if smooth else np.zeros_like(x)
        return np.asarray(x + (corner_density - 1) * at_corners + (BEND_DENSITY - 1) * at_bends)

    anchors = np.array([start, *(place for place in np.array(gap.corners) / gap.film if start < place < end), end])
    measures = cells_up_to(anchors)
    measures *= resolution / (measures[-1] - measures[0])
    kept = _apart(anchors, measures)
    anchors, measures = anchors[kept], measures[kept]
    counts = np.maximum(MIN_CELLS, np.round(np.diff(measures), 6).round().astype(int))
    pieces = []
    for left, right, count in zip(anchors[:-1], anchors[1:], counts, strict=True):
        fine = np.linspace(left, right, 40 * count + 1)
        measure = cells_up_to(fine)
        pieces.append(np.interp(np.linspace(measure[0], measure[-1], count + 1), measure, fine)[:-1])
    return np.append(np.concatenate(pieces), anchors[-1])


def _weights(corners: Array, period: float) -> Array:
    """The weights of increasing corners: half the distance of the two beside one over π decay lengths, at most 1.

    The sum Σ w / (1 + s²) of a row of corners at a distance a < π decay lengths is a/π · π/a = 1.
    """
    around = np.concatenate([corners[-1:] - period, corners, corners[:1] + period])
    return np.asarray(np.minimum((around[2:] - around[:-2]) / 2 / (np.pi * DENSITY_DECAY_LENGTH), 1.0))


def _apart(anchors: Array, measures: Array) -> list[int]:
    """The indices of the anchors at least ``SHARED_CELLS`` apart, the first and the last among them."""
    kept = [0]
    last = anchors.size - 1
    for number in range(1, last):
        behind, ahead = (abs(anchors[number] - anchors[other]) for other in (kept[-1], last))
        cells = measures[number] - measures[kept[-1]], measures[last] - measures[number]
        if min(behind, ahead) > MIN_CORNER_DISTANCE and min(cells) >= SHARED_CELLS:
            kept.append(number)
    return [*kept, last]


def _nearest_integral(places: Array, x: Array) -> Array:
    """The integral up to ``x`` of 1 / (1 + b²), b the distance to the nearest place over DENSITY_DECAY_LENGTH."""
    nearest = np.searchsorted((places[1:] + places[:-1]) / 2, x)
    half_way = np.arctan(np.diff(places) / 2 / DENSITY_DECAY_LENGTH)
    before = np.concatenate([[0.0], 2 * np.cumsum(half_way)])
    beside = np.arctan((x - places[nearest]) / DENSITY_DECAY_LENGTH)
    return np.asarray(DENSITY_DECAY_LENGTH * (before[nearest] + beside))
