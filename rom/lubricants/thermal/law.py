"""The base classes of the laws of the viscosity over temperature."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Annotated, ClassVar, Self

from pydantic import model_validator

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.entries import InUnit, Part
from roughfilm.contact.foundation.errors import InputError

Temperature = Annotated[float, InUnit("K")]
ZERO_CELSIUS = 273.15
"""0 °C, K."""

LIQUID = (213.15, 523.15)
"""Temperatures between which laws without a range of their own are valid, K: at -60 °C and below no oil flows, and at
250 °C and above they decompose."""

LOG_LIMIT = 200.0
"""Logarithm of a viscosity over a usual one, above which a law refuses a temperature as too low."""


def celsius(temperature: float) -> str:
    """The text of a temperature, K, in °C.

    Examples
    --------
    >>> celsius(313.15)
    '40 °C'
    """
    return f"{temperature - ZERO_CELSIUS:.4g} °C"


def at_most(most: float, usual: str) -> Callable[[float], float]:
    """A check of a coefficient over temperature, 1/K, which raises ValueError if its size is above ``most``.

    Parameters
    ----------
    usual : usual coefficients, in words, for the message.
    """

    def checked(coefficient: float) -> float:
        if abs(coefficient) > most:
            raise ValueError(
                f"got {coefficient:g} 1/K; it must be at most {most:g} 1/K in size, of oils it is {usual}; check the "
                "unit"
            )
        return coefficient

    return checked


def check_rising(table: Sequence[tuple[float, float]]) -> None:
    """Raise ValueError if the temperatures, K, of the rows of a table do not rise."""
    for number, (before, after) in enumerate(pairwise(table), 2):
        if not after[0] > before[0]:
            raise ValueError(
                f"table: got {celsius(after[0])} at row {number} after {celsius(before[0])}; the temperature must rise"
            )


@dataclass(frozen=True, kw_only=True)
class Supplied:
    """The state in which a lubricant is supplied.

    Attributes
    ----------
    temperature : temperature T_s, K.
    viscosity : viscosity η_s at it, Pa s.
    """

    temperature: float
    viscosity: float


class TemperatureLaw(Part):
    """A law of the viscosity over the temperature T, K, at cavitation pressure.

    Each law has the keys ``valid_from`` and ``valid_to``, temperatures between which it is valid, K; outside of them a
    result is outside the range of its model.
    """

    ends: ClassVar[str] = ""
    """What the ends of the range are by default, in words."""

    def narrowed(self, low: float, high: float) -> tuple[float, float]:
        """The range of a law, K, with the given ends in the place of its own."""
        first, last = (getattr(self, key) for key in ("valid_from", "valid_to"))
        return low if first is None else first, high if last is None else last

    @model_validator(mode="after")
    def _has_a_range(self) -> Self:
        low, high = self.narrowed(0.0, math.inf)
        if low >= high:
            raise ValueError(f"valid_to: got {celsius(high)}; it must be above valid_from, {celsius(low)}")
        return self

    def refuse_below(self, limit: float, temperature: Array) -> None:
        """Raise InputError if a temperature, K, is at or below the limit at which the law has no viscosity."""
        lowest = float(temperature.min(initial=math.inf))
        if not lowest > limit:
            raise InputError(
                f"lubricant.thermoviscosity: got {celsius(lowest)}; the law {getattr(self, 'law', '')} has no "
                f"viscosity up to {celsius(limit)}, raise the temperature, check its unit, or take another law"
            )


class AnchoredLaw(TemperatureLaw):
    """A law that gives η/η_s, so that it needs the viscosity of the supplied lubricant."""


class AbsoluteLaw(TemperatureLaw):
    """A law that gives the viscosity itself: the kinematic one ν = η/ρ, m²/s, if ``kinematic``, else η, Pa s."""

    kinematic: ClassVar[bool] = False
