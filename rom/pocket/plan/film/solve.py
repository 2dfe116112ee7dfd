"""The thin film over a cell in plan as a result."""

import time
from dataclasses import dataclass, replace

import numpy as np

from roughfilm.contact.foundation.errors import ConvergenceError, Outcome
from roughfilm.contact.foundation.timing import working_time
from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.cavitation.evaluation.grids import MAX_GRID_RATIO
from roughfilm.rom.ladder.model import Effect, Model, Progress, silent
from roughfilm.rom.ladder.provenance import provenance
from roughfilm.rom.ladder.request import CheckedRequest
from roughfilm.rom.ladder.result import NO_COARSER_GRID, Numerics, Result, with_uncertainties
from roughfilm.rom.pocket.model import SCHEMES
from roughfilm.rom.pocket.plan.bounds import Correction, of_slope
from roughfilm.rom.pocket.plan.film import newton, slope
from roughfilm.rom.pocket.plan.film.equations import Film, SheetFlow
from roughfilm.rom.pocket.plan.film.sheet import Sheet, sheet
from roughfilm.rom.pocket.plan.grid import require_resolved
from roughfilm.rom.pocket.plan.quantities import EXTREMES, OnSlidingWall, plan_fields, plan_quantities
from roughfilm.rom.pocket.plan.refinement import refinement_uncertainty
from roughfilm.rom.pocket.scene import Pocket
from roughfilm.rom.pocket.validity.bounds import bounded
from roughfilm.rom.pocket.validity.promise import promise_warnings
from roughfilm.rom.pocket.validity.warnings import ruptures, steep_warnings
from roughfilm.rom.thin_film.basis import even_basis, gauss_basis, sliding_wall_slope
from roughfilm.rom.thin_film.continuation import continued
from roughfilm.rom.thin_film.newton import mode_warnings

MODES = 8
"""Polynomials across the film."""

BACKFLOW_LAYERS = 60
"""Number of layers across the film among which the back-flow is sought."""

COARSER_GRIDS = 2
"""Number of coarser grids from which the uncertainty follows, each with half of the columns of the one before."""

MIN_COARSE = 12
"""Smallest number of columns along the cell of a coarser grid."""

COARSE_TOLERANCE = 1e-8
"""Smallest tolerance of the residual on a coarser grid."""

MAX_KNOWN_RESIDUAL = 1e-7
"""Residual above which the error of the iteration may exceed that of the grid, so that no uncertainty is known.

At a residual of 5e-4 the load over a spherical cap was wrong by 12 %.
"""

MAX_TOTAL_PRODUCTS = 3600
"""Number of products with the matrices of the linear systems after which the continuation in Re stops.

Most random cells need 50 to 800, and the hardest ones that converge need 2400.
"""

RESPONSE_TOLERANCE = 1e-6
"""Tolerance of the linear response to the slope, relative to the neglected force."""

LOOSE = "the residual is above {:g}, so that the error is unknown; take that as the tolerance"
"""The warning of a film that is not converged enough for an uncertainty."""


@dataclass(frozen=True, kw_only=True)
class PlanFilm:
    """A solution of the thin-film equations over a cell in plan, with its residual and number of Newton steps.

    ``other`` is the flow without slope of a solution with it, and with slope of one without; None if it is not known.
    """

    sheet: Sheet
    flow: SheetFlow
    residual: float
    steps: int
    other: SheetFlow | None


def solve_sheet(
    grid: Sheet,
    reynolds_number: float,
    *,
    tolerance: float,
    with_slope: bool,
    measure_slope: bool = False,
    progress: Progress = silent,
) -> PlanFilm:
    """Solve the thin-film equations on a grid, with slope to second order if asked for.

    A film without slope has the flow with it too if its error is measured by that.

    Raises
    ------
    ConvergenceError
        If Newton's method does not converge to the tolerance or needs too many products with its matrices, or the
        response to the slope is not found.
    """
    basis, spent = gauss_basis(MODES), 0

    def attempt(at: float, begin: SheetFlow) -> tuple[SheetFlow, newton.LinearFilm | None, int]:
        nonlocal spent
        flow, linear, steps, products = newton.attempt(grid, basis, at, begin, tolerance)
        spent += products
        if spent > MAX_TOTAL_PRODUCTS and (linear is None or at < reynolds_number):
            raise ConvergenceError(
                f"the film equations did not converge to a steady flow at Re = {reynolds_number:.4g} in {spent} "
                f"iterations of the linear solver (last attempt: Re = {at:.4g}); take navier_stokes, a coarser "
                "resolution or shallower dimples",
                outcome=Outcome.UNFINISHED,
            )
        return flow, linear, steps

    with np.errstate(all="ignore"):
        flow, linear, steps = continued(
            attempt,
            Film(sheet=grid, basis=basis, reynolds_number=0.0).still(),
            reynolds_number,
            progress,
            shallower="shallower dimples",
        )
        sloped = None
        if with_slope or measure_slope:
            force = slope.imbalance(linear.film, flow, linear.velocities)
            change, _ = linear.response(force, tolerance=RESPONSE_TOLERANCE)
            if change is not None:
                sloped = SheetFlow(flat=flow.flat + change.flat, shape=flow.shape)
            elif with_slope:
                raise ConvergenceError("the slope correction did not converge; take film or navier_stokes")
    own, other = (sloped, flow) if with_slope and sloped is not None else (flow, sloped)
    return PlanFilm(sheet=grid, flow=own, residual=linear.residual, steps=steps, other=other)


