"""Type names of the NumPy arrays that every package uses, refusal of masked ones, and arithmetic without overflow."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from roughfilm.contact.foundation.errors import ConvergenceError, InputError

Array = NDArray[np.float64]
"""An array of floating-point numbers, of any shape."""

Mask = NDArray[np.bool_]
"""An array of truth values, of any shape."""

ROUNDING = 1e-12
"""Largest of some numbers, over the largest of those from which they follow, at which all are rounding."""

OVERFLOW_REMEDY = "check the units, or make the scene less extreme"
"""The remedy where numbers overflow though each value of a scene is in its range."""


@contextmanager
def finite_arithmetic(place: str) -> Iterator[None]:
    """Raise an error, in one line, where an operation of the block overflows, divides by zero or is undefined.

    Parameters
    ----------
    place : what computes in the block, such as the name of a model, for the message.

    Raises
    ------
    ConvergenceError
        In place of any ArithmeticError of Python and of NumPy, which would warn and continue with infinite numbers.

    Examples
    --------
    >>> with finite_arithmetic("film"):
    ...     np.array([1e300]) * 1e300
    Traceback (most recent call last):
    ...
    roughfilm.contact.foundation.errors.ConvergenceError: film: its numbers overflow (overflow encountered in multiply)\
; check the units, or make the scene less extreme
    """
    try:
        with np.errstate(over="raise", divide="raise", invalid="raise"):
            yield
    except ArithmeticError as error:
        raise ConvergenceError(f"{place}: its numbers overflow ({error}); {OVERFLOW_REMEDY}") from error


def real_array(place: str, values: object, what: str) -> Array:
    """A new array of real numbers; InputError, with ``what`` was expected, for anything else.

    Examples
    --------
    >>> real_array("spacing", 1j, "two lengths")
    Traceback (most recent call last):
    ...
    roughfilm.contact.foundation.errors.InputError: spacing: got complex128; give two lengths
    """
    try:
        array = np.asarray(values)
    except ValueError:
        raise InputError(f"{place}: got rows of different lengths; give {what}") from None
    if array.dtype.kind not in "biuf":
        raise InputError(f"{place}: got {array.dtype if array.dtype != object else type(values).__name__}; give {what}")
    return np.array(array, dtype=np.float64, order="C")


def unmasked(place: str, values: ArrayLike) -> NDArray[Any]:
    """The values as an array, whose type and numbers are not checked.

    Raises
    ------
    InputError
        If values are masked (``numpy.ma``): they are unknown, and the numbers under the mask mean nothing.
    """
    if isinstance(values, np.ma.MaskedArray) and (count := np.count_nonzero(np.ma.getmaskarray(values))):
        raise InputError(f"{place}: {count} of {values.size} points are masked; fill them first")
    return np.asarray(values)


def beyond_rounding(values: Array, before: Array) -> Array:
    """The values, or zeros where all of them are rounding of the numbers from which they were subtracted or averaged.

    >>> beyond_rounding(np.array([1e-22, -3e-22]), np.array([1e-6, 1e-6]))
    array([0., 0.])
    """
    return values if np.abs(values).max() > ROUNDING * np.abs(before).max() else np.zeros_like(values)
