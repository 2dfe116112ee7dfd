"""A film over a cell in plan on one grid and on coarser ones, with first-order inertia."""

from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.cavitation.evaluation.grids import grid_uncertainty
from roughfilm.rom.ladder.result import with_uncertainties
from roughfilm.rom.pocket.plan.grid import columns_across, plan_grid
from roughfilm.rom.pocket.plan.inertia import Change, inertia
from roughfilm.rom.pocket.plan.plan import Plan
from roughfilm.rom.pocket.plan.quantities import OnSlidingWall, plan_quantities
from roughfilm.rom.pocket.plan.reynolds import (
    Lines,
    PlanFilm,
    highest,
    lines_of,
    pressure_on,
    reverse_flow,
    shear_stress,
    solve_film,
)
from roughfilm.rom.pocket.scene import Pocket

GRIDS = 3
"""Number of grids of a solution, each with half of the columns of the one before."""

MIN_COLUMNS = 4
"""Smallest number of columns of a grid along and across."""

SAFETY_FACTOR = 4 / 3
"""Factor on the uncertainty by the grids, with which it contained at least 95 of 100 errors of random cells."""


@dataclass(frozen=True, kw_only=True)
class Level:
    """A film on one grid, its reverse flow over the sliding speed, and its change by inertia if it is computed."""

    film: PlanFilm
    lines: Lines
    backflow: float
    change: Change | None

    @property
    def residual(self) -> float:
        """The largest residual of the film and of its change."""
        return max(self.film.residual, 0.0 if self.change is None else self.change.residual)

    @property
    def columns(self) -> float:
        """The geometric mean of the numbers of columns along and across."""
        return float(np.sqrt(self.film.pressure.size))

    def change_of_pressure(self, reynolds_number: float) -> float | None:
        """The range of the change of pressure by inertia over that of the pressure; None without inertia."""
        if self.change is None:
            return None
        size = float(np.ptp(self.film.pressure))
        return reynolds_number * float(np.ptp(self.change.pressure)) / size if size > 0 else 0.0

    def on_wall(self, reynolds_number: float) -> OnSlidingWall:
        """Pressure and shear stress on the sliding wall, with inertia to first order in a Reynolds number."""
        pressure, stress = self.film.pressure, shear_stress(self.film)
        if self.change is not None:
            pressure = pressure + reynolds_number * self.change.pressure
            stress = stress + reynolds_number * self.change.shear_stress
        grid = self.film.grid
        stress = (stress + np.roll(stress, 1, axis=0)) / 2
        return OnSlidingWall(x=grid.x, y=grid.y, thickness=grid.thickness, pressure=pressure, shear_stress=stress)

    def pressure_range(self, reynolds_number: float) -> tuple[float, float]:
        """The least and the greatest pressure, with the zero of :meth:`on_wall`."""
        drive = self.lines.drive
        if self.change is not None:
            drive = drive + reynolds_number * self.change.drive
        pressure = pressure_on(self.lines, drive, self.on_wall(reynolds_number).pressure)
        return -highest(-pressure), highest(pressure)

    def quantities(self, scene: Pocket, reynolds_number: float) -> dict[str, Quantity]:
        """The quantities of a scene on this grid; the reverse flow is that without inertia."""
        return plan_quantities(
            scene,
            self.on_wall(reynolds_number),
            backflow=self.backflow,
            pressure_range=self.pressure_range(reynolds_number),
        )


def level_of(plan: Plan, counts: tuple[int, int], *, with_inertia: bool) -> Level:
    """The film on the grid with so many columns along and across."""
    film = solve_film(plan_grid(plan, counts))
    lines = lines_of(film.grid)
    change = inertia(film, lines) if with_inertia else None
    return Level(film=film, lines=lines, backflow=reverse_flow(film, lines), change=change)


def levels_of(plan: Plan, counts: tuple[int, int], *, with_inertia: bool) -> list[Level]:
    """The film on a grid and on coarser ones, the finest first."""
    levels: list[Level] = []
    while len(levels) < GRIDS and min(counts) >= MIN_COLUMNS:
        levels.append(level_of(plan, counts, with_inertia=with_inertia))
        counts = counts[0] // 2, counts[1] // 2
    return levels


def quantities_of(levels: list[Level], scene: Pocket, reynolds_number: float) -> dict[str, Quantity]:
    """The quantities of the finest level, with an uncertainty from the coarser ones if there are any.

    Film and change by inertia have errors of their own, which add up.
    """
    found = [level.quantities(scene, reynolds_number) for level in levels]
    if len(levels) == 1:
        return found[0]
    columns = [level.columns for level in levels]
    of_film = [level.quantities(scene, 0.0) for level in levels] if reynolds_number else found
    uncertainties = {}
    for name in found[0]:
        still = [one[name].value for one in of_film]
        change = [one[name].value - value for one, value in zip(found, still, strict=True)]
        uncertainties[name] = SAFETY_FACTOR * sum(grid_uncertainty(columns, values) for values in (still, change))
    return with_uncertainties(found[0], uncertainties)


def load_over_pressure(scene: Pocket, columns: int) -> float:
    """The magnitude of the load over the largest pressure to first order in Re, by so many columns along the cell.

    It is 0 if all dimples lie between the places of the grid.
    """
    plan, number = scene.plan(), scene.reynolds_number
    level = level_of(plan, (columns, columns_across(plan, columns)), with_inertia=True)
    wall = level.on_wall(number)
    largest = max(abs(one - wall.edge_mean) for one in level.pressure_range(number))
    return abs(wall.mean(wall.pressure) - wall.edge_mean) / largest if largest > 0 else 0.0
