"""HDF5 files of leakage over the load and of sealing loads, with a digest of their inputs."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from pathlib import Path

import h5py
import numpy as np

from roughfilm.contact.foundation.checked_hdf5 import has_mark, open_checked, open_if_of, write_checked, write_inputs
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.inputs import Inputs
from roughfilm.contact.foundation.reading.hdf5_content import Content, Numbers, Text
from roughfilm.rom.seal.leakage.percolation import Side, Threshold

SCHEMA = 2
MARK = b"roughfilm leakage, HDF5 behind 512 bytes, sha256 "
KIND = "series of leakage"
REMEDY = "remove it or choose another place"

SOUGHT = ("direct_x", "direct_y", "homogenized_x", "homogenized_y")
"""Names of the flows: direct between the ends of the gap, and homogenized, each in x and in y."""


@dataclass(frozen=True, kw_only=True)
class Row:
    """The contact and flow at one load.

    Attributes
    ----------
    load : mean pressure, Pa.
    area_fraction, plastic_fraction : real and plastic area over the nominal area.
    mean_gap : mean gap, m.
    pressure_max : largest pressure, Pa.
    valley_depth : Svm of the surface under load, m; NaN if it is flat.
    direct_x, direct_y, homogenized_x, homogenized_y : permeability, m³; exactly 0 if sealed.
    direct_x_uncertainty ... : uncertainty of the permeability, m³.
    direct_x_sealed ... : 1 if there is no open path through the gap, else 0.
    cpu_s : CPU time of the flow, s.
    """

    load: float
    area_fraction: float
    plastic_fraction: float
    mean_gap: float
    pressure_max: float
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

LAYOUT = {f"series/{name}": Numbers(shape=("rows",), missing=name != "load") for name in NUMBERS}
"""What a file holds for its rows."""

UNITS = {"load": "Pa", "mean_gap": "m", "pressure_max": "Pa", "valley_depth": "m", "cpu_s": "s"} | {
    name + more: "m^3" for name in SOUGHT for more in ("", "_uncertainty")
}
"""Units of the numbers of a row; all others are dimensionless."""


@dataclass(frozen=True, kw_only=True)
class LeakageSeries:
    """The rows of a file by load, Pa, and the thresholds by the names in ``SOUGHT``; empty if not yet computed."""

    rows: Mapping[float, Row]
    thresholds: Mapping[str, Threshold]


def save_series(path: Path, inputs: Inputs, series: LeakageSeries, surface: str = "") -> None:
    """Write a series to an HDF5 file, with the name of its surface if it is given.

    The group ``series`` has a column for each number, by increasing load; ``thresholds`` has the brackets.

    Raises
    ------
    InputError
        If ``path`` cannot be written.
    """
    rows = [series.rows[load] for load in sorted(series.rows)]

    def fill(file: h5py.File) -> None:
        write_inputs(file, inputs, SCHEMA)
        if surface:
            file.attrs["surface"] = surface
        for name in NUMBERS:
            column = np.array([getattr(row, name) for row in rows], dtype=float)
            file.create_dataset(f"series/{name}", data=column).attrs["unit"] = UNITS.get(name, "1")
        for name, threshold in series.thresholds.items():
            group = file.create_group(f"thresholds/{name}")
            for end, side in (("open", threshold.open), ("sealed", threshold.sealed)):
                group.attrs[f"{end}_load"] = math.nan if side is None else side.load
                group.attrs[f"{end}_area_fraction"] = math.nan if side is None else side.area_fraction

    write_checked(path, MARK, fill)


def stored_series(path: Path, inputs: Inputs) -> LeakageSeries:
    """The series in a file for these inputs; it is empty if the file does not exist or is empty.

    Raises
    ------
    InputError
        If the file cannot be read, was changed, has a series of other inputs, or is not a series.
    """
    with open_if_of(inputs, path, MARK, SCHEMA, kind=KIND, remedy=REMEDY) as content:
        return LeakageSeries(rows={}, thresholds={}) if content is None else _series(content)


def load_series(path: Path) -> LeakageSeries:
    """The series in a file, whatever its inputs; InputError if the file cannot be read or is not a series."""
    if not has_mark(path, MARK):
        raise InputError(f"{path}: is no {KIND}; name a leakage.h5 of roughfilm leakage")
    with open_checked(path, MARK, SCHEMA, REMEDY) as content:
        return _series(content)


def kept_rows(path: Path) -> tuple[Sequence[Row], str]:
    """The rows in a file and the name of its surface; errors are those of :func:`load_series`."""
    with open_checked(path, MARK, SCHEMA, REMEDY) as content:
        return [*_series(content).rows.values()], content.one("@surface", Text(optional=True)) or ""


def _series(content: Content) -> LeakageSeries:
    columns = [column.tolist() for column in content.take(LAYOUT).values()]
    rows = [Row(**dict(zip(NUMBERS, numbers, strict=True))) for numbers in zip(*columns, strict=True)]
    return LeakageSeries(
        rows={row.load: row for row in rows},
        thresholds={
            name: Threshold(open=_side(content, name, "open"), sealed=_side(content, name, "sealed"))
            for name in SOUGHT
            if content.holds(f"thresholds/{name}")
        },
    )


def _side(content: Content, name: str, end: str) -> Side | None:
    """One side of the bracket of a threshold; None if it is not known."""
    load, area = content.take(
        {f"thresholds/{name}@{end}_{number}": Numbers(missing=True) for number in ("load", "area_fraction")}
    ).values()
    return None if math.isnan(load) else Side(load=load, area_fraction=area)
