"""What the rungs of a rough gap share that need no outside solver."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import Unpack

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.dry_contact.model import Answer, Task, contact_model
from roughfilm.rom.ladder.model import About, Applicability, Effect, Model
from roughfilm.rom.ladder.result import Field, with_uncertainties
from roughfilm.rom.pocket.validity import NO_COARSER_GRID
from roughfilm.rom.rough_gap.flow.factors import RoughGapFactors
from roughfilm.rom.rough_gap.flow.range_of_validity import part_of_lost_waves
from roughfilm.rom.rough_gap.quantities import coefficients, gap_quantities
from roughfilm.rom.rough_gap.scene import RoughGap
from roughfilm.rom.rough_gap.validity import cautions
from roughfilm.rom.rough_gap.walls import Walls

RESIDUAL_MEANING = "largest part of a coefficient by which iterating on would change it"

TOLERANCE = 1e-8


@dataclass(frozen=True, kw_only=True)
class Found:
    """What a rung finds: factors over those of a smooth gap and their error bars, and the flow along x.

    ``flow`` is its size over the nominal flow, shape (nx, ny).
    """

    factors: RoughGapFactors
    uncertainty: RoughGapFactors | None
    flow: Array
    residual: float
    iterations: int
    warnings: tuple[str, ...] = ()


def work(task: Task, *, find: Callable[[Walls, float], Found], slope: bool) -> Answer:
    """Solve on the walls with the task's nodes; waves that these cannot hold count in the error bars."""
    scene: RoughGap = task.scene
    walls = scene.walls(max(task.heights.shape))
    found = find(walls, scene.mean_gap)
    bars: Mapping[str, float] = {}
    warnings = [*cautions(scene, walls), *found.warnings]
    if found.uncertainty is not None:
        bars = coefficients(_with_lost_waves(found.factors, found.uncertainty, scene, walls, slope=slope))
        if not np.isfinite(found.uncertainty.pressure).all():
            warnings.append(NO_COARSER_GRID)
    return Answer(
        quantities=with_uncertainties(gap_quantities(scene, walls, found.factors), bars),
        fields={
            "gap": Field(values=walls.gap, unit="m"),
            "flow": Field(values=found.flow * scene.nominal_flow, unit="m^2/s"),
        },
        residual=found.residual,
        iterations=found.iterations,
        warnings=tuple(warnings),
    )


def _with_lost_waves(
    factors: RoughGapFactors, bars: RoughGapFactors, scene: RoughGap, walls: Walls, *, slope: bool
) -> RoughGapFactors:
    finest = max(scene.surface().shape)
    if finest == max(walls.lower.shape):
        return bars
    part = part_of_lost_waves(scene.walls(finest), walls, stokes=slope)
    a = np.diag(factors.pressure) * part[:2]
    return replace(
        bars,
        pressure=bars.pressure + np.sqrt(np.outer(a, a)),
        shear=bars.shear + np.abs(factors.shear) * part[2],
        friction=bars.friction + factors.friction * float(part[3]),
    )


def gap_model(
    *,
    applies: Callable[[RoughGap], Applicability],
    find: Callable[[Walls, float], Found],
    cost: Callable[[int], float],
    **about: Unpack[About],
) -> Model[RoughGap]:
    """A model of a rough gap; ``find(walls, mean gap)`` solves, ``cost`` gives CPU seconds for a number of nodes."""
    return contact_model(
        **about,
        kind="rough_gap",
        residual_meaning=RESIDUAL_MEANING,
        applies=applies,
        work=partial(work, find=find, slope=Effect.SLOPE in about["keeps"]),
        prepare=partial(prepare, find=find),
        tolerance=TOLERANCE,
        cost=cost,
    )


def prepare(task: Task, *, find: Callable[[Walls, float], Found]) -> None:
    """Compile what the rung needs, and make the walls, which is not the cost of a rung."""
    task.scene.walls(max(task.heights.shape))
    wave = 0.1 * np.cos(2 * np.pi * np.arange(16) / 16)
    find(Walls(lower=np.add.outer(wave, wave), upper=np.ones((16, 16)), spacing=(1.0, 1.0)), 1.0)
