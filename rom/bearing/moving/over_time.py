"""Tables over time: speed, load and path of a bearing, from the scene or from a CSV file."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from hashlib import sha256
from itertools import pairwise
from pathlib import Path
from typing import Annotated, Any, Self

import numpy as np
from pydantic import BeforeValidator, Field, model_validator

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.entries import InUnit, Length, Part, ScenePath, rounded_number
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.reading.regular import file_size
from roughfilm.rom.parts.columns_file import read_columns

MIN_ROWS, MAX_ROWS = 2, 10_000
"""Smallest and largest number of rows of a table."""

MAX_BYTES = 4_000_000
"""Largest size of a file that is read, bytes."""

CLOSING = 1e-6
"""Largest difference of the first and the last row of a table that repeats, over the range of the column."""

WRAPPED = 3
"""Rows that are repeated before and after a table that repeats: slopes depend on two neighbours."""

UNITS: Mapping[str, tuple[str, ...]] = {
    "time": ("s",),
    "speed": ("m/s", "rad/s"),
    "load": ("N", "N/m"),
    "angle": ("rad",),
    "load_x": ("N", "N/m"),
    "load_y": ("N", "N/m"),
    "film": ("m",),
    "eccentricity_x": ("1",),
    "eccentricity_y": ("1",),
    "moment_x": ("N*m",),
    "moment_y": ("N*m",),
}
"""The columns of a table with their SI units; "N/m" is that of an infinitely wide bearing."""

HEADER = "time (ms), load (kN), angle (deg)"

Number = Annotated[float, BeforeValidator(rounded_number)]
Time = Annotated[float, InUnit("s", any_sign=True, rounds=True)]
Speed = Annotated[float, InUnit("m/s", any_sign=True, rounds=True)]
Force = Annotated[float, InUnit("N", any_sign=True, rounds=True)]
Angle = Annotated[float, InUnit("rad", any_sign=True, rounds=True)]
Moment = Annotated[float, InUnit("N*m", any_sign=True, rounds=True)]
Rows = Annotated[tuple[Time, ...], Field(min_length=MIN_ROWS, max_length=MAX_ROWS)]


class OverTime(Part):
    """Speed, load or path over time, in a CSV file or as lists of one length, for :func:`roughfilm.march`.

    Between the rows the columns follow monotone cubics (PCHIP), so that the velocities are continuous. The first row of
    a file names the columns with their units: ``time (ms), load (kN), angle (deg)``.

    Attributes
    ----------
    file : path of a CSV file, in place of the lists.
    digest : digest of the numbers in the file; a file that has changed since is rejected.
    time : times, increasing, s.
    speed : speed of the sliding wall, m/s, which may change its sign; of a wall that turns also a rotational speed.
    load : size of the load, N (N/m of an infinitely wide bearing, in a file).
    angle : direction of the load on a shaft, from the x axis towards the y axis, rad.
    load_x, load_y : components of the load on a shaft, N, in place of load and angle.
    film : least film thickness, m, which is then given; of a pad about a pivot the film at the pivot.
    eccentricity_x, eccentricity_y : position of a shaft over the clearance, which is then given.
    moment_x, moment_y : moments on a pad about a pivot, N m, as those of the load; one that is left out is that of the
        load.
    period : time after which the table repeats, s; without it the table ends with its last row.

    Source: Fritsch and Carlson 1980, doi:10.1137/0717021, for the cubics.
    """

    file: ScenePath | None = None
    digest: str | None = None
    time: Rows | None = None
    speed: tuple[Speed, ...] | None = None
    load: tuple[Force, ...] | None = None
    angle: tuple[Angle, ...] | None = None
    load_x: tuple[Force, ...] | None = None
    load_y: tuple[Force, ...] | None = None
    film: tuple[Length, ...] | None = None
    eccentricity_x: tuple[Number, ...] | None = None
    eccentricity_y: tuple[Number, ...] | None = None
    moment_x: tuple[Moment, ...] | None = None
    moment_y: tuple[Moment, ...] | None = None
    period: Annotated[float, InUnit("s")] | None = None

    @model_validator(mode="after")
    def _can_be_read(self) -> Self:
        lists = [name for name in UNITS if getattr(self, name) is not None]
        if self.file is None:
            if self.digest is not None:
                raise ValueError("digest: got one without a file; leave it out")
            if self.time is None:
                raise ValueError("time: is missing; give it with the other columns as lists, or name a file")
        elif lists:
            raise ValueError(f"file: got one beside {lists[0]}; give one of them")
        table = self.table
        if self.file is None or self.digest == table.digest:
            return self
        if self.digest is not None:
            raise ValueError(
                f"digest: got {self.digest!r:.40}, but the numbers in {self.file} now have {table.digest!r}; leave the "
                "digest out to accept them"
            )
        return self.model_copy(update={"digest": table.digest})

    @property
    def places_or_loads(self) -> bool:
        """Whether the table has a load or a path."""
        return not self.table.columns.keys() <= {"speed", "angle", "moment_x", "moment_y"}

    @property
    def table(self) -> "Table":
        """The columns, read and checked; ValueError if they are not valid."""
        if self.file is not None:
            path = Path(self.file).expanduser()
            try:
                size = file_size(path, "name a CSV file")
                return _read(str(path), path.stat().st_mtime_ns, size, self.period)
            except InputError as error:
                raise ValueError(f"file: {error}") from None
            except ValueError as error:
                raise ValueError(f"file: {path}: {error}") from None
        columns = {name: (unit[0], getattr(self, name)) for name, unit in UNITS.items() if getattr(self, name)}
        return checked_table(columns, self.period)


@dataclass(frozen=True, kw_only=True)
class Table:
    """Columns over time.

    Attributes
    ----------
    time : times, s, increasing; of a table that repeats with the end of the first period.
    columns : the other columns by name, in SI units, each as long as ``time``.
    units : SI unit of each column.
    period : time after which the table repeats, s; None if it does not.
    """

    time: Array
    columns: Mapping[str, Array]
    units: Mapping[str, str]
    period: float | None

    @cached_property
    def digest(self) -> str:
        """The digest of the numbers, in hexadecimal."""
        digest = sha256(self.time.tobytes())
        for name, values in sorted(self.columns.items()):
            digest.update(f"{name} {self.units[name]}".encode() + values.tobytes())
        return digest.hexdigest()[:16]

    @cached_property
    def curves(self) -> Mapping[str, "Curve"]:
        """The columns as functions of time."""
        return {name: Curve.of(self.time, values, self.period) for name, values in self.columns.items()}


@dataclass(frozen=True, kw_only=True)
class Curve:
    """A monotone cubic through the rows of a column, which may repeat.

    Attributes
    ----------
    first : first time, s.
    period : time after which it repeats, s; None if it does not.
    rise : what the values gain in a period: full turns of an angle, else 0.
    cubic, integral : the interpolation, and its integral from the first time.
    """

    first: float
    period: float | None
    rise: float
    cubic: Any
    integral: Any

    @classmethod
    def of(cls, time: Array, values: Array, period: float | None) -> Self:
        """The curve through rows; those of a table that repeats are closed, up to whole turns of an angle."""
        from scipy.interpolate import PchipInterpolator  # slow to import

        rise, first = 0.0, float(time[0])
        if period is not None:
            rise = float(values[-1] - values[0])
            few = min(WRAPPED, time.size - 1)
            before, after = slice(-1 - few, -1), slice(1, 1 + few)
            time, values = (
                np.concatenate([time[before] - period, time, time[after] + period]),
                np.concatenate([values[before] - rise, values, values[after] + rise]),
            )
        cubic = PchipInterpolator(time, values)
        return cls(first=first, period=period, rise=rise, cubic=cubic, integral=cubic.antiderivative())

    def _turned(self, time: float) -> tuple[float, float]:
        """The number of whole periods before a time, and the time in the first period."""
        if self.period is None:
            return 0.0, time
        turns = math.floor((time - self.first) / self.period)
        return turns, time - turns * self.period

    def __call__(self, time: float, order: int = 0) -> float:
        """The value at a time, or its derivative of an order."""
        turns, within = self._turned(time)
        return float(self.cubic(within, order)) + (0.0 if order else turns * self.rise)

    def since_first(self, time: float) -> float:
        """The integral from the first time to a time, of a column without whole turns."""
        turns, within = self._turned(time)
        whole = 0.0 if self.period is None else float(self.integral(self.first + self.period))
        start = float(self.integral(self.first))
        return float(self.integral(within)) - start + turns * (whole - start if self.period is not None else 0.0)

    def fastest(self) -> float:
        """The largest size of the derivative at the rows and between them."""
        knots = np.asarray(self.cubic.x)
        places = np.concatenate([knots, (knots[1:] + knots[:-1]) / 2])
        return float(np.abs(self.cubic(places, 1)).max())


def checked_table(columns: Mapping[str, tuple[str, Sequence[float]]], period: float | None) -> Table:
    """The table of columns, each with its unit.

    Raises
    ------
    ValueError
        In one line, with the row, for times that do not increase, columns of different lengths, few or too many rows,
        columns that exclude each other, values out of range, and a table that does not fit its period.
    """
    times = columns["time"][1]
    if not MIN_ROWS <= len(times) <= MAX_ROWS:
        raise ValueError(f"time: got {len(times)} rows; give {MIN_ROWS} to {MAX_ROWS}")
    for number, (before, after) in enumerate(pairwise(times), 2):
        if not after > before:
            raise ValueError(
                f"time: got {after!r} s in row {number} after {before!r} s; sort the rows by increasing time"
            )
    others = {name: column for name, column in columns.items() if name != "time"}
    if not others:
        raise ValueError(f"time: got no column beside it; give one of {', '.join(list(UNITS)[1:])}")
    for name, (_, values) in others.items():
        if len(values) != len(times):
            raise ValueError(f"{name}: got {len(values)} rows, but time has {len(times)}; give as many")
    _refuse_double(others)
    for name, (_, values) in others.items():
        least = min(values)
        if (name in ("film", "load") and least < 0) or (name == "film" and least == 0):
            row = values.index(least) + 1
            raise ValueError(
                f"{name}: got {least!r} in row {row}; it must be {'above 0' if name == 'film' else '0 or more'}"
            )
    if {"eccentricity_x", "eccentricity_y"} <= others.keys():
        sizes = [
            math.hypot(*both) for both in zip(others["eccentricity_x"][1], others["eccentricity_y"][1], strict=True)
        ]
        if max(sizes) >= 2:
            raise ValueError(
                f"eccentricity_x: got the distance {max(sizes):.4g} clearances in row {sizes.index(max(sizes)) + 1}; "
                "positions are over the clearance, give less"
            )
    time = np.array(times, dtype=float)
    arrays = {name: np.array(column[1], dtype=float) for name, column in others.items()}
    if period is not None:
        time, arrays = _closed(time, arrays, period)
    return Table(time=time, columns=arrays, units={name: column[0] for name, column in others.items()}, period=period)


def _refuse_double(others: Mapping[str, Any]) -> None:
    """ValueError for columns of which one excludes or needs another."""
    for one, other in (("load_x", "load_y"), ("eccentricity_x", "eccentricity_y")):
        if (one in others) != (other in others):
            missing, given = (other, one) if one in others else (one, other)
            raise ValueError(f"{missing}: is missing beside {given}; give both")
    loads = {"load", "angle", "load_x"} & others.keys()
    if "load_x" in loads and len(loads) > 1:
        other = min(loads - {"load_x"})
        raise ValueError(f"load_x: got it beside {other}; give load and angle, or load_x and load_y")
    paths = {"film", "eccentricity_x"} & others.keys()
    if len(paths) > 1:
        raise ValueError("film: got it beside eccentricity_x; give one path")
    if paths and loads:
        path, load = min(paths), min(loads)
        raise ValueError(f"{path}: got it beside {load}; a given path needs its own load, give one of the two")


def _closed(time: Array, values: Mapping[str, Array], period: float) -> tuple[Array, dict[str, Array]]:
    """The rows up to the end of the first period, with the first row again if the last one ends before it."""
    length = float(time[-1] - time[0])
    if length > period * (1 + 1e-9):
        raise ValueError(f"period: got {period!r} s, but the rows span {length!r} s; give at least that")
    if length < period * (1 - 1e-9):
        ends = {name: column[0] for name, column in values.items()}
        if "angle" in values:  # the nearest of the same direction
            turns = round(float(values["angle"][-1] - values["angle"][0]) / (2 * math.pi))
            ends["angle"] = values["angle"][0] + 2 * math.pi * turns
        return (
            np.append(time, time[0] + period),
            {name: np.append(column, ends[name]) for name, column in values.items()},
        )
    closed = {}
    for name, column in values.items():
        gap = float(column[-1] - column[0])
        rise = round(gap / (2 * math.pi)) * 2 * math.pi if name == "angle" else 0.0
        if abs(gap - rise) > CLOSING * max(float(np.ptp(column)), 1e-300):
            raise ValueError(
                f"{name}: got {float(column[0]):.6g} in the first row and {float(column[-1]):.6g} in the last, a "
                "period later; a table that repeats ends where it begins"
            )
        closed[name] = np.append(column[:-1], column[0] + rise)
    return time, closed


@lru_cache(maxsize=8)
def _read(name: str, _modified: int, _size: int, period: float | None) -> Table:
    columns = read_columns(Path(name), UNITS, header=HEADER, most_bytes=MAX_BYTES, most_rows=MAX_ROWS)
    if "time" not in columns:
        raise ValueError(f"line 1: got no column time; begin with a line such as: {HEADER}")
    return checked_table(columns, period)
