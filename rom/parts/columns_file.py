"""Two columns of numbers with units, from a file: CSV with a header, or NPY in SI units."""

import csv
import re
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from roughfilm.contact.foundation.units import to_si

MOST = 2000
"""Rows."""

LARGEST = 1_000_000
"""Bytes; a longer file is refused unread."""

_COLUMN = re.compile(r"(\w{1,20}) ?[(\[]([^()\[\]]{1,40})[)\]]")


def read_rows(path: Path, columns: Mapping[str, str], *, header: str) -> list[list[float]]:
    """The rows of a file: NPY of shape (n, 2) in SI units, or else CSV whose header gives two names and units.

    Parameters
    ----------
    columns : the name of each column, and its SI unit.
    header : one as it may be, such as ``position (um), depth (um)``.

    Raises ValueError that says what is wrong in the file.
    """
    try:
        path = path.expanduser()
        if not path.is_file():
            raise ValueError("is not there; name a file of points" if not path.exists() else "is no file; name one")
        if path.stat().st_size > LARGEST:
            raise ValueError(f"is larger than {LARGEST} bytes; {MOST} points are the most, thin them out")
        return _read_npy(path, columns) if path.suffix.lower() == ".npy" else _read_csv(path, columns, header)
    except OSError as error:
        raise ValueError(f"cannot be read ({error.strerror or error}); check its permissions") from error
    except RuntimeError as error:
        raise ValueError("has a home that is not known; write the path out") from error


def _told(columns: Mapping[str, str]) -> str:
    return " and ".join(columns)


def _read_npy(path: Path, columns: Mapping[str, str]) -> list[list[float]]:
    try:
        # A map, since it refuses a header that claims more than the file holds before any memory is taken.
        array = np.lib.format.open_memmap(path, mode="r")
    except Exception as error:  # a damaged header ends in many kinds of error
        raise ValueError("is no NPY array; save one of shape (n, 2) with numpy.save") from error
    if array.ndim != 2 or array.shape[1] != 2 or array.dtype.kind not in "fiu":
        units = " and ".join(dict.fromkeys(columns.values()))
        raise ValueError(
            f"got {array.dtype} of shape {array.shape}; save numbers of shape (n, 2), {_told(columns)} in {units}"
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
            raise ValueError(f"line {number}: got {len(row)} columns; write two, {_told(columns)}")
        try:
            cells = zip(row, units, columns.values(), strict=True)
            rows.append([to_si(f"{cell.strip()} {unit}", base) for cell, unit, base in cells])
        except ValueError as error:
            raise ValueError(f"line {number}: {error}") from None
    return rows


def _units(first: list[str], columns: Mapping[str, str], header: str) -> list[str]:
    found = [_COLUMN.fullmatch(cell.strip()) for cell in first]
    names = [column[1].lower() for column in found if column]
    if names != list(columns) or len(first) != 2:
        raise ValueError(f"line 1: got {', '.join(first)!r:.60}; write two columns with units, such as: {header}")
    units = [column[2] for column in found if column]
    for unit, base in zip(units, columns.values(), strict=True):
        to_si(f"1 {unit}", base)
    return units
