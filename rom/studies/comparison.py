"""Comparison of models: differences from the most complete one, effects of single terms, error over cost."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations

from roughfilm.rom.ladder.kind import Scene, kind_of, kind_of_scene
from roughfilm.rom.ladder.model import Effect, Model, best_for, one_effect_away
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
    uncertainty : uncertainty of ``relative``: for a difference from the best model that of the best model, for an
        effect that of both models, √(u₁² + u₂²); None if one is unknown.
    """

    model: str
    other: str
    effect: Effect | None
    quantity: str
    absolute: float
    relative: float
    uncertainty: float | None


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


def relative_uncertainty(result: Result, quantity: str) -> float | None:
    """The numerical uncertainty of a quantity over its ``scale`` in the same result; None if it is unknown."""
    uncertainty = result.quantities[quantity].uncertainty
    return None if uncertainty is None else uncertainty / scale(result, quantity)


def distinguished(error: float, other: float, uncertainty: float | None) -> bool:
    """Whether a reference of a relative uncertainty u shows which of two models has the smaller error.

    The true errors lie within |error| ± u. The models can be distinguished if these intervals do not overlap, that
    is, if ||error| - |other|| > 2u; never if u is unknown (None).
    """
    return uncertainty is not None and abs(abs(error) - abs(other)) > 2 * uncertainty


def with_uncertainty(result: Result, uncertainties: Mapping[str, float]) -> Result:
    """The result whose quantities carry the larger of their own uncertainty and the given one, in their units.

    The same quantity of the whole width, and in units of a pressure, carries the same one over its value.
    """
    uncertainties = {
        name: bar * ratio
        for given, bar in uncertainties.items()
        if given in result.quantities
        for name, ratio in _same(result, given).items()
    }
    quantities = {
        name: replace(quantity, uncertainty=max(quantity.uncertainty or 0.0, uncertainties[name]))
        if name in uncertainties
        else quantity
        for name, quantity in result.quantities.items()
    }
    return replace(result, quantities=quantities)


def _same(result: Result, name: str) -> dict[str, float]:
    """The names under which a result has a quantity in other units, with their values over that of the quantity."""
    base, value = name.removesuffix("_per_width").removesuffix("_plus"), result.quantities[name].value
    others = [one for one in (f"bearing_{base}", base, f"{base}_per_area") if one in result.quantities and one != name]
    return {name: 1.0, **{one: abs(result.quantities[one].value / value) for one in others if value}}


def _difference(result: Result, other: Result, quantity: str, effect: Effect | None, top: Result) -> Difference:
    absolute = result.quantities[quantity].value - other.quantities[quantity].value
    size = scale(top, quantity)
    bars = [one.quantities[quantity].uncertainty for one in ([other] if effect is None else [result, other])]
    known = [bar for bar in bars if bar is not None]
    return Difference(
        model=result.model,
        other=other.model,
        effect=effect,
        quantity=quantity,
        absolute=absolute,
        relative=absolute / size,
        uncertainty=math.hypot(*known) / size if len(known) == len(bars) else None,
    )


def to_best(scene: Scene, models: Sequence[Model], results: Mapping[str, Result]) -> tuple[Difference, ...]:
    """The difference of every solved model from the best solved one, in each quantity that both give.

    Parameters
    ----------
    scene : the scene.
    models : models of one kind of scene.
    results : results by the name of the model; at least one.
    """
    solved = [model for model in models if model.name in results]
    top = results[best_for(scene, solved).name]
    return tuple(
        _difference(results[model.name], top, quantity, None, top)
        for model in solved
        if model.name != top.model
        for quantity in kind_of(top).shared(results[model.name], top)
    )


def undecided(
    scene: Scene, models: Sequence[Model], results: Mapping[str, Result]
) -> dict[str, tuple[tuple[str, str], ...]]:
    """The pairs of solved models, by quantity, that the uncertainty of the best solved one does not distinguish.

    Parameters
    ----------
    scene : the scene.
    models : models of one kind of scene.
    results : results by the name of the model; at least one.
    """
    top = results[best_for(scene, [model for model in models if model.name in results]).name]
    errors: dict[str, dict[str, float]] = {}
    for one in to_best(scene, models, results):
        errors.setdefault(one.quantity, {top.model: 0.0})[one.model] = one.relative
    pairs = {
        quantity: tuple(
            (one, other)
            for one, other in combinations([model.name for model in models if model.name in found], 2)
            if not distinguished(found[one], found[other], relative_uncertainty(top, quantity))
        )
        for quantity, found in errors.items()
    }
    return {quantity: found for quantity, found in pairs.items() if found}


def effects(scene: Scene, models: Sequence[Model], results: Mapping[str, Result]) -> tuple[Difference, ...]:
    """The change by each effect: for each pair of solved models that differ by one effect, with it minus without it.

    Parameters
    ----------
    scene : the scene.
    models : models of one kind of scene.
    results : results by the name of the model; at least one.
    """
    solved = [model for model in models if model.name in results]
    top, absent = results[best_for(scene, solved).name], kind_of_scene(scene).absent(scene)
    return tuple(
        _difference(results[other.name], results[model.name], quantity, effect, top)
        for model in solved
        for other, effect in one_effect_away(model, solved, absent)
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


def pareto_front(chart: Sequence[Point], quantity: str, uncertainty: float | None = 0.0) -> tuple[Point, ...]:
    """The points for which no other point has both less cost and less error in a quantity, cheapest first.

    A point whose error cannot be distinguished from that of a cheaper point on the front, with a reference of this
    relative uncertainty (None if it is unknown), is left out.
    """
    front: list[Point] = []
    known = [point for point in chart if quantity in point.error]
    for point in sorted(known, key=lambda point: (point.cpu_s, point.error[quantity])):
        error = point.error[quantity]
        if not front or (
            error < front[-1].error[quantity] and distinguished(error, front[-1].error[quantity], uncertainty)
        ):
            front.append(point)
    return tuple(front)
