"""Type names of the NumPy arrays that every package uses, and the refusal of masked ones."""

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from roughfilm.contact.foundation.errors import InputError

Array = NDArray[np.float64]
"""An array of floating-point numbers, of any shape."""

Mask = NDArray[np.bool_]
"""An array of truth values, of any shape."""


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
