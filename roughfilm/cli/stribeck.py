"""roughfilm stribeck: friction, film and the asperities' share of a load over speed, from a surface and its solids."""

import json
import math
import os
import time
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.markup import escape
from rich.table import Table

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.files import replacing
from roughfilm.rom.bearing.mixed.curves import Wall, resumed_curves, wall_of
from roughfilm.rom.bearing.mixed.curves_store import NUMBERS, UNITS, write_csv
from roughfilm.rom.bearing.mixed.stribeck import MAX_CELLS, MIN_CELLS, RESOLUTION, StribeckCurve, StribeckPoint
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.ladder.provenance import circumstances
from roughfilm.rom.ladder.scene import load_scene, scene_entries
from roughfilm.terminal.console import (
    AsJson,
    Overrides,
    ScenePath,
    in_one_line,
    make_directory,
    messages,
    output,
    print_json,
    progress_bar,
)
from roughfilm.terminal.load_range import loads_of, speeds_of
from roughfilm.terminal.output_file import alone, refuse_unwritable
from roughfilm.words.stribeck import lift_off, speed_scale

SOURCES = (
    "Sahlin 2008, Paper E",
    "10.1016/j.triboint.2007.02.021",
    "10.1016/j.jmaa.2005.09.036",
)
LOADS = "0.5MPa,1MPa,2MPa"
TURNING, SLIDING = "1rpm..600rpm:60", "0.01m/s..10m/s:60"
"""Speeds by default, of what turns and of what does not."""

CURVES, TABLE = "stribeck", "table.h5"


@in_one_line
def command(
    scene: ScenePath,
    out: Annotated[Path, typer.Option(help="Table, curves and report go here; what is finished is found again.")],
    loads: Annotated[
        str,
        typer.Option(metavar="LOADS", help="Over the nominal area: a list, a range such as 0.5MPa..2MPa:3, or one."),
    ] = LOADS,
    speeds: Annotated[
        str | None,
        typer.Option(
            metavar="SPEEDS",
            help="0,30rpm; 1rpm..600rpm:60 (each by the same factor); 0..2m/s:40 (evenly). "
            f"By default {TURNING}, or {SLIDING} where nothing turns.",
        ),
    ] = None,
    table: Annotated[
        Path | None,
        typer.Option(metavar="T.h5", help="Of roughfilm factors C.h5 --out T.h5; else one is made in --out."),
    ] = None,
    resolution: Annotated[int, typer.Option(help="Cells along and across.")] = RESOLUTION,
    set_: Overrides = None,
    as_json: AsJson = False,
) -> None:
    """Sweep speed and load of a bearing whose walls may touch, to Stribeck curves."""
    started, cpu = time.perf_counter(), sum(os.times()[:4])
    read = load_scene(scene, set_ or ())
    if not isinstance(read, Bearing) or read.asperities is None:
        raise InputError(
            f"{scene}: asperities: are missing; add [roughness] with a surface, and [asperities] with the solids "
            "(scripts/examples/scenes/rough_washer.toml)"
        )
    radius = read.turning_radius
    asked = loads_of(loads)
    over = speeds_of(speeds or (SLIDING if radius is None else TURNING), radius)
    if not MIN_CELLS <= resolution <= MAX_CELLS:
        raise InputError(f"--resolution: got {resolution}; it must be {MIN_CELLS} to {MAX_CELLS} cells along a side")
    make_directory(out)
    refuse_unwritable(out / "report.html")
    with alone(out / f"{CURVES}.h5", "sweep"), progress_bar(1.0) as advance:
        wall = wall_of(read, asked[-1], table, out / TABLE, _part(advance, 0.0, 0.5), resolution)
        curves, known = resumed_curves(
            read, over, asked, wall, out / f"{CURVES}.h5", resolution, _part(advance, 0.5, 0.95)
        )
        told = tell(read, curves, wall)
        told["numerics"] |= {
            "points_found": known,
            "resolution": resolution,
            "cpu_s": sum(os.times()[:4]) - cpu,
            "wall_s": time.perf_counter() - started,
        }
        write_csv(out / f"{CURVES}.csv", curves)
        with replacing(out / f"{CURVES}.json") as scratch:
            scratch.write_text(json.dumps(told, indent=1, allow_nan=False) + "\n", encoding="utf-8")
        from roughfilm.pages.stribeck import write_page  # matplotlib is slow to import

        advance(0.95, "drawing the page")
        write_page(read, told, curves, wall.asperities, resolution, out / "report.html")
    _say(read, told, curves, known, out, as_json)


