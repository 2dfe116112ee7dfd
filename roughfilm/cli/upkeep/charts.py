"""roughfilm charts: speed against accuracy of every model and of other solvers, for families of scenes."""

from pathlib import Path
from typing import Annotated, Any

import typer
from rich.table import Table

from roughfilm.batch.directory import alone
from roughfilm.charts.families import FAMILIES
from roughfilm.charts.judgement import WITHIN, Chart, columns_of, entries_of, judged
from roughfilm.charts.store import answers
from roughfilm.contact.foundation.errors import ConvergenceError, InputError, UnavailableError
from roughfilm.contact.foundation.files import write_json
from roughfilm.contact.foundation.writing.kinds import JSON, PAGE, PICTURE
from roughfilm.figures.rendering import embedded
from roughfilm.ladder import models
from roughfilm.pages.render import render, write_figures
from roughfilm.rom.ladder.provenance import circumstances
from roughfilm.rom.studies.table import write_csv
from roughfilm.terminal.console import AsJson, OutDirectory, make_directory, print_json, progress_bar
from roughfilm.terminal.output_file import refuse_unwritable
from roughfilm.terminal.results import print_all, print_left_out, table_of, written
from roughfilm.words.scales import scale_for

EXAMPLES = (
    "roughfilm charts --out charts",
    "roughfilm charts --family cells --out cells",
)


def command(
    out: OutDirectory,
    family: Annotated[
        list[str] | None,
        typer.Option(metavar="NAME", help=f"Chart only this family; repeatable: {', '.join(FAMILIES)}."),
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Chart CPU time against error for every model and resolution: charts.html, .json, .csv, .png and an .svg each."""
    from roughfilm.charts.figures import chart_figure, overview  # matplotlib is slow to import

    names = list(FAMILIES) if not family else list(dict.fromkeys(family))
    for name in names:
        if name not in FAMILIES:
            raise InputError(f"--family: got {name!r}; it must be one of {', '.join(FAMILIES)}")
    make_directory(out)
    refuse_unwritable((out / "charts.html", PAGE), (out / "charts.png", PICTURE), (out / "charts.json", JSON))
    with alone(out):
        charts, without = measured(names, out)
        if not charts:
            raise ConvergenceError("no family has a truth: " + "; ".join(f"{k}: {v}" for k, v in without.items()))
        figures = {chart.family.name.replace(" ", "-"): chart_figure(chart) for chart in charts}
        write_figures(figures, out)
        overview(charts, out / "charts.png")
        entries = {**circumstances(), "families": [entries_of(chart) for chart in charts], "without_truth": without}
        write_csv(columns_of(charts), out / "charts.csv")
        write_json(entries, out / "charts.json")
        render(
            "charts.html.j2",
            out / "charts.html",
            charts=list(zip(charts, figures.values(), strict=True)),
            entries=entries,
            within=WITHIN,
            without=[*without],
            picture=embedded(out / "charts.png") if len(charts) > 1 else None,
            truths={chart.family.name: _truth(chart) for chart in charts},
            taken=_measured_span(charts),
        )
    if as_json:
        print_json(entries)
    else:
        print_all(map(_table, charts))
    print_left_out(without)
    for chart in charts:
        reasons = {**chart.absent, **chart.answers.failed}
        print_left_out({f"{chart.family.name}: {name}": reason for name, reason in reasons.items()})
    if not as_json:
        count = sum(len(chart.points) for chart in charts)
        answer = f"{count} points of speed against accuracy, in {len(charts)} of {len(names)} families"
        print_all([written(answer, out / "charts.html", out / "charts.csv")])


def measured(names: list[str], out: Path) -> tuple[list[Chart], dict[str, str]]:
    """The charts of these families, and for the others the reason why they have none."""
    ladder = models()
    families = [FAMILIES[name](ladder) for name in names]
    charts, without, spent = [], {}, 0.0
    with progress_bar(sum(family.cost for family in families)) as advance:
        for family in families:

            def step(done: float, words: str, spent: float = spent) -> None:
                advance(spent + done, words)

            try:
                stored = out / "measured" / f"{family.name.replace(' ', '_')}.json"
                charts.append(judged(family, answers(family, stored, step), family.absent()))
            except (ConvergenceError, UnavailableError) as error:
                without[family.name] = str(error)
            except (KeyboardInterrupt, SystemExit) as stop:
                stop.add_note("stopped; the same command goes on")
                raise
            spent += family.cost
    return charts, without


def _measured_span(charts: list[Chart]) -> dict[str, Any]:
    """First and last time of measurement, least and greatest load of the machine, and the commits."""
    taken = [one for chart in charts for one in chart.answers.taken.values()]
    return {
        "first": min(one["created"] for one in taken),
        "last": max(one["created"] for one in taken),
        "least_load": min(one["load_average"] for one in taken),
        "greatest_load": max(one["load_average"] for one in taken),
        "commits": sorted({one["commit"] for one in taken}),
        "cpu_s": sum(point.cpu_s for chart in charts for point in chart.points),
    }


def _truth(chart: Chart) -> str:
    """The reference value with its uncertainty and unit."""
    value = chart.truth.value
    return scale_for(chart.family.unit, abs(value)).text(value, chart.truth.uncertainty * abs(value))


def _table(chart: Chart) -> Table:
    """The Pareto front of a family."""
    title = f"{chart.family.name}: {chart.family.quantity}, known to {chart.truth.uncertainty:.1e}"
    rows = [
        (point.model, str(point.resolution), f"{point.cpu_s:.3g}", f"{chart.error(point):.2g}") for point in chart.front
    ]
    return table_of(("on the front", "resolution", "CPU time, s", "error"), rows, title=title, left=1)
