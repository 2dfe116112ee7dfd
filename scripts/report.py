"""roughfilm report: what a finished sweep says of every model: its errors, what orders them, what it costs."""

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer
from rich.markup import escape
from rich.table import Table

from contact.errors import InputError
from contact.files import replacing
from rom.comparison import COMPARED
from rom.error_law import words
from rom.ladder import best
from rom.ordering import Ordering, fitted_powers, ordering
from rom.provenance import machine
from rom.sweep import Sweep, read_sweep, relative_error
from rom.table import read_table
from scripts.common import AsJson, in_one_line, make_directory, models, output, print_json, run_alone
from scripts.pages import render

TOLERANCES = (0.01, 0.02, 0.05, 0.10)

CANDIDATES: dict[str, dict[str, float]] = {
    "Re": {"reynolds_number": 1},
    "d/Ly": {"depth": 1},
    "2d/w": {"slope": 1},
    "Re Ly/w": {"reynolds_number": 1, "depth": -1, "slope": 1},
    "Re d/w": {"reynolds_number": 1, "slope": 1},
    "Re (d/w)²": {"reynolds_number": 1, "slope": 2},
    "d²/(w Ly)": {"depth": 1, "slope": 1},
}
"""Numbers that an engineer would try, each a product of powers of Re, d/Ly and the slope 2d/w (steeper side)."""

SAME = 0.01
"""Errors within this part of each other have no order: a model without any load is 100 % off everywhere."""

SIMPLE_ENOUGH = 0.01
"""A candidate whose rank correlation is at most this much below that of fitted powers is taken instead of them."""


@in_one_line
def command(
    directory: Annotated[Path, typer.Argument(metavar="DIR", help="What 'roughfilm batch' made.")],
    out: Annotated[Path | None, typer.Option(help="The page goes here; by default DIR/report.html.")] = None,
    as_json: AsJson = False,
) -> None:
    """Write the page of a sweep: errors of every model, the number that orders them, speed against accuracy."""
    sweep = read_sweep(read_table(directory / "table.h5"))
    reference = _reference(sweep)
    settings = [name for name in sweep.found if name != reference]
    if not settings:
        raise InputError(f"{directory}: holds one model only; a report compares at least two")
    numbers = {
        (setting, quantity): _orderings(sweep, setting, reference, quantity)
        for setting in settings
        for quantity in COMPARED
    }
    rows = [_row(sweep, setting, reference, numbers) for setting in [*settings, reference]]
    told = {"reference": reference, "cases": len(sweep.names), "settings": rows, "failures": list(sweep.failures)}
    path = out or directory / "report.html"
    make_directory(path.parent)
    _write_page(sweep, reference, settings, numbers, rows, path)
    with replacing(path.with_suffix(".json")) as scratch:
        scratch.write_text(json.dumps({**told, "machine": machine()}, indent=1) + "\n", encoding="utf-8")
    if as_json:
        print_json({**told, "report": str(path)})
        return
    table = Table(
        "setting", "CPU, s", "load error", "95 %", "friction error", "95 %", title=f"{len(sweep.names)} cases"
    )
    for row in rows:
        errors = [f"{100 * row['error'][q][part]:.3g} %" for q in COMPARED for part in ("median", "high")]
        table.add_row(row["setting"], f"{row['cpu_s']:.3g}", *errors)
    output.print(table)
    output.print(f"report: {escape(str(path))}", soft_wrap=True)


def _reference(sweep: Sweep) -> str:
    """The best rung of the sweep, at its finest and best scheme: the one named first in the study."""
    known = [model for model in models() if any(name.split("-")[0] == model.name for name in sweep.found)]
    if not known:
        raise InputError("the table holds no results of this ladder; run the study again")
    top = best(known)
    named = [name for name in sweep.found if name.split("-")[0] == top.name]
    return next((name for scheme in top.schemes for name in named if scheme in name.split("-")), named[-1])


def _known(sweep: Sweep, setting: str, reference: str, quantity: str) -> tuple[dict[str, Any], np.ndarray[Any, Any]]:
    error = relative_error(sweep, setting, reference, quantity)
    features = sweep.features()
    known = np.isfinite(error) & np.isfinite(sum(features.values()))
    return {name: values[known] for name, values in features.items()}, error[known]


def _orderings(sweep: Sweep, setting: str, reference: str, quantity: str) -> dict[str, Ordering]:
    """Each candidate, the fitted powers and the ``chosen`` one; nothing for an error that is the same everywhere."""
    features, error = _known(sweep, setting, reference, quantity)
    if error.size < 8:
        raise InputError(f"{setting}: has {error.size} cases beside {reference}; a report needs at least 8")
    if error.max() <= (1 + SAME) * error.min():
        return {}
    found = {name: ordering(features, powers, error, TOLERANCES) for name, powers in CANDIDATES.items()}
    fitted = fitted_powers(features, error, step=0.25)
    found["fitted"] = ordering(features, fitted or {"reynolds_number": 1}, error, TOLERANCES)
    simple = max(CANDIDATES, key=lambda name: found[name].rank)
    found["chosen"] = found[simple if found[simple].rank >= found["fitted"].rank - SIMPLE_ENOUGH else "fitted"]
    return found


def _row(
    sweep: Sweep, setting: str, reference: str, numbers: Mapping[tuple[str, str], Mapping[str, Ordering]]
) -> dict[str, Any]:
    errors, orders = {}, {}
    for quantity in COMPARED:
        _, error = _known(sweep, setting, reference, quantity)
        median, high, worst = (float(value) for value in (np.median(error), np.percentile(error, 95), error.max()))
        errors[quantity] = {"median": median, "high": high, "worst": worst}
        if numbers.get((setting, quantity)):
            chosen = numbers[setting, quantity]["chosen"]
            orders[quantity] = {
                "number": words(chosen.powers),
                "powers": dict(chosen.powers),
                "rank": chosen.rank,
                "thresholds": {f"{tolerance:g}": limit for tolerance, limit in chosen.thresholds.items()},
                "tried": {name: found.rank for name, found in numbers[setting, quantity].items()},
            }
    cpu = sweep.cpu_s[setting]
    return {
        "setting": setting,
        "solved": int(np.isfinite(cpu).sum()),
        "cpu_s": float(np.nanmedian(cpu)),
        "cpu_s_high": float(np.nanpercentile(cpu, 95)),
        "error": errors,
        "ordered_by": orders,
    }


def _write_page(
    sweep: Sweep,
    reference: str,
    settings: list[str],
    numbers: Mapping[tuple[str, str], Mapping[str, Ordering]],
    rows: list[dict[str, Any]],
    path: Path,
) -> None:
    from scripts import sweep_figures  # matplotlib is slow to import

    chosen = {key: found["chosen"] for key, found in numbers.items() if found}
    render(
        "sweep.html.j2",
        path,
        sweep=sweep,
        reference=reference,
        rows=rows,
        tolerances=[f"{tolerance:g}" for tolerance in TOLERANCES],
        chart=sweep_figures.sweep_chart(sweep, reference, settings),
        order=sweep_figures.errors_in_order(sweep, reference, chosen, settings),
        maps={
            (setting, quantity): sweep_figures.error_maps(sweep, setting, reference, quantity)
            for setting in settings
            for quantity in COMPARED
        },
        machine=machine(),
    )


if __name__ == "__main__":
    run_alone(command)
