"""Columns of numbers from a scene or a file: CSV with a header that gives units, or two columns as NPY in SI units."""

import csv
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from roughfilm.contact.foundation.entries import rounded_number, si_number
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.ranges import RANGES
from roughfilm.contact.foundation.reading.npy import read_header, read_numbers
from roughfilm.contact.foundation.reading.regular import file_size, read_text
from roughfilm.contact.foundation.units import converted, rotational_speed, to_si

MAX_ROWS = 2000
"""Largest number of rows."""

MAX_BYTES = 1_000_000
"""Largest size of a file that is read, bytes."""

_COLUMN = re.compile(r"(\w{1,20}) ?[(\[]([^()\[\]]{1,40})[)\]]")


def read_rows(name: str, columns: Mapping[str, str], *, header: str) -> list[list[float]]:
    """The rows of a file: NPY of shape (n, 2) in SI units, or CSV with a header of two names and units.

    Parameters
    ----------
    name : path of the file; "~" at its beginning is the user's directory.
    columns : name of each column and its SI unit.
    header : example of a header for messages, such as ``position (um), depth (um)``.

    Raises
    ------
    ValueError
        If the file cannot be read, or a row is invalid.
    """
    path = Path(name)
    try:
        if file_size(path, "name a file of points") > MAX_BYTES:
            raise InputError(f"{path}: is larger than {MAX_BYTES} bytes; give at most {MAX_ROWS} points")
        return _read_npy(path, columns) if path.suffix.lower() == ".npy" else _read_csv(path, columns, header)
    except InputError as error:
        raise ValueError(str(error).removeprefix(f"{path}: ")) from None


def read_columns(
    path: Path, columns: Mapping[str, Sequence[str]], *, header: str, most_bytes: int, most_rows: int
) -> dict[str, tuple[str, tuple[float, ...]]]:
    """The columns of a CSV file in any order, each with its SI unit: the header has the names and units of some.

    Parameters
    ----------
    columns : name of each allowed column and the SI units that it may have; "1" is written as ``(1)`` or left out.
    header : example of a header for messages, such as ``time (ms), load (kN)``.
    most_bytes, most_rows : largest size of the file.

    Raises
    ------
    InputError
        If the file cannot be read.
    ValueError
        If a column is unknown or stands twice, or a row is invalid.
    """
    text = read_text(path, most_bytes, f"give at most {most_rows} rows")
    first, rows = _csv_lines(text, header)
    names, units = [], []
    for cell in first[1]:
        name, both = _head(cell.strip(), columns, header)
        if name in names:
            raise ValueError(f"line {first[0]}: got {name} twice; give each column once")
        names.append(name)
        units.append(both)
    values: list[list[float]] = [[] for _ in names]
    for number, row in rows:
        if len(row) != len(names):
            raise ValueError(f"line {number}: got {len(row)} columns; write {len(names)}, {', '.join(names)}")
        for cell, name, (unit, base), column in zip(row, names, units, values, strict=True):
            try:
                column.append(_number(cell.strip(), unit, base))
            except ValueError as error:
                raise ValueError(f"line {number}: {name}: {error}") from None
    return {name: (base, tuple(column)) for name, (_, base), column in zip(names, units, values, strict=True)}


def _number(cell: str, unit: str, base: str) -> float:
    """The number of a cell in its SI unit; without a unit it is a plain one."""
    if unit:
        turning = rotational_speed(f"{cell} {unit}") if base == "rad/s" else None
        return _cell(f"{cell} {unit}", base) if turning is None else turning
    try:
        return rounded_number(float(cell))
    except ValueError:
        raise ValueError(f"got {cell!r:.40}; write a plain number") from None


def _head(cell: str, columns: Mapping[str, Sequence[str]], header: str) -> tuple[str, tuple[str, str]]:
    """The name of a column, and its unit in the file, "" of a plain number, and in SI."""
    match = _COLUMN.fullmatch(cell)
    name, unit = (match[1].lower(), match[2]) if match else (cell.lower(), "")
    if name not in columns:
        raise ValueError(
            f"line 1: got the column {cell!r:.40}; the columns are {', '.join(columns)}, such as: {header}"
        )
    allowed = columns[name]
    if "1" in allowed and unit in ("", "1", "-"):
        return name, ("", "1")
    if not unit:
        raise ValueError(f"line 1: got {cell!r:.40} without a unit; write a line such as: {header}")
    for base in allowed[1:]:
        if rotational_speed(f"1 {unit}") is not None if base == "rad/s" else _is_in(unit, base):
            return name, (unit, base)
    _check_unit(unit, allowed[0])
    return name, (unit, allowed[0])


