"""Series of contacts over the load in HDF5 files; each completed load is added to the file.

The files have a header with a digest, see `roughfilm.contact.foundation.checked_hdf5`. A load is added to a copy, which
then replaces the file.
"""

import json
import math
import os
import shutil
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.checked_hdf5 import (
    HEADER_BYTES,
    content_digest,
    has_mark,
    header_block,
    open_checked,
    refuse_damaged,
)
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.files import replacing
from roughfilm.contact.foundation.inputs import Inputs
from roughfilm.contact.mechanics.contact import Contact

SCHEMA = 1
MARK = b"roughfilm contact, HDF5 behind 512 bytes, sha256 "
REMEDY = "remove it or choose another place"


@dataclass(frozen=True, kw_only=True)
class Row:
    """The numbers of a contact at one load; None where the model does not give a number.

    Attributes
    ----------
    load : mean pressure over the nominal area, Pa.
    area_fraction, area_fraction_pixel, plastic_fraction, approach, complementarity, iterations : as in `Contact`.
    mean_gap : mean distance between the deformed surface and the plane, m.
    pressure_max : largest pressure, Pa.
    cpu_s : CPU time, s.
    """

    load: float
    area_fraction: float
    area_fraction_pixel: float | None
    plastic_fraction: float
    mean_gap: float | None
    approach: float | None
    complementarity: float | None
    iterations: int | None
    pressure_max: float | None
    cpu_s: float


NUMBERS = tuple(entry.name for entry in fields(Row))

UNITS = {"load": "Pa", "mean_gap": "m", "approach": "m", "pressure_max": "Pa", "cpu_s": "s"}
"""Units of the numbers of a row; all others are dimensionless."""


def row_of(contact: Contact, cpu_s: float) -> Row:
    """The numbers of a contact whose solution took the CPU time ``cpu_s``, s."""
    return Row(
        load=contact.load,
        area_fraction=contact.area_fraction,
        area_fraction_pixel=contact.area_fraction_pixel,
        plastic_fraction=contact.plastic_fraction,
        mean_gap=contact.mean_gap,
        approach=contact.approach,
        complementarity=contact.complementarity,
        iterations=contact.iterations,
        pressure_max=float(contact.pressure.max()),
        cpu_s=cpu_s,
    )


def add(path: Path, inputs: Inputs, contacts: Sequence[tuple[Row, Contact | None]]) -> None:
    """Add loads to the file of a series, all or none; loads that the file holds already are kept.

    Parameters
    ----------
    path : the HDF5 file; it is made if it does not exist.
    inputs : inputs of the series; the file must belong to the same ones.
    contacts : for each load its numbers, and its contact if the model gives fields, otherwise None.

    Raises
    ------
    InputError
        If the file cannot be written, was damaged, or holds a series of other inputs or other data.
    """
    before = finished(path, inputs)
    with replacing(path) as scratch:
        if before:
            shutil.copyfile(path, scratch)
        mode = (
            {"name": scratch, "mode": "r+"}
            if before
            else {"name": scratch, "mode": "w", "userblock_size": HEADER_BYTES}
        )
        with h5py.File(**mode) as file:
            if not before:
                _begin(file, inputs)
            for row, contact in contacts:
                _put(file, row, contact)
            _tabulate(file, before | {row.load: row for row, _ in contacts})
        with scratch.open("r+b") as raw:
            raw.write(header_block(MARK, content_digest(scratch)))
            os.fsync(raw.fileno())


def _put(file: h5py.File, row: Row, contact: Contact | None) -> None:
    name = f"loads/{row.load!r}"
    if name in file:
        del file[name]
    group = file.create_group(name)
    group.attrs.update(_numbers(row))
    if contact is not None:
        group.attrs["hardness"] = contact.hardness
        for name, values in _arrays(contact).items():
            _write(group, name, values, "Pa" if name == "pressure" else "m")


def finished(path: Path, inputs: Inputs) -> dict[float, Row]:
    """The rows stored in a file for these inputs, by load, Pa; empty if the file does not exist or is empty.

    Raises
    ------
    InputError
        If the file cannot be read, was damaged or changed, or holds another series or other data.
    """
    try:
        with path.open("rb") as raw:
            head = raw.read(len(MARK))
        if not head:
            return {}
        if head != MARK:
            raise InputError(f"{path}: is no series of contacts; {REMEDY}")
        refuse_damaged(path, MARK, REMEDY)
        with h5py.File(path) as file:
            if file.attrs["schema"] != SCHEMA:
                raise InputError(f"{path}: is of another version of roughfilm; {REMEDY}")
            if file.attrs["digest"] != inputs.digest:
                raise InputError(f"{path}: holds another series, {inputs.difference(file.attrs['settings'])}; {REMEDY}")
            columns = [file[f"series/{name}"][()] for name in NUMBERS]
            rows = [_row(dict(zip(NUMBERS, numbers, strict=True))) for numbers in zip(*columns, strict=True)]
            return {row.load: row for row in rows}
    except FileNotFoundError:
        return {}
    except OSError as error:
        raise InputError(f"{path}: cannot be read ({error.strerror or error}); choose another place") from error


