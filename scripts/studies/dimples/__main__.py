"""Find the best dimple for load by each model, and the load that is lost by choosing with a cheap one.

python -m scripts.studies.dimples DIR... --out OUT, where each DIR holds a finished batch: of
scripts/examples/studies/dimples.toml, and of deep_dimples.toml beside it.
"""

from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer
from numpy.typing import NDArray
from rich.table import Table

from roughfilm.rom.studies.sweep import read_sweep
from roughfilm.rom.studies.table import read_table
from roughfilm.terminal.console import AsJson, in_one_line, run_alone
from scripts.studies.dimples import figures
from scripts.studies.dimples.data import FAMILIES, MIN_LOAD, REFERENCE, Dimples, dimples_of, joined
from scripts.studies.study import Out, publish

SHALLOW = 1.0
"""Depth over film thickness below which a dimple is shallow."""


@in_one_line
def command(
    directories: Annotated[
        list[Path],
        typer.Argument(metavar="DIR...", help="Directories of the batches of dimples.toml, deep_dimples.toml."),
    ],
    out: Out,
    as_json: AsJson = False,
) -> None:
    """Compare the dimples that each model finds best, and the errors of the loads."""
    table = joined([read_table(directory / "table.h5") for directory in directories])
    dimples = dimples_of(read_sweep(table, "pocket"))
    choices = {
        number: {
            family: {model: dimples.choice(family, number, model) for model in dimples.settings} for family in FAMILIES
        }
        for number in dimples.numbers
    }
    rows = [
        row
        for title, cases in parts(dimples).items()
        for model in dimples.settings
        if model != REFERENCE and (row := error_row(dimples, model, title, cases))
    ]
    publish(
        Path(__file__).parent,
        out,
        {
            "losses": figures.losses(dimples),
            **{f"loads at Re {number:g}": figures.loads(dimples, number) for number in dimples.numbers},
        },
        {"choices": choices, "errors": rows},
        tables=[printed(rows)],
        as_json=as_json,
        choices=choices,
        errors=rows,
        models=list(dimples.settings),
        reference=REFERENCE,
        cases=len(dimples.sweep.names),
        min_load=MIN_LOAD,
        mesh=float(np.nanmedian(np.abs(dimples.change_of_mesh() / dimples.load(REFERENCE)))),
    )


def parts(dimples: Dimples) -> dict[str, NDArray[np.bool_]]:
    """The cases of shallow and of deep dimples, as masks by title."""
    shallow = np.asarray(dimples.sweep.given["depth_plus"] < SHALLOW)
    return {f"depth below {SHALLOW:g} film thickness": shallow, f"depth from {SHALLOW:g} film thickness": ~shallow}


def error_row(dimples: Dimples, model: str, title: str, cases: NDArray[np.bool_]) -> dict[str, Any] | None:
    """The errors of the load by a model in some cases, with its CPU time; None without a case to judge."""
    errors = dimples.errors(model, cases)
    if not errors.size:
        return None
    return {
        "part": title,
        "model": model,
        "cpu_s": float(np.nanmedian(dimples.sweep.cpu_s[dimples.settings[model]][cases])),
        "median": float(np.median(errors)),
        "most": float(np.quantile(errors, 0.95)),
        "worst": float(errors.max()),
        "cells": int(errors.size),
    }


def printed(rows: list[dict[str, Any]]) -> Table:
    """The errors as a printed table."""
    shown = Table("cells", "model", "CPU", "load error, median", "95 %", "largest")
    for row in rows:
        shown.add_row(
            row["part"],
            row["model"],
            f"{row['cpu_s']:.2g} s",
            *(f"{100 * row[name]:.2g} %" for name in ("median", "most", "worst")),
        )
    return shown


if __name__ == "__main__":
    run_alone(command)
