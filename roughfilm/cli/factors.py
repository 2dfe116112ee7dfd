"""roughfilm factors: what a rough surface does to a film, as flow factors over the mean gap or at one."""

import math
import os
import time
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.markup import escape
from rich.table import Table

from roughfilm.cli.surface import refuse_same
from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.inputs import Inputs
from roughfilm.contact.foundation.threads import checked_threads
from roughfilm.contact.foundation.units import to_si
from roughfilm.contact.mechanics.press import Press
from roughfilm.contact.mechanics.store import is_series, load_contact, load_series
from roughfilm.contact.read import HeightMap, parse_spacing, periodicity_warnings, read_height_map
from roughfilm.contact.surfaces.surface import MAX_LENGTH, MIN_SPACING, Surface
from roughfilm.rom.bearing.mixed.resume import Work, kept_table
from roughfilm.rom.bearing.mixed.tabulate import gap_of, tabulate_pressed
from roughfilm.rom.homogenization.conductance import FaceRule
from roughfilm.rom.homogenization.factors import NAMES, FlowFactors, relative_quantities
from roughfilm.rom.homogenization.flow_factors import Estimated, flow_factors
from roughfilm.rom.homogenization.table.factor_table import FactorTable, Point
from roughfilm.rom.homogenization.table.separation import Separations
from roughfilm.rom.homogenization.table.tabulate import INTERPOLATION_TOLERANCE, tabulate
from roughfilm.rom.ladder.model import Progress
from roughfilm.rom.ladder.provenance import circumstances, code
from roughfilm.terminal.console import AsJson, Threads, in_one_line, messages, output, print_json, progress_bar
from roughfilm.terminal.output_file import alone, refuse_unwritable

SOURCES = ("10.1016/j.triboint.2007.02.021", "10.1016/j.triboint.2006.02.069", "Sahlin 2008, Papers C and E")
SHOWN = ("A11", "A12", "A22", "B1", "B2")
SHOWN_CONTACT = 0.2
"""The flow is drawn at the point of a table whose contact is nearest to this."""


@in_one_line
def command(
    surface: Annotated[
        Path,
        typer.Argument(
            metavar="SURFACE", help="A surface (HDF5, TOML, an instrument's file), heights (NPY), or contacts."
        ),
    ],
    gap: Annotated[str | None, typer.Option(metavar="H", help="One mean gap, e.g. 3um; else all, as a table.")] = None,
    spacing: Annotated[
        str | None, typer.Option(metavar="D", help="Between the points of an array of heights: 1um, or 1um,2um.")
    ] = None,
    tolerance: Annotated[
        float | None,
        typer.Option(help=f"Of a table's interpolation between its points; {INTERPOLATION_TOLERANCE:g} by default."),
    ] = None,
    rule: Annotated[FaceRule, typer.Option(help="How the gap runs between two nodes.")] = FaceRule.LINEAR,
    offset: Annotated[
        str | None,
        typer.Option(
            metavar="H", help="Added to the gap everywhere, e.g. 10nm; with --gap only, and told in the mean gap."
        ),
    ] = None,
    out: Annotated[
        Path | None, typer.Option(help="Write the table here (HDF5); points that it holds are not solved again.")
    ] = None,
    report: Annotated[Path | None, typer.Option(help="Write a page with its pictures here (HTML).")] = None,
    threads: Threads = None,
    as_json: AsJson = False,
) -> None:
    """Average a rough surface: what its film lets through, drags along and rubs over that of a smooth one.

    A file of contacts (roughfilm contact ... --out) makes one table from thick films to crushed asperities.
    """
    refuse_same({"SURFACE": surface, "--out": out, "--report": report})
    started, cpu = time.perf_counter(), sum(os.times()[:4])
    mean_gap, more = _length("--gap", gap), _length("--offset", offset, least=0.0) or 0.0
    if mean_gap is not None and out is not None:
        raise InputError("--out: holds a table; leave it or --gap out")
    if mean_gap is None and offset is not None:
        raise InputError("--offset: got one for a table, in which contact is closed; give --gap, or leave it out")
    if mean_gap is not None and tolerance is not None:
        raise InputError("--tolerance: is of a table; leave it or --gap out")
    asked, sharing = INTERPOLATION_TOLERANCE if tolerance is None else tolerance, checked_threads(threads)
    for path in filter(None, (out, report)):
        refuse_unwritable(path)
    with alone(out, "table"), progress_bar(1.0) as advance:
        advance(0, f"reading {surface.name}")
        series = _read_series(surface) if surface.is_file() and is_series(surface) else None
        if series is not None and mean_gap is not None:
            raise InputError(f"--gap: {surface} holds contacts, which make a table; leave --gap out")
        rough = (
            _undeformed(surface, series[0])
            if series
            else read_height_map(surface, parse_spacing(spacing), periodic=True)
        )
        if min(rough.heights.shape) < 2:
            raise InputError(
                f"{surface}: is a profile; roughfilm.rom.homogenization.line has its flow factors in closed form"
            )
        settings = {"rule": rule.value, "offset": more, "mean_gap": mean_gap, "code": code()}
        if mean_gap is not None:
            body = Separations(heights=rough.heights)
            separation = body.at_mean_gap(mean_gap)
            gap_there, table = body.gap(separation), None
            found = flow_factors(gap_there, rough.spacing, rule=rule, offset=more, progress=advance)
            told = _told_one(rough, settings, found, separation)
        else:
            if series is None:
                work = _of_surface(surface, rough, asked, rule, sharing, advance)
            else:
                settings |= {name: series[0].settings[name] for name in ("composite_modulus", "hardness")}
                work = _of_contacts(surface, *series, asked, rule, sharing, advance)
            inputs = Inputs(heights=rough.heights, spacing=rough.spacing, settings=settings)
            table, known = kept_table(out, inputs, work)
            told = _told_all(rough, settings | {"tolerance": asked}, table, known)
        told["numerics"] |= {"cpu_s": sum(os.times()[:4]) - cpu, "wall_s": time.perf_counter() - started}
        if report is not None:
            from roughfilm.pages.factors import write_page  # matplotlib is slow to import

            advance(1.0, "drawing the page")
            if table is not None:
                gap_there = _shown_gap(table, rough, settings)
                found = flow_factors(gap_there, rough.spacing, rule=rule)
            write_page(surface.name, told, rough, report, gap_there, found, table)
    _tell(surface.name, told, [path for path in (out, report) if path is not None], as_json)


