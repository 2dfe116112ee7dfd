"""Write results to HDF5 files, completely or not at all, and read them back unchanged."""

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields, replace
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from roughfilm.contact.foundation.checked_hdf5 import checked_bytes, has_mark, open_checked, open_plain
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.files import replacing
from roughfilm.contact.foundation.reading.hdf5_content import Content, Json, Layout, Numbers, Text
from roughfilm.contact.foundation.reading.json_entries import from_json
from roughfilm.contact.foundation.units import Quantity
from roughfilm.contact.foundation.writing.kinds import SIGNATURE, Kind, beginning_with
from roughfilm.rom.ladder.kind import kind_names
from roughfilm.rom.ladder.result import Field, Numerics, Result, with_uncertainties

SCHEMA = 4
"""Version of the file format that is written."""

OLDER = (2, 3)
"""Versions without a header, which are read too."""

MARK = b"roughfilm result, HDF5 behind 512 bytes, sha256 "
KIND = "a result of roughfilm"
REMEDY = "name an .h5 file that it wrote"


@dataclass(frozen=True, kw_only=True)
class SceneEntries:
    """The entry of a stored scene that names its kind."""

    kind: str


@dataclass(frozen=True, kw_only=True)
class Provenance:
    """The entry of a stored provenance that readers need."""

    scene: SceneEntries


ENTRIES = {
    "numerics": Json(kind=Numerics, missing=True),
    "warnings": Json(kind=tuple[str, ...]),
    "outside": Json(kind=tuple[str, ...], optional=True),
    "expected_error": Json(kind=dict[str, float], missing=True),
    "provenance": Json(kind=dict[str, Any]),
}
"""Parts of a result that are attributes of the file, as JSON."""

SCALAR: Layout = {"": Numbers(), "@unit": Text(), "@uncertainty": Numbers(optional=True)}
FIELD: Layout = {"": Numbers(shape=None, missing=True), "@unit": Text()}
"""What a file holds for a quantity and for a field, behind their names."""


def save(result: Result, path: Path, *, overwrite: bool = False) -> None:
    """Write a result to an HDF5 file, which replaces a result, and with ``overwrite`` any file but an input.

    Raises
    ------
    InputError
        If the file cannot be written, or another kind of file is in its place.
    """
    with replacing(path, RESULT, overwrite=overwrite) as scratch:
        scratch.write_bytes(as_bytes(result))


def _holds_result(path: Path) -> bool:
    """Whether a file is a result, as far as its first names show."""
    try:
        if has_mark(path, MARK):
            return True
        with open_plain(path, KIND, REMEDY) as content:
            return content.holds("quantities")
    except InputError:
        return False


RESULT = Kind(KIND, _holds_result)

STORED = beginning_with(KIND, MARK, SIGNATURE)
"""Files that a batch solves again if they hold no result that can be read."""


def as_bytes(result: Result) -> bytes:
    """The bytes of an HDF5 file of a result.

    The datasets in ``quantities`` have the attributes ``unit`` and, if it is known, ``uncertainty``. The datasets in
    ``fields`` have the attribute ``unit``. The ``ENTRIES`` are attributes of the file, as JSON.
    """
    entries = as_entries(result)

    def fill(file: h5py.File) -> None:
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

    return checked_bytes(MARK, fill)


def load(path: Path, *, with_fields: bool = True) -> Result:
    """Read a result from an HDF5 file.

    Parameters
    ----------
    path : the file.
    with_fields : whether to read the fields too; without them, the result has none.

    Raises
    ------
    InputError
        If the file is missing, was damaged or changed, is not a result, or has a schema that this version does not
        read.
    """
    if has_mark(path, MARK):
        with open_checked(path, MARK, SCHEMA, "solve again") as content:
            return _result(content, content.take({f"@{name}": item for name, item in ENTRIES.items()}), with_fields)
    with open_plain(path, KIND, REMEDY) as content:
        schema = content.one("@schema", Numbers(kind=int, optional=True))
        if schema is None or not content.holds("quantities"):
            raise InputError(f"{path}: is not {KIND}; {REMEDY}")
        if schema not in OLDER:
            raise InputError(f"{path}: has schema {schema}; this version reads {OLDER[0]} to {SCHEMA}, solve again")
        if schema == OLDER[0]:
            return _result_of_schema_2(content, with_fields)
        return _result(content, content.take({f"@{name}": item for name, item in ENTRIES.items()}), with_fields)


