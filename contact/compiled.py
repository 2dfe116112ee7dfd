"""Loops compiled by numba at their first call, and kept for the next run where there is a place for them."""

from collections.abc import Callable
from functools import partial
from typing import Any

from numba import njit

FAST = frozenset({"reassoc", "contract", "nsz", "arcp"})
"""Freedoms of rounding that let sums be vectorised, infinities and NaN kept."""


def compiled(loop: Callable[..., Any] | None = None, *, fastmath: frozenset[str] = FAST) -> Any:
    """A decorator: no check of divisions, no lock of the interpreter; ``fastmath`` names what may be reordered."""
    if loop is None:
        return partial(compiled, fastmath=fastmath)
    options: dict[str, Any] = {"nogil": True, "error_model": "numpy", "fastmath": set(fastmath)}
    try:
        return njit(cache=True, **options)(loop)
    except RuntimeError:
        return njit(**options)(loop)
