"""What a seal lets through over a series of loads, and where it seals: kept in HDF5, keyed by what it comes from."""

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from pathlib import Path

import h5py
import numpy as np

from roughfilm.contact.foundation.checked_hdf5 import has_mark, open_checked, write_checked
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.inputs import Inputs
from roughfilm.rom.seal.leakage.percolation import Side, Threshold

SCHEMA = 1
MARK = b"roughfilm leakage, HDF5 behind 512 bytes, sha256 "
REMEDY = "remove it or choose another place"

SOUGHT = ("direct_x", "direct_y", "homogenized_x", "homogenized_y")
"""What seals at a threshold: between ends, and on and on, in either direction."""


@dataclass(frozen=True, kw_only=True)
class Row:
    """One load.

    Attributes
    ----------
    load : mean pressure, Pa.
    area_fraction, plastic_fraction : real and plastic over nominal area.
    mean_gap : m.
    valley_depth : m: Svm of the surface under load; NaN of one that is flat there.
    direct_x, direct_y, homogenized_x, homogenized_y : permeability, m³; exactly 0 where sealed.
    direct_x_uncertainty ... : m³.
    direct_x_sealed ... : 1 where no open path leads through, else 0.
    cpu_s : s, of the flow; contacts know their own.
    """

    load: float
    area_fraction: float
    plastic_fraction: float
    mean_gap: float
    valley_depth: float
    direct_x: float
    direct_y: float
    homogenized_x: float
    homogenized_y: float
    direct_x_uncertainty: float
    direct_y_uncertainty: float
    homogenized_x_uncertainty: float
    homogenized_y_uncertainty: float
    direct_x_sealed: float
    direct_y_sealed: float
    homogenized_x_sealed: float
    homogenized_y_sealed: float
    cpu_s: float


NUMBERS = tuple(entry.name for entry in fields(Row))

UNITS = {"load": "Pa", "mean_gap": "m", "valley_depth": "m", "cpu_s": "s"} | {
    name + more: "m^3" for name in SOUGHT for more in ("", "_uncertainty")
}
"""Of the numbers of a row; all others are pure numbers."""


@dataclass(frozen=True, kw_only=True)
class Kept:
    """What a file holds: rows by load, and the thresholds by what is ``SOUGHT``, none before they were found."""

    rows: Mapping[float, Row]
    thresholds: Mapping[str, Threshold]


def save_series(path: Path, inputs: Inputs, kept: Kept) -> None:
    """Write a series whole: ``series/`` has a column for each number, loads rising; ``thresholds/`` the brackets.

    Raises
    ------
    InputError
        If ``path`` cannot be written.
    """
    rows = [kept.rows[load] for load in sorted(kept.rows)]

    def fill(file: h5py.File) -> None:
        file.attrs["schema"] = SCHEMA
        file.attrs["digest"] = inputs.digest
        file.attrs["settings"] = json.dumps(inputs.settings, sort_keys=True, allow_nan=False)
        for name in NUMBERS:
            column = np.array([getattr(row, name) for row in rows], dtype=float)
            file.create_dataset(f"series/{name}", data=column).attrs["unit"] = UNITS.get(name, "1")
        for name, threshold in kept.thresholds.items():
            group = file.create_group(f"thresholds/{name}")
            for end, side in (("open", threshold.open), ("sealed", threshold.sealed)):
                group.attrs[f"{end}_load"] = math.nan if side is None else side.load
                group.attrs[f"{end}_area_fraction"] = math.nan if side is None else side.area_fraction

    write_checked(path, MARK, fill)


def kept_series(path: Path, inputs: Inputs) -> Kept:
    """What a file holds for these inputs; nothing if there is no such file, or an empty one.

    Raises
    ------
    InputError
        If the file cannot be read, was damaged or changed, or holds a series of other inputs or something else.
    """
    try:
        if path.stat().st_size == 0:
            return Kept(rows={}, thresholds={})
        if not has_mark(path, MARK):
            raise InputError(f"{path}: is no series of leakage; {REMEDY}")
        with open_checked(path, MARK, SCHEMA, REMEDY) as file:
            if file.attrs["digest"] != inputs.digest:
                raise InputError(f"{path}: holds another series, {inputs.difference(file.attrs['settings'])}; {REMEDY}")
            return Kept(rows={row.load: row for row in _rows(file)}, thresholds=_thresholds(file))
    except FileNotFoundError:
        return Kept(rows={}, thresholds={})
    except OSError as error:
        raise InputError(f"{path}: cannot be read ({error.strerror or error}); choose another place") from error


def load_series(path: Path) -> Kept:
    """A series of whatever inputs; InputError as :func:`kept_series` raises it, and if there is none."""
    try:
        if not has_mark(path, MARK):
            raise InputError(f"{path}: is no series of leakage; name a leakage.h5 of roughfilm leakage")
        with open_checked(path, MARK, SCHEMA, REMEDY) as file:
            return Kept(rows={row.load: row for row in _rows(file)}, thresholds=_thresholds(file))
    except OSError as error:
        raise InputError(f"{path}: cannot be read ({error.strerror or error}); name a leakage.h5") from error


def _rows(file: h5py.File) -> Sequence[Row]:
    columns = [file[f"series/{name}"][()].tolist() for name in NUMBERS]
    return [Row(**dict(zip(NUMBERS, numbers, strict=True))) for numbers in zip(*columns, strict=True)]


def _thresholds(file: h5py.File) -> dict[str, Threshold]:
    def side(group: h5py.Group, end: str) -> Side | None:
        load = float(group.attrs[f"{end}_load"])
        area = float(group.attrs[f"{end}_area_fraction"])
        return None if math.isnan(load) else Side(load=load, area_fraction=area)

    groups = {name: file[f"thresholds/{name}"] for name in SOUGHT if f"thresholds/{name}" in file}
    return {name: Threshold(open=side(group, "open"), sealed=side(group, "sealed")) for name, group in groups.items()}
