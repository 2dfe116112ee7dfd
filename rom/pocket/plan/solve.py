"""The models of the Reynolds equation over a cell in plan: their quantities with uncertainties from coarser grids."""

import time

import numpy as np

from roughfilm.contact.foundation.errors import ConvergenceError, Outcome
from roughfilm.contact.foundation.timing import working_time
from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.cavitation.evaluation.grids import grid_uncertainty
from roughfilm.rom.ladder.model import Effect, Model, Progress
from roughfilm.rom.ladder.provenance import provenance
from roughfilm.rom.ladder.request import CheckedRequest
from roughfilm.rom.ladder.result import NO_COARSER_GRID, Numerics, Result, with_uncertainties
from roughfilm.rom.pocket.plan.grid import columns_across, plan_grid
from roughfilm.rom.pocket.plan.inertia import inertia
from roughfilm.rom.pocket.plan.plan import Plan
from roughfilm.rom.pocket.plan.quantities import OnSlidingWall, plan_fields, plan_quantities
from roughfilm.rom.pocket.plan.reynolds import highest, lines_of, pressure_on, reverse_flow, shear_stress, solve_film
from roughfilm.rom.pocket.scene import Pocket
from roughfilm.rom.pocket.validity.promise import promise_warnings
from roughfilm.rom.pocket.validity.warnings import cautions, ruptures

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


def uncertainties(levels: list[Level], scene: Pocket) -> dict[str, float]:
    """The uncertainty of each quantity of the finest level from the coarser ones; empty without any."""
    if len(levels) == 1:
        return {}
    found = [level.quantities(scene) for level in levels]
    cells = [float(np.sqrt(np.prod(level.counts))) for level in levels]
    return {name: grid_uncertainty(cells, [one[name].value for one in found]) for name in found[0]}


def solve(solver: Model[Pocket], scene: Pocket, request: CheckedRequest, progress: Progress) -> Result:
    """Solve ∇·(h³/12 ∇p) = 1/2 ∂h/∂x over a periodic cell, plus first-order inertia if the model has it.

    Lengths are in film thicknesses and pressures in η u / film. The error is of second order in the size of a column;
    the uncertainty of each quantity follows from its values on grids with a half and a quarter of the columns.

    Raises
    ------
    InputError
        If the cell is so broad that the resolution needs too many columns.
    ConvergenceError
        If the residual exceeds the tolerance.
    """
    wall, cpu = time.perf_counter(), working_time()
    plan = scene.plan()
    counts = request.resolution, columns_across(plan, request.resolution)
    progress(0.0, f"{counts[0]} x {counts[1]} columns")
    levels = levels_of(plan, counts, scene.reynolds_number if Effect.INERTIA in solver.keeps else 0.0)
    finest = levels[0]
    if not finest.residual <= request.tolerance:
        raise ConvergenceError(
            f"{solver.name}: residual {finest.residual:.1e} on {counts[0]} x {counts[1]} columns misses the tolerance "
            f"{request.tolerance:.1e}; loosen the tolerance or make the dimples shallower",
            outcome=Outcome.STALLED,
        )
    found = finest.quantities(scene)
    own = uncertainties(levels, scene)
    return Result(
        model=solver.name,
        quantities=with_uncertainties(found, own),
        fields=plan_fields(scene, finest.wall),
        provenance=provenance(scene, model=solver.name, keeps=tuple(solver.keeps), sources=solver.sources),
        numerics=Numerics(
            residual=finest.residual,
            iterations=finest.film.iterations,
            cpu_s=working_time() - cpu,
            wall_s=time.perf_counter() - wall,
            degrees_of_freedom=finest.wall.pressure.size,
            resolution=request.resolution,
            tolerance=request.tolerance,
            scheme=request.scheme,
        ),
        warnings=(
            *cautions(scene),
            *promise_warnings(scene, solver.name),
            *ruptures(scene, finest.range[0] - finest.wall.edge_mean),
            *([] if own else [NO_COARSER_GRID]),
        ),
    )
