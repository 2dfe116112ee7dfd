"""roughfilm stribeck: friction, film and contact over the speed of a rough bearing, as Stribeck curves."""

import math
from collections.abc import Iterator, Sequence
from functools import partial
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.table import Table

from roughfilm.contact.foundation.checked_hdf5 import marked
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.files import write_json
from roughfilm.contact.foundation.ranges import whole_in_range
from roughfilm.contact.foundation.timing import stopwatch
from roughfilm.contact.foundation.writing.kinds import JSON, PAGE
from roughfilm.rom.bearing.mixed.curves import Wall, resumed_curves, wall_of
from roughfilm.rom.bearing.mixed.store import MARK, UNITS, numbers_of, write_csv
from roughfilm.rom.bearing.mixed.stribeck import (
    MAX_CELLS,
    MIN_CELLS,
    RESOLUTION,
    LiftOff,
    StribeckCurve,
    StribeckPoint,
)
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.ladder.model import Progress
from roughfilm.rom.ladder.scene import load_scene, scene_entries
from roughfilm.sampling.cells import Cells, place_of, read_cells, scenes_of
from roughfilm.sampling.stribeck import curves_over_windows, rough_bearing
from roughfilm.terminal.console import (
    AsJson,
    Jobs,
    OutDirectory,
    Overrides,
    ScenePath,
    Windows,
    make_directory,
    process_count,
    progress_bar,
)
from roughfilm.terminal.output_file import alone, refuse_unwritable
from roughfilm.terminal.ranges import loads_of, speeds_of
from roughfilm.terminal.results import origin, show_result, table_of, written
from roughfilm.terminal.scenes import bearing_of, refuse_jobs
from roughfilm.words.average import count_in_words
from roughfilm.words.heat import heat_warnings
from roughfilm.words.numbers import finite
from roughfilm.words.stribeck import (
    at_own_speed,
    flash_warnings_of,
    flash_words,
    hottest_spots,
    lift_off,
    lift_off_scatter,
    outside_warnings,
    scatter_of,
    speed_scale,
)

EXAMPLES = (
    "roughfilm stribeck scripts/examples/scenes/rough_washer.toml --out rough",
    "roughfilm stribeck scripts/examples/scenes/washer.toml --out smooth",
)

SOURCES = (
    "Sahlin 2008, Paper E",
    "10.1016/j.triboint.2007.02.021",
    "10.1016/j.jmaa.2005.09.036",
)
LOADS = "0.5MPa,1MPa,2MPa"
ROTATIONAL_SPEEDS = "1rpm..600rpm:60"
SLIDING_SPEEDS = "0.01m/s..10m/s:60"


