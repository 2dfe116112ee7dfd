"""The solution of the Reynolds equation with cavitation for a pocket, as a result with uncertainty and warnings."""

import time

from roughfilm.contact.foundation.rounding import share
from roughfilm.contact.foundation.timing import working_time
from roughfilm.rom.cavitation.balance import CAVITY
from roughfilm.rom.cavitation.evaluation.flows import IMBALANCE_FACTOR
from roughfilm.rom.cavitation.evaluation.grids import cells_of, grid_sequence, grid_uncertainty, grid_warnings
from roughfilm.rom.cavitation.evaluation.numerics import numerics_of
from roughfilm.rom.cavitation.solve import Solution
from roughfilm.rom.cavitation.solve import solve as balance
from roughfilm.rom.ladder.model import Model, Progress
from roughfilm.rom.ladder.provenance import provenance
from roughfilm.rom.ladder.request import CheckedRequest
from roughfilm.rom.ladder.result import NO_COARSER_GRID, Result, with_uncertainties
from roughfilm.rom.pocket.cavitating.cells import cell_fields, cell_film, cell_quantities
from roughfilm.rom.pocket.cavitating.grooves import groove_fields, groove_problem, groove_quantities
from roughfilm.rom.pocket.plan.grid import columns_across, require_resolved
from roughfilm.rom.pocket.scene import Pocket
from roughfilm.rom.pocket.validity.warnings import inertia_warnings, steep_warnings


def solve(solver: Model[Pocket], scene: Pocket, request: CheckedRequest, progress: Progress) -> Result:
    """Solve (u/2) ∂(θh)/∂x - ∇·(h³/12η ∇p) = 0 with p > p_c in the film, and p = p_c with θ < 1 in cavities.

    The uncertainty of a quantity comes from its values on the coarser grids from which the solution starts.

    Raises
    ------
    InputError
        If a dimple of a cell in plan is narrower than a column.
    ConvergenceError
        If the residual does not meet the tolerance.
    """
    wall, cpu = time.perf_counter(), working_time()
    cells = request.resolution
    if scene.in_plan:
        require_resolved(scene, cells)
        sides = (cells, columns_across(scene.plan(), cells))
        solution = cell_film(scene, sides, tolerance=request.tolerance, progress=progress)
        quantities, fields = cell_quantities, cell_fields
    else:
        solution = balance(groove_problem(scene), (cells, 1), tolerance=request.tolerance, progress=progress)
        quantities, fields = groove_quantities, groove_fields
    grids = grid_sequence(solution)
    levels = [quantities(scene, grid) for grid in grids]
    uncertainty = {}
    if len(grids) > 1:
        for name, quantity in levels[0].items():
            of_grid = grid_uncertainty([*map(cells_of, grids)], [level[name].value for level in levels])
            uncertainty[name] = of_grid + IMBALANCE_FACTOR * solution.imbalance * abs(quantity.value)
    warnings = [*grid_warnings(solution), *([] if uncertainty else [NO_COARSER_GRID])]
    warnings += edge_warnings(scene, solution)
    warnings += (*steep_warnings(scene), *inertia_warnings(scene)) if scene.in_plan else ()
    return Result(
        model=solver.name,
        quantities=with_uncertainties(levels[0], uncertainty),
        fields=fields(scene, solution),
        numerics=numerics_of(
            solution, solution.levels, request, cpu_s=working_time() - cpu, wall_s=time.perf_counter() - wall
        ),
        provenance=provenance(scene, model=solver.name, keeps=tuple(solver.keeps), sources=solver.sources),
        warnings=tuple(warnings),
    )


def edge_warnings(scene: Pocket, solution: Solution) -> list[str]:
    """Warnings where the film is ruptured or at the cavitation pressure on the ends of the period."""
    if scene.cavitation_pressure == 0:
        return [
            "lubricant.cavitation_pressure: is ambient pressure, so that no pressure draws liquid into the period; its "
            "ends are taken as full of liquid"
        ]
    across = solution.grid.volume_y
    ruptured = float(across[solution.kind[0] == CAVITY].sum() / across.sum())
    if ruptured == 0:
        return []
    return [
        f"the film is ruptured on {share(ruptured)} of the edges x = ±length/2, over which the mean is ambient, "
        "so that the rest of the edges is above ambient; place the dimples away from the edges"
    ]
