"""Loops compiled by numba at their first call, and kept for the next run where there is a place for them."""

import logging
from collections.abc import Callable
from functools import cache, cached_property, partial, update_wrapper
from typing import Any


class Compiled:
    """A loop that numba compiles, or reads from its cache, at its first call; numba is slow to import."""

    def __init__(self, loop: Callable[..., Any], *, inline: bool) -> None:
        self._loop = loop
        self._inline = inline
        update_wrapper(self, loop)

    def __call__(self, *arguments: Any) -> Any:
        """Run the loop."""
        return self.dispatcher(*arguments)

    @cached_property
    def dispatcher(self) -> Any:
        """The function of numba; the loops that this one calls are replaced by theirs, as numba wants to see them."""
        names = self._loop.__globals__
        for name in self._loop.__code__.co_names:
            if isinstance(called := names.get(name), Compiled):
                names[name] = called.dispatcher
        njit = _njit()
        if self._inline:
            return njit(forceinline=True)(self._loop)
        try:
            return njit(cache=True)(self._loop)
        except RuntimeError:  # there is no place for a cache
            return njit(self._loop)


compiled: Any = partial(Compiled, inline=False)
"""A decorator for loops: sums may be reordered to be vectorised, infinities and NaN are kept."""

inlined: Any = partial(Compiled, inline=True)
"""For a small loop that others call for every row: it becomes part of them, and costs no call."""


@cache
def _announce() -> None:
    logging.getLogger(__name__).warning("compiling numerical kernels, once after installation ...")


@cache
def _njit() -> Any:
    """Numba's decorator; when it first compiles a loop of this package, a warning in the log says so."""
    from numba import njit
    from numba.core import event

    class Announcement(event.Listener):  # type: ignore[misc]
        def on_start(self, started: Any) -> None:
            if started.data["dispatcher"].py_func.__module__.startswith("roughfilm."):
                _announce()

        def on_end(self, _ended: Any) -> None:
            pass

    event.register("numba:compile", Announcement())
    return partial(njit, nogil=True, error_model="numpy", fastmath={"reassoc", "contract", "nsz", "arcp"})
