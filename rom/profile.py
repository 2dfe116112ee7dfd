"""The measured profile of a groove: depth at points along the wall, checked, and read from a file."""

import csv
import math
import re
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np

from contact.entries import plain_number
from contact.units import to_si

Points = tuple[tuple[float, float], ...]
"""(position, depth) in m."""

FEWEST, MOST = 3, 2000
LARGEST = 1_000_000
"""Bytes; a longer file is refused unread."""

HEADER = "position (um), depth (um)"
_COLUMN = re.compile(r"(\w{1,20}) ?[(\[]([^()\[\]]{1,40})[)\]]")


def checked(points: object) -> Points:
    """The points of a groove, from rows of two numbers in m or from a file of that name.

    Raises ValueError that says which row is wrong, and how.
    """
    if isinstance(points, str):
        try:
            return checked(read_rows(Path(points)))
        except ValueError as error:
            raise ValueError(f"file {points!r:.200}: {error}") from error
    if not isinstance(points, list | tuple):
        raise ValueError(f"got {points!r:.60}; name a file, or give [[position, depth], ...] in m")
    if not FEWEST <= len(points) <= MOST:
        raise ValueError(f"got {len(points)} points; a groove needs {FEWEST} to {MOST} of them")
    rows = tuple(_row(row, number) for number, row in enumerate(points, 1))
    for number, ((before, _), (place, depth)) in enumerate(pairwise(rows), 2):
        if not place > before:
            raise ValueError(f"got position {place!r} m at point {number} after {before!r} m; positions must increase")
        if depth < 0:
            raise ValueError(f"got depth {depth!r} m at point {number}; depth counts downward and is never negative")
    for number in (0, -1):
        if rows[number][1] != 0:
            raise ValueError(
                f"got depth {rows[number][1]!r} m at the {'last' if number else 'first'} point; "
                "a groove begins and ends with depth 0"
            )
    if not any(depth > 0 for _, depth in rows):
        raise ValueError("got depth 0 at every point; a groove is deeper than that somewhere")
    return rows


def _row(row: Any, number: int) -> tuple[float, float]:
    if not isinstance(row, list | tuple) or len(row) != 2:
        raise ValueError(f"got {row!r:.60} as point {number}; write position and depth in m")
    place, depth = (plain_number(value) for value in row)
    if not (math.isfinite(place) and math.isfinite(depth)):
        raise ValueError(f"got {row!r} as point {number}; both numbers must be finite")
    return place, depth


def read_rows(path: Path) -> list[list[float]]:
    """The rows of a file: NPY of shape (n, 2) in m, or else CSV whose header gives two names and units.

    Such a header is ``position (um), depth (um)``. Raises ValueError that says what is wrong in the file.
    """
    try:
        path = path.expanduser()
        if not path.is_file():
            raise ValueError("is not there; name a file of points" if not path.exists() else "is no file; name one")
        if path.stat().st_size > LARGEST:
            raise ValueError(f"is larger than {LARGEST} bytes; {MOST} points are the most, thin them out")
        return _read_npy(path) if path.suffix.lower() == ".npy" else _read_csv(path)
    except OSError as error:
        raise ValueError(f"cannot be read ({error.strerror or error}); check its permissions") from error
    except RuntimeError as error:
        raise ValueError("has a home that is not known; write the path out") from error


def _read_npy(path: Path) -> list[list[float]]:
    try:
        # A map, since it refuses a header that claims more than the file holds before any memory is taken.
        array = np.lib.format.open_memmap(path, mode="r")
    except Exception as error:  # a damaged header ends in many kinds of error
        raise ValueError("is no NPY array; save one of shape (n, 2) with numpy.save") from error
    if array.ndim != 2 or array.shape[1] != 2 or array.dtype.kind not in "fiu":
        raise ValueError(
            f"got {array.dtype} of shape {array.shape}; save numbers of shape (n, 2), position and depth in m"
        )
    return [[float(value) for value in row] for row in array]


def _read_csv(path: Path) -> list[list[float]]:
    try:
        text = path.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError as error:
        raise ValueError(f"byte {error.start} is not UTF-8; save the points as UTF-8 text") from error
    try:
        lines = [(number, row) for number, row in enumerate(csv.reader(text.splitlines()), 1) if any(row)]
    except csv.Error as error:
        raise ValueError(f"is no CSV ({error}); write lines such as: 12.5, 3.2") from error
    if not lines:
        raise ValueError(f"is empty; begin with the line: {HEADER}")
    units = _units(lines[0][1])
    rows = []
    for number, row in lines[1:]:
        if len(row) != 2:
            raise ValueError(f"line {number}: got {len(row)} columns; write two, position and depth")
        try:
            rows.append([to_si(f"{cell.strip()} {unit}", "m") for cell, unit in zip(row, units, strict=True)])
        except ValueError as error:
            raise ValueError(f"line {number}: {error}") from None
    return rows


def _units(header: list[str]) -> list[str]:
    columns = [_COLUMN.fullmatch(cell.strip()) for cell in header]
    names = [column[1].lower() for column in columns if column]
    if names != ["position", "depth"] or len(header) != 2:
        raise ValueError(f"line 1: got {', '.join(header)!r:.60}; write two columns with units, such as: {HEADER}")
    units = [column[2] for column in columns if column]
    for unit in units:
        to_si(f"1 {unit}", "m")
    return units
