"""Where the columns of a mesh stand along a gap: close where its walls bend."""

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.pocket.gap import Gap

CORNER_DENSITY = 10.0
"""How many times denser the columns stand at a corner of the gap than far from one."""

BEND_DENSITY = 4.0
"""The same for the other breaks of the gap, where the slope is continuous."""

REACH = 1.0
"""How far from a break the columns stay dense, in film thicknesses: about as far as the flow feels it."""

NARROWEST = 1e-3
"""Corners nearer to each other than this, in film thicknesses, share one column: a sliver of land is none."""


def columns(gap: Gap, resolution: int) -> Array:
    """Positions of about ``resolution`` + 1 mesh columns over the period, in film thicknesses.

    With the distances s to the corners and b to the nearest other break, here and in the neighbouring periods, in
    REACH, the density is

        1 + (CORNER_DENSITY - 1) Σ 1 / (1 + s²) + (BEND_DENSITY - 1) / (1 + b²).

    Each piece between corners gets a whole number of cells, so that every corner is a column.
    """
    start, end = gap.breaks[0] / gap.film, gap.breaks[-1] / gap.film
    inner = np.array(gap.corners) / gap.film
    inner = inner[(inner - start > NARROWEST) & (np.diff(inner, append=end) > NARROWEST)]
    anchors = np.array([start, *inner, end])
    periods = np.array([-1.0, 0.0, 1.0]) * gap.length
    corners = np.add.outer(periods, gap.corners).ravel() / gap.film
    smooth = [place for place in gap.breaks[1:-1] if place not in gap.corners]
    bends = np.add.outer(periods, smooth).ravel() / gap.film

    def cells_up_to(x: Array) -> Array:
        at_corners = REACH * np.arctan((x[:, None] - corners) / REACH).sum(axis=1)
        at_bends = _to_the_nearest(bends, x) if smooth else np.zeros_like(x)
        return np.asarray(x + (CORNER_DENSITY - 1) * at_corners + (BEND_DENSITY - 1) * at_bends)

    ends = cells_up_to(anchors)
    counts = np.maximum(2, np.round(np.diff(ends) / (ends[-1] - ends[0]) * resolution, 6).round().astype(int))
    pieces = []
    for left, right, count in zip(anchors[:-1], anchors[1:], counts, strict=True):
        fine = np.linspace(left, right, 40 * count + 1)
        measure = cells_up_to(fine)
        pieces.append(np.interp(np.linspace(measure[0], measure[-1], count + 1), measure, fine)[:-1])
    return np.append(np.concatenate(pieces), anchors[-1])


def _to_the_nearest(places: Array, x: Array) -> Array:
    """The integral up to ``x`` of 1 / (1 + b²), with b the distance to the nearest of the places, in REACH."""
    nearest = np.searchsorted((places[1:] + places[:-1]) / 2, x)
    half_way = np.arctan(np.diff(places) / 2 / REACH)
    before = np.concatenate([[0.0], 2 * np.cumsum(half_way)])
    return np.asarray(REACH * (before[nearest] + np.arctan((x - places[nearest]) / REACH)))
