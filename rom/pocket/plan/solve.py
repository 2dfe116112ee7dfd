"""The models of the Reynolds equation over a cell in plan: their quantities with uncertainties from coarser grids."""

import time

import numpy as np

from roughfilm.contact.foundation.errors import ConvergenceError, Outcome
from roughfilm.contact.foundation.timing import working_time
from roughfilm.rom.cavitation.evaluation.grids import grid_uncertainty
from roughfilm.rom.ladder.model import Effect, Model, Progress
from roughfilm.rom.ladder.provenance import provenance
from roughfilm.rom.ladder.request import CheckedRequest
from roughfilm.rom.ladder.result import NO_COARSER_GRID, Numerics, Result, with_uncertainties
from roughfilm.rom.pocket.plan.grid import columns_across
from roughfilm.rom.pocket.plan.level import Level, levels_of
from roughfilm.rom.pocket.plan.quantities import plan_fields
from roughfilm.rom.pocket.scene import Pocket
from roughfilm.rom.pocket.validity.promise import promise_warnings
from roughfilm.rom.pocket.validity.warnings import cautions, ruptures


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
