"""Models on the points of a rough surface: their grid, request, cost and result."""

import math
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any, TypeVar, Unpack

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.timing import one_time, working_time
from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.ladder.model import About, Applicability, Model, Progress, Resolutions
from roughfilm.rom.ladder.provenance import provenance
from roughfilm.rom.ladder.request import CheckedRequest
from roughfilm.rom.ladder.result import Field, Numerics, Result
from roughfilm.rom.parts.pressed_surface import MIN_SIDE_POINTS, RoughScene
from roughfilm.rom.parts.restriction import restricted
from roughfilm.rom.parts.surface_geometry import digest_of

RESOLUTION_MEANING = "points along the longer side; a coarser grid omits the waves that it cannot represent"

RoughSceneT = TypeVar("RoughSceneT", bound=RoughScene)


@dataclass(frozen=True, kw_only=True)
class Task:
    """A scene with a rough surface on a grid: heights, m, shape (nx, ny), spacing, m, and tolerance of the residual."""

    scene: Any
    heights: Array
    spacing: tuple[float, float]
    tolerance: float


@dataclass(frozen=True, kw_only=True)
class Answer:
    """The solution of a model: quantities, fields, residual, iterations, warnings, and what is outside its range."""

    quantities: Mapping[str, Quantity]
    fields: Mapping[str, Field]
    residual: float
    iterations: int
    warnings: tuple[str, ...] = ()
    outside: tuple[str, ...] = ()


Work = Callable[[Task], Answer]


def nothing(_task: Task) -> None:
    """Do nothing, as the preparation of models that need none."""


def once(_scene: Any) -> int:
    """The number of periods of a model on one period, 1."""
    return 1


def one(value: float) -> Quantity:
    """A dimensionless quantity."""
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
    """Solve a model on the surface, without the waves that a requested coarser grid cannot represent.

    Raises
    ------
    InputError
        If ``work`` raises it.
    ConvergenceError
        If ``work`` does not converge.
    """
    model, keeps, sources = solver.name, solver.keeps, solver.sources
    resolution, tolerance, scheme = request.resolution, request.tolerance, request.scheme
    surface = scene.surface()
    own = max(surface.shape)
    progress(0.0, f"{resolution} points along the longer side")
    nx, ny = (max(2, round(points * resolution / own)) for points in surface.shape)
    heights, (length, width) = restricted(surface.heights, (nx, ny)), surface.size
    task = Task(scene=scene, heights=heights, spacing=(length / nx, width / ny), tolerance=tolerance)
    _ = scene.rms_slope  # cached for all models, so that it is not part of the cost of one
    with one_time("start"):
        prepare(task)
    wall, cpu = time.perf_counter(), working_time()
    answer = work(task)
    warnings = [*scene.unit_warnings(), *answer.warnings]
    if not surface.periodic:
        warnings.append("the surface is not marked as periodic; it is taken as one period")
    return Result(
        model=model,
        quantities={"rms_height": Quantity(value=float(heights.std()), unit="m"), **answer.quantities},
        fields=answer.fields,
        numerics=Numerics(
            residual=answer.residual,
            iterations=answer.iterations,
            cpu_s=working_time() - cpu,
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
        outside=answer.outside,
    )


def own_resolutions(scene: RoughScene) -> Resolutions:
    """The numbers of points along the longer side, from a coarse grid to the surface's own, the default."""
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
    """A model of a dry contact, a seal or a rough gap.

    ``cost(heights)`` is in CPU seconds for one period; ``repeats(scene)`` is the number of periods. ``prepare(task)``
    does work that is not part of the cost, such as compilation.
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
