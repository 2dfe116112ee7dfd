"""roughfilm solve: one model on one scene."""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Annotated

import typer
from rich.table import Table

from roughfilm.cli.first_steps.advise import Want, entries_of, tolerance_of
from roughfilm.contact.foundation.errors import InputError
from roughfilm.interface.solving import solve, solve_as_advised
from roughfilm.ladder import find
from roughfilm.rom.advice.advise import DEFAULT_TOLERANCE, Advice, shortfall, wanted
from roughfilm.rom.advice.expected import error_lines
from roughfilm.rom.advice.stated import percent
from roughfilm.rom.ladder.kind import Scene, kind_of_scene
from roughfilm.rom.ladder.model import Model
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.ladder.scene import load_scene
from roughfilm.rom.ladder.store import RESULT, as_entries, save
from roughfilm.terminal.completion import models_beginning_with
from roughfilm.terminal.console import (
    AsJson,
    Overrides,
    Overwrite,
    Processes,
    Resolution,
    ScenePath,
    Scheme,
    Tolerance,
    messages,
    print_json,
    progress_bar,
)
from roughfilm.terminal.layout import wrapped
from roughfilm.terminal.output_file import refuse_unwritable
from roughfilm.terminal.results import print_all, quantity_table, written
from roughfilm.words.cost import cost_in_words
from roughfilm.words.summary import summary

EXAMPLES = (
    "roughfilm solve scripts/examples/scenes/pocket.toml",
    "roughfilm solve scripts/examples/scenes/journal.toml --set load.force=5kN",
    "roughfilm solve scripts/examples/scenes/pocket.toml --model film --out film.h5",
)


def command(
    scene: ScenePath,
    model: Annotated[
        str | None,
        typer.Option(
            help="A name from 'roughfilm models' (default: the advised one, see --within).",
            autocompletion=models_beginning_with,
        ),
    ] = None,
    within: Annotated[
        str | None,
        typer.Option(
            help="Take the cheapest model within this error, for example 2%, and fail if there is none (default: 5%, "
            "else the most accurate model)."
        ),
    ] = None,
    quantity: Want = None,
    out: Annotated[Path | None, typer.Option(help="Write the result with its fields here (HDF5).")] = None,
    overwrite: Overwrite = False,
    set_: Overrides = None,
    resolution: Resolution = None,
    tolerance: Tolerance = None,
    scheme: Scheme = None,
    processes: Processes = 1,
    as_json: AsJson = False,
) -> None:
    """Solve a scene by the cheapest model that is accurate enough, or by a given one."""
    read = load_scene(scene, set_ or ())
    if out is not None:
        refuse_unwritable((out, RESULT), overwrite=overwrite)
    asked, fraction = wanted(read, quantity), DEFAULT_TOLERANCE if within is None else tolerance_of(within)
    own = {"resolution": resolution, "tolerance": tolerance, "scheme": scheme}
    own["processes"] = processes if processes != 1 else None
    given = [name for name, value in own.items() if value is not None]
    if model is None and given:
        raise InputError(f"--{given[0]}: needs --model, as its meaning depends on it; name one from 'roughfilm models'")
    if model is not None and (within is not None or quantity is not None):
        option = "--want" if within is None else "--within"
        raise InputError(f"--model: {option} is for the choice of a model; leave one of them out")
    with progress_bar(1.0) as advance:
        if model is None:
            tolerated = None if within is None else fraction
            result, advice = solve_as_advised(read, within=tolerated, quantity=asked, progress=advance)
            result = replace(result, provenance={**result.provenance, "advice": entries_of(advice)})
            choice = _choice(advice)
        else:
            result = solve(
                read,
                model=model,
                resolution=resolution,
                tolerance=tolerance,
                scheme=scheme,
                processes=processes,
                progress=advance,
            )
            choice = ""
    if choice:
        messages.print(wrapped(choice, messages.width), soft_wrap=True, markup=False)
    if out is not None:
        save(result, out, overwrite=overwrite)
    if as_json:
        print_json(as_entries(result))
    else:
        print_all(_shown(read, find(read.kind, result.model), result, asked, fraction, out))


def _choice(advice: Advice) -> str:
    """The line on the model that is taken, and why."""
    taken = advice.chosen or advice.fallback
    if taken is None:
        return shortfall(advice)
    why = f"cheapest within {percent(advice.within)} in {advice.title}" if advice.chosen else "most accurate one known"
    return f"{taken.model} at resolution {taken.resolution}: {why}, {taken.why}"


def _shown(
    scene: Scene, by: Model, result: Result, quantity: str, within: float, out: Path | None
) -> Iterator[Table | str]:
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
    yield f"{by.name} {by.applies(scene).reason}"
    yield from (f"errors of {by.name}: {line}" for line in error_lines(kind_of_scene(scene), result))
    yield from (f"warning: {warning}" for warning in result.warnings)
    yield written(summary(result, quantity, within), out)
