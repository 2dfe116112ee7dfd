"""What rungs share that work on the points of a rough surface: their grid, quantities, fields and bookkeeping."""

import math
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any, TypeVar, Unpack

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.ladder.model import About, Applicability, Model, Progress, Resolutions
from roughfilm.rom.ladder.provenance import provenance
from roughfilm.rom.ladder.request import CheckedRequest
from roughfilm.rom.ladder.result import Field, Numerics, Result
from roughfilm.rom.parts.pressed_surface import MIN_SIDE_POINTS, RoughScene
from roughfilm.rom.parts.restriction import restricted
from roughfilm.rom.parts.surface_geometry import digest_of

RESOLUTION_MEANING = "points along the longer side; on a coarser grid, the surface less the waves it cannot hold"


RoughSceneT = TypeVar("RoughSceneT", bound=RoughScene)


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


def once(_scene: Any) -> int:
    """One period."""
    return 1


def one(value: float) -> Quantity:
    """A number without unit."""
    return Quantity(value=value, unit="1")


def solve(
    solver: Model[RoughSceneT],
    scene: RoughSceneT,
    request: CheckedRequest,
    progress: Progress,
    *,
    work: Work,
    prepare: Callable[[Task], None],
) -> Result:
    """Do a rung's work on the surface, or on less of its waves where a coarser grid is asked for.

    Raises
    ------
    InputError
        As the work raises it.
    ConvergenceError
        If the work does not converge.
    """
    model, keeps, sources = solver.name, solver.keeps, solver.sources
    resolution, tolerance, scheme = request.resolution, request.tolerance, request.scheme
    surface = scene.surface()
    own = max(surface.shape)
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


def own_resolutions(scene: RoughScene) -> Resolutions:
    """Points along the longer side of a scene's surface: from a coarse grid to its own, which is the default."""
    own = max(scene.surface().shape)
    return Resolutions(least=min(own, MIN_SIDE_POINTS), most=own, default=own, series=scene.resolutions)


def contact_model(
    *,
    kind: str = "dry_contact",
    residual_meaning: str,
    applies: Callable[[RoughSceneT], Applicability],
    work: Work,
    prepare: Callable[[Task], None] = nothing,
    tolerance: float,
    cost: Callable[[int], float],
    repeats: Callable[[RoughSceneT], int] = once,
    **about: Unpack[About],
) -> Model[RoughSceneT]:
    """A model of a contact, dry or wet, or of a rough gap.

    ``cost`` gives CPU seconds for a number of heights, of which there are as many again for each of the ``repeats``.
    ``prepare`` does before the clock starts the work that is done once on a machine.
    """

    def scene_cost(scene: RoughSceneT, resolution: int) -> float:
        nx, ny = scene.surface().shape
        return cost(math.ceil(resolution**2 * min(nx, ny) / max(nx, ny))) * repeats(scene)

    return Model(
        **about,
        kind=kind,
        resolutions=own_resolutions,
        resolution_meaning=RESOLUTION_MEANING,
        residual_meaning=residual_meaning,
        order=None,
        tolerance=tolerance,
        cost=scene_cost,
        applies=applies,
        compute=partial(solve, work=work, prepare=prepare),
    )
