"""roughfilm surface: from an instrument's file to a periodic roughness cell, and what became of it."""

import os
import time
from collections.abc import Mapping
from contextlib import ExitStack
from pathlib import Path
from typing import Annotated

import typer
from rich.markup import escape
from rich.table import Table

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.files import replacing
from roughfilm.contact.foundation.units import Quantity
from roughfilm.contact.parameters.roughness_parameters import bearing_parameters, parameters
from roughfilm.contact.preparation.prepare import Prepared, prepare
from roughfilm.contact.preparation.recipe import AS_IT_IS, Reading, Recipe, load_recipe, recipe_entries
from roughfilm.contact.surfaces.files import read_surface
from roughfilm.contact.surfaces.store import save_surface
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.contact.synthetic.description import make, read_description
from roughfilm.rom.ladder.provenance import circumstances
from roughfilm.terminal.console import AsJson, in_one_line, messages, output, print_json, progress_bar
from roughfilm.words.numbers import in_unit
from roughfilm.words.surface import preparation_steps

SOURCES = ("ISO 25178-2:2021", "F. Sahlin, Luleå University of Technology 2008:26, sections E.3.1 and F.3")

STEPS = 5


@in_one_line
def command(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="A measured surface, or a synthetic one (TOML).")],
    recipe: Annotated[
        Path | None, typer.Option("--prepare", help="The recipe (TOML); by default the usual one.")
    ] = None,
    set_: Annotated[
        list[str] | None,
        typer.Option("--set", metavar="KEY=VALUE", help="Override a key, e.g. edges.direction=x; repeatable."),
    ] = None,
    out: Annotated[Path | None, typer.Option(help="Write the prepared surface here (HDF5).")] = None,
    report: Annotated[Path | None, typer.Option(help="Write a page with its pictures here (HTML).")] = None,
    as_json: AsJson = False,
) -> None:
    """Read a surface, prepare it as a periodic cell, and show it before and after."""
    refuse_same({"FILE": file, "--prepare": recipe, "--out": out, "--report": report})
    started, cpu = time.perf_counter(), sum(os.times()[:4])
    asked = load_recipe(recipe, set_ or ())
    with progress_bar(STEPS) as advance:
        advance(0, f"reading {file.name}")
        surface = _read(file, asked)
        if surface.periodic and recipe is None:
            asked = load_recipe(None, set_ or (), AS_IT_IS)
        advance(1, "preparing")
        prepared = prepare(surface, asked)
        advance(2, "parameters")
        quantities = _quantities(prepared)
        numerics = {
            "residual": prepared.record["invalid"]["residual"],
            "points": prepared.surface.heights.size,
            "cpu_s": sum(os.times()[:4]) - cpu,
            "wall_s": time.perf_counter() - started,
        }
        provenance = {
            "surface": dict(surface.source),
            "recipe": recipe_entries(asked),
            "record": dict(prepared.record),
            "warnings": list(prepared.warnings),
            "sources": list(SOURCES),
            **circumstances(),
        }
        with ExitStack() as both:  # neither is renamed into place before both are whole
            places = [path and both.enter_context(replacing(path)) for path in (out, report)]
            if places[0] is not None:
                advance(3, "writing the surface")
                save_surface(prepared.surface, places[0])
            if places[1] is not None:
                from roughfilm.pages.surface import write_page  # matplotlib is slow to import

                advance(4, "drawing the page")
                write_page(prepared, quantities, provenance, places[1])
    if as_json:
        entries = {name: {"value": one.value, "unit": one.unit} for name, one in quantities.items()}
        print_json({"quantities": entries, "numerics": numerics, "provenance": provenance})
    else:
        output.print(table_of(file.name, quantities))
        for line in preparation_steps(prepared):
            output.print(escape(line), soft_wrap=True)
        for path in filter(None, (out, report)):
            output.print(f"written: {escape(str(path))}", soft_wrap=True)
    for warning in prepared.warnings:
        messages.print(f"[yellow]warning:[/] {escape(warning)}", soft_wrap=True)


def refuse_same(named: Mapping[str, Path | None]) -> None:
    """No output may replace an input, or the other output."""
    seen: dict[str, str] = {}
    for name, path in named.items():
        if path is None:
            continue
        place = os.path.realpath(os.path.expanduser(path))
        if name in ("--out", "--report") and place in seen:
            raise InputError(f"{name} {path}: is the same file as {seen[place]}; choose another place")
        seen[place] = name


def _read(file: Path, recipe: Recipe) -> Surface:
    read = recipe.read
    if file.suffix.lower() == ".toml":
        if read != Reading():
            raise InputError(f"{file}: holds its own spacing and unit; leave out the recipe's table read")
        return make(read_description(file))
    return read_surface(file, channel=read.channel, spacing=read.spacing, height_unit=read.height_unit)


def _quantities(prepared: Prepared) -> dict[str, Quantity]:
    """Parameters of the prepared surface, the same of the measured one as ``raw_...``, and how good the cell is.

    A bearing ratio is a part of the whole area, and what was not measured lies mostly in pits and on flanks: so the
    bearing curve of the measured surface counts its invalid points at their filled heights. All else leaves them out.
    """
    record = prepared.record
    raw = {**parameters(prepared.measured), **bearing_parameters(prepared.filled)}
    return {
        **parameters(prepared.surface),
        **{f"raw_{name}": quantity for name, quantity in raw.items()},
        "invalid_fraction": Quantity(value=record["invalid"]["fraction"], unit="1"),
        "periodicity_mismatch": Quantity(value=record["periodicity_mismatch"]["after"], unit="1"),
        "raw_periodicity_mismatch": Quantity(value=record["periodicity_mismatch"]["before"], unit="1"),
    }


def table_of(name: str, quantities: dict[str, Quantity]) -> Table:
    """Each quantity before and after preparation, lengths in µm."""
    table = Table("parameter", "measured", "prepared", "unit", title=escape(name))
    for column in table.columns[1:3]:
        column.justify = "right"
    for key, quantity in quantities.items():
        if not key.startswith("raw_"):
            raw = quantities.get(f"raw_{key}")
            table.add_row(key, "" if raw is None else in_unit(raw)[0], *in_unit(quantity))
    return table
