"""roughfilm factors: what a rough surface does to a film, as flow factors over the mean gap or at one."""

import math
import os
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer
from rich.markup import escape
from rich.table import Table

from contact.errors import ConvergenceError, InputError
from contact.inputs import Inputs
from contact.surface import LARGEST_LENGTH, LEAST_SPACING
from contact.units import to_si
from rom.homogenization.conductance import FaceRule
from rom.homogenization.factors import FlowFactors
from rom.homogenization.flow_factors import Estimated, flow_factors
from rom.homogenization.separation import Separations
from rom.homogenization.table import FactorTable, Point
from rom.homogenization.table_store import known_points, save_table
from rom.homogenization.tabulate import TOLERANCE, tabulate
from rom.provenance import circumstances, code
from scripts.common import AsJson, in_one_line, messages, output, print_json, progress_bar, run_alone
from scripts.output_file import alone, refuse_unwritable
from scripts.rough_surface import Rough, read_rough, spacing_of
from scripts.surface import refuse_same

SOURCES = ("10.1016/j.triboint.2007.02.021", "10.1016/j.triboint.2006.02.069", "Sahlin 2008, Papers C and E")
SHOWN = ("A11", "A12", "A22", "B1", "B2")
NAMES = ("A11", "A12", "A21", "A22", "B1", "B2", "d", "e")
KEPT_EVERY_S = 2.0
"""Between two writings of a table that grows."""


