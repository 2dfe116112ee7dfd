"""Tables of flow factors in HDF5 files with a digest of their inputs."""

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.checked_hdf5 import has_mark, open_checked, write_checked
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.inputs import Inputs
from roughfilm.rom.homogenization.factors import FlowFactors
from roughfilm.rom.homogenization.table.factor_table import FactorTable, Point

SCHEMA = 4
MARK = b"roughfilm factors, HDF5 behind 512 bytes, sha256 "
REMEDY = "remove it or choose another place"
FACTORS = {"mean_gap": "m", "pressure": "m^3", "shear": "m", "couette": "1/m", "shear_couette": "1/m"}
NUMBERS = {
    "separation": "m",
    "contact": "1",
    "unsolved": "1",
    "iterations": "1",
    "residual": "1",
    "cpu_s": "s",
    "load": "Pa",
    "area_fraction": "1",
    "plastic_fraction": "1",
    "separation_uncertainty": "m",
    "missed": "1",
    "friction_missed": "1",
    "separation_missed": "1",
}


def save_table(path: Path, inputs: Inputs, table: FactorTable, making: Mapping[str, Any] | None = None) -> None:
    """Write a table: ``points/`` has one column per number, narrowest gap first; ``uncertainty/`` has their errors.

    Parameters
    ----------
    path : the file.
    inputs : the surface and the settings of the table.
    table : the table.
    making : entries for JSON on how it was made, which :func:`kept_part` returns.

    Raises
    ------
    InputError
        If ``path`` cannot be written.
    """
    points = table.points

    def fill(file: h5py.File) -> None:
        file.attrs["schema"] = SCHEMA
        file.attrs["digest"] = inputs.digest
        file.attrs["settings"] = json.dumps(inputs.settings, sort_keys=True, allow_nan=False)
        file.attrs["spacing"] = inputs.spacing
        file.attrs["peak"] = table.peak
        file.attrs["rms"] = table.rms
        if making is not None:
            file.attrs["making"] = json.dumps(making, allow_nan=False)
        for name, unit in NUMBERS.items():
            _write(file, f"points/{name}", np.array([getattr(point, name) for point in points]), unit)
        for group in ("factors", "uncertainty"):
            for name, unit in FACTORS.items():
                values = np.array([getattr(getattr(point, group), name) for point in points])
                _write(file, f"{'points' if group == 'factors' else group}/{name}", values, unit)
        _write(file, "points/slopes", np.array([point.slopes for point in points]), "1")
        _write(file, "points/sealed", np.array([point.factors.sealed for point in points]), "1")

    write_checked(path, MARK, fill)


@dataclass(frozen=True, kw_only=True)
class TableSource:
    """The inputs of a table without its heights: ``spacing`` (dx, dy), m, and settings."""

    spacing: tuple[float, float]
    settings: Mapping[str, Any]


def load_table(path: Path) -> FactorTable:
    """The table in a file.

    Raises
    ------
    InputError
        If the file cannot be read, was changed, has another version, or is not a table.
    """
    return load_table_and_source(path)[0]


def load_table_and_source(path: Path) -> tuple[FactorTable, TableSource]:
    """The table in a file and its inputs; errors are those of :func:`load_table`."""
    try:
        _refuse_others(path)
        with open_checked(path, MARK, SCHEMA, REMEDY) as file:
            dx, dy = map(float, file.attrs["spacing"])
            return _table(file), TableSource(spacing=(dx, dy), settings=json.loads(file.attrs["settings"]))
    except OSError as error:
        raise InputError(f"{path}: cannot be read ({error.strerror or error}); name a table of flow factors") from error


def known_points(path: Path, inputs: Inputs) -> Sequence[Point]:
    """The points in a file for these inputs; none if the file does not exist or is empty.

    Raises
    ------
    InputError
        If the file cannot be read, was changed, has a table of other inputs, or is not a table.
    """
    try:
        if path.stat().st_size == 0:
            return ()
        _refuse_others(path)
        with open_checked(path, MARK, SCHEMA, REMEDY) as file:
            if file.attrs["digest"] != inputs.digest:
                raise InputError(f"{path}: holds another table, {inputs.difference(file.attrs['settings'])}; {REMEDY}")
            return _table(file).points
    except FileNotFoundError:
        return ()
    except OSError as error:
        raise InputError(f"{path}: cannot be read ({error.strerror or error}); choose another place") from error


def kept_part(path: Path) -> tuple[FactorTable, Mapping[str, Any]]:
    """The points of a file so far, and the entries on how they were made; errors are those of :func:`load_table`."""
    try:
        _refuse_others(path)
        with open_checked(path, MARK, SCHEMA, REMEDY) as file:
            return _table(file), json.loads(file.attrs["making"])
    except (OSError, LookupError) as error:
        raise InputError(f"{path}: cannot be read ({error}); {REMEDY}") from error


def _refuse_others(path: Path) -> None:
    if not has_mark(path, MARK):
        raise InputError(f"{path}: is no table of flow factors; {REMEDY}")


def _write(file: h5py.File, name: str, values: Array, unit: str) -> None:
    file.create_dataset(name, data=values).attrs["unit"] = unit


def _table(file: h5py.File) -> FactorTable:
    numbers = {name: file[f"points/{name}"][()] for name in NUMBERS}
    sealed, slopes = file["points/sealed"][()], file["points/slopes"][()]
    own, uncertainty = ({name: file[f"{group}/{name}"][()] for name in FACTORS} for group in ("points", "uncertainty"))
    points = [
        Point(
            factors=_factors(own, row, sealed[row]),
            uncertainty=_factors(uncertainty, row, sealed[row]),
            iterations=int(numbers["iterations"][row]),
            slopes=slopes[row],
            **{name: float(numbers[name][row]) for name in NUMBERS if name != "iterations"},
        )
        for row in range(sealed.shape[0])
    ]
    return FactorTable(points=points, peak=float(file.attrs["peak"]), rms=float(file.attrs["rms"]))


def _factors(columns: Mapping[str, Array], row: int, sealed: Array) -> FlowFactors:
    return FlowFactors(
        mean_gap=float(columns["mean_gap"][row]),
        pressure=columns["pressure"][row],
        shear=columns["shear"][row],
        couette=float(columns["couette"][row]),
        shear_couette=float(columns["shear_couette"][row]),
        sealed=(bool(sealed[0]), bool(sealed[1])),
    )
