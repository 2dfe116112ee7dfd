"""One self-contained HTML page that a person would rather look at than read."""

import base64
from collections.abc import Mapping
from dataclasses import dataclass
from importlib import resources
from pathlib import Path

import jinja2

from contact.files import replacing
from rom.comparison import Difference, Point
from rom.convergence import Convergence
from rom.ladder import Model
from rom.result import Result
from rom.scene import Scene, scene_entries

LINKS = "https://doi.org/"


@dataclass(frozen=True, kw_only=True)
class Picture:
    """A picture of one model's flow, or why there is none."""

    model: str
    path: Path | None
    reason: str


@dataclass(frozen=True, kw_only=True)
class Report:
    """Everything the page shows."""

    scene: Scene
    models: tuple[Model, ...]
    results: Mapping[str, Result]
    absent: Mapping[str, str]
    best: str
    to_best: tuple[Difference, ...]
    effects: tuple[Difference, ...]
    chart: tuple[Point, ...]
    uncertainty: Mapping[str, float]
    convergence: Mapping[str, Mapping[str, Convergence]]
    plots: Mapping[str, str]
    pictures: tuple[Picture, ...]


def cheapest_within(report: Report, part: float) -> str:
    """The model with the least CPU time whose load and friction are within ``part`` of the best rung's."""
    worst: dict[str, float] = {report.best: 0.0}
    for difference in report.to_best:
        worst[difference.model] = max(worst.get(difference.model, 0.0), abs(difference.relative))
    enough = [name for name, error in worst.items() if error <= part]
    return min(enough, key=lambda name: report.results[name].numerics.cpu_s)


def write_report(report: Report, path: Path) -> None:
    """Write the page; InputError if it cannot be written."""
    source = resources.files("scripts").joinpath("report.html.j2").read_text(encoding="utf-8")
    environment = jinja2.Environment(autoescape=True, undefined=jinja2.StrictUndefined, trim_blocks=True)
    environment.filters.update(percent=_percent, seconds=_seconds, number=_number, digits=_digits, si=_si, micro=_micro)
    page = environment.from_string(source).render(
        report=report,
        best=report.results[report.best],
        entries=scene_entries(report.scene),
        cheapest={part: cheapest_within(report, part) for part in (0.01, 0.10)},
        differences=_by_model(report.to_best),
        pictures=[(picture, _embedded(picture.path)) for picture in report.pictures],
        sources=_sources(report),
    )
    with replacing(path) as scratch:
        scratch.write_text(page, encoding="utf-8")


def _by_model(differences: tuple[Difference, ...]) -> dict[str, dict[str, Difference]]:
    table: dict[str, dict[str, Difference]] = {}
    for difference in differences:
        table.setdefault(difference.model, {})[difference.quantity] = difference
    return table


def _sources(report: Report) -> list[tuple[str, str]]:
    names = {doi for result in report.results.values() for doi in result.provenance["sources"]}
    return [(doi, LINKS + doi) for doi in sorted(names)]


def _embedded(path: Path | None) -> str:
    return "" if path is None else "data:image/png;base64," + base64.b64encode(path.read_bytes()).decode("ascii")


def _percent(part: float) -> str:
    percent = 100 * part
    if abs(percent) < 1e-3:
        return "0 %"
    return f"{percent:+.0f} %" if abs(percent) >= 99.5 else f"{percent:+.2g} %"


def _seconds(value: float) -> str:
    return f"{value * 1e3:.2g} ms" if value < 0.1 else f"{value:.2g} s"


def _number(value: float) -> str:
    return "0" if abs(value) < 5e-5 else f"{value:.4g}"


def _digits(value: float) -> str:
    return "0" if abs(value) < 5e-7 else f"{value:.6g}"


def _micro(value: float) -> str:
    return f"{value * 1e3:.4g} mm" if value >= 1e-3 else f"{value * 1e6:.4g} µm"


def _si(value: float) -> str:
    for factor, prefix in ((1e9, "G"), (1e6, "M"), (1e3, "k")):
        if abs(value) >= factor:
            return f"{value / factor:.4g} {prefix}Pa"
    return f"{value:.4g} Pa"