def _length(option: str, text: str | None, least: float = MIN_SPACING) -> float | None:
    if text is None:
        return None
    try:
        length = to_si(text.strip(), "m")
    except ValueError as error:
        raise InputError(f"{option} {text}: {error}") from None
    if not least <= length <= MAX_LENGTH:
        raise InputError(f"{option} {text}: give a length above 0, of {MAX_LENGTH:g} m at most")
    return length


def _of_surface(
    surface: Path, rough: HeightMap, tolerance: float, rule: FaceRule, threads: int, advance: Progress
) -> Work:
    """How the table of an undeformed surface is made."""

    def work(known: Sequence[Point], keep: Callable[[Point], None]) -> FactorTable:
        try:
            return tabulate(
                rough.heights,
                rough.spacing,
                tolerance=tolerance,
                rule=rule,
                known=known,
                keep=keep,
                threads=threads,
                progress=advance,
            )
        except InputError as error:
            raise InputError(str(error).replace("heights:", f"{surface}:")) from None

    return work


def _of_contacts(
    series: Path,
    pressed: Inputs,
    loads: Sequence[float],
    tolerance: float,
    rule: FaceRule,
    threads: int,
    advance: Progress,
) -> Work:
    """How the table of a surface under a series of loads is made, from the contacts in a file."""

    def work(known: Sequence[Point], keep: Callable[[Point], None]) -> FactorTable:
        return tabulate_pressed(
            pressed.heights,
            pressed.spacing,
            pressed.settings["composite_modulus"],
            hardness=pressed.settings["hardness"] or math.inf,
            loads=loads,
            tolerance=tolerance,
            rule=rule,
            known=known,
            keep=keep,
            stored=lambda load: load_contact(series, load) if load in loads else None,
            threads=threads,
            progress=advance,
        ).factors

    return work


def _shown_gap(table: FactorTable, rough: HeightMap, settings: Mapping[str, Any]) -> Array:
    """The gap, m, at the point of a table whose flow is drawn."""
    shown = min(table.points, key=lambda point: (any(point.factors.sealed), abs(point.contact - SHOWN_CONTACT)))
    if shown.load == 0:
        return Separations(heights=rough.heights).gap(shown.separation)
    hardness = settings["hardness"] or math.inf
    return gap_of(shown, Press(rough.heights, rough.spacing, settings["composite_modulus"], hardness=hardness))


def _undeformed(path: Path, pressed: Inputs) -> HeightMap:
    """The undeformed surface of a file of contacts."""
    source = {"file": path.name, "settings": dict(pressed.settings)}
    surface = Surface(heights=pressed.heights, spacing=pressed.spacing)
    warnings = periodicity_warnings(path, surface, measured=False)
    return HeightMap(heights=pressed.heights, spacing=pressed.spacing, source=source, warnings=warnings)


def _read_series(path: Path) -> tuple[Inputs, tuple[float, ...]]:
    """A file of contacts; InputError where it cannot make a table."""
    pressed, loads = load_series(path)
    if len(loads) < 2:
        model = pressed.settings["model"]
        told = f"holds contacts with their gaps at {len(loads)} loads, by the model {model}"
        raise InputError(f"{path}: {told}; make one of two or more: roughfilm contact S.h5 --loads ... --out C.h5")
    if pressed.settings["boundary"] != "periodic":
        raise InputError(f"{path}: is of a surface that stands alone; a film that repeats needs --boundary periodic")
    return pressed, loads


def relative(factors: FlowFactors, uncertainty: FlowFactors) -> dict[str, dict[str, float | None]]:
    """Each over that of a smooth film of the mean gap, with its uncertainty; None where that is unknown."""
    quantities = relative_quantities(factors, uncertainty).items()
    return {name: {"value": one.value, "uncertainty": one.uncertainty} for name, one in quantities}


