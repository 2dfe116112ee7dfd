"""Laws of the viscosity over temperature with few constants: exponential, Vogel's and Roelands'."""

import math
import re
from collections.abc import Sequence
from functools import cached_property
from itertools import pairwise
from typing import Annotated, Any, Literal, Self

import numpy as np
from pydantic import AfterValidator, BeforeValidator, model_validator

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.entries import InUnit, PositiveNumber
from roughfilm.contact.foundation.units import converted
from roughfilm.rom.lubricants.thermal.law import (
    LIQUID,
    LOG_LIMIT,
    AbsoluteLaw,
    AnchoredLaw,
    Supplied,
    Temperature,
    at_most,
    celsius,
)
from roughfilm.rom.lubricants.viscosity import LOG_VISCOSITY


def _without_zero(difference: Any) -> Any:
    """The entry of a difference of temperatures; ValueError for one in degrees whose zero is not absolute."""
    if isinstance(difference, str) and re.search(r"(deg|°)\s*[CF]", difference):
        raise ValueError(f"got {difference!r:.60}, a temperature in degrees; it is a difference, write it in K")
    return difference


TemperatureCoefficient = Annotated[
    float, InUnit("K^-1", any_sign=True), AfterValidator(at_most(1.0, "0.02 to 0.06 1/K"))
]
Difference = Annotated[float, InUnit("K"), BeforeValidator(_without_zero)]
Viscosity = Annotated[float, InUnit("Pa*s")]


def _dynamic(viscosity: Any) -> Any:
    """The entry of a viscosity; ValueError for a kinematic one, for which no density stands beside it."""
    try:
        converted(viscosity if isinstance(viscosity, str) else "", "m^2/s")
    except ValueError:
        return viscosity
    raise ValueError(f"got {viscosity!r:.60}, a kinematic viscosity; write mPa*s, or take the law walther")


Point = tuple[Temperature, Annotated[Viscosity, BeforeValidator(_dynamic)]]
"""A temperature, K, and the viscosity at it, Pa s."""

EXPONENTIAL_SPAN = 30.0
"""Distance from T_s within which the exponential law is valid, K."""

ROELANDS_TEMPERATURE = 138.0
"""Roelands' constant: the viscosity of all oils is infinite at -135 °C, here in K."""


class ExponentialViscosity(AnchoredLaw):
    """The law η = η_s exp(-β (T - T_s)), within about 30 K of T_s. Source: Reynolds 1886.

    The coefficient β of a mineral oil falls with temperature, of ISO VG 32 from 0.044/K at 40 °C to 0.027/K at 80 °C:
    30 K away from T_s the law gives 20 to 30 % less than ASTM D341.

    Attributes
    ----------
    temperature_coefficient : coefficient β, 1/K, at most 1 in size.
    valid_from, valid_to : temperatures between which the law is valid, K; by default 30 K to both sides of T_s.

    Examples
    --------
    >>> law = ExponentialViscosity.model_validate({"law": "exponential", "temperature_coefficient": "0.04 1/K"})
    >>> viscosity, slope = law.viscosity(np.array([320.0]), Supplied(temperature=310.0, viscosity=0.03))
    >>> print(f"{viscosity[0]:.6f} {slope[0]:.7f}")
    0.020110 -0.0008044
    """

    law: Literal["exponential"]
    temperature_coefficient: TemperatureCoefficient
    valid_from: Temperature | None = None
    valid_to: Temperature | None = None

    def valid(self, supplied: Supplied) -> tuple[float, float]:
        """The lowest and the highest valid temperature, K."""
        return self.narrowed(supplied.temperature - EXPONENTIAL_SPAN, supplied.temperature + EXPONENTIAL_SPAN)

    def viscosity(self, temperature: Array, supplied: Supplied) -> tuple[Array, Array]:
        """The viscosity η, Pa s, and dη/dT; shape of ``temperature``, K."""
        viscosity = supplied.viscosity * np.exp(-self.temperature_coefficient * (temperature - supplied.temperature))
        return viscosity, -self.temperature_coefficient * viscosity


class RoelandsTemperature(AnchoredLaw):
    """The law η = exp((ln η_s + 9.67) ((T_s - 138 K)/(T - 138 K))^S - 9.67), η_s in Pa s. Source: Roelands 1966.

    With ``piezoviscosity`` by Roelands both are his law η(p, T) = exp((ln η_s + 9.67) (1 + p/0.196 GPa)^Z
    ((T_s - 138 K)/(T - 138 K))^S - 9.67).

    Attributes
    ----------
    index : index S, about 1.2 to 1.3 for mineral oils.
    valid_from, valid_to : temperatures between which the law is valid, K; by default -60 to 250 °C.

    Examples
    --------
    >>> law = RoelandsTemperature.model_validate({"law": "roelands", "index": 1.1})
    >>> viscosity, slope = law.viscosity(np.array([340.0]), Supplied(temperature=313.0, viscosity=0.04))
    >>> print(f"{viscosity[0]:.7f} {slope[0]:.8f}")
    0.0155955 -0.00046788
    """

    law: Literal["roelands"]
    index: PositiveNumber
    valid_from: Temperature | None = None
    valid_to: Temperature | None = None

    def valid(self, supplied: Supplied) -> tuple[float, float]:  # noqa: ARG002
        """The lowest and the highest valid temperature, K."""
        return self.narrowed(*LIQUID)

    def viscosity(self, temperature: Array, supplied: Supplied) -> tuple[Array, Array]:
        """The viscosity η, Pa s, and dη/dT; shape of ``temperature``, K; InputError at 138 K and below."""
        depth = math.log(supplied.viscosity) + LOG_VISCOSITY
        span = supplied.temperature - ROELANDS_TEMPERATURE
        nearest = ROELANDS_TEMPERATURE + abs(span) * (abs(depth) / LOG_LIMIT) ** (1 / self.index)
        self.refuse_below(nearest, np.append(temperature, supplied.temperature))
        above = (temperature - ROELANDS_TEMPERATURE) / span
        # As (…)^S - 1, so that the viscosity at T_s is η_s to the last digit.
        excess = np.expm1(-self.index * np.log(above))
        viscosity = supplied.viscosity * np.exp(depth * excess)
        return viscosity, -viscosity * depth * self.index * (1 + excess) / (above * span)


