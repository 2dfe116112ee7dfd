"""roughfilm report: the errors of every model in a finished sweep, the number that orders them, and the cost."""

from collections.abc import Mapping, Sequence
from itertools import combinations
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
from roughfilm.rom.ladder.provenance import machine
from roughfilm.rom.studies.ordering import Ordering, fitted_powers, ordering
from roughfilm.rom.studies.reference import Order, Ranking, Reference, interval, ranking, reference_of
from roughfilm.rom.studies.sweep import Sweep, loaded, read_sweep, relative_error, sweeping
from roughfilm.rom.studies.table import read_table
from roughfilm.terminal.console import AsJson, make_directory, print_json
from roughfilm.terminal.results import print_all, table_of
from roughfilm.words.numbers import finite, span

EXAMPLES = (
    "roughfilm batch scripts/examples/studies/pocket.toml --out sweep",
    "roughfilm report sweep",
)

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
    reference = reference_of(sweep, models(sweep.kind))
    settings = [name for name in sweep.found if name != reference.setting and np.isfinite(sweep.cpu_s[name]).any()]
    if not settings:
        raise InputError(f"{directory}: holds one model only; a report compares at least two")
    numbers = {
        (setting, quantity): _orderings(sweep, setting, reference, quantity)
        for setting in settings
        for quantity in compared
    }
    rows = [_row(sweep, setting, reference, numbers) for setting in [*settings, reference.setting]]
    bars = {quantity: _bars(sweep, reference, quantity) for quantity in compared}
    ranks = [
        found
        for quantity in compared
        for pair in combinations(settings, 2)
        if (found := ranking(sweep, pair, reference, quantity)) is not None
    ]
    entries = {
        "reference": reference.setting,
        "reference_uncertainty": bars,
        "cases": len(sweep.names),
        "settings": rows,
        "ranking": [_rank_entries(one) for one in ranks],
        "failures": list(sweep.failures),
    }
    path = out or directory / "report.html"
    make_directory(path.parent)
    from roughfilm.figures.sweep import errors_in_order, sweep_chart  # matplotlib is slow to import

    view, chosen = views()[sweep.kind], {key: orders["chosen"] for key, orders in numbers.items() if orders}
    render(
        "sweep.html.j2",
        path,
        sweep=sweep,
        reference=reference.setting,
        bars=bars,
        ranks=[(one, _verdict(one)) for one in ranks],
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
            *(_span(row["error"][quantity]["intervals"][part]) for quantity in compared for part in ("median", "high")),
        )
        for row in rows
    ]
    table_of_errors = table_of(("setting", "CPU, s", *heads), cells, title=f"{len(sweep.names)} cases", left=1)
    undecided = [
        f"{compared[one.quantity]}: {' and '.join(one.settings)} cannot be distinguished with this reference"
        for one in ranks
        if one.order is Order.UNDECIDED
    ]
    print_all((table_of_errors, *undecided, f"report: {path}"))


def _kind(table: Mapping[str, Any]) -> str:
    """The kind of the scenes of a table."""
    names = set(map(str, table.get("kind", ())))
    if len(names) != 1 or not names <= set(kinds()):
        raise InputError("the table does not name one kind of scenes; run the study again")
    return names.pop()


def _known(
    sweep: Sweep, setting: str, reference: Reference, quantity: str
) -> tuple[dict[str, Array], Array, tuple[Array, Array]]:
    """The features and errors of the cases whose error is known, and the least and largest possible errors."""
    error = relative_error(sweep, setting, reference.setting, quantity)
    features = sweep.features()
    known = np.isfinite(error) & np.isfinite(sum(features.values())) & loaded(sweep, reference.setting)
    least, largest = interval(sweep, setting, reference, quantity)
    return {name: values[known] for name, values in features.items()}, error[known], (least[known], largest[known])


def _orderings(sweep: Sweep, setting: str, reference: Reference, quantity: str) -> dict[str, Ordering]:
    """The ordering by each candidate, by the fitted powers, and the ``chosen`` one of them.

    It is empty for a quantity that the setting does not give, and for an error that is the same everywhere.
    """
    features, error, (_, largest) = _known(sweep, setting, reference, quantity)
    if not np.isfinite(sweep.found[setting][quantity]).any():
        return {}
    if error.size < 8:
        raise InputError(f"{setting}: has {error.size} cases beside {reference.setting}; a report needs at least 8")
    if error.max() <= (1 + EQUAL_ERRORS) * error.min():
        return {}
    judged = sweeping(kind_of_name(sweep.kind))
    orders = {
        name: ordering(features, powers, error, TOLERANCES, largest) for name, powers in judged.candidates.items()
    }
    fitted = fitted_powers({name: features[name] for name in judged.fitted}, error, step=0.25)
    orders["fitted"] = ordering(features, fitted or {judged.fitted[0]: 1}, error, TOLERANCES, largest)
    simple, powers = orders[max(judged.candidates, key=lambda name: orders[name].rank)], orders["fitted"]
    better = powers.rank > simple.rank + RANK_GAIN and powers.coverage >= simple.coverage
    return {**orders, "chosen": powers if better else simple}


def _row(
    sweep: Sweep, setting: str, reference: Reference, numbers: Mapping[tuple[str, str], Mapping[str, Ordering]]
) -> dict[str, Any]:
    errors: dict[str, Any] = {}
    orders = {}
    for quantity in kind_of_name(sweep.kind).compared:
        _, error, ends = _known(sweep, setting, reference, quantity)
        spread, least, largest = (_spread(one) for one in (error, *ends))
        intervals = {part: None if spread[part] is None else [least[part], largest[part]] for part in spread}
        errors[quantity] = {**spread, "intervals": intervals}
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


def _spread(error: Array) -> dict[str, float | None]:
    """The median, the 95th percentile and the greatest of the errors; None for an infinite one and without cases."""
    if not error.size:
        return dict.fromkeys(("median", "high", "worst"))
    ordered = np.sort(error)
    median, high = (
        np.percentile(ordered, part, method="higher" if np.isinf(ordered[-1]) else "linear") for part in (50, 95)
    )
    return {"median": finite(median), "high": finite(high), "worst": finite(ordered[-1])}


def _bars(sweep: Sweep, reference: Reference, quantity: str) -> dict[str, float | int | None]:
    """The uncertainty of the reference over the cases in which its error counts."""
    bar = reference.uncertainty[quantity][loaded(sweep, reference.setting)]
    known = bar[np.isfinite(bar)]
    return {**_spread(known), "known": int(known.size), "cases": int(bar.size)}


def _rank_entries(one: Ranking) -> dict[str, Any]:
    nearer = dict(zip(one.settings, one.nearer, strict=True))
    return {"quantity": one.quantity, "settings": list(one.settings), "nearer": nearer, "order": _verdict(one)}


def _verdict(one: Ranking) -> str:
    named = {Order.FIRST: one.settings[0], Order.SECOND: one.settings[1]}
    return f"{named[one.order]} is nearer" if one.order in named else str(one.order)


def _span(ends: Sequence[float | None] | None) -> str:
    return "-" if ends is None else span(ends[0], ends[1])
