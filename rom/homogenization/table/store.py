"""Tables of flow factors in HDF5 files with a digest of their inputs."""

import json
import math
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from pathlib import Path

import h5py
import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.checked_hdf5 import has_mark, open_checked, open_if_of, write_checked, write_inputs
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.inputs import Inputs
from roughfilm.contact.foundation.reading.hdf5_content import Content, Json, Numbers
from roughfilm.rom.homogenization.factors import FactorScatter, FlowFactors
from roughfilm.rom.homogenization.table.factor_table import FactorTable, Point

SCHEMA = 4
MARK = b"roughfilm factors, HDF5 behind 512 bytes, sha256 "
KIND = "table of flow factors"
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
    "peak_pressure": "Pa",
    "separation_uncertainty": "m",
    "missed": "1",
    "friction_missed": "1",
    "separation_missed": "1",
}

SCATTER = {"scatter": "mean", "window_low": "low", "window_high": "high"}
"""Groups of the scatter of a table over windows, with the attributes of :class:`FactorScatter`."""

ROWS = ("rows",)
SHAPES = {"pressure": ("rows", 2, 2), "shear": ("rows", 2)}
LAYOUT = {
    **{f"points/{name}": Numbers(shape=ROWS) for name in NUMBERS},
    **{f"points/{name}": Numbers(shape=SHAPES.get(name, ROWS)) for name in FACTORS},
    **{f"uncertainty/{name}": Numbers(shape=SHAPES.get(name, ROWS), missing=True, infinite=True) for name in FACTORS},
    **{
        f"{group}/{name}": Numbers(shape=SHAPES.get(name, ROWS), missing=True, infinite=True, optional=True)
        for group in SCATTER
        for name in FACTORS
    },
    "points/iterations": Numbers(shape=ROWS, kind=int),
    "points/peak_pressure": Numbers(shape=ROWS, missing=True, optional=True),
    "points/slopes": Numbers(shape=("rows", 7), missing=True),
    "points/sealed": Numbers(shape=("rows", 2), kind=bool),
    "@peak": Numbers(),
    "@rms": Numbers(),
}
"""What the file of a table holds, beside its inputs."""


@dataclass(frozen=True, kw_only=True)
class Solids:
    """The settings of a table of a surface in contact: E* and H, Pa; None where there is no contact or plasticity."""

    composite_modulus: float | None = None
    hardness: float | None = None


@dataclass(frozen=True, kw_only=True)
class Making:
    """How a table was made.

    Attributes
    ----------
    surface, kind : name of the surface and kind of the table for people.
    complete : whether the table has all its points.
    cpu_s : CPU time so far, s.
    """

    surface: str = ""
    kind: str = ""
    complete: bool
    cpu_s: float


def save_table(path: Path, inputs: Inputs, table: FactorTable, making: Making | None = None) -> None:
    """Write a table: ``points/`` has one column per number, narrowest gap first; ``uncertainty/`` has their errors.

    A table of means over windows has their ``scatter/`` too, and the ends of the interval for one window in
    ``window_low/`` and ``window_high/``.

    Parameters
    ----------
    path : the file.
    inputs : the surface and the settings of the table.
    table : the table.
    making : how it was made, which :func:`kept_part` returns.

    Raises
    ------
    InputError
        If ``path`` cannot be written.
    """
    points = table.points

    def fill(file: h5py.File) -> None:
        write_inputs(file, inputs, SCHEMA)
        file.attrs["spacing"] = inputs.spacing
        file.attrs["peak"] = table.peak
        file.attrs["rms"] = table.rms
        if making is not None:
            file.attrs["making"] = json.dumps(asdict(making), allow_nan=False)
        for name, unit in NUMBERS.items():
            _write(file, f"points/{name}", np.array([getattr(point, name) for point in points]), unit)
        for group in ("factors", "uncertainty"):
            for name, unit in FACTORS.items():
                values = np.array([getattr(getattr(point, group), name) for point in points])
                _write(file, f"{'points' if group == 'factors' else group}/{name}", values, unit)
        scatters = [point.scatter for point in points if point.scatter is not None]
        if len(scatters) == len(points):
            for group, part in SCATTER.items():
                for name, unit in FACTORS.items():
                    values = np.array([getattr(getattr(one, part), name) for one in scatters])
                    _write(file, f"{group}/{name}", values, unit)
        _write(file, "points/slopes", np.array([point.slopes for point in points]), "1")
        _write(file, "points/sealed", np.array([point.factors.sealed for point in points]), "1")

    write_checked(path, MARK, fill)


