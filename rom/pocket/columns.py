"""Positions of mesh columns along a gap, denser where its walls bend."""

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.pocket.gap import Gap

CORNER_DENSITY = 10.0
"""Density of columns at a corner of the gap over that far from one."""

BEND_DENSITY = 4.0
"""Density of columns at the other breaks of the gap, where the slope is continuous, over that far from one."""

DENSITY_DECAY_LENGTH = 1.0
"""Decay length of the density beside a break, in film thicknesses: about the decay length of the flow."""

MIN_CORNER_DISTANCE = 1e-3
"""Distance in film thicknesses below which two corners share one column."""


def columns(gap: Gap, resolution: int) -> Array:
    """The positions of about ``resolution`` + 1 mesh columns over the period, in film thicknesses.

    The density of columns is

        1 + (CORNER_DENSITY - 1) Σ 1 / (1 + s²) + (BEND_DENSITY - 1) / (1 + b²)

    with the distances s to the corners and b to the nearest other break, in this period and its neighbours, in units of
    DENSITY_DECAY_LENGTH. Each piece between corners has a whole number of cells, so that every corner is a column.
    """
    start, end = gap.breaks[0] / gap.film, gap.breaks[-1] / gap.film
    inner = np.array(gap.corners) / gap.film
    inner = inner[(inner - start > MIN_CORNER_DISTANCE) & (np.diff(inner, append=end) > MIN_CORNER_DISTANCE)]
    anchors = np.array([start, *inner, end])
    periods = np.array([-1.0, 0.0, 1.0]) * gap.length
    corners = np.add.outer(periods, gap.corners).ravel() / gap.film
    smooth = [place for place in gap.breaks[1:-1] if place not in gap.corners]
    bends = np.add.outer(periods, smooth).ravel() / gap.film

    def cells_up_to(x: Array) -> Array:
        at_corners = DENSITY_DECAY_LENGTH * np.arctan((x[:, None] - corners) / DENSITY_DECAY_LENGTH).sum(axis=1)
        at_bends = _nearest_integral(bends, x) if smooth else np.zeros_like(x)
        return np.asarray(x + (CORNER_DENSITY - 1) * at_corners + (BEND_DENSITY - 1) * at_bends)

    ends = cells_up_to(anchors)
    counts = np.maximum(2, np.round(np.diff(ends) / (ends[-1] - ends[0]) * resolution, 6).round().astype(int))
    pieces = []
    for left, right, count in zip(anchors[:-1], anchors[1:], counts, strict=True):
        fine = np.linspace(left, right, 40 * count + 1)
        measure = cells_up_to(fine)
        pieces.append(np.interp(np.linspace(measure[0], measure[-1], count + 1), measure, fine)[:-1])
    return np.append(np.concatenate(pieces), anchors[-1])


def _nearest_integral(places: Array, x: Array) -> Array:
    """The integral up to ``x`` of 1 / (1 + b²), b the distance to the nearest place over DENSITY_DECAY_LENGTH."""
    nearest = np.searchsorted((places[1:] + places[:-1]) / 2, x)
    half_way = np.arctan(np.diff(places) / 2 / DENSITY_DECAY_LENGTH)
    before = np.concatenate([[0.0], 2 * np.cumsum(half_way)])
    beside = np.arctan((x - places[nearest]) / DENSITY_DECAY_LENGTH)
    return np.asarray(DENSITY_DECAY_LENGTH * (before[nearest] + beside))
