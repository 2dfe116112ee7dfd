"""The errors of a result by the fitted laws and by measurement, which commands, pages and files take from here."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import chain

from roughfilm.contact.foundation.timing import claimed_costs, imports_apart, one_time
from roughfilm.rom.advice.estimates import AdviceTask, a_priori
from roughfilm.rom.advice.laws import lawful, table
from roughfilm.rom.advice.stated import BY_CORRECTION, BY_LAWS, ENTRY, StatedError, entries_of_errors, stated_errors
from roughfilm.rom.ladder.kind import Kind, Scene, kind_of_scene
from roughfilm.rom.ladder.model import Model
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.result import Result

MAX_ERROR_WITHOUT_WARNING = 0.1
"""Stated error of a compared quantity above which a result has a warning."""


def with_errors(
    result: Result,
    scene: Scene,
    model: Model,
    models: Sequence[Model],
    *,
    known: Mapping[str, StatedError] | None = None,
) -> Result:
    """The result with the errors of its model in its quantities, and a warning where one is large.

    An error is that of ``known`` where it has one, such as a measured one, otherwise that of the fitted laws. Outside
    the range of its model a result has no errors: they are unknown. Every command, page and file takes the errors from
    the result, so that they agree. The CPU time of the errors is one of the one-time costs of the result.

    Parameters
    ----------
    result : the result; errors that it has already, with their warning, are replaced.
    scene : the scene.
    model : the model of the result.
    models : all models for this kind of scene.
    known : by quantity, the errors that other runs or the advice give.
    """
    kind = kind_of_scene(scene)
    with one_time("errors"), imports_apart():
        expected = expected_errors(scene, model, result, models)
    errors = {name: error for name, error in expected.items() if name in result.quantities}
    stated = {} if result.outside else known or {}
    errors |= {name: error for name, error in stated.items() if math.isfinite(error.error)}
    errors = _with_ratios(kind, result, _with_input(kind, scene, errors))
    before = error_warnings(kind, model.name, stated_errors(result))
    spent = [result.numerics.one_time, claimed_costs()]
    costs = {name: sum(one.get(name, 0.0) for one in spent) for name in dict.fromkeys(chain(*spent))}
    return replace(
        result,
        numerics=replace(result.numerics, one_time=costs),
        expected_error={name: one.error for name, one in errors.items()},
        provenance={**result.provenance, ENTRY: entries_of_errors(errors)},
        warnings=(
            *(warning for warning in result.warnings if warning not in before),
            *error_warnings(kind, model.name, errors),
        ),
    )


def expected_errors(scene: Scene, model: Model, result: Result, models: Sequence[Model]) -> dict[str, StatedError]:
    """The bounds by the fitted laws of the error of a result over the size of each quantity.

    The uncertainty that the result states replaces the law of the error by the resolution, unless a promise contains
    that error, and the bound is at least this uncertainty.

    Parameters
    ----------
    scene : the scene.
    model : the model of the result.
    result : the result; only its quantities and its resolution are used.
    models : all models for this kind of scene.

    Returns
    -------
    dict
        The error that 95 of 100 scenes do not exceed, for each quantity whose laws hold for the scene and the result;
        none outside the range of the model.
    """
    if result.outside:
        return {}
    kind = kind_of_scene(scene)
    applying = [other for other in models if other.applies(scene).applies]
    errors: dict[str, StatedError] = {}
    for quantity, title in kind.titles.items() if any(other.name == model.name for other in applying) else ():
        if quantity in result.quantities and kind.outside_laws(scene, result, quantity):
            continue
        omitted = kind.omitted(scene, model, quantity)
        task = AdviceTask(
            scene=scene,
            kind=kind,
            models=applying,
            quantity=quantity,
            title=title,
            table=lawful(table(), kind.names_of_laws, holds=kind.lawful),
            numbers=kind.numbers(scene),
            run=lambda other, grid: other.solve(scene, Request(resolution=grid)),
            omitted={} if omitted is None else {model.name: omitted},
        )
        own = task.uncertainty(result) if quantity in result.quantities else None
        estimate = a_priori(task, model, result.numerics.resolution, own)
        if estimate is not None and estimate.sure:
            bound = task.correction(result) if quantity in result.quantities else None
            if bound is not None:
                estimate = replace(estimate, error=bound, source=BY_CORRECTION)
            stated = estimate.stated(omitted)
            stated = replace(stated, error=max(stated.error, own or 0.0))
            errors |= {quantity: stated} if math.isfinite(stated.error) else {}
    return errors


def _with_input(kind: Kind, scene: Scene, errors: Mapping[str, StatedError]) -> dict[str, StatedError]:
    """The errors with those by the input, which add; an error measured against another model has the same input."""
    found = dict(errors)
    for name, error in errors.items():
        own = kind.of_input(scene, name) if error.difference is None else None
        if own is not None and math.isfinite(own.part):
            source = own.source if own.part > error.error else error.source
            found[name] = StatedError(error=error.error + own.part, source=source)
        elif own is not None:
            del found[name]
    return found


def _with_ratios(kind: Kind, result: Result, errors: Mapping[str, StatedError]) -> dict[str, StatedError]:
    """The errors, where that of a ratio of two quantities agrees with theirs.

    A ratio of quantities with the relative errors e and f has an error of at most (1 + e)/(1 - f) - 1. It has no error
    where one of them is unknown, or where the bound exceeds 1 and says nothing.
    """
    found = dict(errors)
    for name, (above, below) in kind.ratios.items():
        if name not in result.quantities or (name in errors and errors[name].source != BY_LAWS):
            continue
        own = errors[name].error if name in errors else math.inf
        one, other = (_relative(kind, result, part, errors) for part in (above, below))
        bound = min(own, (1 + one) / (1 - other) - 1 if other < 1 else math.inf)
        found.pop(name, None)
        if bound <= 1:
            sources = {errors[part].source for part in (above, below) if part in errors}
            source = BY_LAWS if bound == own or len(sources) != 1 else sources.pop()
            found[name] = StatedError(error=bound, source=source)
    return found


def _relative(kind: Kind, result: Result, name: str, errors: Mapping[str, StatedError]) -> float:
    """The error of a quantity over its value; infinite if it is unknown."""
    if name not in errors or name not in result.quantities or result.quantities[name].value == 0:
        return math.inf
    return errors[name].error * kind.scale_of(result, name) / abs(result.quantities[name].value)


def error_warnings(kind: Kind, model: str, errors: Mapping[str, StatedError]) -> tuple[str, ...]:
    """The warning where the error of a compared quantity is large; none if all are small or unknown."""
    large = {name: one for name, one in errors.items() if one.error > MAX_ERROR_WITHOUT_WARNING}
    parts = [f"{title} {large[name].words}" for name, title in kind.compared.items() if name in large]
    if not parts:
        return ()
    return (f"{model} has a large error here: {', '.join(parts)}",)


def error_lines(kind: Kind, result: Result) -> list[str]:
    """The errors of a result for people, one text for each source, such as "load 1 %, friction 2 % (<source>)".

    A compared quantity without an error is "unknown". Of a result with temperatures, a quantity that has the error of
    another one is named with it.
    """
    errors = {name: one for name, one in stated_errors(result).items() if name in result.quantities}
    heated = any(one.unit == "degC" for one in result.quantities.values())
    own = {kind.named[name] for name in errors.keys() & kind.named.keys()}
    by_source: dict[str, list[str]] = {}
    for name, title in kind.named.items():
        if name in errors:
            rise = " of its rise" if result.quantities[name].unit == "degC" else ""
            alike = [kind.alike[name]] if heated and name in kind.alike and kind.alike[name] not in own else []
            titles = " and ".join([title, *alike])
            by_source.setdefault(errors[name].source, []).append(f"{titles} {errors[name].amount}{rise}")
    unknown = [title for name, title in kind.titles.items() if name in _expected(kind, result) - errors.keys()]
    texts = [f"{', '.join(parts)} ({source})" for source, parts in by_source.items()]
    return texts + ([f"{', '.join(unknown)} unknown"] if unknown else [])


def _expected(kind: Kind, result: Result) -> set[str]:
    """The quantities of a result whose error a reader expects: those compared, ratios and temperatures."""
    degrees = {name for name, one in result.quantities.items() if one.unit == "degC"}
    return {*kind.shared(result), *(name for name in kind.ratios if name in result.quantities), *degrees}
