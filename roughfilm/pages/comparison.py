"""The page of a comparison: every model on one scene."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from roughfilm.figures.view import View
from roughfilm.pages.render import render
from roughfilm.rom.advice.advise import DEFAULT_TOLERANCE
from roughfilm.rom.advice.expected import error_lines
from roughfilm.rom.advice.stated import stated_errors
from roughfilm.rom.ladder.kind import Kind, Scene
from roughfilm.rom.ladder.model import Model, best
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.ladder.scene import scene_entries
from roughfilm.rom.studies.comparison import Difference, Point
from roughfilm.rom.studies.convergence import Convergence

LINKS = "https://doi.org/"


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
    plots: Mapping[str, str]
    pictures: Mapping[str, tuple[str, str]]


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
        cheapest={fraction: cheapest_within(report, fraction) for fraction in TOLERANCES},
        errors={name: stated_errors(result) for name, result in report.results.items()},
        error_lines={name: error_lines(report.kind, result) for name, result in report.results.items()},
        grouped=_by_quantity(report),
        sources=[(doi, LINKS + doi) for doi in sorted(sources)],
    )


def _by_quantity(report: Report) -> dict[str, list[str]]:
    """The pairs of models that cannot be distinguished, as text, by the name of the quantity in a sentence."""
    return {
        report.kind.compared[quantity]: [f"{one} and {other}" for one, other in pairs]
        for quantity, pairs in report.undecided.items()
    }
