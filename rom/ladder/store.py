"""Results in HDF5: written whole or not at all, read back as they were."""

import io
import json
from dataclasses import asdict, fields
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.files import replacing
from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.ladder.result import Field, Numerics, Result

SCHEMA = 2


def save(result: Result, path: Path) -> None:
    """Write :func:`as_bytes` to a file; InputError if ``path`` cannot be written."""
    with replacing(path) as scratch:
        scratch.write_bytes(as_bytes(result))


def as_bytes(result: Result) -> bytes:
    """An HDF5 file: ``quantities`` and ``fields`` with units as attributes, ``numerics``, ``provenance`` as JSON."""
    memory = io.BytesIO()
    with h5py.File(memory, "w") as file:
        file.attrs["schema"] = SCHEMA
        file.attrs["model"] = result.model
        file.attrs["provenance"] = json.dumps(result.provenance)
        file.create_group("numerics").attrs.update(asdict(result.numerics))
        for name, quantity in result.quantities.items():
            file.create_dataset(f"quantities/{name}", data=quantity.value).attrs["unit"] = quantity.unit
        for name, field in result.fields.items():
            file.create_dataset(f"fields/{name}", data=field.values, compression="gzip").attrs["unit"] = field.unit
    return memory.getvalue()


def load(path: Path, *, with_fields: bool = True) -> Result:
    """Read a result, or all of it but its fields; raises InputError if the file is missing or is not one."""
    try:
        with h5py.File(path) as file:
            if file.attrs["schema"] != SCHEMA:
                raise InputError(f"{path}: has schema {file.attrs['schema']}; this version reads {SCHEMA}, solve again")
            numerics = file["numerics"].attrs
            return Result(
                model=str(file.attrs["model"]),
                quantities={
                    name: Quantity(value=float(item[()]), unit=str(item.attrs["unit"]))
                    for name, item in file["quantities"].items()
                },
                fields={
                    name: Field(values=np.asarray(item[()]), unit=str(item.attrs["unit"]))
                    for name, item in (file["fields"].items() if with_fields else ())
                },
                numerics=Numerics(**{entry.name: _plain(numerics[entry.name]) for entry in fields(Numerics)}),
                provenance=_mapping(json.loads(file.attrs["provenance"])),
            )
    except (OSError, LookupError, ValueError, TypeError, AttributeError) as error:
        if isinstance(error, InputError):
            raise
        raise InputError(f"{path}: is not a result of roughfilm; name an .h5 file that it wrote") from error


def _plain(value: Any) -> Any:
    return value if isinstance(value, str) else value.item()


def _mapping(entries: object) -> dict[str, Any]:
    if not isinstance(entries, dict):
        raise ValueError("provenance is not a table")
    return entries


def as_entries(result: Result) -> dict[str, Any]:
    """The result without its fields, as ``--json`` prints it."""
    return {
        "model": result.model,
        "quantities": {name: asdict(quantity) for name, quantity in result.quantities.items()},
        "numerics": asdict(result.numerics),
        "provenance": dict(result.provenance),
    }
