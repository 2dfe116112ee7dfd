"""roughfilm surface: a periodic roughness cell from a measured surface, with its parameters before and after."""

from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Annotated, Literal

import typer
from rich.table import Table

from roughfilm.contact.foundation.checked_hdf5 import marked
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.timing import stopwatch
from roughfilm.contact.foundation.units import Quantity
from roughfilm.contact.foundation.writing.kinds import PAGE
from roughfilm.contact.parameters.definitions import AREAL, PROFILE, PROFILE_STANDARD
from roughfilm.contact.parameters.profile import SECTIONS
from roughfilm.contact.parameters.roughness_parameters import parameters, profile_parameters
from roughfilm.contact.preparation.prepare import Prepared, prepare
from roughfilm.contact.preparation.profile import prepare_profile
from roughfilm.contact.preparation.recipe import AS_IT_IS, Reading, Recipe, load_recipe, recipe_entries
from roughfilm.contact.surfaces.files import read_measurement
from roughfilm.contact.surfaces.periodicity import MISMATCH_THRESHOLD
from roughfilm.contact.surfaces.profile import Profile
from roughfilm.contact.surfaces.store import MARK, save_surface
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.contact.synthetic.description import make, read_description
from roughfilm.terminal.console import OUTPUT, AsJson, Overwrite, ReportFile, progress_bar
from roughfilm.terminal.output_file import refuse_same, refuse_unwritable, replacing_together
from roughfilm.terminal.results import origin, show_result, table_of, written
from roughfilm.words.numbers import in_unit
from roughfilm.words.surface import preparation_steps, scale_limits

EXAMPLES = ("roughfilm surface scripts/examples/surfaces/milled.toml --out cell.h5",)

SOURCES = ("ISO 25178-2:2021", "F. Sahlin, Luleå University of Technology 2008:26, sections E.3.1 and F.3")
STEP_COUNT = 5

WITHOUT_L_FILTER = "a primary profile: set l_filter, such as 0.8 mm, for the parameters of the roughness profile (R)"
"""Warning about a profile whose long waves are kept."""

OF_THE_CELL = {
    "invalid_fraction": "points without a height",
    "outlier_fraction": "points of spikes, on rims, or clipped",
    "filled_fraction": "points that are filled",
    "periodicity_mismatch": f"of opposite edges: good up to {MISMATCH_THRESHOLD:g}",
}
"""Meanings of the quantities that are no parameters of roughness."""


def command(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="A measured surface, or a synthetic one (TOML).")],
    recipe: Annotated[Path | None, typer.Option("--prepare", help="The recipe (TOML; default: the usual one).")] = None,
    set_: Annotated[
        list[str] | None,
        typer.Option("--set", metavar="KEY=VALUE", help="Override a key, e.g. edges.direction=x; repeatable."),
    ] = None,
    out: Annotated[
        Path | None, typer.Option(help="Write the prepared surface here (HDF5).", rich_help_panel=OUTPUT)
    ] = None,
    report: ReportFile = None,
    overwrite: Overwrite = False,
    as_json: AsJson = False,
) -> None:
    """Read a surface, prepare it as a periodic cell, and show it before and after."""
    refuse_same({"FILE": file, "--prepare": recipe, "--out": out, "--report": report})
    spent, steps = stopwatch(), load_recipe(recipe, set_ or ())
    with progress_bar(STEP_COUNT) as advance:
        advance(0, f"reading {file.name}")
        surface = _read(file, steps)
    if isinstance(surface, Profile):
        if out is not None or report is not None:
            raise InputError(f"{file}: is a profile, which has no cell; make a surface of it by roughfilm fit")
        _show_profile(file.name, surface, steps, spent, as_json=as_json)
        return
    with progress_bar(STEP_COUNT) as advance:
        refuse_unwritable((out, marked(MARK)), (report, PAGE), overwrite=overwrite)
        if surface.periodic and recipe is None:
            steps = load_recipe(None, set_ or (), AS_IT_IS)
        advance(1, "preparing")
        prepared = prepare(surface, steps)
        advance(2, "parameters")
        quantities = _quantities(prepared)
        numerics = {
            "residual": prepared.record["invalid"]["residual"],
            "points": prepared.surface.heights.size,
            **spent(),
        }
        provenance = origin(
            SOURCES,
            prepared.warnings,
            surface=dict(surface.source),
            recipe=recipe_entries(steps),
            record=dict(prepared.record),
        )
        with replacing_together((out, marked(MARK)), (report, PAGE), overwrite=overwrite) as (surface_file, page):
            if surface_file is not None:
                advance(3, "writing the surface")
                save_surface(prepared.surface, surface_file)
            if page is not None:
                from roughfilm.pages.surface import write_page  # matplotlib is slow to import

                advance(4, "drawing the page")
                write_page(prepared, quantities, provenance, page)
    values = {name: {"value": quantity.value, "unit": quantity.unit} for name, quantity in quantities.items()}

    def shown() -> Iterator[Table | str]:
        yield _table(file.name, quantities)
        yield from preparation_steps(prepared)
        yield f"parameters: {scale_limits(prepared)}"

    entries = {"quantities": values, "numerics": numerics, "provenance": provenance}
    points, rms = " x ".join(map(str, prepared.surface.heights.shape)), " ".join(in_unit(quantities["Sq"]))
    summary = written(f"{file.name}: a cell of {points} points, rms height {rms}", out, report)
    show_result(entries, shown(), as_json=as_json, summary=summary)


