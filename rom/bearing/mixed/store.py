"""Files of Stribeck curves: HDF5 with a digest of the input, and CSV."""

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import fields
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from roughfilm.contact.foundation.checked_hdf5 import open_if_of, write_checked, write_column, write_inputs
from roughfilm.contact.foundation.files import replacing
from roughfilm.contact.foundation.inputs import Inputs
from roughfilm.contact.foundation.reading.hdf5_content import Json, Numbers
from roughfilm.rom.bearing.asperity_contact import FLASH
from roughfilm.rom.bearing.mixed.stribeck import TEMPERATURES, StribeckCurve, StribeckPoint
from roughfilm.rom.studies.table import table_beginning

SCHEMA = 1
MARK = b"roughfilm stribeck, HDF5 behind 512 bytes, sha256 "
KIND = "table of Stribeck curves"
REMEDY = "remove it or choose another place"

UNITS = {
    "pressure": "Pa",
    "speed": "m/s",
    "separation": "m",
    "least_gap": "m",
    "load": "N",
    "film_load": "N",
    "contact_load": "N",
    "friction": "N",
    "pressure_max": "Pa",
    "contact_pressure_max": "Pa",
    "cpu_s": "s",
    "temperature": "degC",
    "outlet_temperature": "degC",
    "estimated_heat_transfer": "W/K",
    **dict.fromkeys(FLASH, "K"),
}
"""Units of the numbers of a point; all others are dimensionless."""

NUMBERS = tuple(entry.name for entry in fields(StribeckPoint) if entry.type is float)
"""The numbers that every point has."""

OF_SOME = (*TEMPERATURES, *FLASH, "estimated_heat_transfer")
"""The numbers of points of some scenes alone; flash temperatures are those of points with contact alone."""

SCATTER = ("scatter", "window_low", "window_high")
"""Groups of the numbers of points over several windows."""

ROWS = ("rows",)


def numbers_of(points: Sequence[StribeckPoint]) -> tuple[str, ...]:
    """The names of the numbers of points, with the temperatures that all, and the estimates that some of them have."""
    known = {name: [getattr(point, name) is not None for point in points] for name in OF_SOME}
    some = [name for name, given in known.items() if any(given) and (name in FLASH or all(given))]
    return (*NUMBERS, *some)


def save_points(
    path: Path, inputs: Inputs, points: Sequence[StribeckPoint], curves: Sequence[StribeckCurve] = ()
) -> None:
    """Write points in one step, in order of load and speed.

    ``points/`` has a column for each number, NaN for a flash temperature without contact, ``uncertainty/`` a column for
    each estimated uncertainty, NaN where there is none, and ``lift_off/`` a row for each load. Points of several
    windows have ``scatter/``, ``window_low/`` and ``window_high/`` too. The attributes ``outside`` and ``leading`` have
    the sentences of each point, as JSON.

    Raises
    ------
    InputError
        If ``path`` cannot be written.
    """
    ordered = sorted(points, key=lambda point: (point.pressure, point.speed))

    def fill(file: h5py.File) -> None:
        write_inputs(file, inputs, SCHEMA)
        for name in numbers_of(points):
            column = [_number(point, name) for point in ordered]
            write_column(file, f"points/{name}", column, UNITS.get(name, "1"))
        for name in sorted({name for point in ordered for name in point.uncertainty}):
            column = [point.uncertainty.get(name, np.nan) for point in ordered]
            write_column(file, f"uncertainty/{name}", column, UNITS.get(name, "1"))
        for group in SCATTER:
            for name in _scattered(ordered):
                write_column(
                    file,
                    f"{group}/{name}",
                    [_of_windows(point, group, name) for point in ordered],
                    UNITS.get(name, "1"),
                )
        file.attrs["outside"] = json.dumps([point.outside for point in ordered])
        file.attrs["leading"] = json.dumps([point.leading for point in ordered])
        if curves:
            write_column(file, "lift_off/pressure", [curve.pressure for curve in curves], "Pa")
            write_column(file, "lift_off/speed", [curve.lift_off.speed for curve in curves], "m/s")
            write_column(file, "lift_off/uncertainty", [curve.lift_off.uncertainty for curve in curves], "m/s")

    write_checked(path, MARK, fill)