@in_one_line
def command(
    surface: Annotated[
        Path, typer.Argument(metavar="SURFACE", help="A surface (HDF5, TOML, an instrument's file) or heights (NPY).")
    ],
    gap: Annotated[str | None, typer.Option(metavar="H", help="One mean gap, e.g. 3um; else all, as a table.")] = None,
    spacing: Annotated[
        str | None, typer.Option(metavar="D", help="Between the points of an array of heights: 1um, or 1um,2um.")
    ] = None,
    tolerance: Annotated[
        float | None, typer.Option(help=f"Of a table's interpolation between its points; {TOLERANCE:g} by default.")
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
    as_json: AsJson = False,
) -> None:
    """Average a rough surface: what its film lets through, drags along and rubs over that of a smooth one."""
    refuse_same({"SURFACE": surface, "--out": out, "--report": report})
    started, cpu = time.perf_counter(), sum(os.times()[:4])
    mean_gap, more = _length("--gap", gap), _length("--offset", offset, least=0.0) or 0.0
    if mean_gap is not None and out is not None:
        raise InputError("--out: holds a table; leave it or --gap out")
    if mean_gap is None and offset is not None:
        raise InputError("--offset: got one for a table, in which contact is closed; give --gap, or leave it out")
    if mean_gap is not None and tolerance is not None:
        raise InputError("--tolerance: is of a table; leave it or --gap out")
    asked = TOLERANCE if tolerance is None else tolerance
    for path in filter(None, (out, report)):
        refuse_unwritable(path)
    with alone(out, "table"), progress_bar(1.0) as advance:
        advance(0, f"reading {surface.name}")
        rough = read_rough(surface, spacing_of(spacing), periodic=True)
        if min(rough.heights.shape) < 2:
            raise InputError(f"{surface}: is a profile; rom.homogenization.line has its flow factors in closed form")
        settings = {"rule": rule.value, "offset": more, "mean_gap": mean_gap, "code": code()}
        if mean_gap is not None:
            body = Separations(heights=rough.heights)
            separation = body.at_mean_gap(mean_gap)
            found = flow_factors(body.gap(separation), rough.spacing, rule=rule, offset=more, progress=advance)
            told = _told_one(rough, settings, found, separation)
        else:
            inputs = Inputs(heights=rough.heights, spacing=rough.spacing, settings=settings)
            table, known = _tabulated(surface, rough, inputs, asked, rule, out, advance)
            told = _told_all(rough, settings | {"tolerance": asked}, table, known)
        told["numerics"] |= {"cpu_s": sum(os.times()[:4]) - cpu, "wall_s": time.perf_counter() - started}
        if report is not None:
            from scripts.factors_page import write_page  # matplotlib is slow to import

            advance(1.0, "drawing the page")
            if mean_gap is None:
                write_page(surface.name, told, rough, report, rule, table=table)
            else:
                write_page(surface.name, told, rough, report, rule, found=found, separation=separation + more)
    _tell(surface.name, told, [path for path in (out, report) if path is not None], as_json)


def _length(option: str, text: str | None, least: float = LEAST_SPACING) -> float | None:
    if text is None:
        return None
    try:
        length = to_si(text.strip(), "m")
    except ValueError as error:
        raise InputError(f"{option} {text}: {error}") from None
    if not least <= length <= LARGEST_LENGTH:
        raise InputError(f"{option} {text}: give a length above 0, of {LARGEST_LENGTH:g} m at most")
    return length


def _tabulated(
    surface: Path,
    rough: Rough,
    inputs: Inputs,
    tolerance: float,
    rule: FaceRule,
    out: Path | None,
    advance: Callable[[float, str], None],
) -> tuple[FactorTable, int]:
    """The table, and how many of its points were in the file; what was finished is kept in it whenever this ends."""
    known = {} if out is None else dict(known_points(out, inputs))
    found, kept = dict(known), time.monotonic()

    def save(error: float = np.nan) -> None:
        if out is not None and len(found) > 1:
            points = tuple(sorted(found.values(), key=lambda point: point.mean_gap))
            peak = Separations(heights=rough.heights).peak
            save_table(out, inputs, FactorTable(points=points, peak=peak, interpolation_error=error))

    def keep(point: Point) -> None:
        nonlocal kept
        found[point.separation] = point
        if time.monotonic() - kept > KEPT_EVERY_S:
            save()
            kept = time.monotonic()

    try:
        table = tabulate(
            rough.heights, rough.spacing, tolerance=tolerance, rule=rule, known=known, keep=keep, progress=advance
        )
    except InputError as error:
        raise InputError(str(error).replace("heights:", f"{surface}:")) from None
    except ConvergenceError:
        save()
        raise
    except (KeyboardInterrupt, SystemExit):
        save()
        end = "; the same command goes on" if out is not None else ", none kept without --out"
        messages.print(f"stopped: {len(found)} points{end}", soft_wrap=True)
        raise
    save(table.interpolation_error)
    return table, sum(point.separation in known for point in table.points)


def numbers(factors: FlowFactors) -> dict[str, float]:
    """By their names: A, B, d and e."""
    a, b = factors.pressure, factors.shear
    values = (a[0, 0], a[0, 1], a[1, 0], a[1, 1], b[0], b[1], factors.couette, factors.shear_couette)
    return {name: float(value) for name, value in zip(NAMES, values, strict=True)}


def relative(factors: FlowFactors, uncertainty: FlowFactors) -> dict[str, dict[str, float | None]]:
    """Each over that of a smooth film of the mean gap, with its uncertainty; None where that cannot be said."""
    own = numbers(factors.relative)
    doubt = numbers(replace(uncertainty, mean_gap=factors.mean_gap).relative)
    return {
        name: {"value": own[name], "uncertainty": doubt[name] if np.isfinite(doubt[name]) else None} for name in NAMES
    }


def _told_one(rough: Rough, settings: dict[str, Any], found: Estimated, separation: float) -> dict[str, Any]:
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


def _told_all(rough: Rough, settings: dict[str, Any], table: FactorTable, known: int) -> dict[str, Any]:
    """The object of ``--json`` for a table."""
    points = [
        {
            "mean_gap": point.mean_gap,
            "separation": point.separation,
            "contact": point.contact,
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
        "units": {"mean_gap": "m", "separation": "m", "contact": "1", **dict.fromkeys(NAMES, "1")},
        "quantities": quantities,
        "numerics": numerics,
        **told,
    }


def _provenance(rough: Rough, settings: dict[str, Any]) -> dict[str, Any]:
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
    table = Table("ĥ, µm", "contact, %", *SHOWN, "sealed", title=escape(name))
    for column in table.columns:
        column.justify = "right"
    for point in points:
        shut = " ".join(axis for axis in "xy" if point[f"sealed_{axis}"])
        cells = [_shown(point[each]) for each in SHOWN]
        table.add_row(f"{1e6 * point['mean_gap']:.4g}", f"{100 * point['contact']:.3g}", *cells, shut)
    return table


def _shown(entry: dict[str, float | None]) -> str:
    """A value to the digits that its uncertainty leaves."""
    value, doubt = entry["value"], entry["uncertainty"]
    assert value is not None
    if doubt is None:
        return f"{value:.3g} ± ?"
    digits = max(0, min(5, math.ceil(-math.log10(doubt)))) if doubt else 5
    return f"{value:.{digits}f}"


if __name__ == "__main__":
    run_alone(command)