@dataclass(frozen=True, kw_only=True)
class TableSource:
    """The inputs of a table without its heights: ``spacing`` (dx, dy), m, and ``solids``."""

    spacing: tuple[float, float]
    solids: Solids


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
    with _opened(path) as content:
        stored = content.take({"@spacing": Numbers(shape=(2,)), "@settings": Json(kind=Solids)})
        dx, dy = stored["@spacing"].tolist()
        return _table(content), TableSource(spacing=(dx, dy), solids=stored["@settings"])


def known_points(path: Path, inputs: Inputs) -> Sequence[Point]:
    """The points in a file for these inputs; none if the file does not exist or is empty.

    Raises
    ------
    InputError
        If the file cannot be read, was changed, has a table of other inputs, or is not a table.
    """
    with open_if_of(inputs, path, MARK, SCHEMA, kind=KIND, remedy=REMEDY) as content:
        return () if content is None else _table(content).points


def kept_part(path: Path) -> tuple[FactorTable, Making]:
    """The points of a file so far, and how they were made; errors are those of :func:`load_table`."""
    with _opened(path) as content:
        return _table(content), content.one("@making", Json(kind=Making))


@contextmanager
def _opened(path: Path) -> Iterator[Content]:
    if not has_mark(path, MARK):
        raise InputError(f"{path}: is no {KIND}; {REMEDY}")
    with open_checked(path, MARK, SCHEMA, REMEDY) as content:
        yield content


def _write(file: h5py.File, name: str, values: Array, unit: str) -> None:
    file.create_dataset(name, data=values).attrs["unit"] = unit


def _table(content: Content) -> FactorTable:
    """The table of a file; its gaps increase and are above 0."""
    stored = content.take(LAYOUT)
    gaps = stored["points/mean_gap"]
    if gaps.size < 2 or not (np.diff(gaps, prepend=0.0) > 0).all():
        raise content.fault("points/mean_gap", "has no two gaps in increasing order")
    if stored["points/peak_pressure"] is None:
        stored["points/peak_pressure"] = np.full(gaps.size, np.nan)
    columns = {
        group: {name: stored[f"{group}/{name}"] for name in (*FACTORS, *more)}
        for group, more in (("points", NUMBERS), ("uncertainty", ()))
    }
    scattered = all(stored[f"{group}/{name}"] is not None for group in SCATTER for name in FACTORS)
    scatters = {group: {name: stored[f"{group}/{name}"] for name in FACTORS} for group in SCATTER} if scattered else {}
    points = [
        Point(
            factors=_factors(columns["points"], row, sealed),
            uncertainty=_factors(columns["uncertainty"], row, sealed),
            slopes=stored["points/slopes"][row],
            scatter=FactorScatter(**{part: _factors(scatters[group], row, sealed) for group, part in SCATTER.items()})
            if scattered
            else None,
            **{name: columns["points"][name][row].item() for name in NUMBERS},
        )
        for row, sealed in enumerate(stored["points/sealed"])
    ]
    modulus = content.one("@settings", Json(kind=Solids)).composite_modulus
    return FactorTable(
        points=points,
        peak=stored["@peak"],
        rms=stored["@rms"],
        composite_modulus=math.inf if modulus is None else modulus,
    )


def _factors(columns: Mapping[str, Array], row: int, sealed: Array) -> FlowFactors:
    return FlowFactors(
        mean_gap=float(columns["mean_gap"][row]),
        pressure=columns["pressure"][row],
        shear=columns["shear"][row],
        couette=float(columns["couette"][row]),
        shear_couette=float(columns["shear_couette"][row]),
        sealed=(bool(sealed[0]), bool(sealed[1])),
    )
