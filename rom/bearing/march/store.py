"""Files of marches: HDF5 that grows by chunks of steps, from which a stopped march goes on, and CSV."""

import json
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.checked_hdf5 import has_mark, write_inputs
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.files import replacing
from roughfilm.contact.foundation.growing_hdf5 import Writer, grow, read
from roughfilm.contact.foundation.inputs import Inputs
from roughfilm.contact.foundation.reading.hdf5_content import Content, Json, Numbers, Text
from roughfilm.contact.foundation.reading.regular import holds_data
from roughfilm.rom.bearing.march.series import Chunk, Series, Snapshot
from roughfilm.rom.studies.table import table_beginning

SCHEMA = 1
MARK = b"roughfilm march, HDF5 behind 512 bytes, sha256 "
REMEDY = "remove it or choose another place"

FIELDS = ("film_thickness", "pressure", "density_ratio")
"""Names of the fields of a snapshot."""

FIELD_UNITS = {"film_thickness": "m", "pressure": "Pa", "density_ratio": "1"}

STATE = {
    "place": ("coordinates",),
    "pressures": ("inflows",),
    "pressure": ("nx", "ny"),
    "fill": ("nx", "ny"),
    "kind": ("nx", "ny"),
    "past_time": ("past",),
    "past_place": ("past", "coordinates"),
    "past_velocity": ("past", "coordinates"),
    "past_held": ("past", "nx", "ny"),
    "past_temperature": ("past",),
    "temperatures": (2,),
    "steps": (5,),
}
"""The arrays from which a march goes on, with their shapes."""


def kept(path: Path, inputs: Inputs, march: str) -> tuple[Chunk, ...]:
    """The chunks of a march in a file, in order; none if there is no file, or an empty one.

    Parameters
    ----------
    march : name of the march, such as "fine".

    Raises
    ------
    InputError
        If the file cannot be read, was damaged or changed, or holds another march or something else.
    """
    if not holds_data(path, REMEDY):
        return ()
    if not has_mark(path, MARK):
        raise InputError(f"{path}: is no series of a march; {REMEDY}")

    def get(file: h5py.File) -> tuple[Chunk, ...]:
        content = Content(file, path, REMEDY)
        if content.one("@schema", Numbers(kind=int)) != SCHEMA:
            raise InputError(f"{path}: is of another version of roughfilm; {REMEDY}")
        stored = content.take({"@digest": Text(), "@settings": Json(kind=dict[str, Any])})
        if stored["@digest"] != inputs.digest:
            raise InputError(f"{path}: holds another march, {inputs.difference(stored['@settings'])}; {REMEDY}")
        place = f"marches/{march}"
        names = sorted(file[place]) if place in file else []
        return tuple(_chunk(file[f"{place}/{name}"]) for name in names)

    return read(path, MARK, REMEDY, get)


def _chunk(group: h5py.Group) -> Chunk:
    snapshots = group.get("snapshots", {})
    return Chunk(
        rows=group["rows"][()],
        snapshots=tuple(
            Snapshot(
                time=float(snapshots[name].attrs["time"]),
                fields={field: (snapshots[f"{name}/{field}"][()], FIELD_UNITS[field]) for field in FIELDS},
            )
            for name in sorted(snapshots)
        ),
        state={name: group[f"state/{name}"][()] for name in STATE},
    )


def keeper(path: Path, inputs: Inputs, march: str, known: int) -> Callable[[Chunk], None]:
    """A function that adds a chunk to the file of a march, completely or not at all.

    Parameters
    ----------
    known : number of chunks that the file holds already.
    """
    count = [known]

    def keep(chunk: Chunk) -> None:
        name = f"marches/{march}/{count[0]:06d}"

        def fill(writer: Writer) -> None:
            if "marches" not in writer.file:
                write_inputs(writer.file, inputs, SCHEMA)
            writer.write(f"{name}/rows", chunk.rows, "SI")
            for key in STATE:
                writer.write(f"{name}/state/{key}", np.asarray(chunk.state[key], dtype=np.float64), "SI")
            for number, one in enumerate(chunk.snapshots):
                for field, (values, unit) in one.fields.items():
                    writer.write(f"{name}/snapshots/{number:06d}/{field}", values, unit)
                writer.file[f"{name}/snapshots/{number:06d}"].attrs["time"] = one.time

        grow(path, MARK, REMEDY, fill)
        count[0] += 1

    return keep


def finish(path: Path, series: Series, quantities: Mapping[str, Any]) -> None:
    """Add the whole series to its file: ``series/`` with a column for each number, ``fields/`` and ``grid/``."""

    def fill(writer: Writer) -> None:
        if "series" in writer.file:
            return
        for name, values in series.columns.items():
            writer.write(f"series/{name}", np.ascontiguousarray(values), series.units[name])
        for name, (places, unit) in series.grid.items():
            writer.write(f"grid/{name}", np.ascontiguousarray(places), unit)
        if series.snapshots:
            writer.write("fields/time", np.array([one.time for one in series.snapshots]), "s")
            for field in FIELDS:
                stack = np.array([one.fields[field][0] for one in series.snapshots])
                writer.write(f"fields/{field}", stack, FIELD_UNITS[field])
        writer.file.attrs["quantities"] = json.dumps(quantities, allow_nan=False)

    grow(path, MARK, REMEDY, fill)


def write_csv(path: Path, units: Mapping[str, str], rows: Array | Sequence[Sequence[float]]) -> None:
    """Write a line for each step; the first line has names and units."""
    heads = [f"{name} ({unit})" for name, unit in units.items()]
    lines = [", ".join(heads), *(", ".join(repr(float(number)) for number in row) for row in rows)]
    with replacing(path, table_beginning(heads[0])) as scratch:
        scratch.write_text("\n".join(lines) + "\n", encoding="utf-8")
