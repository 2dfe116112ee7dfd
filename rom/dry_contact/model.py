"""What rungs share that work on the points of a rough surface: their grid, quantities, fields and bookkeeping."""

import math
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.ladder.model import (
    Applicability,
    Effect,
    Model,
    Progress,
    chosen_scheme,
    chosen_tolerance,
    one_process,
    silent,
)
from roughfilm.rom.ladder.provenance import provenance
from roughfilm.rom.ladder.result import Field, Numerics, Result
from roughfilm.rom.parts.pressed_surface import COARSEST
from roughfilm.rom.parts.restriction import restricted
from roughfilm.rom.parts.surface_geometry import digest_of

RESOLUTION_MEANING = "points along the longer side; on a coarser grid, the surface less the waves it cannot hold"


@dataclass(frozen=True, kw_only=True)
class Task:
    """A scene with a rough surface, on a grid: heights, shape (nx, ny), m, spacing, m, and the residual asked for."""

    scene: Any
    heights: Array
    spacing: tuple[float, float]
    tolerance: float


@dataclass(frozen=True, kw_only=True)
class Answer:
    """What a rung found: quantities and fields, residual, iterations, and what must be known of it."""

    quantities: Mapping[str, Quantity]
    fields: Mapping[str, Field]
    residual: float
    iterations: int
    warnings: tuple[str, ...] = ()


Work = Callable[[Task], Answer]


def nothing(_task: Task) -> None:
    """For work that needs no preparation."""


def one(value: float) -> Quantity:
    """A number without unit."""
    return Quantity(value=value, unit="1")


def solve(
    scene: Any,
    *,
    model: str,
    keeps: frozenset[Effect],
    sources: tuple[str, ...],
    work: Work,
    prepare: Callable[[Task], None],
    default_tolerance: float,
    resolution: int | None = None,
    tolerance: float | None = None,
    scheme: str | None = None,
    processes: int = 1,
    progress: Progress = silent,
) -> Result:
    """Do a rung's work on the surface, or on less of its waves where a coarser grid is asked for.

    Raises
    ------
    InputError
        For a resolution that the surface does not have, a tolerance outside 1e-13..1, a scheme, or more than one
        process, and what the work raises.
    ConvergenceError
        If the work does not converge.
    """
    scheme = chosen_scheme(model, (), scheme)
    one_process(model, processes)
    tolerance = chosen_tolerance(tolerance, default_tolerance)
    surface = scene.surface()
    own = max(surface.shape)
    resolution = own if resolution is None else resolution
    if not min(own, COARSEST) <= resolution <= own:
        told = f"the surface has {own} points along its longer side, take {min(own, COARSEST)} to {own}"
        raise InputError(f"--resolution: got {resolution}; {told}")
    progress(0.0, f"{resolution} points along the longer side")
    nx, ny = (max(2, round(points * resolution / own)) for points in surface.shape)
    heights, (length, width) = restricted(surface.heights, (nx, ny)), surface.size
    task = Task(scene=scene, heights=heights, spacing=(length / nx, width / ny), tolerance=tolerance)
    _ = scene.rms_slope  # what it comes from is kept for all rungs, and is not the cost of one
    prepare(task)
    wall, cpu = time.perf_counter(), time.process_time()
    answer = work(task)
    warnings = list(answer.warnings)
    if not surface.periodic:
        warnings.append("the surface does not say that it repeats itself; it is taken as one period")
    return Result(
        model=model,
        quantities={"rms_height": Quantity(value=float(heights.std()), unit="m"), **answer.quantities},
        fields=answer.fields,
        numerics=Numerics(
            residual=answer.residual,
            iterations=answer.iterations,
            cpu_s=time.process_time() - cpu,
            wall_s=time.perf_counter() - wall,
            degrees_of_freedom=heights.size,
            resolution=resolution,
            tolerance=tolerance,
            scheme=scheme,
        ),
        provenance=provenance(
            scene,
            model=model,
            keeps=tuple(keeps),
            sources=sources,
            heights={"digest": digest_of(surface), "points": list(surface.shape), "used": [nx, ny]},
        ),
        warnings=tuple(warnings),
    )


def contact_model(
    *,
    kind: str = "dry_contact",
    name: str,
    summary: str,
    keeps: frozenset[Effect],
    complete: bool,
    sources: tuple[str, ...],
    residual_meaning: str,
    applies: Callable[[Any], Applicability],
    work: Work,
    prepare: Callable[[Task], None] = nothing,
    default_tolerance: float,
    cost: Callable[[int], float],
) -> Model:
    """A rung of a contact, dry or wet, or of a rough gap; ``cost`` gives CPU seconds for a number of heights.

    ``prepare`` does before the clock starts what is done once on a machine.
    """

    def scene_cost(scene: Any, resolution: int) -> float:
        nx, ny = scene.surface().shape
        return cost(math.ceil(resolution**2 * min(nx, ny) / max(nx, ny)))

    return Model(
        name=name,
        kind=kind,
        summary=summary,
        keeps=keeps,
        complete=complete,
        sources=sources,
        resolution=None,
        resolutions=(),
        own_resolutions=lambda scene: scene.resolutions,
        resolution_meaning=RESOLUTION_MEANING,
        residual_meaning=residual_meaning,
        order=None,
        cost=scene_cost,
        applies=applies,
        solve=partial(
            solve,
            model=name,
            keeps=keeps,
            sources=sources,
            work=work,
            prepare=prepare,
            default_tolerance=default_tolerance,
        ),
    )
