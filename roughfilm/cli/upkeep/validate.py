"""roughfilm validate: published numbers beside ours."""

from pathlib import Path
from typing import Annotated

import typer

from roughfilm.batch.directory import alone
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.files import replacing, write_json
from roughfilm.contact.foundation.writing.kinds import JSON, PAGE, beginning_with
from roughfilm.pages.render import render, write_figures
from roughfilm.rom.ladder.provenance import circumstances
from roughfilm.terminal.console import AsJson, OutDirectory, make_directory, print_json, progress_bar
from roughfilm.terminal.output_file import refuse_unwritable
from roughfilm.terminal.results import print_all, table_of, written
from roughfilm.validation.listing import names, source
from roughfilm.validation.reading import not_yet
from roughfilm.validation.store import answered
from roughfilm.validation.summary import COLUMNS, Compared, entries_of, headline, in_markdown, largest, ours_in_words

EXAMPLES = (
    "roughfilm validate --out validation",
    "roughfilm validate --source bertocchi --out validation",
)

MARKDOWN_BEGINS = "<!-- roughfilm validate -->\n\n"
"""First line of the tables in Markdown."""


def command(
    out: OutDirectory,
    chosen: Annotated[
        list[str] | None,
        typer.Option("--source", metavar="NAME", help=f"Only this source; repeatable: {', '.join(names())}."),
    ] = None,
    thorough: Annotated[bool, typer.Option("--all", help="Take the finest grids: some 4 minutes of CPU time.")] = False,
    as_json: AsJson = False,
) -> None:
    """Compare published numbers with ours: report.html, validation.json and .md, and an .svg each."""
    from roughfilm.figures.validation import compared_figure, curve_figure  # matplotlib is slow to import

    wanted = names() if not chosen else list(dict.fromkeys(chosen))
    for name in wanted:
        if name not in names():
            raise InputError(f"--source: got {name!r}; it must be one of {', '.join(names())}")
    make_directory(out)
    markdown = beginning_with("a table of roughfilm validate", MARKDOWN_BEGINS.encode())
    refuse_unwritable((out / "report.html", PAGE), (out / "validation.json", JSON), (out / "validation.md", markdown))
    with alone(out):
        compared = compare(wanted, out, thorough=thorough)
        figures = {
            one.source.name: curve_figure(one.answer.curves)
            if one.answer.curves
            else compared_figure(one.source, one.answer.rows)
            for one in compared
            if one.answer.curves or len(one.answer.rows) > 1
        }
        write_figures(figures, out)
        with replacing(out / "validation.md", markdown) as scratch:
            scratch.write_text(MARKDOWN_BEGINS + in_markdown(compared), encoding="utf-8")
        entries = {**entries_of(compared), "not_yet": not_yet(), **circumstances()}
        render(
            "validation.html.j2",
            out / "report.html",
            compared=compared,
            columns=COLUMNS,
            figures=figures,
            headline=headline(compared),
            largest=largest(compared),
            not_yet=not_yet(),
            ours=ours_in_words,
            circumstances=circumstances(),
        )
        write_json(entries, out / "validation.json")
    if as_json:
        print_json(entries)
        return
    print_all([table_of(COLUMNS, [one.cells for one in compared])])
    print_all([written(headline(compared).rstrip("."), out / "report.html", out / "validation.json")])


def compare(wanted: list[str], out: Path, *, thorough: bool) -> list[Compared]:
    """The answers of sources, by their names; complete ones in the directory are used again."""
    found = {name: source(name) for name in wanted}
    costs = {name: one.cost[thorough] for name, one in found.items()}
    compared, spent = [], 0.0
    kept = out / "answers"
    make_directory(kept)
    with progress_bar(sum(costs.values())) as advance:
        for name, one in found.items():

            def step(done: float, words: str, spent: float = spent, cost: float = costs[name]) -> None:
                advance(spent + done * cost, words)

            try:
                answer = answered(one, kept / f"{name}.json", thorough=thorough, progress=step)
            except (KeyboardInterrupt, SystemExit) as stop:
                stop.add_note("stopped; the same command goes on")
                raise
            compared.append(
                Compared(
                    source=one, answer=answer.answer, created=answer.created, cpu_s=answer.cpu_s, thorough=thorough
                )
            )
            spent += costs[name]
    return compared
