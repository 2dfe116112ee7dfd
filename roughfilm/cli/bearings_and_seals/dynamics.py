"""roughfilm dynamics: equilibrium, stiffness and damping of a bearing over speed, and the stability of its rotor."""

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer
from rich.table import Table

from roughfilm.contact.foundation.checked_hdf5 import marked
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.files import write_json
from roughfilm.contact.foundation.ranges import whole_in_range
from roughfilm.contact.foundation.timing import stopwatch
from roughfilm.contact.foundation.writing.kinds import JSON, PAGE
from roughfilm.rom.bearing.dynamics.point import UNITS, DynamicPoint
from roughfilm.rom.bearing.dynamics.store import (
    MARK,
    OPERATION,
    dimensionless_of,
    resumed_dynamics,
    write_csv,
    write_ross,
)
from roughfilm.rom.bearing.dynamics.sweep import (
    FREQUENCY_RATIOS,
    MAX_CELLS,
    MIN_CELLS,
    RESOLUTION,
    DynamicCurve,
    free_bearing,
    mass_of,
)
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.ladder.scene import load_scene, scene_entries
from roughfilm.terminal.console import AsJson, OutDirectory, Overrides, ScenePath, make_directory, progress_bar
from roughfilm.terminal.output_file import alone, refuse_unwritable
from roughfilm.terminal.ranges import loads_of, speeds_of
from roughfilm.terminal.results import origin, show_result, table_of, written
from roughfilm.terminal.scenes import bearing_of
from roughfilm.words.dynamics import (
    answer_of,
    critical_mass,
    number_of,
    own_point,
    warnings_of,
    whirl_ratio,
)
from roughfilm.words.heat import heat_warnings
from roughfilm.words.numbers import digits, finite
from roughfilm.words.stribeck import speed_scale

EXAMPLES = (
    "roughfilm dynamics scripts/examples/scenes/grooved_journal.toml --out rotor",
    "roughfilm dynamics scripts/examples/scenes/grooved_journal.toml --speeds 500rpm..9000rpm:50 --out rotor",
)

SOURCES = ("Lund and Thomsen 1978", "10.1115/1.3261324", "10.1115/1.3251669", "10.21105/joss.02120")

SPAN, COUNT = 5.0, 20
"""Largest speed over that of the scene, the inverse of the lowest, and number of speeds, by default."""


def command(
    scene: ScenePath,
    out: OutDirectory,
    speeds: Annotated[
        str | None,
        typer.Option(
            metavar="SPEEDS",
            help="500rpm..9000rpm:50 (by a constant factor); 1500rpm,3000rpm; 1m/s..50m/s:20 "
            f"(default: {COUNT} speeds from a fifth to five times that of the scene, and its own).",
        ),
    ] = None,
    loads: Annotated[
        str | None,
        typer.Option(
            metavar="LOADS",
            help="Forces on the bearing (5kN) or mean pressures: a list, a range 5kN..20kN:3, or one "
            "(default: the scene's load).",
        ),
    ] = None,
    resolution: Annotated[
        int, typer.Option(help="Cells along the film, with half as many across (default 128).", show_default=False)
    ] = RESOLUTION,
    frequency_ratio: Annotated[
        float,
        typer.Option(
            metavar="RATIO",
            help="Frequency of the motion over that of the rotation, for stiffness and damping (default 1: unbalance).",
            show_default=False,
        ),
    ] = 1.0,
    ross: Annotated[
        int,
        typer.Option(metavar="VERSION", help="Version of ROSS for its table, 2 or 3 (default 3).", show_default=False),
    ] = 3,
    isothermal: Annotated[
        bool, typer.Option("--isothermal", help="All films at the temperature of the supplied lubricant.")
    ] = False,
    set_: Overrides = None,
    as_json: AsJson = False,
) -> None:
    """Sweep speed and load of a bearing: stiffness, damping and the stability of its rotor."""
    spent, bearing = stopwatch(), bearing_of(load_scene(scene, set_ or ()))
    bearing = free_bearing(bearing.isothermal() if isothermal else bearing)
    sliding, pressures = _speeds(bearing, speeds), _pressures(bearing, loads)
    resolution = whole_in_range("--resolution", resolution, MIN_CELLS, MAX_CELLS)
    low, high = FREQUENCY_RATIOS
    if not low <= frequency_ratio <= high:
        raise InputError(f"--frequency-ratio: got {frequency_ratio!r}; it must be {low:g} to {high:g}")
    ross = whole_in_range("--ross", ross, 2, 3)
    page, stored = out / "report.html", out / "dynamics.h5"
    make_directory(out)
    refuse_unwritable((page, PAGE), (stored, marked(MARK)), (stored.with_suffix(".json"), JSON))
    with alone(stored, "sweep"), progress_bar(1.0) as advance:
        curves, known = resumed_dynamics(
            bearing,
            sliding,
            pressures,
            stored,
            resolution=resolution,
            frequency_ratio=frequency_ratio,
            mass=mass_of(bearing),
            progress=lambda done, words: advance(0.95 * done, words),
        )
        tables = _write_tables(out, bearing, curves, ross)
        entries = curve_entries(bearing, curves)
        entries["numerics"] |= {
            "points_found": known,
            "resolution": resolution,
            "frequency_ratio": frequency_ratio,
            **spent(),
        }
        write_csv(stored.with_suffix(".csv"), bearing, curves)
        write_json(entries, stored.with_suffix(".json"))
        from roughfilm.pages.dynamics import write_page  # matplotlib is slow to import

        advance(0.95, "drawing the page")
        write_page(bearing, entries, curves, page)
    answer = "; ".join(answer_of(bearing, curve) for curve in curves)
    summary = written(answer, page, stored.with_suffix(".csv"), *tables)
    show_result(
        {**entries, "report": str(page)}, _tables(bearing, curves), as_json=as_json, reused="points", summary=summary
    )