class Vogel(AbsoluteLaw):
    """The law η = a exp(b/(T - c)) by its constants, or through three points. Source: Vogel 1921.

    Attributes
    ----------
    a : constant, a viscosity, Pa s.
    b : constant, a difference of temperatures, K.
    c : constant, the temperature at and below which the law has no viscosity, K.
    points : three rows of temperature and viscosity, in place of the constants.
    valid_from, valid_to : temperatures between which the law is valid, K; by default those of the points, or -60 to
        250 °C above c.

    Examples
    --------
    >>> points = [["40 degC", "28 mPa*s"], ["70 degC", "9.8 mPa*s"], ["100 degC", "4.6 mPa*s"]]
    >>> law = Vogel.model_validate({"law": "vogel", "points": points})
    >>> print(*(f"{one:.6g}" for one in law.constants))
    4.37919e-05 998.907 158.533
    >>> print(f"{law.viscosity(np.array([343.15]))[0][0]:.6f}")
    0.009800
    """

    law: Literal["vogel"]
    a: Viscosity | None = None
    b: Difference | None = None
    c: Temperature | None = None
    points: tuple[Point, Point, Point] | None = None
    valid_from: Temperature | None = None
    valid_to: Temperature | None = None

    @model_validator(mode="after")
    def _has_constants(self) -> Self:
        given = [name for name in "abc" if getattr(self, name) is not None]
        if self.points is None and len(given) < 3:
            raise ValueError(f"got {' and '.join(given) or 'no constant'}; give a, b and c, or three points")
        if self.points is not None and given:
            raise ValueError(f"points: got them and {' and '.join(given)}; give the constants or points")
        if self.points is not None:
            check_points("points", self.points, "Pa s")
            self._can_be_fitted(self.points)
        c = self.constants[2]
        if self.valid_to is not None and self.valid_to <= c:
            raise ValueError(f"valid_to: got {celsius(self.valid_to)}; it must be above c, {celsius(c)}")
        return self

    @staticmethod
    def _can_be_fitted(points: tuple[Point, Point, Point]) -> None:
        (first, above), (second, middle), (third, below) = points
        slopes = math.log(above / middle) / (second - first), math.log(middle / below) / (third - second)
        if not slopes[0] > slopes[1] * (1 + 1e-6):
            raise ValueError(
                f"points: got {slopes[0]:.4g}/K as the fall of ln η from point 1 to 2 and {slopes[1]:.4g}/K from 2 "
                "to 3; it must fall more slowly at the higher temperatures, take exponential or tabulated"
            )

    @cached_property
    def constants(self) -> tuple[float, float, float]:
        """The constants a, Pa s, b and c, K."""
        if self.points is None:
            assert self.a is not None
            assert self.b is not None
            assert self.c is not None
            return self.a, self.b, self.c
        (t1, v1), (t2, v2), (t3, v3) = self.points
        ratio = math.log(v1 / v2) * (t3 - t2) / (math.log(v2 / v3) * (t2 - t1))
        c = t1 - (t3 - t1) / (ratio - 1)
        b = math.log(v1 / v2) * (t1 - c) * (t2 - c) / (t2 - t1)
        return v2 * math.exp(-b / (t2 - c)), b, c

    def valid(self) -> tuple[float, float]:
        """The lowest and the highest valid temperature, K: the given ones, or those of the points."""
        if self.points is not None:
            return self.narrowed(self.points[0][0], self.points[-1][0])
        low, high = LIQUID
        return self.narrowed(max(low, self.constants[2]), high)

    def viscosity(self, temperature: Array) -> tuple[Array, Array]:
        """The viscosity η, Pa s, and dη/dT; shape of ``temperature``, K; InputError near c and below."""
        a, b, c = self.constants
        self.refuse_below(c + b / LOG_LIMIT, temperature)
        above = temperature - c
        viscosity = a * np.exp(b / above)
        return viscosity, -viscosity * b / above**2


def check_points(key: str, points: Sequence[tuple[float, float]], unit: str) -> None:
    """Raise ValueError unless the temperature of points, K, rises and their viscosity falls.

    Parameters
    ----------
    key, unit : key of the points, and SI unit of their viscosities, for the message.
    points : temperatures, K, and viscosities.
    """
    for number, (before, after) in enumerate(pairwise(points), 2):
        if not (after[0] > before[0] and after[1] < before[1]):
            raise ValueError(
                f"{key}: got {celsius(after[0])}, {after[1]:.4g} {unit} at row {number} after {celsius(before[0])}, "
                f"{before[1]:.4g} {unit}; the temperature must rise and the viscosity fall"
            )
