"""roughfilm solve: one model on one scene."""

from dataclasses import replace
from pathlib import Path
from typing import Annotated

import typer
from rich.markup import escape
from rich.table import Table

from roughfilm.cli.advise import Want, advice_for, entries_of
from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.interface.solving import with_expected_error
from roughfilm.ladder import find
from roughfilm.rom.advice.advise import shortfall
from roughfilm.rom.advice.estimates import bounded
from roughfilm.rom.ladder.kind import kind_of_name
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.ladder.scene import load_scene
from roughfilm.rom.ladder.store import as_entries, save
from roughfilm.terminal.console import (
    AsJson,
    Overrides,
    Processes,
    Resolution,
    ScenePath,
    Scheme,
    Tolerance,
    in_one_line,
    messages,
    output,
    print_json,
    progress_bar,
)


@in_one_line
def command(
    scene: ScenePath,
    model: Annotated[str | None, typer.Option(help="A name from 'roughfilm models'.")] = None,
    within: Annotated[
        str | None, typer.Option(help="Instead of a model: take the cheapest that is no farther off, for example 5%.")
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
    """Solve a scene with one model, or with the cheapest that is enough."""
    read = load_scene(scene, set_ or ())
    result, advised = None, None
    if within is not None:
        own = {"model": model, "resolution": resolution, "tolerance": tolerance, "scheme": scheme}
        own["processes"] = processes if processes != 1 else None
        if given := [name for name, value in own.items() if value is not None]:
            raise InputError(f"--{given[0]}: --within chooses the model and how it is run; leave one of them out")
        found = advice_for(read, quantity, within)
        if found.chosen is None:
            raise ConvergenceError(f"--within: {shortfall(found, kind_of_name(read.kind).compared[found.quantity])}")
        model, resolution, result, advised = found.chosen.model, found.chosen.resolution, found.result, found
        messages.print(f"{model} at resolution {resolution}: {found.chosen.reason}", soft_wrap=True, markup=False)
    elif quantity is not None:
        raise InputError("--want: says of which quantity --within speaks; give that too")
    if model is None:
        raise InputError("--model: is missing; name one from 'roughfilm models', or give --within 5%")
    rung = find(read.kind, model)
    if result is None:
        request = Request(resolution=resolution, tolerance=tolerance, scheme=scheme, processes=processes)
        with progress_bar(1.0) as advance:
            result = rung.solve(read, request, progress=advance)
    result = with_expected_error(result, read, rung)
    if advised is not None:
        result = replace(result, provenance={**result.provenance, "advice": entries_of(advised)})
    if out is not None:
        save(result, out)
    if as_json:
        print_json(as_entries(result))
    else:
        output.print(table_of(result))
        numbers = result.numerics
        output.print(
            f"residual {numbers.residual:.1e} ({rung.residual_meaning}), {numbers.iterations} iterations, "
            f"{numbers.degrees_of_freedom} unknowns, {numbers.cpu_s:.3g} CPU s"
        )
        for run in numbers.runs:
            if run.recipe and not run.name:
                output.print(f"first run did not converge; second run succeeded with: {run.recipe}")
        if result.expected_error:
            titles = kind_of_name(read.kind).compared
            errors = (f"{titles[name]} {bounded(error)}" for name, error in result.expected_error.items())
            output.print(f"expected error of {model} by the fitted laws: {', '.join(errors)}", soft_wrap=True)
        output.print(rung.applies(read).reason)
        for warning in result.warnings:
            output.print(f"[yellow]warning:[/] {escape(warning)}")


def table_of(result: Result) -> Table:
    """The quantities of a result, as people read them."""
    known = any(quantity.uncertainty is not None for quantity in result.quantities.values())
    columns = ("quantity", "value", "±", "unit") if known else ("quantity", "value", "unit")
    table = Table(*columns, title=f"{escape(result.provenance['scene']['name'])} by {result.model}")
    table.columns[1].justify = "right"
    for name, quantity in result.quantities.items():
        uncertainty = "" if quantity.uncertainty is None else f"{quantity.uncertainty:.1e}"
        cells = [name, f"{quantity.value:.5g}", uncertainty, "" if quantity.unit == "1" else quantity.unit]
        table.add_row(*(cells if known else (*cells[:2], cells[3])))
    return table
