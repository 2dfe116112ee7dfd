"""roughfilm report: what a finished sweep says of every model: its errors, what orders them, what it costs."""

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer
from rich.markup import escape
from rich.table import Table

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.files import replacing
from roughfilm.figures.view import views
from roughfilm.ladder import models
from roughfilm.pages.render import render
from roughfilm.rom.ladder.kind import kind_of_name, kinds
from roughfilm.rom.ladder.model import best
from roughfilm.rom.ladder.provenance import machine
from roughfilm.rom.studies.ordering import Ordering, fitted_powers, ordering
from roughfilm.rom.studies.sweep import Sweep, loaded, read_sweep, relative_error, sweeping
from roughfilm.rom.studies.table import read_table
from roughfilm.terminal.console import AsJson, in_one_line, make_directory, output, print_json

TOLERANCES = (0.01, 0.02, 0.05, 0.10)

SAME = 0.01
"""Errors within this part of each other have no order: a model without any load is 100 % off everywhere."""

SIMPLE_ENOUGH = 0.1
"""Fitted powers are taken where they correlate better than any candidate by more than this, and cover as many cases."""


@in_one_line
def command(
    directory: Annotated[Path, typer.Argument(metavar="DIR", help="What 'roughfilm batch' made.")],
    out: Annotated[Path | None, typer.Option(help="The page goes here; by default DIR/report.html.")] = None,
    as_json: AsJson = False,
) -> None:
    """Write the page of a sweep: errors of every model, the number that orders them, speed against accuracy."""
    table = read_table(directory / "table.h5")
    sweep = read_sweep(table, _kind(table))
    compared = kind_of_name(sweep.kind).compared
    reference = _reference(sweep)
    settings = [name for name in sweep.found if name != reference and np.isfinite(sweep.cpu_s[name]).any()]
    if not settings:
        raise InputError(f"{directory}: holds one model only; a report compares at least two")
    numbers = {
        (setting, quantity): _orderings(sweep, setting, reference, quantity)
        for setting in settings
        for quantity in compared
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
    heads = [head for title in compared.values() for head in (f"{title} error", "95 %")]
    shown = Table("setting", "CPU, s", *heads, title=f"{len(sweep.names)} cases")
    for row in rows:
        errors = [_percent(row["error"][quantity][part]) for quantity in compared for part in ("median", "high")]
        shown.add_row(row["setting"], f"{row['cpu_s']:.3g}", *errors)
    output.print(shown)
    output.print(f"report: {escape(str(path))}", soft_wrap=True)


def _kind(table: Mapping[str, Any]) -> str:
    """The kind of the scenes of a table."""
    found = set(map(str, table.get("kind", ())))
    if len(found) != 1 or not found <= set(kinds()):
        raise InputError("the table does not say which kind of scenes it holds; run the study again")
    return found.pop()


def _reference(sweep: Sweep) -> str:
    """The best rung that solved any case, at its finest and best scheme: the one named first in the study."""
    ladder = models(sweep.kind)
    solved = [name for name, values in sweep.found.items() if any(np.isfinite(v).any() for v in values.values())]
    names = {name.split("-")[0] for name in solved or sweep.found}
    top = best([model for model in ladder if model.name in names])
    named = [name for name in sweep.found if name.split("-")[0] == top.name]
    return next((name for scheme in top.schemes for name in named if scheme in name.split("-")), named[-1])


def _known(sweep: Sweep, setting: str, reference: str, quantity: str) -> tuple[dict[str, Array], Array]:
    error = relative_error(sweep, setting, reference, quantity)
    features = sweep.features()
    known = np.isfinite(error) & np.isfinite(sum(features.values())) & loaded(sweep, reference)
    return {name: values[known] for name, values in features.items()}, error[known]


def _orderings(sweep: Sweep, setting: str, reference: str, quantity: str) -> dict[str, Ordering]:
    """Each candidate, the fitted powers and the ``chosen`` one.

    Nothing for a quantity that the setting does not give, and for an error that is the same everywhere.
    """
    features, error = _known(sweep, setting, reference, quantity)
    if not np.isfinite(sweep.found[setting][quantity]).any():
        return {}
    if error.size < 8:
        raise InputError(f"{setting}: has {error.size} cases beside {reference}; a report needs at least 8")
    if error.max() <= (1 + SAME) * error.min():
        return {}
    judged = sweeping(kind_of_name(sweep.kind))
    found = {name: ordering(features, powers, error, TOLERANCES) for name, powers in judged.candidates.items()}
    fitted = fitted_powers({name: features[name] for name in judged.fitted}, error, step=0.25)
    found["fitted"] = ordering(features, fitted or {judged.fitted[0]: 1}, error, TOLERANCES)
    simple = found[max(judged.candidates, key=lambda name: found[name].rank)]
    better = found["fitted"].rank > simple.rank + SIMPLE_ENOUGH
    found["chosen"] = found["fitted"] if better and found["fitted"].coverage >= simple.coverage else simple
    return found


def _row(
    sweep: Sweep, setting: str, reference: str, numbers: Mapping[tuple[str, str], Mapping[str, Ordering]]
) -> dict[str, Any]:
    errors: dict[str, Any] = {}
    orders = {}
    for quantity in kind_of_name(sweep.kind).compared:
        _, error = _known(sweep, setting, reference, quantity)
        errors[quantity] = _spread(error) if error.size else dict.fromkeys(("median", "high", "worst"))
        if numbers.get((setting, quantity)):
            chosen = numbers[setting, quantity]["chosen"]
            orders[quantity] = {
                "number": sweeping(kind_of_name(sweep.kind)).words(chosen.powers),
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


def _spread(error: Array) -> dict[str, float]:
    median, high, worst = np.median(error), np.percentile(error, 95), error.max()
    return {"median": float(median), "high": float(high), "worst": float(worst)}


def _percent(part: float | None) -> str:
    return "-" if part is None else f"{100 * part:.3g} %"


def _write_page(
    sweep: Sweep,
    reference: str,
    settings: list[str],
    numbers: Mapping[tuple[str, str], Mapping[str, Ordering]],
    rows: list[dict[str, Any]],
    path: Path,
) -> None:
    from roughfilm.figures import sweep as sweep_figures  # matplotlib is slow to import

    kind, view = kind_of_name(sweep.kind), views()[sweep.kind]
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
            (setting, quantity): view.maps(sweep, setting, reference, quantity)
            for setting in settings
            for quantity in kind.compared
            if view.maps is not None
        },
        compared=kind.compared,
        view=view,
        machine=machine(),
    )
