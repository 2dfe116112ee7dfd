"""The thin film over a cell in plan as a result."""

import time
from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.errors import ConvergenceError
from roughfilm.contact.foundation.timing import working_time
from roughfilm.rom.ladder.model import Effect, Model, Progress, silent
from roughfilm.rom.ladder.provenance import provenance
from roughfilm.rom.ladder.request import CheckedRequest
from roughfilm.rom.ladder.result import Numerics, Result
from roughfilm.rom.pocket.model import SCHEMES
from roughfilm.rom.pocket.plan.film import newton, slope
from roughfilm.rom.pocket.plan.film.equations import Film, SheetFlow
from roughfilm.rom.pocket.plan.film.sheet import Sheet, sheet
from roughfilm.rom.pocket.plan.quantities import OnSlidingWall, plan_fields, plan_quantities
from roughfilm.rom.pocket.scene import Pocket
from roughfilm.rom.pocket.validity.warnings import cautions, ruptures
from roughfilm.rom.thin_film.basis import even_basis, gauss_basis, sliding_wall_slope
from roughfilm.rom.thin_film.continuation import continued
from roughfilm.rom.thin_film.newton import mode_warnings

MODES = 8
"""Polynomials across the film."""

BACKFLOW_LAYERS = 60
"""Number of layers across the film among which the back-flow is sought."""

RESPONSE_TOLERANCE = 1e-6
"""Tolerance of the linear response to the slope, relative to the neglected force."""


@dataclass(frozen=True, kw_only=True)
class PlanFilm:
    """A solution of the thin-film equations over a cell in plan, with its residual and number of Newton steps."""

    sheet: Sheet
    flow: SheetFlow
    residual: float
    steps: int


def solve_sheet(
    grid: Sheet, reynolds_number: float, *, tolerance: float, with_slope: bool, progress: Progress = silent
) -> PlanFilm:
    """Solve the thin-film equations on a grid, with slope to second order if asked for.

    Raises
    ------
    ConvergenceError
        If Newton's method does not converge to the tolerance, or the response to the slope is not found.
    """
    basis = gauss_basis(MODES)
    with np.errstate(all="ignore"):
        flow, linear, steps = continued(
            lambda at, begin: newton.attempt(grid, basis, at, begin, tolerance),
            Film(sheet=grid, basis=basis, reynolds_number=0.0).still(),
            reynolds_number,
            progress,
            shallower="shallower dimples",
        )
        if with_slope:
            force = slope.imbalance(linear.film, flow, linear.velocities)
            change = linear.response(force, tolerance=RESPONSE_TOLERANCE)
            if change is None:
                raise ConvergenceError("the slope correction of the film is not finite here; take navier_stokes")
            flow = SheetFlow(flat=flow.flat + change.flat, shape=flow.shape)
    return PlanFilm(sheet=grid, flow=flow, residual=linear.residual, steps=steps)


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


def solve(solver: Model[Pocket], scene: Pocket, request: CheckedRequest, progress: Progress) -> Result:
    """Solve the thin-film Navier-Stokes equations over a periodic cell, with slope if the model keeps it.

    The error is of second order in the cell size (of first order with the scheme ``upwind``).

    Raises
    ------
    ConvergenceError
        If Newton's method does not converge to the tolerance.
    """
    wall, cpu = time.perf_counter(), working_time()
    grid = sheet(scene.plan(), request.resolution, second_order=request.scheme == SCHEMES[0])
    film = solve_sheet(
        grid,
        scene.reynolds_number,
        tolerance=request.tolerance,
        with_slope=Effect.SLOPE in solver.keeps,
        progress=progress,
    )
    on_wall, pressure = on_sliding_wall(film), film.flow.pressure
    lowest, highest = float(pressure.min()), float(pressure.max())
    return Result(
        model=solver.name,
        quantities=plan_quantities(
            scene, on_wall, backflow=max(0.0, -_slowest(film.flow)), pressure_range=(lowest, highest)
        ),
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
        ),
        warnings=(
            *cautions(scene),
            *mode_warnings(film.flow.along, MODES),
            *ruptures(scene, lowest - on_wall.edge_mean),
        ),
    )