def _told_one(rough: HeightMap, settings: dict[str, Any], found: Estimated, separation: float) -> dict[str, Any]:
    """The object of ``--json`` for one mean gap."""
    factors = found.factors
    quantities: dict[str, Any] = {
        name: {**entry, "unit": "1"} for name, entry in relative(factors, found.uncertainty).items()
    }
    sealed = dict(zip(("sealed_x", "sealed_y"), factors.sealed, strict=True))
    quantities |= {name: {"value": value, "unit": "1"} for name, value in sealed.items()}
    quantities |= {
        "mean_gap": {"value": factors.mean_gap, "unit": "m"},
        "separation": {"value": separation, "unit": "m"},
        "contact": {"value": found.contact, "unit": "1"},
    }
    numerics = {
        "unsolved": found.unsolved,
        "residual": found.residual,
        "iterations": found.iterations,
        "points": rough.heights.size,
    }
    return {"quantities": quantities, **sealed, "numerics": numerics, **_provenance(rough, settings)}


def _told_all(rough: HeightMap, settings: dict[str, Any], table: FactorTable, known: int) -> dict[str, Any]:
    """The object of ``--json`` for a table."""
    points = [
        {
            "mean_gap": point.mean_gap,
            "separation": point.separation,
            "contact": point.contact,
            "load": point.load,
            "area_fraction": point.area_fraction,
            "plastic_fraction": point.plastic_fraction,
            "sealed_x": point.factors.sealed[0],
            "sealed_y": point.factors.sealed[1],
            **relative(point.factors, point.uncertainty),
        }
        for point in table.points
    ]
    quantities = {
        "narrowest": {"value": table.narrowest, "unit": "m"},
        "widest": {"value": table.widest, "unit": "m"},
        "interpolation_error": {"value": table.interpolation_error, "unit": "1"},
    }
    off, asked = table.interpolation_error, settings["tolerance"]
    told = _provenance(rough, settings)
    if off > asked:
        few = (
            f"the table is off by {off:.2g} between some points, more than {asked:g}: factors jump there, or 400 points"
        )
        told["provenance"]["warnings"].append(f"{few} are too few; look at the surface for spikes and plateaus")
    numerics = {
        "unsolved": max(point.unsolved for point in table.points),
        "residual": max(point.residual for point in table.points),
        "iterations": sum(point.iterations for point in table.points),
        "points": rough.heights.size,
        "separations": len(table.points),
        "separations_found": known,
    }
    return {
        "points": points,
        "units": {"mean_gap": "m", "separation": "m", "contact": "1", "load": "Pa", **dict.fromkeys(NAMES, "1")},
        "quantities": quantities,
        "numerics": numerics,
        **told,
    }


def _provenance(rough: HeightMap, settings: dict[str, Any]) -> dict[str, Any]:
    return {
        "provenance": {
            "surface": dict(rough.source),
            "settings": settings,
            "warnings": list(rough.warnings),
            "sources": list(SOURCES),
            **circumstances(),
        }
    }


def _tell(name: str, told: dict[str, Any], written: list[Path], as_json: bool) -> None:
    if as_json:
        print_json(told)
    else:
        output.print(_table_of(name, told.get("points") or [_flat(told["quantities"])]))
        for path in written:
            output.print(f"written: {escape(str(path))}", soft_wrap=True)
    found = told["numerics"].get("separations_found")
    if found:
        messages.print(f"found: {found} of {told['numerics']['separations']} points, not solved again", soft_wrap=True)
    for warning in told["provenance"]["warnings"]:
        messages.print(f"[yellow]warning:[/] {escape(warning)}", soft_wrap=True)


def _flat(quantities: dict[str, Any]) -> dict[str, Any]:
    return {name: entry if "uncertainty" in entry else entry["value"] for name, entry in quantities.items()}


def _table_of(name: str, points: list[dict[str, Any]]) -> Table:
    """Points as people read them, over a smooth film of the same mean gap."""
    pressed = any(point.get("load") for point in points)
    table = Table(*(["load, MPa"] if pressed else []), "ĥ, µm", "contact, %", *SHOWN, "sealed", title=escape(name))
    for column in table.columns:
        column.justify = "right"
    for point in points:
        shut = " ".join(axis for axis in "xy" if point[f"sealed_{axis}"])
        cells = [_shown(point[each]) for each in SHOWN]
        load = [f"{point['load'] / 1e6:.4g}"] if pressed else []
        table.add_row(*load, f"{1e6 * point['mean_gap']:.4g}", f"{100 * point['contact']:.3g}", *cells, shut)
    return table


def _shown(entry: dict[str, float | None]) -> str:
    """A value to the digits that its uncertainty leaves."""
    value, doubt = entry["value"], entry["uncertainty"]
    assert value is not None
    if doubt is None:
        return f"{value:.3g} ± ?"
    digits = max(0, min(5, math.ceil(-math.log10(doubt)))) if doubt else 5
    return f"{value:.{digits}f}"
