"""roughfilm report: the errors of every model in a finished sweep, the number that orders them, and the cost."""

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.files import write_json
from roughfilm.figures.view import views
from roughfilm.ladder import models
from roughfilm.pages.render import render
from roughfilm.rom.ladder.kind import kind_of_name, kinds
from roughfilm.rom.ladder.model import best
from roughfilm.rom.ladder.provenance import machine
from roughfilm.rom.studies.ordering import Ordering, fitted_powers, ordering
from roughfilm.rom.studies.sweep import Sweep, loaded, read_sweep, relative_error, sweeping
from roughfilm.rom.studies.table import read_table
from roughfilm.terminal.console import AsJson, make_directory, print_json
from roughfilm.terminal.results import print_all, table_of

TOLERANCES = (0.01, 0.02, 0.05, 0.10)

EQUAL_ERRORS = 0.01
"""Errors within this fraction of each other have no order: a model without load has an error of 100 % everywhere."""

RANK_GAIN = 0.1
"""Fitted powers are taken if their rank correlation is larger by this than any candidate's, at the same coverage."""


def command(
    directory: Annotated[Path, typer.Argument(metavar="DIR", help="The output directory of 'roughfilm batch'.")],
    out: Annotated[Path | None, typer.Option(help="Write the page here (default: DIR/report.html).")] = None,
    as_json: AsJson = False,
) -> None:
    """Write the report of a sweep: errors of every model, the number that orders them, speed and accuracy."""
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
    entries = {"reference": reference, "cases": len(sweep.names), "settings": rows, "failures": list(sweep.failures)}
    path = out or directory / "report.html"
    make_directory(path.parent)
    from roughfilm.figures.sweep import errors_in_order, sweep_chart  # matplotlib is slow to import

    view, chosen = views()[sweep.kind], {key: orders["chosen"] for key, orders in numbers.items() if orders}
    render(
        "sweep.html.j2",
        path,
        sweep=sweep,
        reference=reference,
        rows=rows,
        tolerances=[f"{tolerance:g}" for tolerance in TOLERANCES],
        chart=sweep_chart(sweep, reference, settings),
        order=errors_in_order(sweep, reference, chosen, settings),
        maps={key: view.maps(sweep, key[0], reference, key[1]) for key in numbers} if view.maps else {},
        compared=compared,
        view=view,
        machine=machine(),
    )
    write_json({**entries, "machine": machine()}, path.with_suffix(".json"))
    if as_json:
        print_json({**entries, "report": str(path)})
        return
    heads = [head for title in compared.values() for head in (f"{title} error", "95 %")]
    cells = [
        (
            row["setting"],
            f"{row['cpu_s']:.3g}",
            *(_percent(row["error"][quantity][part]) for quantity in compared for part in ("median", "high")),
        )
        for row in rows
    ]
    table_of_errors = table_of(("setting", "CPU, s", *heads), cells, title=f"{len(sweep.names)} cases", left=1)
    print_all((table_of_errors, f"report: {path}"))


def _kind(table: Mapping[str, Any]) -> str:
    """The kind of the scenes of a table."""
    names = set(map(str, table.get("kind", ())))
    if len(names) != 1 or not names <= set(kinds()):
        raise InputError("the table does not name one kind of scenes; run the study again")
    return names.pop()


def _reference(sweep: Sweep) -> str:
    """The setting of the best model that solved any case, at its best scheme."""
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
    """The ordering by each candidate, by the fitted powers, and the ``chosen`` one of them.

    It is empty for a quantity that the setting does not give, and for an error that is the same everywhere.
    """
    features, error = _known(sweep, setting, reference, quantity)
    if not np.isfinite(sweep.found[setting][quantity]).any():
        return {}
    if error.size < 8:
        raise InputError(f"{setting}: has {error.size} cases beside {reference}; a report needs at least 8")
    if error.max() <= (1 + EQUAL_ERRORS) * error.min():
        return {}
    judged = sweeping(kind_of_name(sweep.kind))
    orders = {name: ordering(features, powers, error, TOLERANCES) for name, powers in judged.candidates.items()}
    fitted = fitted_powers({name: features[name] for name in judged.fitted}, error, step=0.25)
    orders["fitted"] = ordering(features, fitted or {judged.fitted[0]: 1}, error, TOLERANCES)
    simple, powers = orders[max(judged.candidates, key=lambda name: orders[name].rank)], orders["fitted"]
    better = powers.rank > simple.rank + RANK_GAIN and powers.coverage >= simple.coverage
    return {**orders, "chosen": powers if better else simple}


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
                "tried": {name: one.rank for name, one in numbers[setting, quantity].items()},
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


def _percent(fraction: float | None) -> str:
    return "-" if fraction is None else f"{100 * fraction:.3g} %"