def is_series(path: Path) -> bool:
    """Whether a file holds a series of contacts, whatever its name; raises OSError if it cannot be read."""
    return has_mark(path, MARK)


def load_series(path: Path) -> tuple[Inputs, tuple[float, ...]]:
    """The inputs of the series in a file, and the loads at which it holds fields, Pa, in increasing order.

    Raises
    ------
    InputError
        If the file cannot be read, was damaged or changed, or holds other data.
    """
    if not is_series(path):
        raise InputError(f"{path}: is no series of contacts; {REMEDY}")
    with open_checked(path, MARK, SCHEMA, REMEDY) as file:
        dx_dy = file.attrs["spacing"]
        inputs = Inputs(
            heights=file["heights"][()],
            spacing=(float(dx_dy[0]), float(dx_dy[1])),
            settings=json.loads(file.attrs["settings"]),
        )
        loads = sorted(float(name) for name, group in file["loads"].items() if "pressure" in group)
    return inputs, tuple(loads)


def load_contact(path: Path, load: float) -> Contact:
    """The stored contact at a load, Pa.

    The file does not hold the elastic displacement, which is computed as u_e = a − (max z − z) − u_p + g, with the
    approach a, the heights z, the plastic displacement u_p and the gap g, all in m.

    Raises
    ------
    InputError
        If the file was damaged or changed, or holds no fields at this load.
    """
    refuse_damaged(path, MARK, REMEDY)
    with h5py.File(path) as file:
        name = f"loads/{load!r}"
        if name not in file or "pressure" not in file[name]:
            raise InputError(f"{path}: holds no fields at {load!r} Pa; solve this load")
        group = file[name]
        row = _row(group.attrs)
        heights, dx_dy = file["heights"][()], file.attrs["spacing"]
        gap, plastic = group["gap"][()], group["plastic_displacement"][()]
        approach = float(group.attrs["approach"])
        return Contact(
            load=load,
            hardness=float(group.attrs["hardness"]),
            heights=heights,
            spacing=(float(dx_dy[0]), float(dx_dy[1])),
            pressure=group["pressure"][()],
            elastic_displacement=approach - (heights.max() - heights) - plastic + gap,
            plastic_displacement=plastic,
            approach=approach,
            gap=gap,
            complementarity=float(group.attrs["complementarity"]),
            iterations=int(row.iterations or 0),
        )


def _begin(file: h5py.File, inputs: Inputs) -> None:
    file.attrs["schema"] = SCHEMA
    file.attrs["digest"] = inputs.digest
    file.attrs["settings"] = json.dumps(inputs.settings, sort_keys=True, allow_nan=False)
    file.attrs["spacing"] = inputs.spacing
    file.attrs["spacing_unit"] = "m"
    _write(file, "heights", inputs.heights, "m")


def _write(group: h5py.Group, name: str, values: Array, unit: str) -> None:
    written = group.create_dataset(name, data=values, compression="gzip", compression_opts=1, shuffle=True)
    written.attrs["unit"] = unit


def _tabulate(file: h5py.File, rows: Mapping[float, Row]) -> None:
    """Write the group ``series``: a column for each number, by increasing load; NaN where a number is missing."""
    if "series" in file:
        del file["series"]
    ordered = [_numbers(rows[load]) for load in sorted(rows)]
    for name in NUMBERS:
        column = np.array([numbers[name] for numbers in ordered])
        file.create_dataset(f"series/{name}", data=column).attrs["unit"] = UNITS.get(name, "1")


def _numbers(row: Row) -> dict[str, float]:
    return {name: math.nan if value is None else float(value) for name, value in vars(row).items()}


def _arrays(contact: Contact) -> dict[str, Array]:
    return {
        "pressure": contact.pressure,
        "gap": contact.gap,
        "plastic_displacement": contact.plastic_displacement,
    }


def _row(attributes: Mapping[str, Any]) -> Row:
    numbers = {name: float(attributes[name]) for name in NUMBERS}
    values: dict[str, Any] = {name: None if math.isnan(number) else number for name, number in numbers.items()}
    values["iterations"] = None if values["iterations"] is None else int(values["iterations"])
    return Row(**values)
