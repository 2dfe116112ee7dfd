"""The page of a comparison: every model on one scene."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from roughfilm.contact.foundation.units import Quantity
from roughfilm.figures.view import Plot, View
from roughfilm.pages.render import render
from roughfilm.rom.advice.advise import DEFAULT_TOLERANCE
from roughfilm.rom.advice.expected import error_warnings
from roughfilm.rom.advice.stated import percent as bound
from roughfilm.rom.advice.stated import stated_errors
from roughfilm.rom.ladder.kind import Kind, Scene
from roughfilm.rom.ladder.model import Model, best_for
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.ladder.scene import scene_entries
from roughfilm.rom.studies.comparison import Difference, Point, relative_uncertainty
from roughfilm.rom.studies.convergence import Convergence
from roughfilm.words.headline import STATED, headline, listed, whole
from roughfilm.words.numbers import percent
from roughfilm.words.outside import outside_in_words
from roughfilm.words.scales import Scales, scales_of

LINKS = "https://doi.org/"

MAX_CARDS = 5
"""Largest number of quantities at the top of the page."""

MIN_CHANGE, MAX_CHANGE = 5e-5, 10.0
"""Change over the whole between which it is given in per cent; a whole near zero is no measure."""


@dataclass(frozen=True, kw_only=True)
class Report:
    """The content of the page; ``results`` have their errors and are in order of their CPU time."""

    scene: Scene
    kind: Kind
    view: View
    models: tuple[Model, ...]
    results: Mapping[str, Result]
    absent: Mapping[str, str]
    best: str
    to_best: tuple[Difference, ...]
    effects: tuple[Difference, ...]
    undecided: Mapping[str, tuple[tuple[str, str], ...]]
    chart: tuple[Point, ...]
    uncertainty: Mapping[str, float]
    convergence: Mapping[str, Mapping[str, Convergence]]
    plots: Mapping[str, Plot]
    picture: tuple[str, str, str] | None


TOLERANCES = (0.01, DEFAULT_TOLERANCE, 0.10)
"""Tolerances for which the page names the cheapest model."""


def cheapest_within(report: Report, fraction: float) -> str:
    """The model with the least CPU time whose stated error in all compared quantities is at most a fraction.

    Without such a model it is the reference itself, whatever its error.
    """
    compared = report.kind.shared(report.results[report.best])
    worst = {report.best: 0.0}
    for name, result in report.results.items():
        if name != report.best:
            errors = stated_errors(result)
            worst[name] = max(
                (errors[one].error if one in errors else math.inf for one in compared),
                default=math.inf,
            )
    enough = [name for name, error in worst.items() if error <= fraction]
    return min(enough, key=lambda name: report.results[name].numerics.cpu_s)


def write_comparison(report: Report, path: Path) -> None:
    """Write the page; InputError if it cannot be written."""
    best_result = report.results[report.best]
    sources = {doi for result in report.results.values() for doi in result.provenance["sources"]}
    scales = scales_of([best_result])
    study = report.convergence.get(report.best, {}).get(next(iter(report.kind.shared(best_result)), ""))
    own = best_result.quantities[next(iter(report.kind.compared))].uncertainty
    origin = report.view.grids if study is not None and own == study.uncertainty else STATED
    head = headline(report.scene, best_result, report.models, scales, origin)
    render(
        report.view.page,
        path,
        report=report,
        view=report.view,
        compared={name: report.kind.compared[name] for name in report.kind.shared(best_result)},
        reduced=report.best != best_for(report.scene, _applying(report)).name,
        best=best_result,
        headline=head,
        cards=_cards(report, scales, head.quantity),
        rows=_rows(report, scales),
        error_rows=_error_rows(report),
        effects=[sorted(frozenset[str]().union(*_kept(report).values())), _kept(report)],
        changes=_changes(report, scales),
        convergence=_convergence(report, scales),
        warnings=_warnings(report),
        place=[*report.results].index(report.best),
        entries=scene_entries(report.scene),
        cheapest={fraction: cheapest_within(report, fraction) for fraction in TOLERANCES},
        grouped=_groups(report),
        sources=[(doi, LINKS + doi) for doi in sorted(sources)],
    )


def _applying(report: Report) -> list[Model]:
    return [model for model in report.models if model.applies(report.scene).applies]


def _solved(report: Report) -> list[Model]:
    """The models with a result, in order of their CPU time."""
    named = {model.name: model for model in report.models}
    return [named[name] for name in report.results]


def _kept(report: Report) -> dict[str, frozenset[str]]:
    """The effects of the scene that each solved model keeps."""
    absent = report.kind.absent(report.scene)
    return {model.name: frozenset(map(str, model.keeps - absent)) for model in _solved(report)}


def _shown(report: Report, names: Sequence[str], known: Mapping[str, Quantity]) -> list[tuple[str, str]]:
    """The known quantities that stand for these names, each of the whole bearing, with their titles."""
    variants = ([f"bearing_{name}", name, f"{name}_per_width"] for name in names)
    found = dict.fromkeys(next((one for one in three if one in known), "") for three in variants)
    return [(name, report.kind.reported.get(name, name)) for name in found if name]


def _of_whole(report: Report, quantity: str) -> tuple[str, float]:
    """The quantity of the whole that stands for a compared one, and its value over that one."""
    top = report.results[report.best].quantities
    name = whole(quantity, report.results[report.best])
    return (name, top[name].value / top[quantity].value) if top[quantity].value else (quantity, 1.0)


def _of_model(report: Report, result: Result, name: str) -> Quantity | None:
    """A quantity of a result; of an infinitely wide film that per width, for the width of the bearing."""
    top, base = report.results[report.best].quantities, name.removeprefix("bearing_")
    narrow = f"{base}_per_width"
    if name in result.quantities or not all(narrow in one for one in (result.quantities, top)) or name not in top:
        return result.quantities.get(name)
    ratio = top[name].value / top[narrow].value if top[narrow].value else math.nan
    one = result.quantities[narrow]
    bar = None if one.uncertainty is None else one.uncertainty * abs(ratio)
    return Quantity(value=one.value * ratio, unit=top[name].unit, uncertainty=bar)


def _cards(report: Report, scales: Scales, first: str) -> list[tuple[str, str, str]]:
    """Value, uncertainty and title of the quantities at the top of the page; those near 0 are left out."""
    cards, known = [], report.results[report.best].quantities
    for name, title in _shown(report, report.view.cards, known):
        one = known[name]
        scale = scales(name, one.unit)
        if name != first and abs(one.value) > scale.negligible:
            value, _, bar = scale.of(one).partition(" ± ")
            uncertainty = {"": "", "?": "uncertainty unknown"}.get(bar, f"± {bar} {scale.unit}".strip())
            cards.append((f"{value} {scale.unit}".strip(), uncertainty, title))
    return cards[:MAX_CARDS]


def _rows(report: Report, scales: Scales) -> list[tuple[str, list[tuple[str, str]]]]:
    """The rows of the table: the title with its unit, and value and uncertainty by every model; no row of zeros."""
    rows, top = [], report.results[report.best]
    known = {name: one for result in (*report.results.values(), top) for name, one in result.quantities.items()}
    for name, title in _shown(report, report.view.rows, known):
        scale = scales(name, known[name].unit)
        cells = []
        for result in report.results.values():
            one = _of_model(report, result, name)
            value, _, bar = ("–", "", "") if one is None else scale.of(one).partition(" ± ")
            cells.append((value, bar))
        if any(value.strip("0.") not in ("", "–") for value, _ in cells):
            rows.append((scale.label(title), cells))
    return rows


def _error_rows(report: Report) -> list[tuple[str, list[tuple[str, str]]]]:
    """The rows of the errors in the compared quantities, by every model: difference and error of the best one."""
    rows = []
    for name in report.kind.shared(report.results[report.best]):
        cells = []
        for result in report.results.values():
            error = stated_errors(result).get(name) if name in result.quantities else None
            if result.model == report.best:
                own = relative_uncertainty(result, name)
                numerical = "unknown" if own is None else bound(own)
                cells.append(("", numerical if error is None else error.amount))
                continue
            value, _, bar = ("–" if error is None else error.amount).partition(" ± ")
            cells.append((value, bar))
        rows.append((report.kind.compared[name], cells))
    return rows


def _changes(report: Report, scales: Scales) -> tuple[list[str], list[tuple[str, str, str, list[tuple[str, str]]]]]:
    """The heads of the table of effects, and its rows: effect, models, and the change of each compared quantity."""
    top = report.results[report.best]
    shown = {name: _of_whole(report, name) for name in report.kind.shared(top)}
    scale_of = {name: scales(one, top.quantities[one].unit) for name, (one, _) in shown.items()}
    found: dict[tuple[str, str, str], dict[str, tuple[str, str]]] = {}
    for one in report.effects:
        ratio = shown[one.quantity][1]
        size = abs(ratio) * report.kind.scale_of(top, one.quantity)
        bar = math.inf if one.uncertainty is None else one.uncertainty * size
        number = scale_of[one.quantity].number(one.absolute * ratio, bar)
        sign = "+" if one.absolute * ratio > 0 and number.lstrip("(0.± ") and number[0] not in "−(" else ""
        relative = percent(one.relative) if MIN_CHANGE < abs(one.relative) < MAX_CHANGE else ""
        key = (str(one.effect), one.other, one.model)
        found.setdefault(key, {})[one.quantity] = (sign + number, relative)
    heads = [scale_of[name].label(report.kind.compared[name]) for name in shown]
    return heads, [(*key, [cells.get(name, ("–", "")) for name in shown]) for key, cells in found.items()]


def _convergence(report: Report, scales: Scales) -> list[dict[str, Any]]:
    """The rows of the grid convergence, in the units of the page."""
    top, rows = report.results[report.best].quantities, []
    for model, studies in report.convergence.items():
        for quantity, study in studies.items():
            name, ratio = _of_whole(report, quantity)
            scale = scales(name, top[name].unit)
            least = scale.negligible
            shown = [0.0 if abs(value * ratio) <= least else value * ratio for value in (*study.values, study.value)]
            values = [f"{value / scale.factor:.6g}".replace("-", "−") for value in shown]
            rows.append(
                {
                    "model": model,
                    "quantity": scale.label(report.kind.compared[quantity]),
                    "grids": [*zip(study.grids, values[:-1], strict=True)],
                    "order": study.order_text or "–",
                    "value": values[-1],
                    "uncertainty": f"{study.uncertainty * abs(ratio) / scale.factor:.2g}",
                    "kind": study.kind,
                }
            )
    return rows


def _warnings(report: Report) -> list[tuple[str, str]]:
    """What is outside the range of each model, and the warnings, without those on errors, which the table shows."""
    return [(name, outside_in_words(result.outside)) for name, result in report.results.items() if result.outside] + [
        (name, warning)
        for name, result in report.results.items()
        for warning in result.warnings
        if warning not in error_warnings(report.kind, name, stated_errors(result))
    ]


def _groups(report: Report) -> dict[str, list[str]]:
    """The models that cannot be distinguished, as text, by the name of the quantity in a sentence.

    Models in order of their error that are near each other in pairs form a group.
    """
    found: dict[str, list[str]] = {}
    for quantity, pairs in report.undecided.items():
        near = {frozenset(pair) for pair in pairs}
        sizes = {report.best: 0.0} | {
            one.model: abs(one.relative) for one in report.to_best if one.quantity == quantity
        }
        ordered = sorted(sizes, key=lambda name: sizes[name])
        groups: list[list[str]] = []
        for start in range(len(ordered)):
            group = [ordered[start]]
            for name in ordered[start + 1 :]:
                if all(frozenset((name, other)) in near for other in group):
                    group.append(name)
            if len(group) > 1 and not any(set(group) <= set(other) for other in groups):
                groups.append(group)
        in_order = [[name for name in (model.name for model in report.models) if name in group] for group in groups]
        found[report.kind.compared[quantity]] = [listed(group) for group in in_order]
    return found
