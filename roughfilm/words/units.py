"""Quantities in the units of engineers, films in µm and flows in ml/min, rounded to their uncertainty."""

import math
from collections.abc import Mapping
from dataclasses import replace

from roughfilm.contact.foundation.rounding import TWO_DIGIT_MANTISSA
from roughfilm.contact.foundation.units import Quantity

EXACT, UNKNOWN = "exact", "unknown"
"""Words in the place of an uncertainty of zero, and of one that is not known."""

MAX_DIGITS = 6
"""Largest number of digits of a value with an uncertainty."""

DIGITS = 5
"""Digits of a value without an uncertainty."""

Scales = tuple[tuple[float, str], ...]

_MINUTE, _HOUR = 1 / 60, 1 / 3600


def _prefixed(unit: str, *powers: int, size: float = 1.0) -> Scales:
    """The multiples of a unit by powers of ten; ``size`` is that of the unit in the SI unit."""
    names = {-12: "p", -9: "n", -6: "µ", -3: "m", 0: "", 3: "k", 6: "M", 9: "G"}
    return tuple((size * 10.0**power, f"{names[power]}{unit}") for power in powers)


SCALES: Mapping[str, Scales] = {
    "1": ((1e-12, "1e-12"), (1e-9, "1e-9"), (1e-6, "1e-6"), (1e-4, ""), (1e6, "1e6"), (1e9, "1e9")),
    "m": _prefixed("m", -12, -9, -6, -3, 0),
    "m^2": ((1e-12, "µm²"), (1e-6, "mm²"), (1.0, "m²")),
    "m^3": (
        (1e-27, "nm³"),
        (1e-24, "1e-24 m³"),
        (1e-21, "1e-21 m³"),
        (1e-18, "µm³"),
        (1e-15, "1e-15 m³"),
        (1e-12, "1e-12 m³"),
        (1e-9, "mm³"),
    ),
    "m^2/s": ((1e-18, "nm²/s"), (1e-12, "µm²/s"), (1e-6, "mm²/s"), (1.0, "m²/s")),
    "m^3/s": (
        (_MINUTE * 1e-15, "pl/min"),
        (_MINUTE * 1e-12, "nl/min"),
        (_MINUTE * 1e-9, "µl/min"),
        (_MINUTE * 1e-6, "ml/min"),
        (_MINUTE * 1e-3, "l/min"),
    ),
    "m/s": _prefixed("m/s", -9, -6, -3, 0),
    "Pa": _prefixed("Pa", 0, 3, 6, 9),
    "N": _prefixed("N", -9, -6, -3, 0, 3, 6),
    "N/m": _prefixed("N/m", -6, -3, 0, 3, 6),
    "N*m": _prefixed("N·m", -9, -6, -3, 0, 3, 6),
    "W": _prefixed("W", -9, -6, -3, 0, 3, 6),
    "W/m": _prefixed("W/m", -6, -3, 0, 3, 6),
    "kg/s": _prefixed("g/h", -9, -6, -3, 0, 3, size=1e-3 * _HOUR),
    "kg/(m*s)": _prefixed("g/(h·m)", -9, -6, -3, 0, 3, size=1e-3 * _HOUR),
    "rad": ((1e-6, "µrad"), (1e-3, "mrad"), (math.pi / 180, "°")),
    "deg": ((1.0, "°"),),
    "degC": ((1.0, "°C"),),
}
"""Sizes of the units in which a quantity is shown, in its SI unit, with their names; the smallest first."""

ROUND_OFF = 1e-12
"""Magnitude over the largest one of the same unit in a result below which a value is round-off."""

UNRESOLVED = 1e-8
"""Uncertainty over the largest magnitude of the same unit below which a value within it is round-off."""

UNRESOLVED_PART = 0.05
"""Magnitude over its uncertainty below which a value is rounded to 0."""

BOUND = 1e-6
"""The bound of an uncertainty that is round-off, over the unit."""

BARE = 1e-4
"""Size of the unit of plain dimensionless numbers above this; it only chooses the unit."""


def scale_of(unit: str, size: float) -> tuple[float, str]:
    """The largest unit that is not larger than a size in an SI unit, as its size there and its name.

    Examples
    --------
    >>> scale_of("Pa", 2.5e6), scale_of("m", 4e-6), scale_of("K", 300.0)
    ((1000000.0, 'MPa'), (1e-06, 'µm'), (1.0, 'K'))
    """
    scales = SCALES.get(unit)
    if scales is None:
        return 1.0, unit.replace("*", "·").replace("^2", "²").replace("^3", "³")
    neutral = next((one for one in scales if one[1] == "" or one[0] == 1.0), scales[-1])
    chosen = next((one for one in reversed(scales) if one[0] <= size * (1 + 1e-9)), scales[0]) if size > 0 else neutral
    return (1.0, "") if chosen == (BARE, "") else chosen