def command(
    scene: ScenePath,
    out: OutDirectory,
    loads: Annotated[
        str | None,
        typer.Option(
            metavar="LOADS",
            help="Mean pressures or forces on the bearing (5kN): a list, a range 0.5MPa..2MPa:3, or one "
            f"(default: the scene's load, or {LOADS}).",
        ),
    ] = None,
    speeds: Annotated[
        str | None,
        typer.Option(
            metavar="SPEEDS",
            help="0,30rpm; 1rpm..600rpm:60 (by a constant factor); 0..2m/s:40 (evenly spaced) "
            f"(default: the scene's speed, and {ROTATIONAL_SPEEDS}, or {SLIDING_SPEEDS} where nothing turns).",
        ),
    ] = None,
    table: Annotated[
        Path | None,
        typer.Option(metavar="T.h5", help="Table from 'roughfilm factors C.h5' (default: one made in --out)."),
    ] = None,
    windows: Windows = None,
    resolution: Annotated[int, typer.Option(help="Cells along and across.")] = RESOLUTION,
    isothermal: Annotated[
        bool, typer.Option("--isothermal", help="All films at the temperature of the supplied lubricant.")
    ] = False,
    set_: Overrides = None,
    jobs: Jobs = None,
    as_json: AsJson = False,
) -> None:
    """Sweep speed and load of a bearing, smooth or with walls that may touch, to Stribeck curves."""
    spent, cells = stopwatch(), None if windows is None else read_cells(windows)
    if cells is None:
        refuse_jobs(jobs)
        scenes = [bearing_of(load_scene(scene, set_ or ()))]
    else:
        scenes = scenes_of(scene, set_ or (), "roughness.surface", cells, rough_bearing)
    scenes = [one.isothermal() for one in scenes] if isothermal else scenes
    bearing = scenes[0]
    default = SLIDING_SPEEDS if bearing.turning_radius is None else ROTATIONAL_SPEEDS
    sliding, own = speeds_of(speeds or default, bearing.turning_radius), bearing.load_pressure
    if speeds is None and bearing.motion.speed:
        sliding = tuple(sorted({*sliding, abs(bearing.motion.speed)}))
    pieces = None if bearing.wide else bearing.pieces
    area = None if pieces is None else pieces * bearing.nominal_area
    pressures = (own,) if loads is None and own is not None else loads_of(loads or LOADS, area)
    resolution = whole_in_range("--resolution", resolution, MIN_CELLS, MAX_CELLS)
    if table is not None and bearing.asperities is None:
        raise InputError(f"--table: got {table}, but the scene has no [asperities]; add them or leave the table out")
    if table is not None and cells is not None:
        raise InputError(f"--table: got {table} beside a set of windows, each of which has its own; leave it out")
    page, stored = out / "report.html", out / "stribeck.h5"
    make_directory(out)
    refuse_unwritable((page, PAGE), (stored, marked(MARK)), (stored.with_suffix(".json"), JSON))
    with alone(stored, "sweep"), progress_bar(1.0) as advance:
        if cells is None:
            made = partial(
                wall_of, bearing, pressures[-1], table, out / "table.h5", _between(advance, 0.0, 0.5), resolution
            )
            wall = None if bearing.asperities is None else made()
            curves, known = resumed_curves(
                bearing, sliding, pressures, wall, stored, resolution, _between(advance, 0.5, 0.95)
            )
        else:
            curves, wall, known = curves_over_windows(
                scenes,
                [place_of(out, path) for path in cells.paths],
                sliding,
                pressures,
                cells.independent,
                stored,
                resolution=resolution,
                processes=process_count(jobs),
                progress=_between(advance, 0.0, 0.95),
            )
        entries = curve_entries(bearing, curves, wall, sliding, cells)
        entries["numerics"] |= {"points_found": known, "resolution": resolution, **spent()}
        write_csv(stored.with_suffix(".csv"), curves)
        write_json(entries, stored.with_suffix(".json"))
        from roughfilm.pages.stribeck import write_page  # matplotlib is slow to import

        advance(0.95, "drawing the page")
        write_page(bearing, entries, curves, None if wall is None else wall.asperities, resolution, page)

    def shown() -> Iterator[Table | str]:
        scale = speed_scale(bearing)
        heads = ["load, MPa", f"lift-off, {scale.unit}", "least μ", f"at, {scale.unit}", "μ at the lowest speed"]
        if cells is not None:
            heads[2:] = ["±, windows", "least μ", "±, windows", *heads[3:], "±, windows"]
        parted = bearing.asperities is None
        hottest = [
            max((point.temperature for point in curve.points if point.temperature is not None), default=None)
            for curve in curves
        ]
        if None not in hottest:
            heads.append("hottest film, °C")
        spots = [flash_words(curve) for curve in curves]
        if any(spots):
            heads.append("spots hotter by, K")
            spots = [flash or "–" for flash in spots]
        lowest = [
            (curve, _least_friction(curve), hot, flash)
            for curve, hot, flash in zip(curves, hottest, spots, strict=True)
        ]

        def scatter(number: str) -> list[str]:
            return [] if cells is None else [number]

        yield table_of(
            heads,
            [
                (
                    f"{curve.pressure / 1e6:.4g}",
                    "no asperities" if parted else lift_off(curve, scale, named=False),
                    *scatter("" if parted else lift_off_scatter(curve, scale)),
                    f"{least.friction_coefficient:.3g}",
                    *scatter(scatter_of(least, "friction_coefficient")),
                    f"{scale.factor * least.speed:.4g}",
                    f"{curve.points[0].friction_coefficient:.3g}",
                    *scatter(scatter_of(curve.points[0], "friction_coefficient")),
                    *([] if hot is None else [f"{hot:.1f}"]),
                    *([flash] if flash else []),
                )
                for curve, least, hot, flash in lowest
            ],
            title=None if cells is None else f"over {count_in_words(len(cells.paths), cells.independent)}",
        )

    least = min(map(_least_friction, curves), key=lambda point: point.friction_coefficient)
    at = f"{speed_scale(bearing).factor * least.speed:.4g} {speed_scale(bearing).unit}"
    beyond = " (outside the range of the model, error unknown)" if least.outside else ""
    answer = "; ".join(
        [*at_own_speed(bearing, curves), f"least friction coefficient {least.friction_coefficient:.4f} at {at}{beyond}"]
    )
    summary = written(answer, page, stored.with_suffix(".csv"))
    show_result({**entries, "report": str(page)}, shown(), as_json=as_json, reused="points", summary=summary)


def _between(advance: Progress, first: float, last: float) -> Progress:
    """A progress that moves the bar from ``first`` to ``last``."""
    return lambda done, words: advance(first + (last - first) * done, words)


