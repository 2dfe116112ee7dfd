"""A film over a cell in plan on one grid and on coarser ones, with first-order inertia."""

import numpy as np

from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.pocket.plan.grid import columns_across, plan_grid
from roughfilm.rom.pocket.plan.inertia import inertia
from roughfilm.rom.pocket.plan.plan import Plan
from roughfilm.rom.pocket.plan.quantities import OnSlidingWall, plan_quantities
from roughfilm.rom.pocket.plan.reynolds import highest, lines_of, pressure_on, reverse_flow, shear_stress, solve_film
from roughfilm.rom.pocket.scene import Pocket

GRIDS = 3
"""Number of grids of a solution, each with half of the columns of the one before."""

MIN_COLUMNS = 4
"""Smallest number of columns of a grid along and across."""


class Level:
    """A film on one grid, with first-order inertia at a Reynolds number, 0 for none."""

    def __init__(self, plan: Plan, counts: tuple[int, int], reynolds_number: float) -> None:
        self.counts = counts
        film = solve_film(plan_grid(plan, counts))
        lines = lines_of(film.grid)
        pressure, drive, stress, residual = film.pressure, lines.drive, shear_stress(film), film.residual
        if reynolds_number:
            change = inertia(film, lines)
            pressure = pressure + reynolds_number * change.pressure
            drive = drive + reynolds_number * change.drive
            stress = stress + reynolds_number * change.shear_stress
            residual = max(residual, change.residual)
        self.film, self.residual = film, residual
        self.wall = OnSlidingWall(
            x=film.grid.x,
            y=film.grid.y,
            thickness=film.grid.thickness,
            pressure=pressure,
            shear_stress=(stress + np.roll(stress, 1, axis=0)) / 2,
        )
        on_lines = pressure_on(lines, drive, pressure)
        self.range = (-highest(-on_lines), highest(on_lines))
        self.backflow = reverse_flow(film, lines)

    def quantities(self, scene: Pocket) -> dict[str, Quantity]:
        """The quantities of a scene on this grid."""
        return plan_quantities(scene, self.wall, backflow=self.backflow, pressure_range=self.range)


def levels_of(plan: Plan, counts: tuple[int, int], reynolds_number: float) -> list[Level]:
    """The film on a grid and on coarser ones, the finest first."""
    levels = []
    while len(levels) < GRIDS and min(counts) >= MIN_COLUMNS:
        levels.append(Level(plan, counts, reynolds_number))
        counts = counts[0] // 2, counts[1] // 2
    return levels


def load_over_pressure(scene: Pocket, columns: int) -> float:
    """The magnitude of the load over the largest pressure to first order in Re, by so many columns along the cell."""
    plan = scene.plan()
    level = Level(plan, (columns, columns_across(plan, columns)), scene.reynolds_number)
    zero = level.wall.edge_mean
    return abs(level.wall.mean(level.wall.pressure) - zero) / max(abs(one - zero) for one in level.range)
