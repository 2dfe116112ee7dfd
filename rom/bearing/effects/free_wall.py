"""Variants of a bearing whose wall moves freely: at its place, or where the wall carries the load of the scene."""

from dataclasses import replace

from roughfilm.contact.foundation.timing import imports_apart, working_time
from roughfilm.rom.bearing.corners import infinite_flows
from roughfilm.rom.bearing.effects.ablation import Variant, VariantSolution
from roughfilm.rom.bearing.effects.under_load import VariantFilm
from roughfilm.rom.bearing.equilibrium.expected import expected_scene
from roughfilm.rom.bearing.equilibrium.grids import FILM_RESIDUAL
from roughfilm.rom.bearing.free.evaluated import evaluated
from roughfilm.rom.bearing.free.solve import solve_free
from roughfilm.rom.bearing.mixed.wall import asperities_of
from roughfilm.rom.bearing.outside import film_outside
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.shear_thinning import thinning
from roughfilm.rom.bearing.warnings import scene_warnings
from roughfilm.rom.cavitation.evaluation.grids import cells_of, grid_warnings
from roughfilm.rom.cavitation.problem import Problem
from roughfilm.rom.ladder.model import Progress, silent


@imports_apart()
def solved_freely(variant: Variant, cells: int, progress: Progress = silent) -> VariantSolution:
    """Solve a variant with its wall at the place of the scene, or, with a load, where it carries the load.

    Raises
    ------
    InputError
        If no film carries the load, or flow factors or contact pressures are unknown for so thin a film.
    ConvergenceError
        If the film or its equilibrium does not converge.
    """
    scene, least = variant.scene, None
    if scene.load is not None and scene.asperities is None and variant.rough:
        least = VariantFilm(variant=replace(variant, scene=expected_scene(scene)), cells=cells).min_gap

    def film(one: Bearing) -> Problem:
        return replace(variant, scene=one).problem(least)

    cpu, thinned = working_time(), thinning(scene)
    free = solve_free(
        scene,
        cells,
        film=film,
        ruptures=variant.ruptures,
        contact=None if scene.asperities is None else asperities_of(scene),
        tolerance=FILM_RESIDUAL,
        heated=None if thinned is None else thinned.placed(),
        progress=progress,
    )
    there, found = free.scenes, evaluated(free, variant.outputs)
    solution, quantities = found.levels[0]
    films = [{"film": one.geometry.thinnest} if scene.load is not None else {} for one in there]
    units = {name: quantity.unit for name, quantity in quantities.items()}
    return VariantSolution(
        scene=there[0],
        levels=tuple(
            {name: one.value for name, one in values.items()} | least_film
            for (_, values), least_film in zip(found.levels, films, strict=True)
        ),
        cells=tuple(cells_of(one) for one, _ in found.levels),
        units=units | dict.fromkeys(films[0], "m"),
        factor_uncertainties=found.of_factors,
        residual=solution.residual,
        imbalance=solution.imbalance,
        unknown=infinite_flows(solution),
        balance=free.balance or 0.0,
        cpu_s=working_time() - cpu,
        warnings=(*grid_warnings(solution), *scene_warnings(scene, solution)),
        outside=film_outside(there[0], solution),
    )
