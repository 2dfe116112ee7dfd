"""Series of contacts over the load in HDF5 files; each completed load is added to the file.

The files grow in place and are checked, see `roughfilm.contact.foundation.growing_hdf5`. Fields are stored without
compression, which would take as long as the contact itself; fields that are 0 everywhere take no space.
"""

import json
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any, TypeVar

import h5py
import numpy as np
from pydantic import PositiveFloat

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.checked_hdf5 import HEADER_BYTES, has_mark
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.growing_hdf5 import Writer, grow, read
from roughfilm.contact.foundation.inputs import Inputs
from roughfilm.contact.foundation.reading.hdf5_content import Content, Json, Numbers, Text
from roughfilm.contact.foundation.reading.regular import holds_data, opened
from roughfilm.contact.mechanics.contact import Contact

T = TypeVar("T")

SCHEMA = 2
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

ALWAYS = ("load", "area_fraction", "plastic_fraction", "cpu_s")
"""The numbers of a row that every model gives."""

MAP = ("nx", "ny")
SURFACE = {"heights": Numbers(shape=MAP), "@spacing": Numbers(shape=(2,))}
FIELDS = {
    "/pressure": Numbers(shape=MAP),
    "/gap": Numbers(shape=MAP),
    "/plastic_displacement": Numbers(shape=MAP),
    "@hardness": Numbers(infinite=True),
    "@approach": Numbers(),
    "@complementarity": Numbers(),
    "@iterations": Numbers(),
}
"""What a file holds for its surface, and for a load with fields."""


@dataclass(frozen=True, kw_only=True)
class Settings:
    """The settings of a series that its readers need: model, boundary, E* and H, Pa, None without plasticity."""

    model: str
    boundary: str
    composite_modulus: PositiveFloat
    hardness: PositiveFloat | None


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

    def fill(writer: Writer) -> None:
        if "series" in writer.file:
            before = _rows(Content(writer.file, path, REMEDY), inputs)
        else:
            before = {}
            _begin(writer, inputs)
        names = [f"loads/{row.load!r}" for row, _ in contacts]
        for name, (row, contact) in zip(names, contacts, strict=True):
            _put(writer, _new(name), row, contact)
        _tabulate(writer.file, before | {row.load: row for row, _ in contacts})
        for name in names:  # at the end, since HDF5 writes into the place of what was removed
            if name in writer.file:
                writer.remove(name)
            writer.rename(_new(name), name)

    if holds_data(path, REMEDY):
        _refuse_other(path)
    grow(path, MARK, REMEDY, fill)


def _new(name: str) -> str:
    """The name of the group of a load while it is written."""
    return f"{name} new"


def _put(writer: Writer, name: str, row: Row, contact: Contact | None) -> None:
    """Write the group of a load."""
    group = writer.file.create_group(name)
    group.attrs.update(_numbers(row))
    if contact is not None:
        group.attrs["hardness"] = contact.hardness
        for field, values in _arrays(contact).items():
            writer.write(f"{name}/{field}", values, "Pa" if field == "pressure" else "m")


def finished(path: Path, inputs: Inputs) -> dict[float, Row]:
    """The rows stored in a file for these inputs, by load, Pa; empty if the file does not exist or is empty.

    Raises
    ------
    InputError
        If the file cannot be read, was damaged or changed, or holds another series or other data.
    """
    return _read(path, lambda content: _rows(content, inputs)) if holds_data(path, REMEDY) else {}


def _rows(content: Content, inputs: Inputs) -> dict[float, Row]:
    """The rows of a series by load, Pa; raises InputError if it has other inputs."""
    stored = content.take({"@digest": Text(), "@settings": Json(kind=dict[str, Any])})
    if stored["@digest"] != inputs.digest:
        difference = inputs.difference(stored["@settings"])
        raise InputError(f"{content.path}: holds another series, {difference}; {REMEDY}")
    columns = content.take({f"series/{name}": _number(name, ("rows",)) for name in NUMBERS}).values()
    rows = [_row(numbers) for numbers in zip(*(column.tolist() for column in columns), strict=True)]
    return {row.load: row for row in rows}