def _check_unit(unit: str, base: str) -> None:
    """Raise ValueError if a unit does not measure the quantity of an SI unit."""
    if base == "K" and not _is_in(unit, base):
        raise ValueError(f"line 1: got a temperature in {unit!r:.40}; convert it to degC or K")
    to_si(f"1 {unit}", base)


def _is_in(unit: str, base: str) -> bool:
    """Whether a unit measures the same quantity as an SI unit."""
    try:
        to_si(f"1 {unit}", base)
    except ValueError:
        return False
    return True


def _csv_lines(text: str, header: str) -> tuple[tuple[int, list[str]], list[tuple[int, list[str]]]]:
    """The first line of a CSV text that is not empty, and the others, each with its number."""
    try:
        lines = [(number, row) for number, row in enumerate(csv.reader(text.splitlines()), 1) if any(row)]
    except csv.Error as error:
        raise ValueError(f"is no CSV ({error}); write lines such as: 12.5, 3.2") from error
    if not lines:
        raise ValueError(f"is empty; begin with the line: {header}")
    return lines[0], lines[1:]


def number_pairs(rows: Sequence[Any], columns: Mapping[str, str], *, name: str) -> tuple[tuple[float, float], ...]:
    """The rows as pairs of floats, each in the range of its unit; a smaller one is a rounding error and counts as zero.

    Parameters
    ----------
    rows : pairs of numbers in SI units.
    columns : name of each column and its SI unit.
    name : what a row is, for messages.

    Raises
    ------
    ValueError
        If a row is not two numbers, or a number is out of range.
    """
    return tuple(_pair(row, columns, f"{name} {number}") for number, row in enumerate(rows, 1))


def _pair(row: Any, columns: Mapping[str, str], name: str) -> tuple[float, float]:
    if not isinstance(row, list | tuple) or len(row) != 2:
        units = " and ".join(dict.fromkeys(columns.values()))
        raise ValueError(f"got {row!r:.60} as {name}; write {' and '.join(columns)} in {units}")
    numbers = [si_number(value) for value in row]
    for number, (column, unit) in zip(numbers, columns.items(), strict=True):
        if not abs(number) <= RANGES[unit].most:
            raise ValueError(f"got {number!r} {unit} as {column} of {name}; it must be 0 or {RANGES[unit]} in size")
    first, second = (
        number if number in RANGES[unit] else 0.0 for number, unit in zip(numbers, columns.values(), strict=True)
    )
    return first, second


def _read_npy(path: Path, columns: Mapping[str, str]) -> list[list[float]]:
    units = " and ".join(dict.fromkeys(columns.values()))
    remedy = f"save numbers of shape (n, 2), {' and '.join(columns)} in {units}"
    numbers = read_header(path, remedy)
    if len(numbers.shape) != 2 or numbers.shape[1] != 2:
        raise ValueError(f"got {numbers.dtype} of shape {numbers.shape}; {remedy}")
    rows: list[list[float]] = read_numbers(path, numbers).tolist()
    return rows


def _read_csv(path: Path, columns: Mapping[str, str], header: str) -> list[list[float]]:
    text = read_text(path, MAX_BYTES, f"give at most {MAX_ROWS} points")
    first, lines = _csv_lines(text, header)
    units = _units(first[1], columns, header)
    rows = []
    for number, row in lines:
        if len(row) != 2:
            raise ValueError(f"line {number}: got {len(row)} columns; write two, {' and '.join(columns)}")
        try:
            cells = zip(row, units, columns.values(), strict=True)
            rows.append([_cell(f"{cell.strip()} {unit}", base) for cell, unit, base in cells])
        except ValueError as error:
            raise ValueError(f"line {number}: {error}") from None
    return rows


def _cell(text: str, base: str) -> float:
    """The number of a cell in its SI unit; zero for one below the range of the unit."""
    return 0.0 if abs(converted(text, base)) < RANGES[base].least else to_si(text, base)


def _units(first: list[str], columns: Mapping[str, str], header: str) -> list[str]:
    matches = [_COLUMN.fullmatch(cell.strip()) for cell in first]
    names = [column[1].lower() for column in matches if column]
    if names != list(columns) or len(first) != 2:
        raise ValueError(f"line 1: got {', '.join(first)!r:.60}; write two columns with units, such as: {header}")
    units = [column[2] for column in matches if column]
    for unit, base in zip(units, columns.values(), strict=True):
        _check_unit(unit, base)
    return units
