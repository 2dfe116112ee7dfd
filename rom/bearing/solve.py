"""The solution of a bearing's film as a result, with its uncertainty and warnings."""

import math
import time
from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.timing import one_time, working_time
from roughfilm.rom.bearing.corners import infinite_flows
from roughfilm.rom.bearing.quantities import FILM_OUTPUTS, Fields, Outputs, density_ratio
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.uncertainty import POSITIONS, uncertainties
from roughfilm.rom.bearing.warnings import (
    grid_warnings,
    load_warnings,
    pressure_warnings,
    rupture_warnings,
    scene_warnings,
)
from roughfilm.rom.cavitation.discretise import Ends
from roughfilm.rom.cavitation.problem import Problem
from roughfilm.rom.cavitation.shape import Shape
from roughfilm.rom.cavitation.solve import Solution
from roughfilm.rom.cavitation.solve import solve as balance
from roughfilm.rom.homogenization.gap_factors import FactorsOverGap
from roughfilm.rom.ladder.model import Model, Progress
from roughfilm.rom.ladder.provenance import provenance
from roughfilm.rom.ladder.request import CheckedRequest
from roughfilm.rom.ladder.result import NO_COARSER_GRID, Field, Numerics, Result, SolverRun, with_uncertainties

WARM_UP_CELLS = 40
"""Number of cells of a film on which every compiled loop runs once."""


def solve(
    solver: Model[Bearing],
    scene: Bearing,
    request: CheckedRequest,
    progress: Progress,
    *,
    film: Callable[[Bearing], Problem],
    ruptures: bool,
    outputs: Outputs = FILM_OUTPUTS,
) -> Result:
    """Solve the film of a bearing on successively finer grids and estimate the uncertainty of its quantities.

    Parameters
    ----------
    solver : the model.
    film : film(scene), the problem that the model solves.
    ruptures : whether the film cavitates.
    outputs : the functions that evaluate the film.

    Raises
    ------
    InputError
        If the model does not apply to the scene.
    ConvergenceError
        If the film does not converge.
    """
    cells = request.resolution
    fits = solver.applies(scene)
    if not fits.applies:
        raise InputError(f"model: got {solver.name!r}; {fits.reason}")
    problem = film(scene)
    with one_time("start"):
        load_loops(problem.shape.wide)
    wall, cpu = time.perf_counter(), working_time()
    solution = balance(problem, (cells, cells), tolerance=request.tolerance, ruptures=ruptures, progress=progress)
    quantities = outputs.quantities(scene, solution)
    uncertainty = uncertainties(scene, solution, quantities, outputs)
    warnings = [
        *grid_warnings(solution),
        *pressure_warnings(solution),
        *rupture_warnings(solution),
        *scene_warnings(scene, solution),
        *load_warnings(scene, solution, quantities),
    ]
    if not uncertainty:
        warnings.append(NO_COARSER_GRID)
    explained = infinite_flows(solution) | frozenset(POSITIONS)
    if unknown := [name for name, value in uncertainty.items() if not math.isfinite(value) and name not in explained]:
        warnings.append(f"{', '.join(unknown)}: unknown uncertainty, as the roughness has too few points")
    return Result(
        model=solver.name,
        quantities=with_uncertainties(quantities, uncertainty),
        fields=_fields(scene, solution, outputs.fields(scene, solution)),
        numerics=Numerics(
            residual=solution.residual,
            iterations=sum(level.iterations for level in solution.levels),
            cpu_s=working_time() - cpu,
            wall_s=time.perf_counter() - wall,
            degrees_of_freedom=solution.state.pressure.size,
            resolution=cells,
            tolerance=request.tolerance,
            scheme=request.scheme,
            runs=tuple(
                SolverRun(name=" x ".join(map(str, level.shape)), iterations=level.iterations)
                for level in solution.levels
            ),
        ),
        provenance=provenance(
            scene,
            model=solver.name,
            keeps=tuple(solver.keeps),
            sources=solver.sources,
            **origin_of(problem.shape.roughness),
        ),
        warnings=tuple(warnings),
    )


def origin_of(roughness: FactorsOverGap | None) -> dict[str, Any]:
    """The entry "table" of provenance for flow factors of a table that was made for the result or kept from others."""
    origin = getattr(roughness, "origin", None)
    return {"table": dict(origin)} if origin else {}


@cache
def load_loops(wide: bool) -> None:
    """Compile or load the compiled loops once in a process, so that they do not count in the time of a film."""
    shape = Shape(thickness=lambda x, y: 1e-6 * (2 - x) + 0 * y, breaks=(0.0, 1.0), wide=wide)
    ends = Ends(sides=None if wide else (0.0, 0.0))
    balance(Problem(shape=shape, ends=ends, speed=1.0, viscosity=1.0), (WARM_UP_CELLS, WARM_UP_CELLS))


def _fields(scene: Bearing, solution: Solution, more: Fields) -> dict[str, Field]:
    """The fields over the grid, shape (nx, ny), with x in the coordinates of the scene for either sliding direction."""
    shape = solution.problem.shape
    x, y = np.meshgrid(solution.grid.x, solution.grid.y, indexing="ij")
    values: Fields = {
        "x": (x, "rad" if shape.polar else "m"),
        "y": (y, "m"),
        "film_thickness": (solution.faces.thickness, "m"),
        "pressure": (solution.state.pressure + scene.lubricant.cavitation_pressure, "Pa"),
        "density_ratio": (density_ratio(solution), "1"),
        **more,
    }
    if solution.turned:
        values = {name: (field[::-1], unit) for name, (field, unit) in values.items()}
        mirrored, unit = values["x"]
        values["x"] = (shape.breaks[0] + shape.breaks[-1] - mirrored, unit)
    return {name: Field(values=np.ascontiguousarray(field), unit=unit) for name, (field, unit) in values.items()}