def _refuse_other(path: Path) -> None:
    """Raise InputError if a file is no series of contacts, or one of an older version."""
    if not is_series(path):
        raise InputError(f"{path}: is no series of contacts; {REMEDY}")
    with opened(path, REMEDY) as raw:
        if len(raw.read(HEADER_BYTES).removeprefix(MARK).rstrip(b"\0").split()) == 1:
            raise InputError(f"{path}: is of an older version of roughfilm; {REMEDY}")


def _read(path: Path, get: Callable[[Content], T], arrays: Callable[[str], bool] = lambda _name: True) -> T:
    """The return value of ``get``, called with the open file after a check of the arrays."""
    _refuse_other(path)

    def checked(file: h5py.File) -> T:
        content = Content(file, path, REMEDY)
        if content.one("@schema", Numbers(kind=int)) != SCHEMA:
            raise InputError(f"{path}: is of another version of roughfilm; {REMEDY}")
        return get(content)

    return read(path, MARK, REMEDY, checked, arrays=arrays)


def is_series(path: Path) -> bool:
    """Whether a file holds a series of contacts, whatever its name; InputError if it cannot be read."""
    return has_mark(path, MARK)


def load_series(path: Path) -> tuple[Inputs, tuple[float, ...]]:
    """The inputs of the series in a file, and the loads at which it holds fields, Pa, in increasing order.

    Raises
    ------
    InputError
        If the file cannot be read, was damaged or changed, or holds other data.
    """

    def get(content: Content) -> tuple[Inputs, tuple[float, ...]]:
        content.one("@settings", Json(kind=Settings))
        stored = content.take({**SURFACE, "@settings": Json(kind=dict[str, Any])})
        dx, dy = stored["@spacing"].tolist()
        inputs = Inputs(heights=stored["heights"], spacing=(dx, dy), settings=stored["@settings"])
        names = {f"loads/{name}@load": Numbers() for name in content.names("loads")}
        names = {name: one for name, one in names.items() if content.holds(name.replace("@load", "/pressure"))}
        return inputs, tuple(sorted(content.take(names).values()))

    return _read(path, get)


def load_contact(path: Path, load: float) -> Contact:
    """The stored contact at a load, Pa.

    The file does not hold the elastic displacement, which is computed as u_e = a − (max z − z) − u_p + g, with the
    approach a, the heights z, the plastic displacement u_p and the gap g, all in m.

    Raises
    ------
    InputError
        If the file was damaged or changed, or holds no fields at this load.
    """
    name = f"loads/{load!r}"

    def get(content: Content) -> Contact:
        if not content.holds(f"{name}/pressure"):
            raise InputError(f"{path}: holds no fields at {load!r} Pa; solve this load")
        stored = content.take(SURFACE | {f"{name}{one}": item for one, item in FIELDS.items()})
        heights, approach = stored["heights"], stored[f"{name}@approach"]
        gap, plastic = stored[f"{name}/gap"], stored[f"{name}/plastic_displacement"]
        dx, dy = stored["@spacing"].tolist()
        return Contact(
            load=load,
            hardness=stored[f"{name}@hardness"],
            heights=heights,
            spacing=(dx, dy),
            pressure=stored[f"{name}/pressure"],
            elastic_displacement=approach - (heights.max() - heights) - plastic + gap,
            plastic_displacement=plastic,
            approach=approach,
            gap=gap,
            complementarity=stored[f"{name}@complementarity"],
            iterations=int(stored[f"{name}@iterations"]),
        )

    return _read(path, get, lambda array: array == "/heights" or array.startswith(f"/{name}/"))


def _begin(writer: Writer, inputs: Inputs) -> None:
    attributes = writer.file.attrs
    attributes["schema"] = SCHEMA
    attributes["digest"] = inputs.digest
    attributes["settings"] = json.dumps(inputs.settings, sort_keys=True, allow_nan=False)
    attributes["spacing"] = inputs.spacing
    attributes["spacing_unit"] = "m"
    writer.write("heights", inputs.heights, "m")


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


def _number(name: str, shape: tuple[str, ...] = ()) -> Numbers:
    """What the file holds for a number of a row: NaN where the model does not give it."""
    return Numbers(shape=shape, missing=name not in ALWAYS)


def _row(numbers: Sequence[float]) -> Row:
    given = zip(NUMBERS, numbers, strict=True)
    values: dict[str, Any] = {name: None if math.isnan(number) else number for name, number in given}
    values["iterations"] = None if values["iterations"] is None else int(values["iterations"])
    return Row(**values)