def _result(content: Content, entries: Mapping[str, Any], with_fields: bool) -> Result:
    """The result in a file, whose ``entries`` are those of ``ENTRIES``."""
    if content.one("@provenance", Json(kind=Provenance)).scene.kind not in kind_names():
        raise content.fault("@provenance", "names no known kind of scene")
    return Result(
        model=content.one("@model", Text()),
        quantities={
            name: Quantity(value=value, unit=unit, uncertainty=uncertainty)
            for name, (value, unit, uncertainty) in _members(content, "quantities", SCALAR).items()
        },
        fields={
            name: Field(values=values, unit=unit)
            for name, (values, unit) in (_members(content, "fields", FIELD).items() if with_fields else ())
        },
        numerics=entries["@numerics"],
        provenance=entries["@provenance"],
        warnings=entries["@warnings"],
        outside=entries["@outside"] or (),
        expected_error=entries["@expected_error"],
    )


def _members(content: Content, group: str, layout: Layout) -> dict[str, list[Any]]:
    """The values of a layout for each name in a group."""
    names = content.names(group)
    stored = content.take({f"{group}/{name}{end}": item for name in names for end, item in layout.items()})
    return {name: [stored[f"{group}/{name}{end}"] for end in layout] for name in names}


def _result_of_schema_2(content: Content, with_fields: bool) -> Result:
    """The result in a file of schema 2, which has uncertainties, warnings and runs of the solver in its provenance."""
    old = content.one("@provenance", Json(kind=dict[str, Any]))
    items = {
        entry.name: Text() if entry.name == "scheme" else Numbers(missing=True, infinite=True, optional=True)
        for entry in fields(Numerics)
    }
    stored = content.take({f"numerics@{name}": item for name, item in items.items()})
    numerics = {name: stored[f"numerics@{name}"] for name in items if stored[f"numerics@{name}"] is not None}
    try:
        residuals, imbalances = old.pop("equations", {}), old.pop("imbalance", {})
        runs = [{"name": " x ".join(map(str, grid.pop("nodes"))), **grid} for grid in old.pop("grids", [])]
        for name, tries in {"": old.pop("tries", []), **old.pop("runs", {})}.items():
            last = {"residual": residuals.get(name), "imbalance": imbalances.get(name)}
            runs += [{"name": name, **one, **(last if one is tries[-1] else {})} for one in tries]
        numerics |= {"processes": old.pop("processes", 1), "runs": runs}
        entries = {
            "@numerics": from_json(json.dumps(numerics), Numerics),
            "@warnings": from_json(json.dumps(old.pop("warnings", [])), tuple[str, ...]),
            "@outside": (),
            "@expected_error": {},
            "@provenance": old,
        }
        uncertainty = from_json(json.dumps(old.pop("uncertainty", {})), dict[str, float])
    except (LookupError, TypeError, ValueError, AttributeError) as error:
        raise content.fault("@provenance", "lacks entries of the solver") from error
    result = _result(content, entries, with_fields)
    return replace(result, quantities=with_uncertainties(result.quantities, uncertainty))


def as_entries(result: Result) -> dict[str, Any]:
    """The result without its fields, as the option ``--json`` prints it."""
    return {
        "model": result.model,
        "quantities": {name: asdict(quantity) for name, quantity in result.quantities.items()},
        "numerics": asdict(result.numerics),
        "warnings": list(result.warnings),
        "outside": list(result.outside),
        "expected_error": dict(result.expected_error),
        "provenance": dict(result.provenance),
    }