def without_round_off(quantities: Mapping[str, Quantity]) -> dict[str, Quantity]:
    """The quantities of a result, those that are round-off with the value 0.

    A value is round-off below ``ROUND_OFF``, or if it is less than an uncertainty below ``UNRESOLVED``.

    Examples
    --------
    >>> found = without_round_off({"load": Quantity(value=4e-12, unit="Pa"), "p": Quantity(value=1e4, unit="Pa")})
    >>> found["load"].value, found["p"].value
    (0.0, 10000.0)
    """
    largest: dict[str, float] = {}
    for one in quantities.values():
        if math.isfinite(one.value):
            largest[one.unit] = max(largest.get(one.unit, 0.0), abs(one.value))

    def is_round_off(one: Quantity) -> bool:
        size, uncertainty = largest.get(one.unit, 0.0), one.uncertainty or 0.0
        return abs(one.value) < ROUND_OFF * size or abs(one.value) <= uncertainty < UNRESOLVED * size

    return {name: replace(one, value=0.0) if is_round_off(one) else one for name, one in quantities.items()}


def in_engineering_units(quantities: Mapping[str, Quantity]) -> dict[str, tuple[str, str, str]]:
    """The values, uncertainties and units of the quantities of a result, as texts, from :func:`in_engineering_unit`.

    A value of 0 whose uncertainty is round-off has the unit of the largest value of its dimension.

    Examples
    --------
    >>> load = Quantity(value=4e-12, unit="Pa", uncertainty=1e-10)
    >>> in_engineering_units({"load": load, "pressure": Quantity(value=2e4, unit="Pa")})["load"]
    ('0', '<0.000001', 'kPa')
    """
    cleared = without_round_off(quantities)
    found = {name: in_engineering_unit(one) for name, one in cleared.items()}
    for name, one in cleared.items():
        largest = max(abs(other.value) for other in cleared.values() if other.unit == one.unit)
        size, unit = scale_of(one.unit, largest)
        if one.value == 0 and 0 < (one.uncertainty or 0.0) < BOUND * size:
            found[name] = ("0", f"<{BOUND:f}", unit)
    return found


def in_engineering_unit(quantity: Quantity) -> tuple[str, str, str]:
    """The value, the uncertainty and the unit of a quantity, as texts; both numbers are in that unit.

    The value is rounded to its uncertainty, and has ``MAX_DIGITS`` digits at most; an uncertainty below the last of
    them is given as a bound. An uncertainty of zero is "exact", and one that is not known "unknown".

    Examples
    --------
    >>> in_engineering_unit(Quantity(value=2.0272e6, unit="Pa", uncertainty=300.0))
    ('2.0272', '0.0003', 'MPa')
    >>> in_engineering_unit(Quantity(value=5e-6, unit="m", uncertainty=0.0))
    ('5', 'exact', 'µm')
    >>> in_engineering_unit(Quantity(value=2e-9, unit="1", uncertainty=0.02))
    ('0.00', '0.02', '')
    """
    value, uncertainty = quantity.value, quantity.uncertainty
    known = uncertainty is not None and math.isfinite(uncertainty)
    if not math.isfinite(value):
        return str(value), UNKNOWN, scale_of(quantity.unit, 0.0)[1]
    size, unit = scale_of(quantity.unit, _size(abs(value), uncertainty if known and uncertainty else 0.0))
    value /= size
    if not known or not uncertainty:
        return _plain(value), EXACT if known else UNKNOWN, unit
    uncertainty /= size
    mantissa, exponent = f"{uncertainty:.1e}".split("e")
    last = int(exponent) - (float(mantissa) < TWO_DIGIT_MANTISSA)
    least = math.floor(math.log10(max(abs(value), uncertainty))) + 1 - MAX_DIGITS
    bound = f"<{10.0**least:.{max(-least, 0)}f}" if last < least and uncertainty < 10.0**least else ""
    last = max(last, least)
    return _rounded(value, last), bound or _rounded(uncertainty, last), unit


def _size(size: float, uncertainty: float) -> float:
    """The size that chooses the unit: the uncertainty where the value is small against it and is rounded to 0."""
    return uncertainty if size < UNRESOLVED_PART * uncertainty else size


def _plain(value: float) -> str:
    """A value with ``DIGITS`` digits, without a power of ten where that is short."""
    return f"{value:.0f}" if 10.0**DIGITS <= abs(value) < 1e7 else f"{value:.{DIGITS}g}"


def _rounded(value: float, last: int) -> str:
    """A value rounded to 10 to the power of ``last``, without a minus sign before zero."""
    text = f"{round(value, -last):.{max(-last, 0)}f}"
    return text.removeprefix("-") if not text.strip("-0.") else text
