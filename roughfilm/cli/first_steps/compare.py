"""roughfilm compare: every model that applies on one scene, in one report."""

from collections.abc import Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.table import Table

from roughfilm.batch.jobs import Job, jobs_of, run_all
from roughfilm.contact.foundation.errors import ConvergenceError
from roughfilm.contact.foundation.files import write_json
from roughfilm.contact.foundation.writing.kinds import PAGE, entries_from, refuse_to_replace
from roughfilm.figures.rendering import draw_apart, embedded
from roughfilm.figures.view import Plot, views
from roughfilm.ladder import models
from roughfilm.pages.comparison import Report, cheapest_within, write_comparison
from roughfilm.pages.render import write_figures
from roughfilm.rom.advice.advise import DEFAULT_TOLERANCE
from roughfilm.rom.advice.measured import with_measured_errors
from roughfilm.rom.advice.stated import percent, stated_errors
from roughfilm.rom.ladder.kind import Scene, kind_of, kind_of_scene
from roughfilm.rom.ladder.model import Model, best_for
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.ladder.scene import load_scene
from roughfilm.rom.ladder.store import STORED, as_entries
from roughfilm.rom.studies.comparison import (
    effects,
    points,
    relative_uncertainty,
    to_best,
    undecided,
    with_uncertainty,
)
from roughfilm.rom.studies.convergence import GRIDS, Convergence, ConvergenceKind, convergence
from roughfilm.terminal.console import (
    NOT_CONVERGED,
    AsJson,
    OutDirectory,
    Overrides,
    ScenePath,
    make_directory,
    print_json,
)
from roughfilm.terminal.output_file import alone, refuse_unwritable
from roughfilm.terminal.results import print_all, print_left_out, quantity_table, table_of
from roughfilm.words.cost import cost_in_words
from roughfilm.words.outside import outside_in_words
from roughfilm.words.summary import judgement, value_of

EXAMPLES = (
    "roughfilm compare scripts/examples/scenes/pocket.toml --out study",
    "roughfilm compare scripts/examples/scenes/journal.toml --out journal",
)

RESULTS = "results"


def command(
    scene: ScenePath,
    out: OutDirectory,
    set_: Overrides = None,
    grids: Annotated[
        int, typer.Option(min=GRIDS, max=4, help="Grids of the convergence study; the fourth is the finest and slow.")
    ] = GRIDS,
    as_json: AsJson = False,
) -> None:
    """Run every model that applies and write report.html, results (.h5) and figures."""
    read = load_scene(scene, set_ or ())
    page = out / "report.html"
    make_directory(out)
    refuse_unwritable((page, PAGE), (out / "chart.json", entries_from("reference")))
    ladder = models(read.kind)
    left_out = {model.name: reason for model in ladder if (reason := _reason_to_leave_out(model, read))}
    failed: dict[str, str] = {}
    jobs = jobs_of(read, [model for model in ladder if model.name not in left_out], out / RESULTS, grids)
    for job in jobs:
        refuse_to_replace(job.path, STORED)
    with alone(page, "comparison"):
        runs = run_all(jobs, failed)
        results = _finest(runs)
        absent = {**left_out, **failed}
        if not results:
            raise ConvergenceError("no model solved the scene: " + "; ".join(f"{k}: {v}" for k, v in absent.items()))
        report = _judge(read, ladder, results, [result for _, result in runs], absent, out)
        write_comparison(report, page)
    if as_json:
        print_json(_entries(report, out))
    else:
        tables = [_convergence_table(name, study) for name, study in report.convergence.items()]
        pairs = [
            f"{report.kind.compared[quantity]}: cannot be distinguished with this reference: "
            + ", ".join(f"{one} and {other}" for one, other in found)
            for quantity, found in report.undecided.items()
            if found
        ]
        tables_of_results = map(quantity_table, report.results.values())
        outside = [f"{name}: {outside_in_words(one.outside)}" for name, one in report.results.items() if one.outside]
        warnings = [f"warning: {warning}" for result in report.results.values() for warning in result.warnings]
        print_all((*tables_of_results, *tables, _error_table(report), *outside, *dict.fromkeys(warnings), *pairs))
    print_left_out(absent)
    if not as_json:
        print_all((_summary(report, out),))
    if failed:
        raise typer.Exit(NOT_CONVERGED)


def _reason_to_leave_out(model: Model, scene: Scene) -> str | None:
    fits, here = model.applies(scene), model.available()
    if not fits.applies:
        return fits.reason
    return None if here.available else here.detail


def _finest(runs: Sequence[tuple[Job, Result]]) -> dict[str, Result]:
    """The finest result of every model that solved the scene at its default resolution."""
    return {
        job.setting.model.name: max(
            (result for _, result in runs if result.model == job.setting.model.name),
            key=lambda result: result.numerics.resolution,
        )
        for job, _ in runs
        if job.setting.resolution is None
    }


def _error_table(report: Report) -> Table:
    """The cost and the errors of every model in the compared quantities, cheapest first."""
    compared = report.kind.shared(report.results[report.best])
    rows = []
    for name, result in report.results.items():
        errors = stated_errors(result)
        amounts = [errors[one].amount if one in errors else "unknown" for one in compared]
        rows.append((name, f"{result.numerics.cpu_s:.2g}", *amounts))
    heads = ("model", "CPU s", *(f"error in {report.kind.compared[one]}" for one in compared))
    table = table_of(heads, rows, title=f"errors measured against {report.best}, ± its own error", left=1)
    table.columns[0].no_wrap = True
    return table


