"""Write results to HDF5 files, completely or not at all, and read them back unchanged."""

import io
import json
from dataclasses import asdict
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.files import replacing
from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.ladder.result import Field, Numerics, Result, SolverRun, with_uncertainties

SCHEMA = 3
"""Version of the file format that is written."""

ENTRIES = ("numerics", "warnings", "expected_error", "provenance")
"""Parts of a result that are attributes of the file, as JSON."""


def save(result: Result, path: Path) -> None:
    """Write a result to an HDF5 file; InputError if it cannot be written or another kind of file is in its place."""
    refuse_other_file(path)
    with replacing(path) as scratch:
        scratch.write_bytes(as_bytes(result))


def refuse_other_file(path: Path) -> None:
    """Raise InputError if ``path`` is a file that is not a result, such as a scene or a surface."""
    path = path.expanduser()
    if not path.is_file():
        return
    try:
        with h5py.File(path) as file:
            known = "quantities" in file
    except OSError:
        known = False
    if not known:
        raise InputError(f"{path}: is a file that holds no result and would be replaced; choose another name")


def as_bytes(result: Result) -> bytes:
    """The bytes of an HDF5 file of a result.

    The datasets in ``quantities`` have the attributes ``unit`` and, if it is known, ``uncertainty``. The datasets in
    ``fields`` have the attribute ``unit``. The ``ENTRIES`` are attributes of the file, as JSON.
    """
    memory, entries = io.BytesIO(), as_entries(result)
    with h5py.File(memory, "w") as file:
        file.attrs["schema"] = SCHEMA
        file.attrs["model"] = result.model
        for name in ENTRIES:
            file.attrs[name] = json.dumps(entries[name], default=np.generic.item)
        for name in ("quantities", "fields"):
            file.create_group(name, track_order=True)  # the first ones stay the first
        for name, quantity in result.quantities.items():
            attributes = file.create_dataset(f"quantities/{name}", data=quantity.value).attrs
            attributes["unit"] = quantity.unit
            if quantity.uncertainty is not None:
                attributes["uncertainty"] = quantity.uncertainty
        for name, field in result.fields.items():
            file.create_dataset(f"fields/{name}", data=field.values, compression="gzip").attrs["unit"] = field.unit
    return memory.getvalue()


def load(path: Path, *, with_fields: bool = True) -> Result:
    """Read a result from an HDF5 file.

    Parameters
    ----------
    path : the file.
    with_fields : whether to read the fields too; without them, the result has none.

    Raises
    ------
    InputError
        If the file is missing, is not a result, or has a schema that this version does not read.
    """
    if not path.is_file():
        raise InputError(f"{path}: no such file; name an .h5 file that roughfilm wrote")
    try:
        with h5py.File(path) as file:
            if "quantities" not in file:
                raise LookupError("quantities")
            if (schema := file.attrs["schema"]) not in (2, SCHEMA):
                raise InputError(f"{path}: has schema {schema}; this version reads 2 and {SCHEMA}, solve again")
            entries = _of_schema_2(file) if schema == 2 else {name: json.loads(file.attrs[name]) for name in ENTRIES}
            runs = tuple(SolverRun(**run) for run in entries["numerics"].pop("runs"))
            quantities = {
                name: Quantity(
                    value=float(item[()]),
                    unit=str(item.attrs["unit"]),
                    uncertainty=float(item.attrs["uncertainty"]) if "uncertainty" in item.attrs else None,
                )
                for name, item in file["quantities"].items()
            }
            return Result(
                model=str(file.attrs["model"]),
                quantities=with_uncertainties(quantities, entries.get("uncertainty", {})),
                fields={
                    name: Field(values=np.asarray(item[()]), unit=str(item.attrs["unit"]))
                    for name, item in (file["fields"].items() if with_fields else ())
                },
                numerics=Numerics(**entries["numerics"], runs=runs),
                provenance={**entries["provenance"]},
                warnings=tuple(entries["warnings"]),
                expected_error={**entries["expected_error"]},
            )
    except (OSError, LookupError, ValueError, TypeError, AttributeError) as error:
        if isinstance(error, InputError):
            raise
        raise InputError(f"{path}: is not a result of roughfilm; name an .h5 file that it wrote") from error


def _of_schema_2(file: h5py.File) -> dict[str, Any]:
    """The entries of a file of schema 2, which has uncertainties, warnings and runs of the solver in its provenance."""
    old = json.loads(file.attrs["provenance"])
    attributes = file["numerics"].attrs.items()
    numerics = {name: value if isinstance(value, str) else value.item() for name, value in attributes}
    residuals, imbalances = old.pop("equations", {}), old.pop("imbalance", {})
    runs = [{"name": " x ".join(map(str, grid.pop("nodes"))), **grid} for grid in old.pop("grids", [])]
    for name, tries in {"": old.pop("tries", []), **old.pop("runs", {})}.items():
        last = {"residual": residuals.get(name), "imbalance": imbalances.get(name)}
        runs += [{"name": name, **one, **(last if one is tries[-1] else {})} for one in tries]
    return {
        "numerics": {**numerics, "processes": old.pop("processes", 1), "runs": runs},
        "uncertainty": old.pop("uncertainty", {}),
        "warnings": old.pop("warnings", []),
        "expected_error": {},
        "provenance": old,
    }


def as_entries(result: Result) -> dict[str, Any]:
    """The result without its fields, as the option ``--json`` prints it."""
    return {
        "model": result.model,
        "quantities": {name: asdict(quantity) for name, quantity in result.quantities.items()},
        "numerics": asdict(result.numerics),
        "warnings": list(result.warnings),
        "expected_error": dict(result.expected_error),
        "provenance": dict(result.provenance),
    }
