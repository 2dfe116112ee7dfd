"""Measured properties over temperature: a viscosity and a heat capacity as tables."""

from collections.abc import Callable, Mapping
from functools import cached_property
from typing import Annotated, Any, Literal, Self

import numpy as np
from pydantic import BeforeValidator, Field, PlainSerializer, model_validator

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.entries import InUnit, NamesFile, Part
from roughfilm.contact.foundation.units import SiNumber, in_si, to_si, with_unit
from roughfilm.rom.lubricants.thermal.law import AbsoluteLaw, Temperature, check_rising
from roughfilm.rom.lubricants.thermal.viscosity import Point, check_points
from roughfilm.rom.parts.columns_file import MAX_ROWS, read_rows

MIN_ROWS = 2
"""Smallest number of rows of a table."""


def rows_of_file(columns: Mapping[str, str], header: str) -> Callable[[Any], Any]:
    """A reader of the rows of a table, which may be given by the name of a file.

    Parameters
    ----------
    columns : names of both columns and their SI units.
    header : example of a header of the file, for messages.

    Returns
    -------
    a function of the entry; it raises ValueError if the file cannot be read.
    """

    def rows(entries: Any) -> Any:
        if not isinstance(entries, str):
            return entries
        try:
            return in_si(read_rows(entries, columns, header=header))
        except ValueError as error:
            raise ValueError(f"file {entries!r:.200}: {error}") from error

    return rows


class TabulatedViscosity(AbsoluteLaw):
    """ln η by monotone cubics (PCHIP) of T through measured points, straight beyond them, out of range.

    ``table`` names a CSV file (``temperature (degC), viscosity (mPa*s)``). Source: Fritsch and Carlson 1980,
    doi:10.1137/0717021.

    Attributes
    ----------
    table : rows of temperature and viscosity, such as ["40 degC", "28 mPa*s"], or the name of a CSV file.
    valid_from, valid_to : temperatures between which the law is valid, K; by default those of the table.

    Examples
    --------
    >>> rows = [["20 degC", "70 mPa*s"], ["40 degC", "28 mPa*s"], ["100 degC", "4.6 mPa*s"]]
    >>> law = TabulatedViscosity.model_validate({"law": "tabulated", "table": rows})
    >>> print(*(f"{one:.6f}" for one in law.viscosity(np.array([313.15, 333.15]))[0]))
    0.028000 0.013611
    """

    law: Literal["tabulated"]
    table: Annotated[
        tuple[Point, ...],
        Field(min_length=MIN_ROWS, max_length=MAX_ROWS),
        BeforeValidator(
            rows_of_file({"temperature": "K", "viscosity": "Pa*s"}, "temperature (degC), viscosity (mPa*s)")
        ),
        NamesFile(),
    ]
    valid_from: Temperature | None = None
    valid_to: Temperature | None = None

    @model_validator(mode="after")
    def _falls(self) -> Self:
        check_points("table", self.table, "Pa s")
        return self

    def valid(self) -> tuple[float, float]:
        """The lowest and the highest valid temperature, K: the given ones, or the first and the last of the table."""
        return self.narrowed(self.table[0][0], self.table[-1][0])

    @cached_property
    def _curves(self) -> tuple[Any, Any]:
        """The logarithm of the viscosity over temperature, and its slope."""
        from scipy.interpolate import PchipInterpolator  # slow to import

        temperature, viscosity = np.array(self.table).T
        curve = PchipInterpolator(temperature, np.log(viscosity))
        return curve, curve.derivative()

    def viscosity(self, temperature: Array) -> tuple[Array, Array]:
        """The viscosity η, Pa s, and dη/dT; shape of ``temperature``, K."""
        curve, slope = self._curves
        inside = np.clip(temperature, self.table[0][0], self.table[-1][0])
        rate = slope(inside)
        viscosity = np.exp(curve(inside) + rate * (temperature - inside))
        return viscosity, viscosity * rate


SpecificHeat = Annotated[float, InUnit("J/(kg*K)")]
HeatRow = tuple[Temperature, SpecificHeat]


class HeatCapacity(Part):
    """The specific heat capacity c of a lubricant: one number, or a table over temperature.

    Between the rows of a table monotone cubics (PCHIP) interpolate; beyond them c is that of the nearest row.

    Attributes
    ----------
    constant : heat capacity at all temperatures, J/(kg K).
    table : rows of temperature and heat capacity, or the name of a CSV file.
    """

    constant: SpecificHeat | None = None
    table: (
        Annotated[
            tuple[HeatRow, ...],
            Field(min_length=MIN_ROWS, max_length=MAX_ROWS),
            BeforeValidator(
                rows_of_file(
                    {"temperature": "K", "heat_capacity": "J/(kg*K)"}, "temperature (degC), heat_capacity (J/kg/K)"
                )
            ),
            NamesFile(),
        ]
        | None
    ) = None

    @model_validator(mode="after")
    def _one_of_two(self) -> Self:
        if (self.constant is None) == (self.table is None):
            got = "neither" if self.constant is None else "both"
            raise ValueError(
                f'got {got} of constant and table; give a number, such as "2000 J/(kg*K)", or a table over temperature'
            )
        check_rising(self.table or ())
        return self

    @cached_property
    def _curves(self) -> tuple[Any, Any]:
        """The heat capacity over temperature, and its integral from the first temperature."""
        from scipy.interpolate import PchipInterpolator  # slow to import

        temperature, capacity = np.array(self.table).T
        curve = PchipInterpolator(temperature, capacity)
        return curve, curve.antiderivative()

    def _enthalpy(self, temperature: Array) -> Array:
        assert self.table is not None
        curve, integral = self._curves
        inside = np.clip(temperature, self.table[0][0], self.table[-1][0])
        return np.asarray(integral(inside) + curve(inside) * (temperature - inside))

    def heat(self, temperature: Array, start: float) -> tuple[Array, Array]:
        """The integral of c from ``start``, J/kg, and c, J/(kg K); shape of ``temperature``, K.

        Examples
        --------
        >>> rows = [["0 degC", "1800 J/(kg*K)"], ["100 degC", "2200 J/(kg*K)"]]
        >>> capacity = HeatCapacity.model_validate({"table": rows})
        >>> heat, value = capacity.heat(np.array([313.15, 333.15]), 313.15)
        >>> print(f"{heat[1]:.1f} J/kg, {value[0]:.1f} J/(kg K)")
        40000.0 J/kg, 1960.0 J/(kg K)
        """
        if self.constant is not None:
            return self.constant * (temperature - start), np.full_like(temperature, self.constant)
        assert self.table is not None
        value = self._curves[0](np.clip(temperature, self.table[0][0], self.table[-1][0]))
        return self._enthalpy(temperature) - self._enthalpy(np.array(start)), np.asarray(value)


def _constant(entries: Any) -> Any:
    """The table of a heat capacity; a constant may be given as a text alone."""
    if isinstance(entries, dict | HeatCapacity):
        return entries
    return {"constant": SiNumber(to_si(entries, "J/(kg*K)"))}


def _brief(capacity: HeatCapacity) -> Any:
    """The entry of a scene: a text for a constant."""
    if capacity.constant is not None:
        return with_unit(capacity.constant, "J/(kg*K)")
    return capacity.model_dump(mode="json", exclude_none=True)


AnyHeatCapacity = Annotated[HeatCapacity, BeforeValidator(_constant), PlainSerializer(_brief)]
