"""Where the columns of a mesh stand along a gap: close where the slope of the film jumps."""

import numpy as np

from rom.gap import Array, Gap

EDGE_DENSITY = 10.0
"""How many times denser the columns stand at a corner of the gap than far from one."""

EDGE_REACH = 1.0
"""How far from a corner the columns stay dense, in film thicknesses: about as far as the flow feels the corner."""


def columns(gap: Gap, resolution: int, *, density: float = EDGE_DENSITY, reach: float = EDGE_REACH) -> Array:
    """Positions of about ``resolution`` + 1 mesh columns over the period, in film thicknesses.

    The density is 1 + (c-1) Σ 1 / (1 + ((x - e)/r)²) over the corners e and those of the neighbouring periods, with
    c = ``density`` and r = ``reach``; each piece gets a whole number of cells, so that every break is a column.
    """
    breaks, period = np.array(gap.breaks) / gap.film, gap.length / gap.film
    corners = np.add.outer([-period, 0.0, period], np.array(gap.corners) / gap.film).ravel()

    def cells_up_to(x: Array) -> Array:
        bumps = np.arctan((x[:, None] - corners) / reach) * reach
        return np.asarray(x + (density - 1) * bumps.sum(axis=1))

    ends = cells_up_to(breaks)
    counts = np.maximum(2, np.round(np.diff(ends) / (ends[-1] - ends[0]) * resolution, 6).round().astype(int))
    pieces = []
    for left, right, count in zip(breaks[:-1], breaks[1:], counts, strict=True):
        fine = np.linspace(left, right, 40 * count + 1)
        measure = cells_up_to(fine)
        pieces.append(np.interp(np.linspace(measure[0], measure[-1], count + 1), measure, fine)[:-1])
    return np.append(np.concatenate(pieces), breaks[-1])
