"""roughfilm contact: a rough surface pressed against a flat plane, load by load."""

import math
import os
import time
from dataclasses import asdict
from enum import StrEnum
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.markup import escape
from rich.table import Table

from roughfilm.cli.surface import refuse_same
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.inputs import Inputs
from roughfilm.contact.foundation.threads import checked_threads
from roughfilm.contact.foundation.units import to_si
from roughfilm.contact.mechanics.load_series import Series, estimated, solved
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
from roughfilm.contact.mechanics.solid import Solid, composite_modulus
from roughfilm.contact.mechanics.store import UNITS, Row
from roughfilm.contact.read import HeightMap, parse_spacing, read_height_map
from roughfilm.rom.ladder.provenance import circumstances, code
from roughfilm.terminal.console import AsJson, in_one_line, messages, output, print_json, progress_bar
from roughfilm.terminal.load_range import loads_of
from roughfilm.terminal.output_file import alone, refuse_unwritable
from roughfilm.words.numbers import digits

SHOWN = 5
"""Loads whose pressures are drawn."""


LEAST_TOLERANCE = 1e-13


class Boundary(StrEnum):
    """What lies beyond the edges."""

    PERIODIC = "periodic"
    FREE = "free"


@in_one_line
def command(
    surface: Annotated[
        Path, typer.Argument(metavar="SURFACE", help="A surface (HDF5, TOML, an instrument's file) or heights (NPY).")
    ],
    modulus: Annotated[str, typer.Option(metavar="E", help="Young's modulus of the surface, e.g. 210GPa.")],
    poisson: Annotated[float, typer.Option(metavar="NU", help="Its Poisson's ratio.")],
    loads: Annotated[
        str, typer.Option(metavar="LOADS", help="Mean pressures: 1MPa..1GPa:25 (by a constant factor), a list, or one.")
    ],
    hardness: Annotated[str | None, typer.Option(metavar="H", help="The greatest pressure; none if elastic.")] = None,
    counter_modulus: Annotated[
        str | None, typer.Option(metavar="E", help="Young's modulus of the flat body; rigid if not given.")
    ] = None,
    counter_poisson: Annotated[float | None, typer.Option(metavar="NU", help="Its Poisson's ratio.")] = None,
    spacing: Annotated[
        str | None, typer.Option(metavar="D", help="Between the points of an array of heights: 1um, or 1um,2um.")
    ] = None,
    model: Annotated[
        ContactModel | None, typer.Option(help="The rung; by default the best that --hardness allows.")
    ] = None,
    boundary: Annotated[Boundary, typer.Option(help="Repeated without end, or alone.")] = Boundary.PERIODIC,
    tolerance: Annotated[
        float, typer.Option(help="Of the conditions of contact, over the rms height.")
    ] = COMPLEMENTARITY_TOLERANCE,
    threads: Annotated[int, typer.Option(help="Threads that share the work.")] = 1,
    out: Annotated[
        Path | None, typer.Option(help="Write the series here (HDF5); loads that it holds are not solved again.")
    ] = None,
    report: Annotated[Path | None, typer.Option(help="Write a page with its pictures here (HTML).")] = None,
    as_json: AsJson = False,
) -> None:
    """Press a rough surface against a flat plane: area, gap and pressures by load."""
    refuse_same({"SURFACE": surface, "--out": out, "--report": report})
    started, cpu = time.perf_counter(), sum(os.times()[:4])
    asked = loads_of(loads)
    body = _solid("", modulus, poisson, hardness)
    counter = _counter(counter_modulus, counter_poisson)
    rung = chosen_model(model, body.hardness)
    bound = math.inf if rung in MODELS_WITHOUT_HARDNESS else body.hardness
    _refuse(rung, boundary, asked, bound)
    checked_threads(threads)
    if not LEAST_TOLERANCE <= tolerance < 1:
        raise InputError(f"--tolerance: got a tolerance of {tolerance:g}; it must be {LEAST_TOLERANCE:g} to 1")
    stiffness = composite_modulus(body, counter)
    periodic = boundary is Boundary.PERIODIC
    for path in filter(None, (out, report)):
        refuse_unwritable(path)
    with alone(out, "series"), progress_bar(len(asked) + 1) as advance:
        advance(0, f"reading {surface.name}")
        otherwise = ", --boundary free takes it as it stands"
        rough = read_height_map(surface, parse_spacing(spacing), periodic=periodic, otherwise=otherwise)
        settings = {
            "model": rung.value,
            "modulus": body.modulus,
            "poisson": body.poisson,
            "hardness": None if math.isinf(bound) else bound,
            "counter_modulus": counter and counter.modulus,
            "counter_poisson": counter and counter.poisson,
            "composite_modulus": stiffness,
            "boundary": boundary.value,
            "tolerance": tolerance,
        }
        inputs = Inputs(heights=rough.heights, spacing=rough.spacing, settings={**settings, "code": code()})
        shown = _spaced(asked)
        if rung in GRID_MODELS:
            at = solver(
                rung,
                rough.heights,
                rough.spacing,
                stiffness,
                hardness=bound,
                boundary=boundary.value,
                tolerance=tolerance,
                threads=threads,
            )
            series = solved(at, inputs, asked, shown, out, advance)
        else:
            try:
                estimate = estimator(rung, rough.heights, rough.spacing, stiffness, bound)
            except InputError as error:
                raise InputError(f"{surface}, {rung}: {error}; take --model elastic") from None
            series = estimated(estimate, inputs, asked, shown, out)
        told = _told(rung, rough, settings, series)
        told["numerics"] |= {"cpu_s": sum(os.times()[:4]) - cpu, "wall_s": time.perf_counter() - started}
        if report is not None:
            from roughfilm.pages.contact import write_page  # matplotlib is slow to import

            advance(len(asked), "drawing the page")
            write_page(surface.name, told, series, report)
    _tell(surface.name, told, series, [path for path in (out, report) if path is not None], as_json)


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


