"""Measured compressibility: a table with monotone interpolation, or a law fitted to it."""

from functools import cached_property
from itertools import pairwise
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import BeforeValidator, PlainSerializer, model_validator

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.entries import NamesFile
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.units import with_unit
from roughfilm.rom.lubricants.compressibility import DowsonHigginson
from roughfilm.rom.lubricants.law import LubricantLaw
from roughfilm.rom.parts.columns_file import MAX_ROWS, number_pairs, read_rows

MIN_ROWS = 3
"""Smallest number of rows of a table."""

COLUMNS = {"pressure": "Pa", "density": "kg/m^3"}
HEADER = "pressure (MPa), density (kg/m^3)"

Table = tuple[tuple[float, float], ...]
"""Rows (pressure above cavitation pressure, Pa; density, kg/m³ or relative)."""


def checked(table: object) -> Table:
    """The rows of a table from rows of two numbers in SI units, or from the file of that name.

    Raises
    ------
    ValueError
        If a row is invalid, a column does not increase, or the file cannot be read.
    """
    if isinstance(table, str):
        try:
            return checked(read_rows(table, COLUMNS, header=HEADER))
        except ValueError as error:
            raise ValueError(f"file {table!r:.200}: {error}") from error
    if not isinstance(table, list | tuple) or not MIN_ROWS <= len(table) <= MAX_ROWS:
        got = f"{len(table)} rows" if isinstance(table, list | tuple) else f"{table!r:.60}"
        raise ValueError(
            f"got {got}; name a file, or give {MIN_ROWS} to {MAX_ROWS} rows [pressure, density] in Pa, kg/m^3"
        )
    rows = number_pairs(table, COLUMNS, name="row")
    if rows[0][0] != 0 or rows[0][1] <= 0:
        raise ValueError(f"got {rows[0]!r} as row 1; it must be the density at pressure 0 (cavitation pressure)")
    for number, (before, after) in enumerate(pairwise(rows), 2):
        if not (after[0] > before[0] and after[1] > before[1]):
            raise ValueError(f"got {after!r} at row {number} after {before!r}; pressure and density must both increase")
    return rows


class Tabulated(LubricantLaw):
    """θ by monotone cubics (PCHIP) through measured points and linear beyond the last one, or by a fitted law.

    ``table`` names a CSV file (``pressure (MPa), density (kg/m^3)``) of pressures above cavitation pressure. Source:
    Fritsch and Carlson 1980, doi:10.1137/0717021.

    Attributes
    ----------
    table : rows [pressure in Pa, density], or the name of a CSV file.
    fit : the law that is fitted to the points.
    """

    law: Literal["tabulated"]
    table: Annotated[
        Table, BeforeValidator(checked), PlainSerializer(lambda table: [list(row) for row in table]), NamesFile()
    ]
    fit: Literal["dowson_higginson"] | None = None

    @model_validator(mode="after")
    def _can_be_fitted(self) -> "Tabulated":
        if self.fit is not None:
            try:
                _ = self.fitted
            except InputError as error:
                raise ValueError(f"fit: {error}") from None
        return self

    @property
    def valid_to(self) -> float:
        """The last pressure of the table, Pa."""
        return self.table[-1][0]

    @cached_property
    def fitted(self) -> DowsonHigginson:
        """The law fitted to the points; InputError if none fits."""
        return fitted(self.table)

    @cached_property
    def _curve(self) -> Any:
        from scipy.interpolate import PchipInterpolator  # slow to import

        pressure, density = np.array(self.table).T
        return PchipInterpolator(pressure, density / density[0] - 1)

    def compression(self, pressure: Array) -> tuple[Array, Array]:
        """The compression ϑ = θ - 1 and dθ/dp, 1/Pa, at p >= 0; shape of ``pressure``."""
        if self.fit is not None:
            return self.fitted.compression(pressure)
        inside = np.minimum(pressure, self.valid_to)
        slope = self._curve(inside, 1)
        return self._curve(inside) + slope * (pressure - inside), slope

    def pressure_at(self, theta: float) -> float:
        """The pressure, Pa, of a density θ >= 1; InputError above the last density of the table."""
        if self.fit is not None:
            return self.fitted.pressure_at(theta)
        from scipy.optimize import brentq  # slow to import

        densest = self.table[-1][1] / self.table[0][1]
        if theta > densest:
            raise InputError(f"theta: got {theta!r}; the table ends at {densest:.6g}")
        return float(brentq(lambda pressure: float(self._curve(pressure)) - (theta - 1), 0.0, self.valid_to))


def fitted(table: Table) -> DowsonHigginson:
    """Dowson and Higginson's law fitted by least squares in θ; InputError if the points have another shape."""
    from scipy.optimize import least_squares  # slow to import

    pressure, density = np.array(table).T
    excess = density / density[0] - 1
    scale = pressure[-1]

    def misfit(numbers: Array) -> Array:
        c1, rise = np.exp(numbers)
        return np.asarray((rise * pressure / scale / (c1 + pressure / scale) - excess) / excess[-1])

    optimum = least_squares(misfit, np.log([1.0, 2 * excess[-1]]), xtol=1e-14, ftol=1e-14, gtol=1e-14)
    c1, rise = np.exp(optimum.x)
    if not (optimum.success and 1e-4 < c1 < 1e6):
        raise InputError("Dowson and Higginson's law does not fit the curvature of the points; leave fit out")
    numbers = {"law": "dowson_higginson", "c1": with_unit(float(scale * c1), "Pa"), "c2": 1 + float(rise)}
    return DowsonHigginson.model_validate(numbers)
