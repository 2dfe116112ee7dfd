"""roughfilm march: a bearing in time, under loads and speeds that change."""

from collections.abc import Iterator
from typing import Annotated, Any

import typer
from rich.table import Table

from roughfilm.contact.foundation.checked_hdf5 import marked
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.files import write_json
from roughfilm.contact.foundation.timing import stopwatch
from roughfilm.contact.foundation.units import to_si
from roughfilm.contact.foundation.writing.kinds import JSON, PAGE
from roughfilm.rom.bearing.march.solve import CELLS, ERROR, March, entries_of, march_bearing
from roughfilm.rom.bearing.march.store import MARK, write_csv
from roughfilm.rom.ladder.scene import load_scene, scene_entries
from roughfilm.terminal.console import (
    NUMERICS,
    AsJson,
    OutDirectory,
    Overrides,
    ScenePath,
    make_directory,
    progress_bar,
)
from roughfilm.terminal.output_file import alone, refuse_unwritable
from roughfilm.terminal.results import origin, show_result, table_of, written
from roughfilm.terminal.scenes import bearing_of
from roughfilm.words.march import headline, rows_of
from roughfilm.words.outside import outside_in_words

EXAMPLES = (
    "roughfilm march scripts/examples/scenes/engine_bearing.toml --out engine",
    "roughfilm march scripts/examples/scenes/unbalanced_rotor.toml --end 0.2s --out rotor",
)

SOURCES = ("10.1115/1.3251669", "Hairer, Nørsett and Wanner 1993, Solving Ordinary Differential Equations I")

DEFAULT_FIELDS = 25
"""Number of times at which fields are kept."""


def command(
    scene: ScenePath,
    out: OutDirectory,
    end: Annotated[
        str | None,
        typer.Option(
            metavar="TIME", help="Last time, 0.2s (default: that of the table, 5 of its periods, or 20 turns)."
        ),
    ] = None,
    error: Annotated[
        float,
        typer.Option(
            help="Largest error of a time step, over the motion in the largest step.", rich_help_panel=NUMERICS
        ),
    ] = ERROR,
    steps: Annotated[
        int | None,
        typer.Option(help="Number of equal steps, in place of steps by their error.", rich_help_panel=NUMERICS),
    ] = None,
    cells: Annotated[
        str, typer.Option(metavar="NX,NY", help="Cells along and across.", rich_help_panel=NUMERICS)
    ] = f"{CELLS[0]},{CELLS[1]}",
    fields: Annotated[
        int, typer.Option(help="Number of times, evenly spaced, whose fields are kept.", rich_help_panel=NUMERICS)
    ] = DEFAULT_FIELDS,
    uncertainty: Annotated[
        bool,
        typer.Option(
            "--uncertainty/--no-uncertainty",
            help="March on a coarser grid too, twice, for the uncertainty.",
            rich_help_panel=NUMERICS,
        ),
    ] = True,
    isothermal: Annotated[
        bool, typer.Option("--isothermal", help="All films at the temperature of the supplied lubricant.")
    ] = False,
    set_: Overrides = None,
    as_json: AsJson = False,
) -> None:
    """March a bearing in time: film, pressure, load, friction and flows as loads and speeds change."""
    spent = stopwatch()
    bearing = bearing_of(load_scene(scene, set_ or ()))
    bearing = bearing.isothermal() if isothermal else bearing
    page, stored = out / "report.html", out / "series.h5"
    last, size = None if end is None else _time(end), _cells(cells)
    make_directory(out)
    refuse_unwritable((page, PAGE), (stored, marked(MARK)), (stored.with_suffix(".json"), JSON))
    with alone(stored, "march"), progress_bar(1.0) as advance:
        march = march_bearing(
            bearing,
            end=last,
            error=error,
            steps=steps,
            cells=size,
            fields=fields,
            uncertain=uncertainty,
            path=stored,
            progress=lambda done, words: advance(0.97 * done, words),
        )
        entries = march_entries(march)
        entries["numerics"] |= spent()
        write_csv(stored.with_suffix(".csv"), march.series.units, march.series.rows)
        write_json(entries, stored.with_suffix(".json"))
        from roughfilm.pages.march import write_page  # matplotlib is slow to import

        advance(0.97, "drawing the page")
        write_page(march, entries, page)

    def shown() -> Iterator[Table | str]:
        yield table_of(["quantity", "value", "unit"], list(rows_of(march.quantities, march.titles)))
        yield f"from {march.first:.4g} s to {march.last:.4g} s; {march.state}"

    answer = "; ".join(filter(None, [outside_in_words(march.outside), headline(march.quantities), march.state]))
    summary = written(answer, page, stored, stored.with_suffix(".csv"))
    show_result({**entries, "report": str(page)}, shown(), as_json=as_json, reused="steps", summary=summary)


def march_entries(march: March) -> dict[str, Any]:
    """The object of ``--json``, without the cost."""
    series = march.series
    return {
        "quantities": entries_of(march.quantities),
        "titles": dict(march.titles),
        "first": march.first,
        "last": march.last,
        "state": march.state,
        "settled": march.settled,
        "outside": list(march.outside),
        "units": dict(series.units),
        "numerics": {
            "steps": len(series.rows),
            "steps_found": series.known,
            "cells": list(march.numerics.cells),
            "error": march.numerics.error,
            "largest_step": march.numerics.step,
            "residual": float(series["residual"].max()),
            "force_residual": float(series["force_residual"].max()),
            "flow_imbalance": float(abs(series["flow_imbalance"]).max()),
        },
        "provenance": origin(SOURCES, _warnings(march), scene=scene_entries(march.scene)),
    }


def _warnings(march: March) -> list[str]:
    beyond = outside_in_words(march.outside)
    return [*([beyond] if beyond else []), *march.warnings]


def _time(text: str) -> float:
    try:
        return to_si(text, "s")
    except ValueError as fault:
        raise InputError(f"end: {fault}") from None


def _cells(text: str) -> tuple[int, int]:
    counts = text.replace("x", ",").split(",")
    if len(counts) != 2 or not all(count.strip().isdecimal() for count in counts):
        raise InputError(f"cells: got {text!r:.40}; write two numbers, such as 64,32")
    return int(counts[0]), int(counts[1])
