"""Variants of a bearing at the temperature at which their heat is balanced."""

from collections.abc import Callable
from dataclasses import replace

from roughfilm.contact.foundation.units import ZERO_CELSIUS
from roughfilm.rom.bearing.effects.ablation import Variant, VariantSolution
from roughfilm.rom.bearing.model import smooth_resolutions
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.thermal.heat_balance import EFFECTIVE, INSENSITIVE, Heated, Sensitivity, balanced_film, grids
from roughfilm.rom.bearing.thermal.outside import outside_at
from roughfilm.rom.ladder.model import Progress, silent

SolveOn = Callable[[Variant, int, Progress], VariantSolution]
"""A function that solves a variant on a grid of so many cells, at a film thickness or under a load."""


def with_heat(solve: SolveOn, variant: Variant, cells: int, progress: Progress = silent) -> VariantSolution:
    """Solve a variant, of a lubricant with a temperature at the one at which its heat is balanced, as ``heat_balance``.

    Parameters
    ----------
    solve : the solver of variants without temperature.
    variant : the variant; its scene has the supplied lubricant.
    cells : number of cells along a side of the finest grid.

    Returns
    -------
    VariantSolution
        Its scene is at the temperature of the film, and its quantities include ``effective_temperature``. Where this or
        the supply is outside of the range of the lubricant, ``outside`` says so.

    Raises
    ------
    InputError
        If ``solve`` raises it, nothing takes the heat away, or friction heats the film without end.
    ConvergenceError
        If a film or its temperature does not converge.
    """
    scene = variant.scene
    if scene.lubricant.lacking:
        return _judged(solve(variant, cells, progress), scene)
    liquid, base, spent = scene.lubricant.liquid, variant.outputs, 0.0

    def film(temperature: float, size: int, sensitivity: Sensitivity = INSENSITIVE) -> VariantSolution:
        nonlocal spent
        heat = Heated(base=base, liquid=liquid, temperature=temperature, sensitivity=sensitivity)
        found = solve(replace(variant, scene=scene.at_temperature(temperature), heat=heat), size, progress)
        spent += found.cpu_s
        return found

    sizes = grids(smooth_resolutions(scene), cells)
    found, _, _ = balanced_film(film, lambda one: one.values, scene, sizes)
    return _judged(replace(found, cpu_s=spent), scene)


def _judged(found: VariantSolution, scene: Bearing) -> VariantSolution:
    """The solution with the sentence on temperatures outside of the range of the lubricant of the scene."""
    return replace(found, outside=(*outside_at(scene, found.values), *found.outside))


def supplied(there: Bearing, scene: Bearing) -> Bearing:
    """The scene at a film thickness or place that was found at the temperature of its film, with its own lubricant."""
    return there.model_copy(update={"lubricant": scene.lubricant, "supply": scene.supply})


def at_own_temperature(scene: Bearing, solution: VariantSolution) -> Bearing:
    """The scene at the temperature of a solution of it; the scene itself without a temperature."""
    effective = solution.values.get(EFFECTIVE)
    return scene if effective is None else scene.at_temperature(effective + ZERO_CELSIUS)
