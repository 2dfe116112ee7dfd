"""Loops compiled by numba at their first call, and kept for the next run where there is a place for them."""

from collections.abc import Callable
from functools import partial
from typing import Any

from numba import njit

_njit: Any = partial(njit, nogil=True, error_model="numpy", fastmath={"reassoc", "contract", "nsz", "arcp"})


def compiled(loop: Callable[..., Any]) -> Any:
    """A decorator for loops: sums may be reordered to be vectorised, infinities and NaN are kept."""
    try:
        return _njit(cache=True)(loop)
    except RuntimeError:
        return _njit(loop)


inlined: Any = _njit(inline="always")
"""For a small loop that others call for every row: it becomes part of them, and costs no call."""
