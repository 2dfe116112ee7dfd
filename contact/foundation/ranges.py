"""The range of each physical quantity in an input: that of engineering, with ten decades more at both ends."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from numbers import Integral, Real
from typing import Any

from roughfilm.contact.foundation.errors import InputError

MARGIN = 1e10
"""Factor by which a range reaches beyond engineering, at both ends."""


@dataclass(frozen=True)
class Range:
    """A range of the size of a number; zero is in every range, because only a key decides whether it has a meaning.

    Attributes
    ----------
    least, most : smallest and largest size of a number other than zero.

    Examples
    --------
    >>> 0.0 in Range(1e-3, 1e3), -10.0 in Range(1e-3, 1e3), float("nan") in Range(1e-3, 1e3)
    (True, True, False)
    """

    least: float
    most: float

    def __contains__(self, value: float) -> bool:
        """Whether the size of a number is in the range; False for one that is not finite."""
        return value == 0 or self.least <= abs(value) <= self.most

    def __str__(self) -> str:
        """Both ends, in words."""
        return f"{self.least:g} to {self.most:g}"


_ENGINEERING: Mapping[str, tuple[float, float]] = {
    "m": (1e-12, 1e3),
    "m^2": (1e-24, 1e6),
    "Pa": (1e-3, 1e12),
    "Pa/m": (1e-3, 1e16),
    "Pa^-1": (1e-12, 1e-5),
    "Pa*s": (1e-6, 1e6),
    "m^2/s": (1e-9, 1e3),
    "m^3/s": (1e-20, 1e3),
    "kg/m^3": (1e-3, 1e5),
    "kg": (1e-9, 1e6),
    "kg*m": (1e-12, 1e6),
    "kg*m^2": (1e-15, 1e6),
    "m/s": (1e-9, 1e5),
    "rad": (1e-8, 1e2),
    "rad/s": (1e-6, 1e6),
    "N": (1e-9, 1e9),
    "N/m": (1e-9, 1e9),
    "N*m": (1e-12, 1e12),
    "W": (1e-12, 1e9),
    "s": (1e-9, 1e10),
    "K": (1e-3, 1e5),
    "K^-1": (1e-9, 1e3),
    "W/(m*K)": (1e-6, 1e6),
    "W/(m^2*K)": (1e-6, 1e9),
    "J/(kg*K)": (1e-3, 1e6),
    "1": (1e-6, 1e6),
}
"""Smallest and largest number in engineering, by SI unit; "1" for dimensionless numbers."""

RANGES: Mapping[str, Range] = {
    unit: Range(float(f"{least / MARGIN:g}"), float(f"{most * MARGIN:g}"))
    for unit, (least, most) in _ENGINEERING.items()
}
"""The allowed range of a number by its SI unit."""


def in_range(place: str, value: object, unit: str, *, zero: bool = False) -> float:
    """The number in the SI unit as a float, if it is above zero, or zero where that is allowed, and in its range.

    Raises
    ------
    InputError
        In one line, for anything else.

    Examples
    --------
    >>> in_range("load", 1e6, "Pa")
    1000000.0
    >>> in_range("load", 1e300, "Pa")
    Traceback (most recent call last):
    ...
    roughfilm.contact.foundation.errors.InputError: load: got 1e+300; it must be 1e-13 to 1e+22 Pa, check the unit
    """
    number: Any = value if not isinstance(value, bool) and isinstance(value, Real) else math.nan
    if (number > 0 or (zero and number == 0)) and number in RANGES[unit]:
        return float(number)
    allowed = f"{'0 or ' if zero else ''}{RANGES[unit]} {unit}".removesuffix(" 1")
    raise InputError(f"{place}: got {value!r:.60}; it must be {allowed}, check the unit")


def whole_in_range(place: str, value: object, least: int, most: int) -> int:
    """The whole number, also one of NumPy, if least <= value <= most.

    Raises
    ------
    InputError
        In one line, for anything else.

    Examples
    --------
    >>> whole_in_range("windows", 2.5, 1, 10)
    Traceback (most recent call last):
    ...
    roughfilm.contact.foundation.errors.InputError: windows: got 2.5; give a whole number from 1 to 10
    """
    if not isinstance(value, bool) and isinstance(value, Integral) and least <= int(value) <= most:
        return int(value)
    raise InputError(f"{place}: got {value!r:.60}; give a whole number from {least} to {most}")
