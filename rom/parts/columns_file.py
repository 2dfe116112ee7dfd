"""Two columns of numbers from a scene or a file: CSV with a header that gives units, or NPY in SI units."""

import csv
import math
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from roughfilm.contact.foundation.entries import plain_number
from roughfilm.contact.foundation.units import to_si

MAX_ROWS = 2000
"""Largest number of rows."""

MAX_BYTES = 1_000_000
"""Largest size of a file that is read, bytes."""

_COLUMN = re.compile(r"(\w{1,20}) ?[(\[]([^()\[\]]{1,40})[)\]]")


def read_rows(path: Path, columns: Mapping[str, str], *, header: str) -> list[list[float]]:
    """The rows of a file: NPY of shape (n, 2) in SI units, or CSV with a header of two names and units.

    Parameters
    ----------
    columns : name of each column and its SI unit.
    header : example of a header for messages, such as ``position (um), depth (um)``.

    Raises
    ------
    ValueError
        If the file cannot be read, or a row is invalid.
    """
    try:
        path = path.expanduser()
        if not path.is_file():
            raise ValueError("is not there; name a file of points" if not path.exists() else "is no file; name one")
        if path.stat().st_size > MAX_BYTES:
            raise ValueError(f"is larger than {MAX_BYTES} bytes; give at most {MAX_ROWS} points")
        return _read_npy(path, columns) if path.suffix.lower() == ".npy" else _read_csv(path, columns, header)
    except OSError as error:
        raise ValueError(f"cannot be read ({error.strerror or error}); check its permissions") from error
    except RuntimeError as error:
        raise ValueError("has a home directory that does not exist; write the whole path") from error


def number_pairs(rows: Sequence[Any], *, name: str, columns: str) -> tuple[tuple[float, float], ...]:
    """The rows as pairs of finite floats; ``name`` of a row and ``columns`` with their units are for messages.

    Raises
    ------
    ValueError
        If a row is not two finite numbers.
    """
    return tuple(_pair(row, f"{name} {number}", columns) for number, row in enumerate(rows, 1))


def _pair(row: Any, name: str, columns: str) -> tuple[float, float]:
    if not isinstance(row, list | tuple) or len(row) != 2:
        raise ValueError(f"got {row!r:.60} as {name}; write {columns}")
    first, second = map(plain_number, row)
    if not (math.isfinite(first) and math.isfinite(second)):
        raise ValueError(f"got {row!r} as {name}; both numbers must be finite")
    return first, second


def _read_npy(path: Path, columns: Mapping[str, str]) -> list[list[float]]:
    try:
        # A memory map checks the size that the header claims before it allocates memory.
        array = np.lib.format.open_memmap(path, mode="r")
    except Exception as error:  # a damaged header causes many kinds of error
        raise ValueError("is no NPY array; save one of shape (n, 2) with numpy.save") from error
    if array.ndim != 2 or array.shape[1] != 2 or array.dtype.kind not in "fiu":
        units = " and ".join(dict.fromkeys(columns.values()))
        raise ValueError(
            f"got {array.dtype} of shape {array.shape}; save numbers of shape (n, 2), "
            f"{' and '.join(columns)} in {units}"
        )
    return [[float(value) for value in row] for row in array]


def _read_csv(path: Path, columns: Mapping[str, str], header: str) -> list[list[float]]:
    try:
        text = path.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError as error:
        raise ValueError(f"byte {error.start} is not UTF-8; save the points as UTF-8 text") from error
    try:
        lines = [(number, row) for number, row in enumerate(csv.reader(text.splitlines()), 1) if any(row)]
    except csv.Error as error:
        raise ValueError(f"is no CSV ({error}); write lines such as: 12.5, 3.2") from error
    if not lines:
        raise ValueError(f"is empty; begin with the line: {header}")
    units = _units(lines[0][1], columns, header)
    rows = []
    for number, row in lines[1:]:
        if len(row) != 2:
            raise ValueError(f"line {number}: got {len(row)} columns; write two, {' and '.join(columns)}")
        try:
            cells = zip(row, units, columns.values(), strict=True)
            rows.append([to_si(f"{cell.strip()} {unit}", base) for cell, unit, base in cells])
        except ValueError as error:
            raise ValueError(f"line {number}: {error}") from None
    return rows


def _units(first: list[str], columns: Mapping[str, str], header: str) -> list[str]:
    matches = [_COLUMN.fullmatch(cell.strip()) for cell in first]
    names = [column[1].lower() for column in matches if column]
    if names != list(columns) or len(first) != 2:
        raise ValueError(f"line 1: got {', '.join(first)!r:.60}; write two columns with units, such as: {header}")
    units = [column[2] for column in matches if column]
    for unit, base in zip(units, columns.values(), strict=True):
        to_si(f"1 {unit}", base)
    return units
