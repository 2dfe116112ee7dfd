"""Loops that are compiled at the first call, and kept for the next run."""

from collections.abc import Callable
from functools import partial
from typing import Any

from numba import njit

_njit: Any = partial(njit, nogil=True, error_model="numpy", fastmath={"reassoc", "contract", "nsz", "arcp"})


def jit(loop: Callable[..., Any]) -> Any:
    """Compiled at the first call; kept for the next run where there is a place for it."""
    try:
        return _njit(cache=True)(loop)
    except RuntimeError:
        return _njit(loop)


inlined: Any = _njit(inline="always")
"""For a small loop that others call for every row: it becomes part of them, and costs no call."""
