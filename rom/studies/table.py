"""Tables of columns with units, as CSV files for reading and as HDF5 files for figures and reports."""

import csv
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import h5py
import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.files import replacing


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
    with replacing(path) as scratch, scratch.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(header)
        writer.writerows(zip(*([_text(value) for value in column.values] for column in table.values()), strict=True))


def write_hdf5(table: Mapping[str, Column], path: Path) -> None:
    """Write a table as an HDF5 file: a dataset for each column, in order, with the attribute ``unit``.

    Raises InputError if the file cannot be written.
    """
    with replacing(path) as scratch, h5py.File(scratch, "w", track_order=True) as file:
        for name, column in table.items():
            texts = column.unit == ""
            dataset = file.create_dataset(name, data=list(column.values), dtype=h5py.string_dtype() if texts else float)
            dataset.attrs["unit"] = column.unit


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
    if not path.is_file():
        raise InputError(f"{path}: no such file; name a table.h5 that 'roughfilm batch' wrote")
    try:
        with h5py.File(path) as file:
            if any(item.ndim != 1 for item in file.values()):
                raise TypeError("a column has one dimension")
            return {
                name: Column(
                    values=(item.asstr()[()] if item.attrs["unit"] == "" else item[()]).tolist(),
                    unit=str(item.attrs["unit"]),
                )
                for name, item in file.items()
            }
    except (OSError, LookupError, TypeError, AttributeError) as error:
        raise InputError(
            f"{path}: is not a table of roughfilm; name a table.h5 that 'roughfilm batch' wrote"
        ) from error


def _text(value: float | str) -> str:
    if isinstance(value, str):
        return value
    if np.isnan(value):
        return ""
    return repr(int(value)) if float(value).is_integer() and abs(value) < 1e15 else repr(float(value))
