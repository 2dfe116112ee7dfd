"""The page of a comparison: every model on one scene."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from roughfilm.figures.view import View
from roughfilm.pages.render import render
from roughfilm.rom.ladder.kind import Kind, Scene
from roughfilm.rom.ladder.model import Model, best
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.ladder.scene import scene_entries
from roughfilm.rom.studies.comparison import Difference, Point
from roughfilm.rom.studies.convergence import Convergence

LINKS = "https://doi.org/"


@dataclass(frozen=True, kw_only=True)
class Report:
    """The content of the page."""

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
    plots: Mapping[str, str]
    pictures: Mapping[str, tuple[str, str]]


def cheapest_within(report: Report, fraction: float) -> str:
    """The model with the least CPU time whose error in all compared quantities is at most a fraction.

    The error is |difference| + uncertainty of the reference, which is the best model. Without such a model it is the
    reference itself, whatever its uncertainty.
    """
    top = report.results[report.best]
    compared = report.kind.shared(top)
    floor = {name: report.uncertainty.get(name, math.inf) for name in compared}
    worst = {
        name: 0.0 if compared == report.kind.shared(top, result) else math.inf
        for name, result in report.results.items()
    }
    for one in report.to_best:
        worst[one.model] = max(worst[one.model], abs(one.relative) + floor[one.quantity])
    enough = [name for name, error in worst.items() if error <= fraction]
    return min(enough, key=lambda name: report.results[name].numerics.cpu_s)


def write_comparison(report: Report, path: Path) -> None:
    """Write the page; InputError if it cannot be written."""
    sources = {doi for result in report.results.values() for doi in result.provenance["sources"]}
    render(
        report.view.page,
        path,
        report=report,
        view=report.view,
        compared=report.kind.compared,
        reduced=report.best != best([model for model in report.models if model.applies(report.scene).applies]).name,
        best=report.results[report.best],
        entries=scene_entries(report.scene),
        cheapest={fraction: cheapest_within(report, fraction) for fraction in (0.01, 0.10)},
        known=max(report.uncertainty.get(name, math.inf) for name in report.kind.shared(report.results[report.best])),
        infinity=math.inf,
        grouped=_by_quantity(report),
        differences=_by_model(report.to_best),
        sources=[(doi, LINKS + doi) for doi in sorted(sources)],
    )


def _by_model(differences: tuple[Difference, ...]) -> dict[str, dict[str, Difference]]:
    table: dict[str, dict[str, Difference]] = {}
    for difference in differences:
        table.setdefault(difference.model, {})[difference.quantity] = difference
    return table


def _by_quantity(report: Report) -> dict[str, list[str]]:
    """The pairs of models that cannot be distinguished, as text, by the name of the quantity in a sentence."""
    return {
        report.kind.compared[quantity]: [f"{one} and {other}" for one, other in pairs]
        for quantity, pairs in report.undecided.items()
    }
