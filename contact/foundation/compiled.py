"""Loops compiled by numba at their first call and cached on disk where the cache can be written."""

import logging
from collections.abc import Callable
from functools import cache, cached_property, partial, update_wrapper
from typing import Any


class Loop:
    """A loop that numba compiles, or reads from its cache, at its first call; numba is slow to import."""

    def __init__(self, loop: Callable[..., Any], **options: Any) -> None:
        self._loop = loop
        self._options = options
        update_wrapper(self, loop)

    def __call__(self, *arguments: Any) -> Any:
        """Run the loop."""
        return self._dispatcher(*arguments)

    @cached_property
    def _dispatcher(self) -> Any:
        """The function of numba; the loops that this one calls are replaced by theirs, as numba wants to see them."""
        names = self._loop.__globals__
        for name in self._loop.__code__.co_names:
            if isinstance(called := names.get(name), Loop):
                names[name] = called._dispatcher
        try:
            return _njit()(**self._options)(self._loop)
        except RuntimeError:  # there is no place for a cache
            return _njit()(**{**self._options, "cache": False})(self._loop)


compiled: Any = partial(Loop, cache=True, _nrt=False)
"""Decorator of a loop: numba may reorder sums to vectorise them, and keeps infinities and NaN.

The loop makes and returns no array: ``_nrt=False`` leaves out the counting of references to arrays, which would cost
more than a short row takes. The option is private to numba.
"""

called: Any = partial(compiled, no_cpython_wrapper=True)
"""Decorator of a loop that only compiled loops call: it compiles faster without an interface to Python."""

inlined: Any = partial(Loop, inline="always")
"""Decorator of a small loop, or of one with a single caller: numba copies it into the loop that calls it."""

allocating: Any = partial(Loop, cache=True)
"""Decorator of a loop that makes or returns arrays."""


@cache
def _njit() -> Any:
    """Numba's decorator; when it first compiles a loop of this package, a warning in the log says so."""
    from numba import njit
    from numba.core import event

    class Announcement(event.Listener):
        def on_start(self, started: Any) -> None:
            if str(started.data["dispatcher"].py_func.__module__).startswith("roughfilm."):
                _announce()

        def on_end(self, _ended: Any) -> None:
            pass

    event.register("numba:compile", Announcement())  # type: ignore[no-untyped-call]
    fast = {"reassoc", "contract", "nsz", "arcp"}
    return partial(njit, nogil=True, error_model="numpy", fastmath=fast, no_cfunc_wrapper=True)


@cache
def _announce() -> None:
    logging.getLogger(__name__).warning("compiling numerical kernels; later runs use the compiled ones ...")