def _summary(report: Report, out: Path) -> str:
    """The last line: the value of the best model, the cheapest model that is accurate enough, and the page."""
    first, top = next(iter(report.kind.compared)), report.results[report.best]
    cheapest = report.results[cheapest_within(report, DEFAULT_TOLERANCE)]
    tolerance, page = percent(DEFAULT_TOLERANCE), out / "report.html"
    value = f"{value_of(top, first)} by {top.model}"
    if top.outside:
        return f"{outside_in_words(top.outside)}; {value}; {cost_in_words(top)}; page: {page}"
    error = stated_errors(top).get(first)
    if error is not None and error.error > DEFAULT_TOLERANCE:
        return f"{value}; {judgement(top, first, DEFAULT_TOLERANCE)}; {cost_in_words(top)}; page: {page}"
    if cheapest is top:
        return f"{value}; no cheaper model is known to be within {tolerance}; {cost_in_words(top)}; page: {page}"
    verdict, costs = judgement(cheapest, first, DEFAULT_TOLERANCE), [*map(cost_in_words, (cheapest, top))]
    return f"{value}; {cheapest.model} is {verdict}; {' instead of '.join(costs)}; page: {page}"


def _convergence_table(model: str, study: Mapping[str, Convergence]) -> Table:
    title = f"{model} on grids {', '.join(map(str, next(iter(study.values())).grids))}"
    rows = [
        (quantity, one.order_text, f"{one.value:.5g}", f"{one.uncertainty:.1e}", one.kind)
        for quantity, one in study.items()
    ]
    return table_of(("quantity", "order", "value", "±", "kind"), rows, title=title, left=5)


def _judge(
    scene: Scene,
    ladder: tuple[Model, ...],
    results: Mapping[str, Result],
    runs: Sequence[Result],
    absent: Mapping[str, str],
    out: Path,
) -> Report:
    from roughfilm.figures.base import grid_convergence, speed_against_accuracy, svg  # matplotlib is slow to import

    view, titles = views()[scene.kind], kind_of_scene(scene).compared
    solved = [model for model in ladder if model.name in results]
    top = best_for(scene, solved)
    grids = {model.name: convergence(model, runs, scene) for model in solved}
    results = {name: _with_grids(result, grids[name]) for name, result in results.items()}
    results = with_measured_errors(scene, ladder, results)
    results = dict(sorted(results.items(), key=lambda item: item[1].numerics.cpu_s))
    chart = points(results[top.name], runs)
    studies = {model.name: grids[model.name] for model in solved if model.order_of(scene) and grids[model.name]}
    extrapolated = any(one.kind is ConvergenceKind.MONOTONE for study in studies.values() for one in study.values())
    floor = _uncertainty(results[top.name], grids[top.name])
    plots = {
        **view.plots(scene, results, top.name),
        "chart": Plot(svg=svg(speed_against_accuracy(chart, floor, titles, view))),
        **({"convergence": Plot(svg=svg(grid_convergence(studies, titles, view)))} if extrapolated else {}),
    }
    report = Report(
        scene=scene,
        kind=kind_of_scene(scene),
        view=view,
        models=ladder,
        results=results,
        absent=absent,
        best=top.name,
        to_best=to_best(scene, ladder, results),
        effects=effects(scene, ladder, results),
        undecided=undecided(scene, ladder, results),
        chart=chart,
        uncertainty=floor,
        convergence=studies,
        plots=plots,
        picture=_picture(top, results, view.drawing, out),
    )
    write_figures({name: plot.svg for name, plot in plots.items() if plot.svg}, out)
    write_json(_chart_entries(report), out / "chart.json")
    return report


def _with_grids(result: Result, study: Mapping[str, Convergence]) -> Result:
    """The result with the uncertainty by the grids, or by the run itself if that is larger.

    Grids that a study refines in some directions only do not show the error of the others.
    """
    return with_uncertainty(result, {name: one.uncertainty for name, one in study.items()})


def _uncertainty(result: Result, study: Mapping[str, Convergence]) -> dict[str, float]:
    """The uncertainty of each compared quantity over its scale, where it is known."""
    known = {name: relative_uncertainty(_with_grids(result, study), name) for name in kind_of(result).shared(result)}
    return {name: found for name, found in known.items() if found is not None}


def _entries(report: Report, out: Path) -> dict[str, Any]:
    return {
        **as_entries(report.results[report.best]),
        "models": [as_entries(result) for result in report.results.values()],
        "differences": [asdict(difference) for difference in report.to_best + report.effects],
        "cheapest_within_5_percent": cheapest_within(report, 0.05),
        "cheapest_within_10_percent": cheapest_within(report, 0.10),
        "undecided": {quantity: [*pairs] for quantity, pairs in report.undecided.items()},
        "convergence": {
            model: {quantity: asdict(one) for quantity, one in study.items()}
            for model, study in report.convergence.items()
        },
        "chart": _chart_entries(report),
        "absent": dict(report.absent),
        "report": str(out / "report.html"),
    }


def _chart_entries(report: Report) -> dict[str, Any]:
    reference = report.results[report.best]
    return {
        "reference": {
            "model": reference.model,
            "resolution": reference.numerics.resolution,
            "cpu_s": reference.numerics.cpu_s,
            "uncertainty": dict(report.uncertainty),
        },
        "points": [asdict(point) for point in report.chart],
        "machine": {**reference.provenance["machine"], "load_average": reference.provenance["load_average"]},
    }


def _picture(model: Model, results: Mapping[str, Result], drawing: str, out: Path) -> tuple[str, str, str] | None:
    """A model that resolves the flow, the best one if it does, and the address of its picture, or "" and the reason."""
    resolved = [name for name, result in results.items() if "vertices" in result.fields]
    if not resolved:
        return None
    name = model.name if model.name in resolved else resolved[-1]
    path = out / f"flow-{name}.png"
    drawn = draw_apart(drawing, out / RESULTS / f"{name}.h5", path)
    return name, embedded(path) if drawn.available else "", drawn.detail
