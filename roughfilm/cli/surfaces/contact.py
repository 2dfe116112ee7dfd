"""roughfilm contact: area, gap and pressures of a rough surface that is pressed against a flat plane, over the load."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import asdict
from enum import StrEnum
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.table import Table

from roughfilm.contact.foundation.checked_hdf5 import marked
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.inputs import Inputs
from roughfilm.contact.foundation.threads import checked_threads
from roughfilm.contact.foundation.timing import stopwatch
from roughfilm.contact.foundation.units import to_si
from roughfilm.contact.foundation.writing.kinds import PAGE
from roughfilm.contact.mechanics.load_series import ContactSeries, estimated, solved
from roughfilm.contact.mechanics.models import (
    GRID_MODELS,
    MODELS_WITHOUT_HARDNESS,
    SOURCES,
    ContactModel,
    chosen_model,
    estimator,
    solver,
)
from roughfilm.contact.mechanics.press import COMPLEMENTARITY_TOLERANCE
from roughfilm.contact.mechanics.solid import Solid, beyond_elasticity, composite_modulus
from roughfilm.contact.mechanics.store import MARK, UNITS, Row
from roughfilm.contact.read import HeightMap, parse_spacing, read_height_map
from roughfilm.rom.ladder.provenance import code
from roughfilm.terminal.console import NUMERICS, OUTPUT, AsJson, ReportFile, Spacing, progress_bar
from roughfilm.terminal.output_file import alone, refuse_same, refuse_unwritable
from roughfilm.terminal.ranges import loads_of
from roughfilm.terminal.results import origin, show_result, table_of, written
from roughfilm.words.contact import number_of
from roughfilm.words.numbers import digits
from roughfilm.words.outside import outside_in_words, outside_of_series

EXAMPLES = (
    "roughfilm surface scripts/examples/surfaces/milled.toml --out cell.h5",
    "roughfilm contact cell.h5 --modulus 210GPa --poisson 0.3 --loads 1MPa",
    "roughfilm contact cell.h5 --modulus 210GPa --poisson 0.3 --loads 1MPa,9MPa",
)

DRAWN_LOADS = 5
"""Loads whose pressures are drawn."""

MIN_TOLERANCE = 1e-13
ROW_NUMERICS = ("complementarity", "iterations", "cpu_s")
COLUMNS = {
    "load, MPa": ("load", 1e-6),
    "area, %": ("area_fraction", 100),
    "in pixels, %": ("area_fraction_pixel", 100),
    "plastic, %": ("plastic_fraction", 100),
    "mean gap, µm": ("mean_gap", 1e6),
    "p max, MPa": ("pressure_max", 1e-6),
    "iterations": ("iterations", 1),
}
"""Columns of the table: quantity and factor."""


class Boundary(StrEnum):
    """Condition at the edges of the surface."""

    PERIODIC = "periodic"
    FREE = "free"


def command(
    surface: Annotated[
        Path, typer.Argument(metavar="SURFACE", help="A surface (HDF5, TOML, an instrument's file) or heights (NPY).")
    ],
    modulus: Annotated[str, typer.Option(metavar="E", help="Young's modulus of the surface, e.g. 210GPa.")],
    poisson: Annotated[float, typer.Option(metavar="NU", help="Poisson's ratio of the surface.")],
    loads: Annotated[
        str, typer.Option(metavar="LOADS", help="Mean pressures: 1MPa..1GPa:25 (by a constant factor), a list, or one.")
    ],
    hardness: Annotated[str | None, typer.Option(metavar="H", help="Largest pressure (default: elastic).")] = None,
    counter_modulus: Annotated[
        str | None, typer.Option(metavar="E", help="Young's modulus of the flat body (default: rigid).")
    ] = None,
    counter_poisson: Annotated[
        float | None, typer.Option(metavar="NU", help="Poisson's ratio of the flat body.")
    ] = None,
    spacing: Spacing = None,
    model: Annotated[
        ContactModel | None,
        typer.Option(metavar="MODEL", help=f"{', '.join(ContactModel)} (default: the best that --hardness allows)."),
    ] = None,
    boundary: Annotated[Boundary, typer.Option(help="Periodic surface, or one that stands alone.")] = Boundary.PERIODIC,
    tolerance: Annotated[
        float,
        typer.Option(help="Largest violation of the contact conditions over the rms height.", rich_help_panel=NUMERICS),
    ] = COMPLEMENTARITY_TOLERANCE,
    threads: Annotated[int, typer.Option(help="Threads that share the work.", rich_help_panel=NUMERICS)] = 1,
    out: Annotated[
        Path | None,
        typer.Option(
            help="Write the series here (HDF5); loads that it holds are not solved again.", rich_help_panel=OUTPUT
        ),
    ] = None,
    report: ReportFile = None,
    as_json: AsJson = False,
) -> None:
    """Press a rough surface against a flat plane: area, gap and pressures by load."""
    refuse_same({"SURFACE": surface, "--out": out, "--report": report})
    spent, pressures = stopwatch(), loads_of(loads)
    body, counter = _solid("", modulus, poisson, hardness), _counter(counter_modulus, counter_poisson)
    chosen = chosen_model(model, body.hardness)
    limit = math.inf if chosen in MODELS_WITHOUT_HARDNESS else body.hardness
    _refuse(chosen, boundary, pressures, limit)
    checked_threads(threads)
    if not MIN_TOLERANCE <= tolerance < 1:
        raise InputError(f"--tolerance: got a tolerance of {tolerance:g}; it must be {MIN_TOLERANCE:g} to 1")
    stiffness = composite_modulus(body, counter)
    refuse_unwritable((out, marked(MARK)), (report, PAGE))
    with alone(out, "series"), progress_bar(len(pressures) + 1) as advance:
        advance(0, f"reading {surface.name}")
        periodic, otherwise = boundary is Boundary.PERIODIC, ", --boundary free takes it as it stands"
        rough = read_height_map(surface, parse_spacing(spacing), periodic=periodic, otherwise=otherwise)
        settings = {
            "model": chosen.value,
            "modulus": body.modulus,
            "poisson": body.poisson,
            "hardness": None if math.isinf(limit) else limit,
            "counter_modulus": counter and counter.modulus,
            "counter_poisson": counter and counter.poisson,
            "composite_modulus": stiffness,
            "boundary": boundary.value,
            "tolerance": tolerance,
        }
        inputs = Inputs(heights=rough.heights, spacing=rough.spacing, settings={**settings, "code": code()})
        drawn = _spread_out(pressures)
        if chosen in GRID_MODELS:
            at = solver(
                chosen,
                rough.heights,
                rough.spacing,
                stiffness,
                hardness=limit,
                boundary=boundary.value,
                tolerance=tolerance,
                threads=threads,
            )
            series = solved(at, inputs, pressures, drawn, out, advance)
        else:
            try:
                estimate = estimator(chosen, rough.heights, rough.spacing, stiffness, limit)
            except InputError as error:
                raise InputError(f"{surface}, {chosen}: {error}; take --model elastic") from None
            series = estimated(estimate, inputs, pressures, drawn, out)
        entries = _entries(chosen, rough, settings, series)
        entries["numerics"] |= spent()
        if report is not None:
            from roughfilm.pages.contact import write_page  # matplotlib is slow to import

            advance(len(pressures), "drawing the page")
            write_page(surface.name, entries, series, report)

    def shown() -> Iterator[Table | str]:
        yield table_of([*COLUMNS], map(_cells, series.rows), title=surface.name)

    bars = series.uncertainties.get(series.rows[-1].load, {})
    words = filter(None, [outside_in_words(entries["outside"]), _in_words(chosen, series.rows[-1], bars)])
    summary = written("; ".join(words), out, report)
    show_result(entries, shown(), as_json=as_json, reused="loads", summary=summary)


def _solid(prefix: str, modulus: str, poisson: float, hardness: str | None = None) -> Solid:
    try:
        numbers = {
            name: to_si(text.strip(), "Pa")
            for name, text in (("modulus", modulus), ("hardness", hardness))
            if text is not None
        }
    except ValueError as error:
        place = f"--{prefix}modulus {modulus}" + ("" if hardness is None else f", --{prefix}hardness {hardness}")
        raise InputError(f"{place}: {error}") from None
    try:
        return Solid(poisson=poisson, **numbers)
    except InputError as error:
        raise InputError(str(error).replace("solid.", f"--{prefix}")) from None


def _counter(modulus: str | None, poisson: float | None) -> Solid | None:
    if (modulus is None) != (poisson is None):
        missing = "--counter-modulus" if modulus is None else "--counter-poisson"
        raise InputError(f"{missing}: is missing; give both for an elastic flat body, or none for a rigid one")
    return None if modulus is None or poisson is None else _solid("counter-", modulus, poisson)


def _refuse(model: ContactModel, boundary: Boundary, loads: tuple[float, ...], hardness: float) -> None:
    """Raise InputError for loads above the hardness, and for a model without edges at a free boundary."""
    above = [load for load in loads if load > hardness]
    if above:
        raise InputError(
            f"--loads: {len(above)} of {len(loads)}, up to {above[-1] / 1e6:.10g} MPa, are above the hardness of "
            f"{hardness / 1e6:.10g} MPa, which is the largest mean pressure that the whole area can carry; lower them"
        )
    if boundary is Boundary.FREE and (model not in GRID_MODELS or model is ContactModel.STANLEY_KATO):
        raise InputError(f"--boundary free: {model} has no edges; take --model elastic or elastic_plastic")


def _spread_out(loads: tuple[float, ...]) -> tuple[float, ...]:
    """A few of the loads, the first and the last among them."""
    count = min(DRAWN_LOADS, len(loads))
    return tuple(loads[round(k * (len(loads) - 1) / max(count - 1, 1))] for k in range(count))


def _entries(model: ContactModel, rough: HeightMap, settings: dict[str, Any], series: ContactSeries) -> dict[str, Any]:
    """The object of ``--json``, without the cost."""
    last = asdict(series.rows[-1])
    units = {name: UNITS.get(name, "1") for name in last}
    bars = series.uncertainties.get(series.rows[-1].load, {})
    quantities = {
        name: {"value": value, "unit": units[name], **({"uncertainty": bars[name]} if name in bars else {})}
        for name, value in last.items()
        if name not in ROW_NUMERICS
    }
    quantities["plasticity_index"] = {"value": _plasticity_index(series.rows[-1]), "unit": "1"}
    quantities["composite_modulus"] = {"value": settings["composite_modulus"], "unit": "Pa"}
    violations = [row.complementarity for row in series.rows if row.complementarity is not None]
    found = [_outside(model, row, settings["composite_modulus"]) for row in series.rows]
    points = [(f"{row.load / 1e6:.4g} MPa", reasons) for row, reasons in zip(series.rows, found, strict=True)]
    warnings = [*rough.warnings, *filter(None, [outside_of_series(points)])]
    if series.untrusted:
        outside = f"{len(series.untrusted)} of {len(series.rows)} loads lie outside the range where {model} is trusted"
        better = ContactModel.ELASTIC if settings["hardness"] is None else ContactModel.ELASTIC_PLASTIC
        warnings.append(f"{outside}; compare with --model {better}")
    return {
        "series": [asdict(row) for row in series.rows],
        "units": units,
        "quantities": quantities,
        "numerics": {
            "residual": max(violations, default=None),
            "iterations": sum(row.iterations or 0 for row in series.rows),
            "points": rough.heights.size,
            "loads": len(series.rows),
            "loads_found": series.reused,
        },
        "outside": list(found[-1]),
        "provenance": origin([SOURCES[model]], warnings, surface=dict(rough.source), settings=settings),
    }


def _outside(model: ContactModel, row: Row, composite_modulus: float) -> tuple[str, ...]:
    """The sentence on a pressure beyond linear elasticity; the bearing area does not use it."""
    if model is ContactModel.BEARING_AREA:
        return ()
    if row.pressure_max is None:
        return beyond_elasticity(row.load, composite_modulus, "mean pressure")
    return beyond_elasticity(row.pressure_max, composite_modulus)


def _plasticity_index(row: Row) -> float:
    pixels = row.area_fraction if row.area_fraction_pixel is None else row.area_fraction_pixel
    return row.plastic_fraction / pixels if pixels else 0.0


def _in_words(model: ContactModel, row: Row, uncertainties: Mapping[str, float]) -> str:
    """The contact under one load, as a sentence."""
    gap = "" if row.mean_gap is None else f", mean gap {number_of(row, 'mean_gap', 1e6, uncertainties)} µm"
    area = number_of(row, "area_fraction", 100, uncertainties)
    return f"under {digits(row.load / 1e6)} MPa {area} % of the area touch{gap}, by {model}"


def _cells(row: Row) -> list[str]:
    values = [(getattr(row, name), factor) for name, factor in COLUMNS.values()]
    return ["-" if value is None else digits(value * factor) for value, factor in values]