def _least_friction(curve: StribeckCurve) -> StribeckPoint:
    return min(curve.points, key=lambda point: point.friction_coefficient)


def curve_entries(
    scene: Bearing,
    curves: Sequence[StribeckCurve],
    wall: Wall | None,
    speeds: Sequence[float],
    cells: Cells | None = None,
) -> dict[str, Any]:
    """The object of ``--json``, without the cost; ``cells`` are those of a set of windows."""
    quantities: dict[str, Any] = {}
    for curve in curves:
        name, least = f"{curve.pressure / 1e6:g} MPa", _least_friction(curve)
        quantities |= {
            f"lift-off speed at {name}": {
                "value": finite(curve.lift_off.speed),
                "uncertainty": finite(curve.lift_off.uncertainty),
                "unit": "m/s",
                **({} if cells is None else _scatter_entries(curve.lift_off)),
            },
            f"least friction coefficient at {name}": {
                "value": least.friction_coefficient,
                "unit": "1",
                **({} if cells is None else _scatter_of(least, "friction_coefficient")),
            },
            f"speed of the least friction at {name}": {"value": least.speed, "unit": "m/s"},
        }
        if (spots := hottest_spots(curve.points)) is not None:
            quantities[f"greatest flash temperature at {name}"] = {
                "value": spots[1].mean,
                "low": spots[1].low,
                "high": spots[1].high,
                "unit": "K",
            }
    points = [point for curve in curves for point in curve.points]
    names = numbers_of(points)
    never = [curve.pressure for curve in curves if math.isnan(curve.lift_off.speed)]
    warnings = [f"{pressure / 1e6:g} MPa: the walls part at none of the speeds" for pressure in never]
    warnings += [
        f"{curve.pressure / 1e6:g} MPa: no film carries it at {missing} of {len(speeds)} speeds, below "
        f"{curve.points[0].speed:.4g} m/s; the curve leaves them out"
        for curve in curves
        if (missing := len(speeds) - len(curve.points))
    ]
    warnings += outside_warnings(scene, curves)
    if wall is not None:
        warnings += wall.asperities.spot_pressures(min(point.separation for point in points)).warnings
    warnings += flash_warnings_of(scene, points)
    if cells is not None and scene.asperities is not None and scene.asperities.solid_heat is not None:
        warnings.append("asperities.solid_heat: flash temperatures are left out over windows; take one surface")
    warnings += heat_warnings(scene, points, "points")
    return {
        "curves": [
            {
                "pressure": curve.pressure,
                "lift_off": {
                    "speed": finite(curve.lift_off.speed),
                    "uncertainty": finite(curve.lift_off.uncertainty),
                    **({} if cells is None else _scatter_entries(curve.lift_off)),
                },
                "points": [_point_entries(point, names, scattered=cells is not None) for point in curve.points],
            }
            for curve in curves
        ],
        "units": {name: UNITS.get(name, "1") for name in names},
        "quantities": quantities,
        "numerics": {
            "residual": max(point.residual for point in points),
            "balance": max(point.balance for point in points),
            "points": len(points),
            "table_points": 0 if wall is None else wall.points,
            "table_points_found": 0 if wall is None else wall.known_points,
        },
        "provenance": origin(
            SOURCES,
            [*(() if wall is None else wall.warnings), *(() if cells is None else cells.warnings), *warnings],
            scene=scene_entries(scene),
            table={} if wall is None else dict(wall.source),
        ),
        **({} if cells is None else {"windows": cells.entries()}),
    }


def _point_entries(point: StribeckPoint, names: Sequence[str], *, scattered: bool) -> dict[str, Any]:
    numbers = {name: getattr(point, name) for name in names}
    entries: dict[str, Any] = {name: None if one is None else finite(one) for name, one in numbers.items()}
    entries["uncertainty"] = {name: finite(value) for name, value in point.uncertainty.items()}
    entries["outside"] = list(point.outside)
    if scattered:
        entries["scatter"] = {name: finite(value) for name, value in point.scatter.items()}
        entries["window_interval"] = {name: list(ends) for name, ends in point.window_interval.items()}
    return entries


def _scatter_entries(lift_off: LiftOff) -> dict[str, Any]:
    """The scatter of a lift-off speed over windows and the interval for one window; None where they are unknown."""
    ends = lift_off.window_interval
    return {"scatter": lift_off.scatter, "window_interval": None if ends is None else list(ends)}


def _scatter_of(point: StribeckPoint, name: str) -> dict[str, Any]:
    """The scatter of a number of a point over windows and the interval for one window; None where they are unknown."""
    ends = point.window_interval.get(name)
    return {"scatter": point.scatter.get(name), "window_interval": None if ends is None else list(ends)}
