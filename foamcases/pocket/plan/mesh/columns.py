"""Positions of the columns of a cell in plan along each side, denser over dimples and at corners of their walls."""

from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.pocket.plan.plan import Plan

DIMPLE_DENSITY = 3.0
"""Density of columns over a dimple over that far from one."""

CORNER_DENSITY = 8.0
"""Density of columns at the break with the sharpest corner over that far from dimples."""

CORNER_STEP = 0.02
"""Distance over which the slope on both sides of a break is measured, in film thicknesses."""

SAMPLES = 400
"""Number of places along each side at which the film is compared with that outside of dimples."""

TABLE = 20_001
"""Number of places at which the density is tabulated."""

SAME_THICKNESS = 1e-9
"""Relative difference of film thicknesses below which they count as equal."""

MIN_COLUMNS = 4
"""Least number of columns along a side."""


@dataclass(frozen=True, kw_only=True)
class Sides:
    """The positions of the columns' faces on the sliding wall along x and y, in film thicknesses."""

    x: Array
    y: Array


def sides_of(plan: Plan, resolution: int) -> Sides:
    """The faces of ``resolution`` columns along x and as many per length along y, over one period.

    The density of columns along a side is

        1 + (DIMPLE_DENSITY - 1) / (1 + s²) + (CORNER_DENSITY - DIMPLE_DENSITY) max w / (1 + b²)

    with the distances s to the nearest place with a dimple beside it and b to a break of the plan, in film thicknesses.
    The weight w of a break is the largest jump of slope there, over that at the other breaks of the side. If the plan
    is mirrored, the number of columns across is even, and they are symmetric about y = 0.

    Parameters
    ----------
    plan : the gap over the cell.
    resolution : number of columns along x.
    """
    along, across = (_middles(side) for side in (plan.length, plan.breadth))
    dimpled = np.abs(plan.thickness(along[:, None], across) / plan.film - 1) > SAME_THICKNESS
    rows = max(MIN_COLUMNS, round(resolution * plan.breadth / plan.length))
    if plan.mirrored:
        rows = 2 * round(rows / 2)

    def corners(breaks: tuple[float, ...], *, turned: bool) -> Array:
        """The jumps of slope at the breaks of a side."""
        step = CORNER_STEP * plan.film
        places = np.array(breaks)[:, None] + [-step, 0.0, step]
        other = (along if turned else across)[:, None, None]
        before, at, after = np.moveaxis(plan.thickness(*((other, places) if turned else (places, other))), -1, 0)
        return np.asarray(np.abs(after - 2 * at + before).max(axis=0, initial=0.0) / step)

    x = _faces(
        plan, plan.length, along[dimpled.any(axis=1)], plan.breaks_x, corners(plan.breaks_x, turned=False), resolution
    )
    y = _faces(
        plan, plan.breadth, across[dimpled.any(axis=0)], plan.breaks_y, corners(plan.breaks_y, turned=True), rows
    )
    return Sides(x=x, y=(y - y[::-1]) / 2 if plan.mirrored else y)


def _middles(side: float) -> Array:
    """Places along a side, m, at which the film is compared with that outside of dimples."""
    return ((np.arange(SAMPLES) + 0.5) / SAMPLES - 0.5) * side


def _faces(plan: Plan, side: float, dimpled: Array, breaks: tuple[float, ...], corners: Array, count: int) -> Array:
    """The positions of ``count`` + 1 faces along a side, in film thicknesses.

    ``dimpled`` are places with a dimple beside them, and ``corners`` the jumps of slope at ``breaks``.
    """
    period = side / plan.film
    table = np.linspace(-period / 2, period / 2, TABLE)
    near = np.maximum(_distance(table, dimpled / plan.film, period) - period / SAMPLES, 0)
    bent = np.zeros(TABLE)
    for place, corner in zip(breaks, corners, strict=True):
        distance = _distance(table, np.array([place]) / plan.film, period)
        bent = np.maximum(bent, corner / max(corners.max(), SAME_THICKNESS) / (1 + distance**2))
    density = 1 + (DIMPLE_DENSITY - 1) / (1 + near**2) + (CORNER_DENSITY - DIMPLE_DENSITY) * bent
    total = np.concatenate([[0.0], np.cumsum(density[1:] + density[:-1])])
    faces = np.interp(np.linspace(0, total[-1], count + 1), total, table)
    faces[[0, -1]] = -period / 2, period / 2
    return faces


def _distance(table: Array, places: Array, period: float) -> Array:
    """The distance to the nearest of places in this period and its neighbours; infinite if there are none."""
    if not places.size:
        return np.full(table.shape, np.inf)
    around = np.unique(np.add.outer([-period, 0.0, period], places))
    after = np.clip(np.searchsorted(around, table), 1, around.size - 1)
    return np.asarray(np.minimum(np.abs(table - around[after - 1]), np.abs(table - around[after])))
