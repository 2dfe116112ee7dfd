"""roughfilm charts: speed against accuracy of every model and of other people's solvers, family by family."""

import json
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.markup import escape
from rich.table import Table

from roughfilm.batch.directory import alone
from roughfilm.charts.families import FAMILIES
from roughfilm.charts.judgement import WITHIN, Chart, columns_of, entries_of, judged
from roughfilm.charts.store import answers
from roughfilm.contact.foundation.errors import ConvergenceError, InputError, UnavailableError
from roughfilm.contact.foundation.files import replacing
from roughfilm.figures.rendering import embedded
from roughfilm.ladder import models
from roughfilm.pages.render import render, write_figures
from roughfilm.rom.ladder.provenance import circumstances
from roughfilm.rom.studies.table import write_csv
from roughfilm.terminal.console import AsJson, in_one_line, make_directory, messages, output, print_json, progress_bar


@in_one_line
def command(
    out: Annotated[Path, typer.Option(help="The page and its numbers go here; what was measured is used again.")],
    family: Annotated[
        list[str] | None,
        typer.Option(metavar="NAME", help=f"Chart this one alone; repeatable: {', '.join(FAMILIES)}."),
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
    with alone(out):
        charts, without = measured(names, out)
        if not charts:
            raise ConvergenceError("no family has a truth: " + "; ".join(f"{k}: {v}" for k, v in without.items()))
        figures = {chart.family.name.replace(" ", "-"): chart_figure(chart) for chart in charts}
        write_figures(figures, out)
        overview(charts, out / "charts.png")
        entries = {**circumstances(), "families": [entries_of(chart) for chart in charts], "without_truth": without}
        write_csv(columns_of(charts), out / "charts.csv")
        with replacing(out / "charts.json") as path:
            path.write_text(json.dumps(entries, indent=1) + "\n", encoding="utf-8")
        render(
            "charts.html.j2",
            out / "charts.html",
            charts=list(zip(charts, figures.values(), strict=True)),
            entries=entries,
            within=WITHIN,
            picture=embedded(out / "charts.png"),
            taken=_span(charts),
        )
    if as_json:
        print_json(entries)
    else:
        for chart in charts:
            output.print(_table(chart))
        output.print(f"page: {escape(str(out / 'charts.html'))}", soft_wrap=True)
    for name, reason in without.items():
        messages.print(f"[yellow]left out:[/] {name}: {escape(reason)}", soft_wrap=True)
    for chart in charts:
        for name, reason in {**chart.absent, **chart.answers.failed}.items():
            messages.print(f"[yellow]left out:[/] {chart.family.name}: {name}: {escape(reason)}", soft_wrap=True)


def measured(names: list[str], out: Path) -> tuple[list[Chart], dict[str, str]]:
    """The charts of these families, and why the others have none."""
    ladder = models()
    families = [FAMILIES[name](ladder) for name in names]
    charts, without, spent = [], {}, 0.0
    with progress_bar(sum(family.cost for family in families)) as advance:
        for family in families:

            def step(done: float, words: str, spent: float = spent) -> None:
                advance(spent + done, words)

            try:
                found = answers(family, out / "measured" / f"{family.name.replace(' ', '_')}.json", step)
                charts.append(judged(family, found, family.absent()))
            except (ConvergenceError, UnavailableError) as error:
                without[family.name] = str(error)
            except (KeyboardInterrupt, SystemExit) as stop:
                stop.add_note("stopped; the same command goes on")
                raise
            spent += family.cost
    return charts, without


def _span(charts: list[Chart]) -> dict[str, Any]:
    """When the first and the last point were measured, under which loads of the machine, by which commits."""
    taken = [one for chart in charts for one in chart.answers.taken.values()]
    return {
        "first": min(one["created"] for one in taken),
        "last": max(one["created"] for one in taken),
        "least_load": min(one["load_average"] for one in taken),
        "greatest_load": max(one["load_average"] for one in taken),
        "commits": sorted({one["commit"] for one in taken}),
        "cpu_s": sum(point.cpu_s for chart in charts for point in chart.points),
    }


def _table(chart: Chart) -> Table:
    """The front of a family."""
    title = f"{chart.family.name}: {chart.family.quantity}, known to {chart.truth.uncertainty:.1e}"
    table = Table("on the front", "resolution", "CPU time, s", "error", title=title)
    for point in chart.front:
        table.add_row(point.model, str(point.resolution), f"{point.cpu_s:.3g}", f"{chart.error(point):.2g}")
    return table
