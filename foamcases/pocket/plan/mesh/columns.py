"""Positions of the columns of a cell in plan along each side, denser over dimples and at their outlines."""

from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.pocket.plan.plan import Plan

DIMPLE_DENSITY = 3.0
"""Density of columns over a dimple over that far from one."""

OUTLINE_DENSITY = 6.0
"""Density of columns where an outline begins or ends over that far from one."""

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

        1 + (DIMPLE_DENSITY - 1) / (1 + s²) + (OUTLINE_DENSITY - DIMPLE_DENSITY) / (1 + b²)

    with the distances s to the nearest place with a dimple beside it and b to the nearest break of the plan, in film
    thicknesses. If the plan is mirrored, the number of columns across is even, and they are symmetric about y = 0.

    Parameters
    ----------
    plan : the gap over the cell.
    resolution : number of columns along x.
    """
    along, across = ((np.arange(SAMPLES) + 0.5) / SAMPLES - 0.5 for _ in range(2))
    thickness = plan.thickness(along[:, None] * plan.length, across[None] * plan.breadth)
    dimpled = np.abs(thickness / plan.film - 1) > SAME_THICKNESS
    rows = max(MIN_COLUMNS, round(resolution * plan.breadth / plan.length))
    if plan.mirrored:
        rows = 2 * round(rows / 2)
    x = _faces(plan.length, plan.breaks_x, along[dimpled.any(axis=1)], resolution, plan.film)
    y = _faces(plan.breadth, plan.breaks_y, across[dimpled.any(axis=0)], rows, plan.film)
    return Sides(x=x, y=(y - y[::-1]) / 2 if plan.mirrored else y)


def _faces(length: float, breaks: tuple[float, ...], dimpled: Array, count: int, film: float) -> Array:
    """The positions of ``count`` + 1 faces from -length/2 to length/2, in film thicknesses."""
    period = length / film
    table = np.linspace(-period / 2, period / 2, TABLE)
    near = _distance(table, dimpled * period, period)
    outline = _distance(table, np.array(breaks) / film, period)
    density = (
        1
        + (DIMPLE_DENSITY - 1) / (1 + np.maximum(near - period / SAMPLES, 0) ** 2)
        + (OUTLINE_DENSITY - DIMPLE_DENSITY) / (1 + outline**2)
    )
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
