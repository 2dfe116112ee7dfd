"""Models of a rough gap that need no external solver."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import Unpack

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.dry_contact.model import Answer, Task, contact_model
from roughfilm.rom.ladder.model import About, Applicability, Effect, Model
from roughfilm.rom.ladder.result import NO_COARSER_GRID, Field, with_uncertainties
from roughfilm.rom.rough_gap.flow.factors import RoughGapFactors
from roughfilm.rom.rough_gap.flow.range_of_validity import change_by_lost_waves
from roughfilm.rom.rough_gap.quantities import gap_quantities, known_uncertainties
from roughfilm.rom.rough_gap.scene import RoughGap
from roughfilm.rom.rough_gap.validity import cautions, lowest_under_sliding, ruptures
from roughfilm.rom.rough_gap.walls import Walls

RESIDUAL_MEANING = "largest relative solver error of a coefficient"

RESIDUAL_TOLERANCE = 1e-8
"""Default tolerance of the residual."""


@dataclass(frozen=True, kw_only=True)
class GapFlow:
    """The solution of a model: factors over those of a smooth gap, their uncertainty, and the flow under a gradient.

    ``flow`` is the magnitude of the flow under a gradient along x, over the nominal flow, shape (nx, ny), and
    ``suction`` the mean pressure under sliding less the lowest one, over 6ηu, 1/m.
    """

    factors: RoughGapFactors
    uncertainty: RoughGapFactors | None
    flow: Array
    residual: float
    iterations: int
    suction: float = 0.0
    warnings: tuple[str, ...] = ()


def work(task: Task, *, find: Callable[[Walls, float], GapFlow], slope: bool) -> Answer:
    """Solve on the walls at the task's nodes; uncertainties include the waves that the grid cannot represent."""
    scene: RoughGap = task.scene
    walls = scene.walls(max(task.heights.shape))
    solution = find(walls, scene.mean_gap)
    uncertainties: Mapping[str, float] = {}
    warnings = [*cautions(scene, walls), *solution.warnings]
    if walls.slides:
        warnings += ruptures(scene, lowest_under_sliding(scene, solution.suction), "under sliding")
    if solution.uncertainty is not None:
        lost = _with_lost_waves(solution.factors, solution.uncertainty, scene, walls, slope=slope)
        uncertainties = known_uncertainties(lost, walls)
        if not np.isfinite(solution.uncertainty.pressure).all():
            warnings.append(NO_COARSER_GRID)
    return Answer(
        quantities=with_uncertainties(gap_quantities(scene, walls, solution.factors), uncertainties),
        fields={
            "gap": Field(values=walls.gap, unit="m"),
            "flow": Field(values=solution.flow * scene.nominal_flow, unit="m^2/s"),
        },
        residual=solution.residual,
        iterations=solution.iterations,
        warnings=tuple(warnings),
    )


def _with_lost_waves(
    factors: RoughGapFactors, uncertainty: RoughGapFactors, scene: RoughGap, walls: Walls, *, slope: bool
) -> RoughGapFactors:
    finest = max(scene.surface().shape)
    if finest == max(walls.lower.shape):
        return uncertainty
    change = change_by_lost_waves(scene.walls(finest), walls, stokes=slope)
    a = np.diag(factors.pressure) * change[:2]
    return replace(
        uncertainty,
        pressure=uncertainty.pressure + np.sqrt(np.outer(a, a)),
        shear=uncertainty.shear + np.abs(factors.shear) * change[2],
        friction=uncertainty.friction + factors.friction * float(change[3]),
    )


def gap_model(
    *,
    applies: Callable[[RoughGap], Applicability],
    find: Callable[[Walls, float], GapFlow],
    cost: Callable[[int], float],
    **about: Unpack[About],
) -> Model[RoughGap]:
    """A model of a rough gap from a solver ``find(walls, mean_gap)`` and its cost, CPU seconds over nodes."""
    return contact_model(
        **about,
        kind="rough_gap",
        residual_meaning=RESIDUAL_MEANING,
        applies=applies,
        work=partial(work, find=find, slope=Effect.SLOPE in about["keeps"]),
        prepare=partial(prepare, find=find),
        tolerance=RESIDUAL_TOLERANCE,
        cost=cost,
    )


def prepare(task: Task, *, find: Callable[[Walls, float], GapFlow]) -> None:
    """Compile the kernels of the model and compute the walls, neither of which is part of its cost."""
    task.scene.walls(max(task.heights.shape))
    wave = 0.1 * np.cos(2 * np.pi * np.arange(16) / 16)
    find(Walls(lower=np.add.outer(wave, wave), upper=np.ones((16, 16)), spacing=(1.0, 1.0)), 1.0)
