"""The table of a scene that describes contact between the walls of a bearing."""

from functools import cached_property
from typing import Annotated, Any, Self, overload

import numpy as np
from pydantic import BeforeValidator, Field, PlainSerializer, model_validator

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.entries import Part, plain_number
from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.lubricants.thermal.law import Temperature, celsius, check_rising
from roughfilm.rom.lubricants.thermal.tabulated import MIN_ROWS
from roughfilm.rom.parts.columns_file import MAX_ROWS
from roughfilm.rom.parts.solids import Counter, HeatConductor, RoughBody

FLASH = ("flash_temperature", "flash_temperature_low", "flash_temperature_high")
"""Names of the estimates of the flash temperature, which have no uncertainty but a range."""

DEFAULT_FRICTION = 0.1
"""Coefficient of boundary friction where none is given."""


def _friction_coefficient(value: object) -> float:
    number = plain_number(value)
    if not 0 <= number <= 10:
        raise ValueError(f"got {number!r}; it must be 0 to 10")
    return number


Coefficient = Annotated[float, BeforeValidator(_friction_coefficient)]
FrictionRow = tuple[Temperature, Coefficient]


class BoundaryFriction(Part):
    """The coefficient of boundary friction: one number, or a table over temperature.

    Between the rows of a table monotone cubics (PCHIP) interpolate; beyond them it has no value. Source: Fritsch and
    Carlson 1980, doi:10.1137/0717021.

    Attributes
    ----------
    constant : coefficient at all temperatures.
    table : rows of temperature and coefficient, such as ["40 degC", 0.12].

    Examples
    --------
    >>> friction = BoundaryFriction.model_validate({"table": [["20 degC", 0.12], ["60 degC", 0.1], ["120 degC", 0.06]]})
    >>> round(friction.at(313.15), 4), friction.at(np.array([333.15, 393.15])).round(4).tolist()
    (0.1107, [0.1, 0.06])
    """

    constant: Coefficient | None = None
    table: Annotated[tuple[FrictionRow, ...], Field(min_length=MIN_ROWS, max_length=MAX_ROWS)] | None = None

    @model_validator(mode="after")
    def _one_of_two(self) -> Self:
        if (self.constant is None) == (self.table is None):
            raise ValueError("give a number, such as 0.1, or a table over temperature")
        check_rising(self.table or ())
        return self

    @cached_property
    def _curve(self) -> Any:
        from scipy.interpolate import PchipInterpolator  # slow to import

        return PchipInterpolator(*np.array(self.table).T)

    @overload
    def at(self, temperature: float | None) -> float: ...

    @overload
    def at(self, temperature: Array) -> Array: ...

    def at(self, temperature: float | Array | None) -> float | Array:
        """The coefficient at temperatures, K, of their shape; that of a constant needs no temperature.

        Raises
        ------
        InputError
            If a temperature lies outside of the table, or it has none.
        """
        if self.constant is not None:
            return np.full_like(temperature, self.constant) if isinstance(temperature, np.ndarray) else self.constant
        assert self.table is not None
        if temperature is None:
            raise InputError("lubricant.temperature: missing; a table of asperities.friction needs it")
        first, last = self.table[0][0], self.table[-1][0]
        for end in (float(np.min(temperature)), float(np.max(temperature))):
            if not first <= end <= last:
                raise InputError(
                    f"asperities.friction: got {celsius(end)}; its table is from {celsius(first)} to {celsius(last)}, "
                    "add rows"
                )
        found = self._curve(temperature)
        return np.asarray(found) if isinstance(temperature, np.ndarray) else float(found)


def _number_or_table(entries: Any) -> Any:
    """The table of a friction coefficient; a constant may be given as a number alone."""
    if isinstance(entries, dict | BoundaryFriction):
        return entries
    return {"constant": _friction_coefficient(entries)}


def _brief(friction: BoundaryFriction) -> Any:
    """The entry of a scene: a number for a constant."""
    return friction.model_dump(mode="json", exclude_none=True) if friction.constant is None else friction.constant


class AsperityContact(Part):
    """Contact between the asperities of the rough wall and the smooth wall.

    The friction coefficient may also be a table over temperature, ``{ table = [["20 degC", 0.12], ...] }``
    (:class:`BoundaryFriction`).

    Attributes
    ----------
    friction : coefficient of boundary friction where asperities touch.
    solid : solid of the rough wall, elastic if it has no hardness; left out with a stored table, which has its own.
    counter : solid of the smooth wall; without it that wall is rigid.
    solid_heat : heat conduction of the solid of the rough wall; the model then estimates the flash temperature of the
        spots in contact.
    counter_heat : that of the solid of the smooth wall; by default the same.
    """

    friction: Annotated[BoundaryFriction, BeforeValidator(_number_or_table), PlainSerializer(_brief)] = Field(
        default=BoundaryFriction(constant=DEFAULT_FRICTION), json_schema_extra={"default": DEFAULT_FRICTION}
    )
    solid: RoughBody | None = None
    counter: Counter | None = None
    solid_heat: HeatConductor | None = None
    counter_heat: HeatConductor | None = None

    @model_validator(mode="after")
    def _has_a_rough_wall(self) -> Self:
        if self.counter is not None and self.solid is None:
            raise ValueError("solid: is missing, but there is a counter; give the solid of the rough wall")
        if self.counter_heat is not None and self.solid_heat is None:
            raise ValueError("solid_heat: is missing, but there is counter_heat; give that of the rough wall")
        return self

    @overload
    def friction_at(self, temperature: float | None) -> float: ...

    @overload
    def friction_at(self, temperature: Array) -> Array: ...

    def friction_at(self, temperature: float | Array | None) -> float | Array:
        """The coefficient of boundary friction at temperatures, K, of their shape (:meth:`BoundaryFriction.at`)."""
        return self.friction.at(temperature)
