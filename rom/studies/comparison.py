"""Comparison of models: differences from the most complete one, effects of single terms, error over cost."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from roughfilm.rom.ladder.kind import kind_of
from roughfilm.rom.ladder.model import Effect, Model, best, one_effect_away
from roughfilm.rom.ladder.result import Result


@dataclass(frozen=True, kw_only=True)
class Difference:
    """The difference between two models in one quantity.

    Attributes
    ----------
    model, other : names of the models; the difference is the value of ``model`` minus that of ``other``.
    effect : effect that ``model`` includes and ``other`` omits; None for a difference from the best model.
    quantity : name of the quantity.
    absolute : difference, in the unit of the quantity.
    relative : difference over the ``scale`` of the quantity in the result of the best model.
    """

    model: str
    other: str
    effect: Effect | None
    quantity: str
    absolute: float
    relative: float


@dataclass(frozen=True, kw_only=True)
class Point:
    """One run in the chart of error over CPU time.

    Attributes
    ----------
    model : name of the model.
    resolution : number of cells, points or nodes.
    cpu_s : CPU time, s.
    error : by quantity, |difference from the reference run| over the ``scale`` of the quantity.
    """

    model: str
    resolution: int
    cpu_s: float
    error: Mapping[str, float]


def scale(result: Result, quantity: str) -> float:
    """The size by which the kind of scene divides an error in a quantity, in the unit of the quantity."""
    return kind_of(result).scale_of(result, quantity)


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
    """The difference of every solved model from the best solved one, in each quantity that both give.

    Parameters
    ----------
    models : models of one kind of scene.
    results : results by the name of the model; at least one.
    """
    solved = [model for model in models if model.name in results]
    top = results[best(solved).name]
    return tuple(
        _difference(results[model.name], top, quantity, None, top)
        for model in solved
        if model.name != top.model
        for quantity in kind_of(top).shared(results[model.name], top)
    )


def effects(models: Sequence[Model], results: Mapping[str, Result]) -> tuple[Difference, ...]:
    """The change by each effect: for each pair of solved models that differ by one effect, with it minus without it.

    Parameters
    ----------
    models : models of one kind of scene.
    results : results by the name of the model; at least one.
    """
    solved = [model for model in models if model.name in results]
    top = results[best(solved).name]
    return tuple(
        _difference(results[other.name], results[model.name], quantity, effect, top)
        for model in solved
        for other, effect in one_effect_away(model, solved)
        for quantity in kind_of(top).shared(results[model.name], results[other.name], top)
    )


def points(reference: Result, runs: Sequence[Result]) -> tuple[Point, ...]:
    """The error of each run against a reference run; the reference run itself is omitted."""
    return tuple(
        Point(
            model=run.model,
            resolution=run.numerics.resolution,
            cpu_s=run.numerics.cpu_s,
            error={
                quantity: abs(run.quantities[quantity].value - reference.quantities[quantity].value)
                / scale(reference, quantity)
                for quantity in kind_of(reference).shared(run, reference)
            },
        )
        for run in runs
        if (run.model, run.numerics.resolution) != (reference.model, reference.numerics.resolution)
    )


def pareto_front(chart: Sequence[Point], quantity: str) -> tuple[Point, ...]:
    """The points for which no other point has both less cost and less error in a quantity, cheapest first."""
    front: list[Point] = []
    known = [point for point in chart if quantity in point.error]
    for point in sorted(known, key=lambda point: (point.cpu_s, point.error[quantity])):
        if not front or point.error[quantity] < front[-1].error[quantity]:
            front.append(point)
    return tuple(front)
