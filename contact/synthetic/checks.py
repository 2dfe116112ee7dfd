"""Checks of the arguments of synthetic surfaces, which raise InputError with one line."""

import math

from roughfilm.contact.foundation.errors import InputError

REPEAT_TOLERANCE = 1e-3
"""Relative deviation up to which the number of repeats of a length in the period counts as whole."""


def number_between(place: str, value: float, least: float, most: float, remedy: str) -> float:
    """The number as a float if least <= value <= most; raises InputError otherwise."""
    if isinstance(value, bool) or not isinstance(value, int | float) or not least <= value <= most:
        raise InputError(f"{place}: got {value!r}; {remedy}")
    return float(value)


def whole_between(place: str, value: int, least: int, most: int) -> int:
    """The whole number if least <= value <= most; raises InputError otherwise."""
    if isinstance(value, bool) or not isinstance(value, int) or not least <= value <= most:
        raise InputError(f"{place}: got {value!r}; write a whole number from {least} to {most}")
    return value


def length(place: str, value: float) -> float:
    """The length, m, if it is 1e-15 m to 1e6 m; raises InputError otherwise."""
    return number_between(place, value, 1e-15, 1e6, "it must be 1e-15 to 1e6 m, look at the unit")


def repeats(place: str, repeat: float, side: float) -> int:
    """Number of repeats of a length, m, in a side of the period, m; raises InputError if it is not whole to 0.1 %."""
    length(place, repeat)
    count = max(1, round(side / repeat))
    if abs(side / repeat - count) > REPEAT_TOLERANCE * count:
        counts = sorted({max(1, math.floor(side / repeat)), math.ceil(side / repeat)})
        nearest = " or ".join(f"{side / fitting:.5g} m" for fitting in counts)
        raise InputError(
            f"{place}: got {repeat:.5g} m, which does not divide the period of {side:.5g} m; write {nearest}"
        )
    return count