def _speeds(bearing: Bearing, text: str | None) -> tuple[float, ...]:
    """The sliding speeds, m/s; by default around that of the scene."""
    own = abs(bearing.motion.speed)
    if text is not None:
        return speeds_of(text, bearing.turning_radius)
    if own == 0:
        raise InputError("--speeds: is missing for a scene without a speed; write for example 500rpm..9000rpm:50")
    return tuple(sorted({*np.geomspace(own / SPAN, own * SPAN, COUNT).tolist(), own}))


def _pressures(bearing: Bearing, text: str | None) -> tuple[float, ...]:
    """The loads over the nominal area, Pa; by default that of the scene."""
    if text is not None:
        return loads_of(text, None if bearing.wide else bearing.nominal_area)
    if bearing.load_pressure is None:
        raise InputError("--loads: are missing for a scene without a load; write for example 5kN or 0.5MPa,1MPa")
    return (bearing.load_pressure,)


def _write_tables(out: Path, bearing: Bearing, curves: Sequence[DynamicCurve], version: int) -> list[Path]:
    """Write the table for ROSS of each load; none of a wall that is no shaft, and of an infinitely wide one."""
    if bearing.wide or "whirl_ratio" not in curves[0].points[0].numbers:
        return []
    names = ["ross.toml"] if len(curves) == 1 else [f"ross_{number + 1}.toml" for number in range(len(curves))]
    for name, curve in zip(names, curves, strict=True):
        write_ross(out / name, bearing, curve, version=version)
    return [out / name for name in names]


def _tables(bearing: Bearing, curves: Sequence[DynamicCurve]) -> Iterator[Table | str]:
    """The tables of the terminal: some speeds of each load."""
    scale = speed_scale(bearing)
    for curve in curves:
        whirls = "whirl_ratio" in curve.points[0].numbers
        heads = [f"speed, {scale.unit}", "least film, µm"]
        touching = "contact_share" in curve.points[0].numbers
        heated = "temperature" in curve.points[0].numbers
        if touching:
            heads.append("contact, %")
        if heated:
            heads.append("film, °C")
        if whirls and not (touching or heated):
            heads.append("eccentricity")
        heads += ["whirl ratio", "critical mass, kg"] if whirls else ["K, N/µm", "B, kN·s/m"]
        yield table_of(
            heads,
            [_row(point, scale.factor, whirls=whirls) for point in _some(bearing, curve)],
            title=f"load {curve.pressure / 1e6:.4g} MPa",
        )


def _row(point: DynamicPoint, factor: float, *, whirls: bool) -> list[str]:
    beginning = [digits(factor * point.speed), number_of(point, "film_min", 1e6)]
    if "contact_share" in point.numbers:
        beginning.append(number_of(point, "contact_share", 100.0))
    if "temperature" in point.numbers:
        beginning.append(number_of(point, "temperature"))
    if whirls and not point.numbers.keys() & {"contact_share", "temperature"}:
        beginning.append(number_of(point, "eccentricity"))
    if not whirls:
        return [*beginning, number_of(point, "stiffness", 1e-6), number_of(point, "damping", 1e-3)]
    return [*beginning, whirl_ratio(point), critical_mass(point)]


def _some(bearing: Bearing, curve: DynamicCurve) -> list[DynamicPoint]:
    """At most seven points evenly over those of a curve, and that at the speed of the scene."""
    last = len(curve.points) - 1
    chosen = {round(last * part / 6) for part in range(7)} | {curve.points.index(own_point(bearing, curve))}
    return [curve.points[number] for number in sorted(chosen)]


def curve_entries(scene: Bearing, curves: Sequence[DynamicCurve]) -> dict[str, Any]:
    """The object of ``--json``, without the cost."""
    points = [point for curve in curves for point in curve.points]
    return {
        "curves": [
            {
                "pressure": curve.pressure,
                "points": [_point_entries(scene, point) for point in curve.points],
                "omitted": [{"speed": one.speed, "reason": one.reason} for one in curve.omitted],
                "onset": None
                if curve.onset is None
                else {
                    "mass": curve.onset.mass,
                    "rotation": finite(curve.onset.rotation),
                    "uncertainty": finite(curve.onset.uncertainty),
                },
            }
            for curve in curves
        ],
        "units": {**OPERATION, **{name: UNITS[name] for name in points[0].numbers}},
        "numerics": {"residual": max(point.residual for point in points), "points": len(points)},
        "provenance": origin(
            SOURCES,
            [
                *heat_warnings(scene, points, "speeds"),
                *(warning for curve in curves for warning in warnings_of(scene, curve)),
            ],
            scene=scene_entries(scene),
        ),
    }


def _point_entries(scene: Bearing, point: DynamicPoint) -> dict[str, Any]:
    """The numbers of a point; a critical mass of a rotor that is stable at any mass is null, with "stable": true."""
    entries: dict[str, Any] = {name: getattr(point, name) for name in OPERATION}
    entries |= {name: finite(value) for name, value in point.numbers.items()}
    entries["uncertainty"] = {name: finite(value) for name, value in point.uncertainty.items()}
    entries["outside"] = list(point.outside)
    if "critical_mass" in point.numbers:
        entries["stable_at_any_mass"] = point.numbers["critical_mass"] == float("inf")
    return entries | dimensionless_of(scene, point)