def on_sliding_wall(film: PlanFilm) -> OnSlidingWall:
    """The pressure and shear stress on the sliding wall over the rectangles between the nodes."""
    grid, pressure = film.sheet, film.flow.pressure
    shear = (1 + film.flow.along @ sliding_wall_slope(film.flow.modes)) / grid.thickness[0]
    ahead = (pressure + np.roll(pressure, -1, axis=0)) / 2
    return OnSlidingWall(
        x=grid.x,
        y=grid.y,
        thickness=grid.thickness[3],
        pressure=(ahead + np.roll(ahead, -1, axis=1)) / 2,
        shear_stress=(shear + np.roll(shear, -1, axis=1)) / 2,
        on_edge=(pressure[0] + np.roll(pressure[0], -1)) / 2,
        at_corner=float(pressure[0, 0]),
    )


def _slowest(flow: SheetFlow) -> float:
    """The least velocity along the sliding direction."""
    basis = even_basis(flow.modes, BACKFLOW_LAYERS)
    return float(min((basis.nodes + row @ basis.shape).min() for row in flow.along))


def coarser(
    scene: Pocket, film: PlanFilm, resolution: int, *, tolerance: float, second_order: bool, with_slope: bool
) -> list[PlanFilm]:
    """The film on grids with a half and a quarter of the cells, as far as they exist and have a solution."""
    films: list[PlanFilm] = []
    while len(films) < COARSER_GRIDS and (resolution := resolution // 2) >= MIN_COARSE:
        grid = sheet(scene.plan(), resolution, second_order=second_order)
        if np.prod(grid.shape) > MAX_GRID_RATIO**2 * np.prod((films[-1] if films else film).sheet.shape):
            break
        try:
            films.append(solve_sheet(grid, scene.reynolds_number, tolerance=tolerance, with_slope=with_slope))
        except ConvergenceError:
            break
    return films


def _quantities(scene: Pocket, film: PlanFilm) -> dict[str, Quantity]:
    pressure = film.flow.pressure
    return plan_quantities(
        scene,
        on_sliding_wall(film),
        backflow=max(0.0, -_slowest(film.flow)),
        pressure_range=(float(pressure.min()), float(pressure.max())),
    )


def solve(solver: Model[Pocket], scene: Pocket, request: CheckedRequest, progress: Progress) -> Result:
    """Solve the thin-film Navier-Stokes equations over a periodic cell, with slope if the model keeps it.

    The error is of second order in the cell size (of first order with the scheme ``upwind``); the uncertainty of each
    quantity follows from its values on grids with a half and a quarter of the columns.

    Raises
    ------
    InputError
        If the cell is so broad that the resolution needs too many columns, or a dimple is narrower than a column.
    ConvergenceError
        If Newton's method does not converge to the tolerance.
    """
    wall, cpu = time.perf_counter(), working_time()
    second_order, with_slope = request.scheme == SCHEMES[0], Effect.SLOPE in solver.keeps
    require_resolved(scene, request.resolution)
    film = solve_sheet(
        sheet(scene.plan(), request.resolution, second_order=second_order),
        scene.reynolds_number,
        tolerance=request.tolerance,
        with_slope=with_slope,
        measure_slope=bool(bounded(scene, solver)),
        progress=progress,
    )
    films = [film]
    films += coarser(
        scene,
        film,
        request.resolution,
        tolerance=max(request.tolerance, COARSE_TOLERANCE),
        second_order=second_order,
        with_slope=with_slope,
    )
    values, uncertainties = [_quantities(scene, one) for one in films], {}
    loose = max(one.residual for one in films) > MAX_KNOWN_RESIDUAL
    if len(films) > 1 and not loose:
        cells = [float(np.sqrt(np.prod(one.sheet.shape))) for one in films]
        uncertainties = {
            name: refinement_uncertainty(cells, [one[name].value for one in values], order=2.0 if second_order else 1.0)
            for name in values[0]
        }
    bounds = {}
    if uncertainties and bounded(scene, solver) and film.other is not None:
        solutions = (film, replace(film, flow=film.other))
        made = Correction.between(scene, *((_quantities(scene, one), on_sliding_wall(one)) for one in solutions))
        largest = max(abs(values[0][name].value) for name in EXTREMES)
        bounds = of_slope(scene, made, uncertainties, largest=largest, kept=with_slope)
    on_wall = on_sliding_wall(film)
    return Result(
        model=solver.name,
        quantities=with_uncertainties(values[0], uncertainties),
        fields=plan_fields(scene, on_wall),
        provenance=provenance(scene, model=solver.name, keeps=tuple(solver.keeps), sources=solver.sources),
        numerics=Numerics(
            residual=film.residual,
            iterations=film.steps,
            cpu_s=working_time() - cpu,
            wall_s=time.perf_counter() - wall,
            degrees_of_freedom=film.flow.flat.size,
            resolution=request.resolution,
            tolerance=request.tolerance,
            scheme=request.scheme,
            details=bounds,
        ),
        warnings=(
            *promise_warnings(scene, solver.name),
            *steep_warnings(scene),
            *mode_warnings(film.flow.along, MODES),
            *ruptures(scene, solver, float(film.flow.pressure.min()) - on_wall.edge_mean),
            *([LOOSE.format(MAX_KNOWN_RESIDUAL)] if loose else [] if uncertainties else [NO_COARSER_GRID]),
        ),
    )
