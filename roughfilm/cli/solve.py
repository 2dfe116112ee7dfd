"""roughfilm solve: one model on one scene."""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Annotated

import typer
from rich.table import Table

from roughfilm.cli.advise import Want, advice_for, entries_of
from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.interface.solving import with_expected_error
from roughfilm.ladder import find
from roughfilm.rom.advice.advise import shortfall
from roughfilm.rom.advice.estimates import bounded
from roughfilm.rom.ladder.kind import Scene, kind_of_name
from roughfilm.rom.ladder.model import Model
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.ladder.scene import load_scene
from roughfilm.rom.ladder.store import as_entries, refuse_other_file, save
from roughfilm.terminal.console import (
    AsJson,
    Overrides,
    Processes,
    Resolution,
    ScenePath,
    Scheme,
    Tolerance,
    messages,
    print_json,
    progress_bar,
)
from roughfilm.terminal.output_file import refuse_unwritable
from roughfilm.terminal.results import print_all, table_of
from roughfilm.words.cost import cost_in_words


def command(
    scene: ScenePath,
    model: Annotated[str | None, typer.Option(help="A name from 'roughfilm models'.")] = None,
    within: Annotated[
        str | None, typer.Option(help="Instead of a model: take the cheapest within this error, for example 5%.")
    ] = None,
    quantity: Want = None,
    out: Annotated[Path | None, typer.Option(help="Write the result with its fields here (HDF5).")] = None,
    set_: Overrides = None,
    resolution: Resolution = None,
    tolerance: Tolerance = None,
    scheme: Scheme = None,
    processes: Processes = 1,
    as_json: AsJson = False,
) -> None:
    """Solve a scene by one model, or by the cheapest that is accurate enough."""
    read = load_scene(scene, set_ or ())
    if out is not None:
        refuse_other_file(out)
        refuse_unwritable(out)
    result, advice = None, None
    if within is not None:
        own = {"model": model, "resolution": resolution, "tolerance": tolerance, "scheme": scheme}
        own["processes"] = processes if processes != 1 else None
        if given := [name for name, value in own.items() if value is not None]:
            raise InputError(f"--{given[0]}: --within chooses the model and how it is run; leave one of them out")
        advice = advice_for(read, quantity, within)
        if advice.chosen is None:
            raise ConvergenceError(f"--within: {shortfall(advice)}")
        model, resolution, result = advice.chosen.model, advice.chosen.resolution, advice.result
        messages.print(f"{model} at resolution {resolution}: {advice.chosen.reason}", soft_wrap=True, markup=False)
    elif quantity is not None:
        raise InputError("--want: names the quantity of --within; give that too")
    if model is None:
        raise InputError("--model: is missing; name one from 'roughfilm models', or give --within 5%")
    by = find(read.kind, model)
    if result is None:
        request = Request(resolution=resolution, tolerance=tolerance, scheme=scheme, processes=processes)
        with progress_bar(1.0) as advance:
            result = by.solve(read, request, progress=advance)
    result = with_expected_error(result, read, by)
    if advice is not None:
        result = replace(result, provenance={**result.provenance, "advice": entries_of(advice)})
    if out is not None:
        save(result, out)
    if as_json:
        print_json(as_entries(result))
    else:
        print_all(_shown(read, by, result))


def _shown(scene: Scene, by: Model, result: Result) -> Iterator[Table | str]:
    """The result for people."""
    yield quantity_table(result)
    numbers = result.numerics
    yield (
        f"residual {numbers.residual:.1e} ({by.residual_meaning}), {numbers.iterations} iterations, "
        f"{numbers.degrees_of_freedom} unknowns, {cost_in_words(result)}"
    )
    for run in numbers.runs:
        if run.recipe and not run.name:
            yield f"first run did not converge; second run succeeded with: {run.recipe}"
    if result.expected_error:
        titles = kind_of_name(scene.kind).titles
        errors = (f"{titles[name]} {bounded(error)}" for name, error in result.expected_error.items())
        yield f"expected error of {by.name} by the fitted laws: {', '.join(errors)}"
    yield by.applies(scene).reason
    yield from (f"warning: {warning}" for warning in result.warnings)


def quantity_table(result: Result) -> Table:
    """The quantities of a result, with their uncertainties where any is known."""
    known = any(quantity.uncertainty is not None for quantity in result.quantities.values())
    rows = []
    for name, quantity in result.quantities.items():
        uncertainty = "" if quantity.uncertainty is None else f"{quantity.uncertainty:.1e}"
        unit = "" if quantity.unit == "1" else quantity.unit
        rows.append((name, f"{quantity.value:.5g}", *([uncertainty] if known else []), unit))
    heads = ("quantity", "value", *(["±"] if known else []), "unit")
    table = table_of(heads, rows, title=f"{result.provenance['scene']['name']} by {result.model}", left=1)
    for column in table.columns[2:]:
        column.justify = "left"
    return table
