"""Loops compiled by numba at their first call and cached on disk where the cache can be written."""

from collections.abc import Callable
from functools import partial
from typing import Any

from numba import njit

_njit: Any = partial(njit, nogil=True, error_model="numpy", fastmath={"reassoc", "contract", "nsz", "arcp"})


def compiled(loop: Callable[..., Any]) -> Any:
    """Compile a loop; sums may be reordered for vectorisation, infinities and NaN keep their meaning."""
    try:
        return _njit(cache=True)(loop)
    except RuntimeError:
        return _njit(loop)


inlined: Any = _njit(inline="always")
"""Decorator that inlines a small loop into the compiled loops that call it."""
