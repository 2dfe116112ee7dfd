"""Checks of the arguments of contact mechanics, which raise InputError with one line."""

import math
from numbers import Real

import numpy as np
from numpy.typing import ArrayLike

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError


def positive(place: str, value: float) -> float:
    """The number as a float if it is finite and above 0; raises InputError otherwise."""
    if not _is_number(value) or not 0 < value < math.inf:
        raise InputError(f"{place}: got {value!r}; give a finite number above 0")
    return float(value)


def positive_fields(place: str, data: object) -> None:
    """Raise InputError if a field of a dataclass is not finite and above 0."""
    for name, value in vars(data).items():
        positive(f"{place}.{name}", value)


def not_negative(place: str, value: float) -> float:
    """The number as a float if it is finite and 0 or above; raises InputError otherwise."""
    if not _is_number(value) or not 0 <= value < math.inf:
        raise InputError(f"{place}: got {value!r}; give a finite number, 0 or above")
    return float(value)


def finite(place: str, values: ArrayLike) -> Array:
    """The numbers as an array of floats, any shape, if all are finite; raises InputError otherwise."""
    array = np.asarray(values, dtype=np.float64)
    if not np.isfinite(array).all():
        raise InputError(f"{place}: got a number that is not finite; give finite ones")
    return array


def _is_number(value: object) -> bool:
    return isinstance(value, Real) and not isinstance(value, bool)
