"""Tables of columns with units, as CSV files for reading and as HDF5 files for figures and reports."""

import csv
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import h5py
import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.checked_hdf5 import checked_bytes, has_mark, open_checked, open_plain
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.files import replacing
from roughfilm.contact.foundation.reading.hdf5_content import Content, Numbers, Text
from roughfilm.contact.foundation.writing.kinds import Kind, beginning

SCHEMA = 1
MARK = b"roughfilm columns, HDF5 behind 512 bytes, sha256 "
KIND = "a table of roughfilm"
REMEDY = "name a table.h5 that 'roughfilm batch' wrote"

TEXTS, NUMBERS = Text(shape=("rows",)), Numbers(shape=("rows",), missing=True, infinite=True)
"""What a file holds for a column."""


def _holds_table(path: Path) -> bool:
    """Whether a file is a table, as far as the units of its columns show; those of older versions have no mark."""
    try:
        if has_mark(path, MARK):
            return True
        with open_plain(path, KIND, REMEDY) as content:
            return _has_units(content)
    except InputError:
        return False


TABLE = Kind(KIND, _holds_table)


@dataclass(frozen=True, kw_only=True)
class Column:
    """A column of a table.

    Attributes
    ----------
    values : numbers, NaN where a number is missing, or texts.
    unit : unit of the numbers, "1" for dimensionless ones; "" for texts.
    """

    values: Sequence[float] | Sequence[str]
    unit: str


def write_csv(table: Mapping[str, Column], path: Path) -> None:
    """Write a table as a CSV file: a line of names, such as "load_per_area (Pa)", and a line for each row.

    A NaN is written as an empty entry. Raises InputError if the file cannot be written.
    """
    header = [name if column.unit in ("", "1") else f"{name} ({column.unit})" for name, column in table.items()]
    with (
        replacing(path, table_beginning(header[0])) as scratch,
        scratch.open("w", encoding="utf-8", newline="") as file,
    ):
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(header)
        writer.writerows(zip(*([_text(value) for value in column.values] for column in table.values()), strict=True))


def table_beginning(heading: str) -> Kind:
    """The kind of CSV files whose first column has a heading."""
    return Kind(
        f"a table that begins with the column {heading!r}",
        lambda path: beginning(path).split(b"\n")[0].split(b",")[0] == heading.encode(),
    )


def write_hdf5(table: Mapping[str, Column], path: Path) -> None:
    """Write a table as an HDF5 file: a dataset for each column, in order, with the attribute ``unit``.

    Raises InputError if the file cannot be written.
    """

    def fill(file: h5py.File) -> None:
        file.attrs["schema"] = SCHEMA
        for name, column in table.items():
            texts = column.unit == ""
            dataset = file.create_dataset(name, data=list(column.values), dtype=h5py.string_dtype() if texts else float)
            dataset.attrs["unit"] = column.unit

    with replacing(path, TABLE) as scratch:
        scratch.write_bytes(checked_bytes(MARK, fill, ordered=True))


def read_table(path: Path) -> dict[str, NDArray[Any]]:
    """Read the columns of a table.h5 by name: floats in SI units, NaN where missing, or texts; all have one length.

    Raises
    ------
    InputError
        If the file is missing or is not such a table.

    Examples
    --------
    This plots the load over the depth of the cylindrical grooves, computed by one model::

        table = read_table(Path("study/table.h5"))
        chosen = (table["model"] == "navier_stokes") & (table["profile"] == "cylindrical")
        axes.plot(table["depth_plus"][chosen], table["load_plus"][chosen], "o")
    """
    return {
        name: np.asarray(column.values, dtype=str if column.unit == "" else float)
        for name, column in read_columns(path).items()
    }


def read_columns(path: Path) -> dict[str, Column]:
    """Read the columns of a table.h5 with their units, by name; all have one length.

    Raises
    ------
    InputError
        If the file is missing or is not such a table.
    """
    if has_mark(path, MARK):
        with open_checked(path, MARK, SCHEMA, REMEDY) as content:
            return _columns(content)
    with open_plain(path, KIND, REMEDY) as content:  # of a version that wrote no header
        if not _has_units(content):
            raise InputError(f"{path}: is not {KIND}; {REMEDY}")
        return _columns(content)


def _has_units(content: Content) -> bool:
    units = content.take({f"{name}@unit": Text(optional=True) for name in content.names("")})
    return bool(units) and None not in units.values()


def _columns(content: Content) -> dict[str, Column]:
    names = content.names("")
    units = content.take({f"{name}@unit": Text() for name in names})
    columns = content.take({name: TEXTS if units[f"{name}@unit"] == "" else NUMBERS for name in names})
    return {
        name: Column(values=column if isinstance(column, list) else column.tolist(), unit=units[f"{name}@unit"])
        for name, column in columns.items()
    }


def _text(value: float | str) -> str:
    if isinstance(value, str):
        return value
    if np.isnan(value):
        return ""
    return repr(int(value)) if float(value).is_integer() and abs(value) < 1e15 else repr(float(value))
