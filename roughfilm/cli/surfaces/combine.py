"""roughfilm combine: the difference of two measurements of one place, or the sum of two walls."""

from collections.abc import Iterator
from pathlib import Path
from typing import Annotated

import typer
from rich.table import Table

from roughfilm.contact.foundation.checked_hdf5 import marked
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.timing import stopwatch
from roughfilm.contact.foundation.units import to_si
from roughfilm.contact.foundation.writing.kinds import PAGE
from roughfilm.contact.preparation.recipe import Recipe, load_recipe
from roughfilm.contact.registration.combine import (
    Combined,
    Level,
    Mirror,
    Operation,
    Shift,
    composite,
    difference,
    usual_entries,
)
from roughfilm.contact.surfaces import files
from roughfilm.contact.surfaces.store import MARK, save_surface
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.interface.surfaces import read_surface
from roughfilm.terminal.console import OUTPUT, AsJson, Overwrite, ReportFile, progress_bar
from roughfilm.terminal.output_file import refuse_same, refuse_unwritable, replacing_together
from roughfilm.terminal.results import origin, show_result, table_of, written
from roughfilm.words.combination import answer, combination_rows, combination_steps

EXAMPLES = (
    "roughfilm combine before.x3p after.x3p --out wear.h5 --report wear.html",
    "roughfilm combine cell.h5 other.h5 --operation sum --out walls.h5",
)

SOURCES = ("D. Padfield, IEEE Trans. Image Process. 21 (2012) 2706", "B. D. Lucas and T. Kanade, IJCAI 1981, 674")
STEP_COUNT = 4


def command(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="The measurement before, or the first wall.")],
    other: Annotated[Path, typer.Argument(metavar="OTHER", help="The measurement after, or the second wall.")],
    operation: Annotated[Operation, typer.Option(help="FILE − OTHER, or FILE + OTHER turned over.")] = "difference",
    shift: Annotated[
        str | None,
        typer.Option(
            metavar="X,Y",
            help="Position of OTHER on FILE, e.g. '5um,-2um', or 'registered', by the correlation (default: "
            "registered for a difference, 0 for a sum).",
        ),
    ] = None,
    level: Annotated[
        Level, typer.Option(help="Points through which the plane is fitted that a difference is measured from.")
    ] = "unworn",
    mirror: Annotated[
        Mirror, typer.Option(help="Coordinate of OTHER that a sum reverses: 'y' turns it over about the x axis.")
    ] = "y",
    recipe: Annotated[
        Path | None,
        typer.Option(
            "--prepare", help="Recipe (TOML) whose form, outliers and filters both take first (default: the tilt)."
        ),
    ] = None,
    set_: Annotated[
        list[str] | None,
        typer.Option("--set", metavar="KEY=VALUE", help="Override a key of the recipe, e.g. form=mean; repeatable."),
    ] = None,
    out: Annotated[
        Path | None, typer.Option(help="Write the difference or the sum here (HDF5).", rich_help_panel=OUTPUT)
    ] = None,
    report: ReportFile = None,
    overwrite: Overwrite = False,
    as_json: AsJson = False,
) -> None:
    """Subtract two measurements of one place, which shows wear, or add two walls that face each other."""
    refuse_same({"FILE": file, "OTHER": other, "--prepare": recipe, "--out": out, "--report": report})
    spent, place = stopwatch(), _shift(shift, operation)
    with progress_bar(STEP_COUNT) as advance:
        reading = load_recipe(recipe, set_ or ())
        surfaces = []
        for path in (file, other):
            advance(0, f"reading {path.name}")
            surfaces.append(_read(path, reading))
        refuse_unwritable((out, marked(MARK)), (report, PAGE), overwrite=overwrite)
        first, second = surfaces
        steps = load_recipe(recipe, set_ or (), usual_entries(first, second))
        advance(1, "registering")
        if operation == "sum":
            combined = composite(first, second, steps, shift=place, mirror=mirror)
        else:
            combined = difference(first, second, steps, shift=place, level=level)
        numerics = {"points": combined.surface.heights.size, **spent()}
        provenance = origin(
            SOURCES,
            combined.warnings,
            surfaces=[dict(first.source), dict(second.source)],
            record=dict(combined.record),
        )
        names = (file.name, other.name)
        with replacing_together((out, marked(MARK)), (report, PAGE), overwrite=overwrite) as (surface_file, page):
            if surface_file is not None:
                advance(2, "writing the surface")
                save_surface(combined.surface, surface_file)
            if page is not None:
                from roughfilm.pages.combination import write_page  # matplotlib is slow to import

                advance(3, "drawing the page")
                write_page(combined, names, provenance, page)
    values = {
        name: {"value": quantity.value, "unit": quantity.unit, "uncertainty": quantity.uncertainty}
        for name, quantity in combined.quantities.items()
    }
    entries = {"quantities": values, "numerics": numerics, "provenance": provenance}
    summary = written(answer(combined, names), out, report)
    show_result(entries, _shown(combined, names), as_json=as_json, summary=summary)


def _shown(combined: Combined, names: tuple[str, str]) -> Iterator[Table | str]:
    sign = "+" if combined.operation == "sum" else "−"
    rows = [row[:4] for row in combination_rows(combined)]
    table = table_of(("quantity", "value", "±", "unit"), rows, title=f" {sign} ".join(names), left=1)
    table.columns[-1].justify = "left"
    yield table
    yield from combination_steps(combined)


def _read(file: Path, recipe: Recipe) -> Surface:
    described = file.suffix.lower() == ".toml"
    return read_surface(file, **dict(recipe.read)) if described else files.read_surface(file, **dict(recipe.read))


def _shift(text: str | None, operation: Operation) -> Shift:
    if text is None:
        return "registered" if operation == "difference" else (0.0, 0.0)
    if text.strip() == "registered":
        return "registered"
    parts = text.split(",")
    if len(parts) != 2:
        raise InputError(f"--shift: got {text!r:.60}; write two lengths, such as '5um,-2um', or 'registered'")
    try:
        x, y = (to_si(part.strip(), "m") for part in parts)
    except ValueError as error:
        raise InputError(f"--shift: {error}") from None
    return x, y