def known_points(path: Path, inputs: Inputs) -> tuple[StribeckPoint, ...]:
    """The points of a file for these inputs; none if there is no file, or an empty one.

    Raises
    ------
    InputError
        If the file cannot be read, is damaged, or holds other curves or something else.
    """
    with open_if_of(inputs, path, MARK, SCHEMA, kind=KIND, remedy=REMEDY) as content:
        if content is None:
            return ()
        numbers = (*NUMBERS, *(name for name in OF_SOME if name in content.names("points")))
        columns = content.take({f"points/{name}": Numbers(shape=ROWS, missing=name in FLASH) for name in numbers})
        outside = content.one("@outside", Json(kind=tuple[tuple[str, ...], ...]))
        leading = content.one("@leading", Json(kind=tuple[str, ...]))
        for place, words in (("@outside", outside), ("@leading", leading)):
            if len(words) != len(columns["points/speed"]):
                raise content.fault(place, "has another number of points")
        known = [f"uncertainty/{name}" for name in content.names("uncertainty")]
        uncertainties = content.take(
            {name: Numbers(shape=(len(columns["points/speed"]),), missing=True) for name in known}
        )
    return tuple(
        StribeckPoint(
            **_given({name: columns[f"points/{name}"][row].item() for name in numbers}),
            uncertainty={
                name.removeprefix("uncertainty/"): column[row].item()
                for name, column in uncertainties.items()
                if not np.isnan(column[row])
            },
            outside=outside[row],
            leading=leading[row],
        )
        for row in range(len(columns["points/speed"]))
    )


def write_csv(path: Path, curves: Sequence[StribeckCurve]) -> None:
    """Write a row for each point with its uncertainties; the first line has names and units.

    If some points are outside the range of the model, the last column is 1 there.
    """
    uncertain = sorted({name for curve in curves for point in curve.points for name in point.uncertainty})
    names = numbers_of([point for curve in curves for point in curve.points])
    heads = [f"{name} ({UNITS.get(name, '1')})" for name in names]
    heads += [f"{name} ± ({UNITS.get(name, '1')})" for name in uncertain]
    scattered = _scattered([point for curve in curves for point in curve.points])
    heads += [f"{name}_{group} ({UNITS.get(name, '1')})" for name in scattered for group in SCATTER]
    some = any(point.outside for curve in curves for point in curve.points)
    lines = [", ".join([*heads, "outside_range (1)"] if some else heads)]
    for point in (point for curve in curves for point in curve.points):
        numbers = [_written(_number(point, name)) for name in names]
        numbers += [repr(float(point.uncertainty[name])) if name in point.uncertainty else "" for name in uncertain]
        own = [_of_windows(point, group, name) for name in scattered for group in SCATTER]
        numbers += [_written(number) for number in own] + ([_written(float(bool(point.outside)))] if some else [])
        lines.append(", ".join(numbers))
    with replacing(path, table_beginning(heads[0])) as scratch:
        scratch.write_text("\n".join(lines) + "\n", encoding="utf-8")


def _given(numbers: Mapping[str, float]) -> dict[str, Any]:
    """The numbers that a point has, without missing estimates."""
    return {name: number for name, number in numbers.items() if not (name in FLASH and math.isnan(number))}


def _number(point: StribeckPoint, name: str) -> float:
    """A number of a point; NaN where the point has none."""
    number = getattr(point, name)
    return math.nan if number is None else float(number)


def _written(number: float) -> str:
    """A number in a table; "" if it is missing."""
    return "" if math.isnan(number) else repr(number)


def _scattered(points: Sequence[StribeckPoint]) -> list[str]:
    """The names of the quantities that have a scatter at some points."""
    return sorted({name for point in points for name in point.scatter})


def _of_windows(point: StribeckPoint, group: str, name: str) -> float:
    """The scatter of a quantity of a point, or an end of its interval for one window; NaN if it is unknown."""
    if group == "scatter":
        return float(point.scatter.get(name, np.nan))
    return float(point.window_interval.get(name, (np.nan, np.nan))[group == "window_high"])