def _read(file: Path, recipe: Recipe) -> Surface | Profile:
    read = recipe.read
    if file.suffix.lower() == ".toml":
        if read != Reading():
            raise InputError(f"{file}: holds its own spacing and unit; leave out the recipe's table read")
        return make(read_description(file))
    return read_measurement(file, **dict(read))


def _show_profile(
    name: str, measured: Profile, recipe: Recipe, spent: Callable[[], dict[str, float]], *, as_json: bool
) -> None:
    """The parameters of a profile, in place of those of a surface."""
    profile = prepare_profile(measured, recipe)
    letter: Literal["P", "R"] = "P" if recipe.l_filter is None else "R"
    count = profile.heights.size
    quantities = profile_parameters(profile.heights, profile.spacing, sections=min(SECTIONS, count), profile=letter)
    warnings = [] if recipe.l_filter is not None else [WITHOUT_L_FILTER]
    if measured.source["filled"]:
        warnings.append(f"{measured.source['filled']} of {count} points were invalid, and are interpolated")
    entries = {
        "quantities": {name: {"value": one.value, "unit": one.unit} for name, one in quantities.items()},
        "numerics": {"points": count, **spent()},
        "provenance": origin(
            (PROFILE_STANDARD,), warnings, profile=dict(profile.source), recipe=recipe_entries(recipe)
        ),
    }

    def shown() -> Iterator[Table | str]:
        rows = []
        for key, one in quantities.items():
            value, unit = in_unit(one)
            rows.append((f"{key}, {unit}" if unit else key, value, PROFILE[f"R{key[1:]}"].meaning))
        table = table_of(("parameter", "profile", "meaning"), rows, title=name, left=1)
        table.columns[-1].justify = "left"
        yield table

    length, rms = (
        " ".join(in_unit(Quantity(value=profile.length, unit="m"))),
        " ".join(in_unit(quantities[f"{letter}q"])),
    )
    summary = f"{name}: a profile of {count} points, {length} long, {letter}q {rms}"
    show_result(entries, shown(), as_json=as_json, summary=summary)


def _quantities(prepared: Prepared) -> dict[str, Quantity]:
    """Parameters of the prepared surface, those of the measured one as ``raw_...``, and the quality of the cell.

    Those of the measured surface are of its valid points, spikes and rims included.
    """
    record = prepared.record
    outliers = sum(record["outliers"][name] for name in ("spikes", "rims", "above", "below"))
    return {
        **parameters(prepared.surface),
        **{f"raw_{name}": quantity for name, quantity in parameters(prepared.measured).items()},
        "invalid_fraction": Quantity(value=record["invalid"]["fraction"], unit="1"),
        "outlier_fraction": Quantity(value=outliers / record["invalid"]["measured"], unit="1"),
        "filled_fraction": Quantity(value=record["filled"]["fraction"], unit="1"),
        "periodicity_mismatch": Quantity(value=record["periodicity_mismatch"]["after"], unit="1"),
        "raw_periodicity_mismatch": Quantity(value=record["periodicity_mismatch"]["before"], unit="1"),
    }


def _table(name: str, quantities: Mapping[str, Quantity]) -> Table:
    """Each quantity before and after preparation, lengths in µm, with its meaning; blank where a surface has none."""
    rows = []
    for key in dict.fromkeys((*AREAL, *(key.removeprefix("raw_") for key in quantities))):
        raw, value = (in_unit(quantities[one]) if one in quantities else ("", "") for one in (f"raw_{key}", key))
        if raw[0] or value[0]:
            unit = raw[1] or value[1]
            meaning = AREAL[key].meaning if key in AREAL else OF_THE_CELL.get(key, "")
            rows.append((f"{key}, {unit}" if unit else key, raw[0], value[0], meaning))
    table = table_of(("parameter", "measured", "prepared", "meaning"), rows, title=name, left=1)
    table.columns[-1].justify = "left"
    return table
