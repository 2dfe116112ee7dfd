"""The grid of columns over a cell in plan."""

from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.pocket.plan.plan import Plan

MIN_ACROSS = 4
"""Smallest number of columns across the cell."""


@dataclass(frozen=True, kw_only=True)
class PlanGrid:
    """Equal rectangular columns over a cell, in film thicknesses.

    Attributes
    ----------
    x, y : positions of the faces between the columns, shapes (nx + 1,) and (ny + 1,).
    thickness : film thickness at the middles of the columns, shape (nx, ny).
    east, north : film thickness at the middles of the faces towards greater x and y, shape (nx, ny).
    """

    x: Array
    y: Array
    thickness: Array
    east: Array
    north: Array

    @property
    def steps(self) -> tuple[float, float]:
        """Lengths of a column along and across."""
        return float(self.x[1] - self.x[0]), float(self.y[1] - self.y[0])


def columns_across(plan: Plan, resolution: int) -> int:
    """The number of columns across a cell with ``resolution`` columns along it: as many per length."""
    return max(MIN_ACROSS, round(resolution * plan.breadth / plan.length))


def plan_grid(plan: Plan, resolution: int) -> PlanGrid:
    """The grid with ``resolution`` columns along the cell, and as many across per length."""
    across = columns_across(plan, resolution)
    x = np.linspace(-plan.length / 2, plan.length / 2, resolution + 1)
    y = np.linspace(-plan.breadth / 2, plan.breadth / 2, across + 1)
    middle_x, middle_y = (x[1:] + x[:-1])[:, None] / 2, (y[1:] + y[:-1]) / 2
    return PlanGrid(
        x=x / plan.film,
        y=y / plan.film,
        thickness=plan.thickness(middle_x, middle_y) / plan.film,
        east=plan.thickness(x[1:, None], middle_y) / plan.film,
        north=plan.thickness(middle_x, y[1:]) / plan.film,
    )
