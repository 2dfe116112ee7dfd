"""Solve published tables by models with temperature: python -m scripts.studies.isoviscous --out OUT.

The lubricant heats and keeps its viscosity; each number must be that of the isothermal model to the last bit.
"""

import json
from collections.abc import Iterable
from typing import Annotated, Any

import typer

from roughfilm.contact.foundation.files import replacing
from roughfilm.contact.foundation.writing.kinds import JSON
from roughfilm.rom.ladder.provenance import circumstances
from roughfilm.terminal.console import AsJson, in_one_line, make_directory, print_json, run_alone
from roughfilm.terminal.results import print_all, table_of
from roughfilm.validation.isoviscous import MODELS, IsoviscousLimit, TableRow, isoviscous_limits, table_rows
from scripts.studies.study import Out, counted, plain

Found = Iterable[tuple[TableRow, dict[str, IsoviscousLimit]]]
"""The rows of the tables and their films by the names of the models."""

COLUMNS = ("table", "model", "rows", "the same", "changed", "without a film", "numbers and fields")


def cells_of(found: Found) -> list[tuple[str, ...]]:
    """The rows of each table by each model, counted by their outcome, and how many numbers and fields they compare."""
    limits: dict[tuple[str, str], list[IsoviscousLimit]] = {}
    for row, by_model in found:
        for model, limit in by_model.items():
            limits.setdefault((row.source, model), []).append(limit)
    return [
        (
            source,
            model,
            str(len(some)),
            str(sum(not one.changed and not one.reason for one in some)),
            str(sum(bool(one.changed) for one in some)),
            str(sum(bool(one.reason) for one in some)),
            str(sum(one.compared for one in some)),
        )
        for (source, model), some in limits.items()
    ]


@in_one_line
def command(
    out: Out,
    cells: Annotated[int, typer.Option(min=8, help="Cells along and across the film.")] = 32,
    as_json: AsJson = False,
) -> None:
    """Compare the films of published tables by models with temperature with isothermal ones, bit for bit."""
    make_directory(out)
    rows, found = list(table_rows()), []
    with counted(len(rows)) as advance:
        for row in rows:
            advance(f"{row.source}, {row.case}")
            found.append((row, isoviscous_limits(row, cells)))
    numbers: dict[str, Any] = plain(
        {
            "cells": cells,
            "models": MODELS,
            "rows": [{"table": row.source, "case": row.case, **limits} for row, limits in found],
            "provenance": circumstances(),
        }
    )
    with replacing(out / "isoviscous.json", JSON) as scratch:
        scratch.write_text(json.dumps(numbers, indent=1, allow_nan=False) + "\n", encoding="utf-8")
    if as_json:
        print_json(numbers)
        return
    print_all([table_of(COLUMNS, cells_of(found), left=2)])


if __name__ == "__main__":
    run_alone(command)
