"""The models of the Reynolds equation over a cell in plan: their quantities with uncertainties from coarser grids."""

import time
from collections.abc import Mapping

from roughfilm.contact.foundation.errors import ConvergenceError, Outcome
from roughfilm.contact.foundation.timing import working_time
from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.ladder.model import Effect, Model, Progress
from roughfilm.rom.ladder.provenance import provenance
from roughfilm.rom.ladder.request import CheckedRequest
from roughfilm.rom.ladder.result import NO_COARSER_GRID, Numerics, Result
from roughfilm.rom.pocket.plan.bounds import Correction, of_inertia
from roughfilm.rom.pocket.plan.grid import columns_across, require_resolved
from roughfilm.rom.pocket.plan.level import Level, levels_of, quantities_of
from roughfilm.rom.pocket.plan.quantities import EXTREMES, plan_fields
from roughfilm.rom.pocket.scene import Pocket
from roughfilm.rom.pocket.validity.bounds import bounded
from roughfilm.rom.pocket.validity.promise import promise_warnings
from roughfilm.rom.pocket.validity.warnings import column_warnings, inertia_warnings, ruptures, steep_warnings


def solve(solver: Model[Pocket], scene: Pocket, request: CheckedRequest, progress: Progress) -> Result:
    """Solve ∇·(h³/12 ∇p) = 1/2 ∂h/∂x over a periodic cell, plus first-order inertia if the model has it.

    Lengths are in film thicknesses and pressures in η u / film. The error is of second order in the size of a column;
    the uncertainty of each quantity follows from its values on grids with a half and a quarter of the columns.

    Raises
    ------
    InputError
        If the cell is so broad that the resolution needs too many columns, or a dimple is narrower than a column.
    ConvergenceError
        If the residual exceeds the tolerance.
    """
    wall, cpu = time.perf_counter(), working_time()
    plan = scene.plan()
    require_resolved(scene, request.resolution)
    counts = request.resolution, columns_across(plan, request.resolution)
    progress(0.0, f"{counts[0]} x {counts[1]} columns")
    with_inertia = Effect.INERTIA in solver.keeps
    number = scene.reynolds_number if with_inertia else 0.0
    levels = levels_of(plan, counts, with_inertia=with_inertia)
    finest = levels[0]
    if not finest.residual <= request.tolerance:
        raise ConvergenceError(
            f"{solver.name}: residual {finest.residual:.1e} on {counts[0]} x {counts[1]} columns misses the tolerance "
            f"{request.tolerance:.1e}; loosen the tolerance or make the dimples shallower",
            outcome=Outcome.STALLED,
        )
    on_wall = finest.on_wall(number)
    quantities = quantities_of(levels, scene, number)
    return Result(
        model=solver.name,
        quantities=quantities,
        fields=plan_fields(scene, on_wall),
        provenance=provenance(scene, model=solver.name, keeps=tuple(solver.keeps), sources=solver.sources),
        numerics=Numerics(
            residual=finest.residual,
            iterations=finest.film.iterations,
            cpu_s=working_time() - cpu,
            wall_s=time.perf_counter() - wall,
            degrees_of_freedom=on_wall.pressure.size,
            resolution=request.resolution,
            tolerance=request.tolerance,
            scheme=request.scheme,
            details=bounds_by_inertia(scene, finest, quantities) if bounded(scene, solver) else {},
        ),
        warnings=(
            *promise_warnings(scene, solver.name),
            *column_warnings(scene, request.resolution),
            *steep_warnings(scene),
            *inertia_warnings(scene, change=finest.change_of_pressure(number)),
            *ruptures(scene, solver, finest.pressure_range(number)[0] - on_wall.edge_mean),
            *([] if len(levels) > 1 else [NO_COARSER_GRID]),
        ),
    )


def bounds_by_inertia(scene: Pocket, level: Level, quantities: Mapping[str, Quantity]) -> dict[str, float]:
    """The bounds of the errors of a film by its correction for inertia; none without uncertainties."""
    number, relative = scene.reynolds_number, level.change_of_pressure(scene.reynolds_number)
    if relative is None or any(quantities[name].uncertainty is None for name in EXTREMES):
        return {}
    made = Correction.between(scene, *((level.quantities(scene, one), level.on_wall(one)) for one in (0.0, number)))
    largest = max(abs(quantities[name].value) for name in EXTREMES)
    return of_inertia(scene, made, quantities, largest=largest, relative=relative)