def _part(advance: Any, first: float, last: float) -> Any:
    """A progress that fills a part of the bar."""
    return lambda done, words: advance(first + (last - first) * done, words)


def tell(scene: Bearing, curves: Sequence[StribeckCurve], wall: Wall) -> dict[str, Any]:
    """The object of ``--json``, but for what it cost."""
    quantities: dict[str, Any] = {}
    for curve in curves:
        name = f"{curve.pressure / 1e6:g} MPa"
        least = min(curve.points, key=lambda point: point.friction_coefficient)
        quantities |= {
            f"lift-off speed at {name}": {
                "value": _number(curve.lift_off.speed),
                "uncertainty": _number(curve.lift_off.uncertainty),
                "unit": "m/s",
            },
            f"least friction coefficient at {name}": {"value": least.friction_coefficient, "unit": "1"},
            f"speed of the least friction at {name}": {"value": least.speed, "unit": "m/s"},
        }
    return {
        "curves": [
            {
                "pressure": curve.pressure,
                "lift_off": {name: _number(value) for name, value in vars(curve.lift_off).items()},
                "points": [_entries(point) for point in curve.points],
            }
            for curve in curves
        ],
        "units": {name: UNITS.get(name, "1") for name in NUMBERS},
        "quantities": quantities,
        "numerics": {
            "residual": max(point.residual for curve in curves for point in curve.points),
            "balance": max(point.balance for curve in curves for point in curve.points),
            "points": sum(len(curve.points) for curve in curves),
            "table_points": wall.points,
            "table_points_found": wall.known_points,
        },
        "provenance": {
            "scene": scene_entries(scene),
            "table": dict(wall.source),
            "warnings": [*wall.warnings, *_warnings(curves)],
            "sources": list(SOURCES),
            **circumstances(),
        },
    }


def _entries(point: StribeckPoint) -> dict[str, Any]:
    return {name: _number(getattr(point, name)) for name in NUMBERS} | {
        "uncertainty": {name: _number(value) for name, value in point.uncertainty.items()}
    }


def _number(value: float) -> float | None:
    return float(value) if math.isfinite(value) else None


def _warnings(curves: Sequence[StribeckCurve]) -> list[str]:
    never = [curve.pressure for curve in curves if math.isnan(curve.lift_off.speed)]
    return [f"{pressure / 1e6:g} MPa: no speed was found at which the walls part" for pressure in never]


def _say(
    scene: Bearing, told: Mapping[str, Any], curves: Sequence[StribeckCurve], known: int, out: Path, as_json: bool
) -> None:
    if as_json:
        print_json({**told, "report": str(out / "report.html")})
    else:
        scale = speed_scale(scene)
        table = Table("load, MPa", f"lift-off, {scale.unit}", "least μ", f"at, {scale.unit}", "μ at the slowest")
        for column in table.columns:
            column.justify = "right"
        for curve in curves:
            least = min(curve.points, key=lambda point: point.friction_coefficient)
            table.add_row(
                f"{curve.pressure / 1e6:.4g}",
                lift_off(curve, scale, named=False),
                f"{least.friction_coefficient:.4f}",
                f"{scale.factor * least.speed:.4g}",
                f"{curve.points[0].friction_coefficient:.4f}",
            )
        output.print(table)
        output.print(f"report: {escape(str(out / 'report.html'))}", soft_wrap=True)
    if known:
        messages.print(f"found: {known} of {told['numerics']['points']} points, not solved again", soft_wrap=True)
    for warning in told["provenance"]["warnings"]:
        messages.print(f"[yellow]warning:[/] {escape(warning)}", soft_wrap=True)