def _refuse(rung: ContactModel, boundary: Boundary, asked: tuple[float, ...], hardness: float) -> None:
    """What cannot be, before anything is solved."""
    above = [load for load in asked if load > hardness]
    if above:
        raise InputError(
            f"--loads: {len(above)} of {len(asked)}, up to {above[-1] / 1e6:.10g} MPa, are above the hardness of "
            f"{hardness / 1e6:.10g} MPa, which is all that the whole area can bear; lower them"
        )
    if boundary is Boundary.FREE and (rung not in GRID_MODELS or rung is ContactModel.STANLEY_KATO):
        raise InputError(f"--boundary free: {rung} knows no edges; take --model elastic or elastic_plastic")


def _spaced(loads: tuple[float, ...]) -> tuple[float, ...]:
    """A few of the loads, the first and the last among them."""
    count = min(SHOWN, len(loads))
    return tuple(loads[round(k * (len(loads) - 1) / max(count - 1, 1))] for k in range(count))


def _told(rung: ContactModel, rough: HeightMap, settings: dict[str, Any], series: Series) -> dict[str, Any]:
    """The object of ``--json``."""
    last = series.rows[-1]
    quantities = {name: {"value": value, "unit": UNITS.get(name, "1")} for name, value in asdict(last).items()}
    quantities["plasticity_index"] = {"value": _index(last), "unit": "1"}
    quantities["composite_modulus"] = {"value": settings["composite_modulus"], "unit": "Pa"}
    worst = [row.complementarity for row in series.rows if row.complementarity is not None]
    warnings = list(rough.warnings)
    if series.untrusted:
        few = f"{len(series.untrusted)} of {len(series.rows)} loads lie outside the range where {rung} is trusted"
        better = ContactModel.ELASTIC if settings["hardness"] is None else ContactModel.ELASTIC_PLASTIC
        warnings.append(f"{few}; compare with --model {better}")
    return {
        "series": [asdict(row) for row in series.rows],
        "units": {name: UNITS.get(name, "1") for name in asdict(last)},
        "quantities": {name: entry for name, entry in quantities.items() if name not in NUMERICS},
        "numerics": {
            "residual": max(worst) if worst else None,
            "iterations": sum(row.iterations or 0 for row in series.rows),
            "points": rough.heights.size,
            "loads": len(series.rows),
            "loads_found": series.found,
        },
        "provenance": {
            "surface": dict(rough.source),
            "settings": settings,
            "warnings": warnings,
            "sources": [SOURCES[rung]],
            **circumstances(),
        },
    }


NUMERICS = ("complementarity", "iterations", "cpu_s")


def _index(row: Row) -> float:
    pixels = row.area_fraction if row.area_fraction_pixel is None else row.area_fraction_pixel
    return row.plastic_fraction / pixels if pixels else 0.0


def _tell(name: str, told: dict[str, Any], series: Series, written: list[Path], as_json: bool) -> None:
    if as_json:
        print_json(told)
    else:
        output.print(_table_of(name, series.rows))
        for path in written:
            output.print(f"written: {escape(str(path))}", soft_wrap=True)
    if series.found:
        messages.print(f"found: {series.found} of {len(series.rows)} loads, not solved again", soft_wrap=True)
    for warning in told["provenance"]["warnings"]:
        messages.print(f"[yellow]warning:[/] {escape(warning)}", soft_wrap=True)


def _table_of(name: str, rows: tuple[Row, ...]) -> Table:
    """The series as people read it."""
    table = Table("load, MPa", "area, %", "plastic, %", "mean gap, µm", "p max, MPa", "iterations", title=escape(name))
    for column in table.columns:
        column.justify = "right"
    for row in rows:
        table.add_row(*_cells(row))
    return table


def _cells(row: Row) -> tuple[str, ...]:
    """A row in MPa, per cent and µm."""
    told = (
        (row.load, 1e-6),
        (row.area_fraction, 100),
        (row.plastic_fraction, 100),
        (row.mean_gap, 1e6),
        (row.pressure_max, 1e-6),
        (row.iterations, 1),
    )
    return tuple("-" if value is None else digits(value * factor) for value, factor in told)
