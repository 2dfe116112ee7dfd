"""What separates the rungs: differences to the best one, the effects between neighbours, errors against cost."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from rom.ladder import Effect, Model, best, one_effect_away
from rom.result import Result

COMPARED = ("load_plus", "friction_plus")

LEAST_LOAD = 1e-3
"""A load below this part of the greatest pressure is no load to divide by; the pressure is taken instead."""


@dataclass(frozen=True, kw_only=True)
class Difference:
    """How far one model is from another in one quantity: absolute, and relative to the best rung's ``scale``."""

    model: str
    other: str
    effect: Effect | None
    quantity: str
    absolute: float
    relative: float


@dataclass(frozen=True, kw_only=True)
class Point:
    """One run on the speed-accuracy chart: CPU seconds, and error in each compared quantity against the best rung."""

    model: str
    resolution: int
    cpu_s: float
    error: Mapping[str, float]


def scale(result: Result, quantity: str) -> float:
    """What an error in a quantity is divided by: its size, or the greatest pressure where there is hardly any load."""
    size = abs(result.quantities[quantity].value)
    if quantity != "load_plus":
        return size
    pressure = max(abs(result.quantities[name].value) for name in ("pressure_max_plus", "pressure_min_plus"))
    return size if size > LEAST_LOAD * pressure else pressure


def _difference(result: Result, other: Result, quantity: str, effect: Effect | None, top: Result) -> Difference:
    absolute = result.quantities[quantity].value - other.quantities[quantity].value
    return Difference(
        model=result.model,
        other=other.model,
        effect=effect,
        quantity=quantity,
        absolute=absolute,
        relative=absolute / scale(top, quantity),
    )


def to_best(models: Sequence[Model], results: Mapping[str, Result]) -> tuple[Difference, ...]:
    """Every solved model's difference to the best solved rung."""
    solved = [model for model in models if model.name in results]
    top = results[best(solved).name]
    return tuple(
        _difference(results[model.name], top, quantity, None, top)
        for model in solved
        if model.name != top.model
        for quantity in COMPARED
    )


def effects(models: Sequence[Model], results: Mapping[str, Result]) -> tuple[Difference, ...]:
    """For each pair of solved models one effect apart, what that effect adds: with it less without it."""
    solved = [model for model in models if model.name in results]
    top = results[best(solved).name]
    return tuple(
        _difference(results[other.name], results[model.name], quantity, effect, top)
        for model in solved
        for other, effect in one_effect_away(model, solved)
        for quantity in COMPARED
    )


def points(reference: Result, runs: Sequence[Result]) -> tuple[Point, ...]:
    """Each run's error against a reference run, which is left out itself."""
    return tuple(
        Point(
            model=run.model,
            resolution=run.numerics.resolution,
            cpu_s=run.numerics.cpu_s,
            error={
                quantity: abs(run.quantities[quantity].value - reference.quantities[quantity].value)
                / scale(reference, quantity)
                for quantity in COMPARED
            },
        )
        for run in runs
        if (run.model, run.numerics.resolution) != (reference.model, reference.numerics.resolution)
    )


def pareto_front(chart: Sequence[Point], quantity: str) -> tuple[Point, ...]:
    """The points that no other point beats in both cost and error, cheapest first."""
    front: list[Point] = []
    for point in sorted(chart, key=lambda point: (point.cpu_s, point.error[quantity])):
        if not front or point.error[quantity] < front[-1].error[quantity]:
            front.append(point)
    return tuple(front)
