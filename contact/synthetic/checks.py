"""What the arguments of a synthetic surface must be; whatever is wrong is told in one line."""

import math

from roughfilm.contact.foundation.errors import InputError

WHOLE = 1e-3
"""How far from a whole number of repeats a length may be, relatively, and still be taken for it."""


def number_between(place: str, value: float, least: float, most: float, remedy: str) -> float:
    """The number, if least <= value <= most; InputError otherwise, also for what is no number."""
    if isinstance(value, bool) or not isinstance(value, int | float) or not least <= value <= most:
        raise InputError(f"{place}: got {value!r}; {remedy}")
    return float(value)


def whole_between(place: str, value: int, least: int, most: int) -> int:
    """The whole number, if least <= value <= most; InputError otherwise, also for what is none."""
    if isinstance(value, bool) or not isinstance(value, int) or not least <= value <= most:
        raise InputError(f"{place}: got {value!r}; write a whole number from {least} to {most}")
    return value


def length(place: str, value: float) -> float:
    """A length, m: 1e-15 to 1e6, beyond which the unit is wrong."""
    return number_between(place, value, 1e-15, 1e6, "it must be 1e-15 to 1e6 m, look at the unit")


def repeats(place: str, repeat: float, side: float) -> int:
    """How often a length, m, fits a side of the period; whole to one part in a thousand, or InputError."""
    length(place, repeat)
    count = max(1, round(side / repeat))
    if abs(side / repeat - count) > WHOLE * count:
        ways = sorted({max(1, math.floor(side / repeat)), math.ceil(side / repeat)})
        nearest = " or ".join(f"{side / way:.5g} m" for way in ways)
        raise InputError(
            f"{place}: got {repeat:.5g} m, which does not divide the period of {side:.5g} m; write {nearest}"
        )
    return count
