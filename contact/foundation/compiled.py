"""Decorators of numerical loops that numba compiles at their first call and caches on disk where that is possible.

All loops run without the lock of the interpreter, so that threads run them at the same time. A division by zero gives
an infinity or NaN, as in NumPy, and no exception. Sums may be reordered and products contracted, except in loops that
are ``unreordered``; infinities and NaN keep their meaning.
"""

import gc
import logging
import time
from collections.abc import Callable
from functools import cache, cached_property, partial, update_wrapper
from typing import Any

from roughfilm.contact.foundation.cache import warn
from roughfilm.contact.foundation.timing import one_time

COMPILATION_S = "10 to 30"
"""Usual times in which the loops of a scene are compiled, s."""


_starting = partial(one_time, "start", time.thread_time)
"""Count the CPU time of importing numba, and of reading compiled loops from the disk, as a one-time cost."""


class Loop:
    """A function that numba compiles, or reads from its cache, at its first call.

    Numba is slow to import, so that it is imported at that call and not with the module of the loop.

    Parameters
    ----------
    loop : function in the part of Python that numba compiles.
    options : options of ``numba.njit`` in addition to those of all loops.
    """

    def __init__(self, loop: Callable[..., Any], **options: Any) -> None:
        self._loop = loop
        self._options = options
        update_wrapper(self, loop)

    def __call__(self, *arguments: Any) -> Any:
        """Run the compiled loop with positional arguments and return its result."""
        return self._dispatcher(*arguments)

    @cached_property
    def _dispatcher(self) -> Any:
        """The compiled function; in the module of this loop the loops that it calls are replaced by compiled ones."""
        names = self._loop.__globals__
        for name in self._loop.__code__.co_names:
            if isinstance(called := names.get(name), Loop):
                names[name] = called._dispatcher
        with _starting():
            try:
                dispatcher = _njit()(**self._options)(self._loop)
            except RuntimeError:  # no directory for the cache can be written
                return _njit()(**{**self._options, "cache": False})(self._loop)
            dispatcher._cache.save_overload = partial(_keep, dispatcher._cache.save_overload)
            dispatcher._cache.load_overload = _starting()(dispatcher._cache.load_overload)
        return dispatcher


def _keep(save: Callable[..., None], *compilation: Any) -> None:
    """Keep a compiled loop for later runs, or warn once that the disk has no space for it."""
    try:
        save(*compilation)
    except OSError as error:
        warn(
            f"compiled kernels: cannot be written ({error.strerror or error}); set NUMBA_CACHE_DIR to another directory"
        )


compiled: Any = partial(Loop, cache=True, _nrt=False)
"""Decorator of a loop that neither makes nor returns an array.

The option ``_nrt=False``, which is private to numba, omits the counting of references to arrays: for short rows the
counting would take longer than the loop.
"""

unreordered: Any = partial(compiled, fastmath=False)
"""Decorator of a loop as ``compiled``, whose results equal those of the same operations of NumPy to the last bit."""

called: Any = partial(compiled, no_cpython_wrapper=True)
"""Decorator of a loop that only compiled loops call; without an interface to Python it compiles faster."""

inlined: Any = partial(Loop, inline="always")
"""Decorator of a loop that is small or has a single caller; numba copies it into the loop that calls it."""

allocating: Any = partial(Loop, cache=True)
"""Decorator of a loop that makes or returns arrays."""


@cache
def _njit() -> Any:
    """The decorator of numba with the options of all loops.

    When numba compiles a loop of this package for the first time in a process, a warning is logged. The CPU time counts
    as the one-time cost "compilation". Python does not look for unused cycles of objects meanwhile, which takes a tenth
    of the time and frees little.
    """
    from numba import njit
    from numba.core import event

    class Compilation(event.Listener):
        depth = 0
        collects = False
        account: Any = None

        def on_start(self, started: Any) -> None:
            if self.depth == 0:
                self.collects = gc.isenabled()
                gc.disable()
                self.account = one_time("compilation", time.thread_time)
                self.account.__enter__()
            self.depth += 1
            if str(started.data["dispatcher"].py_func.__module__).startswith("roughfilm."):
                _announce()

        def on_end(self, _ended: Any) -> None:
            self.depth -= 1
            if self.depth == 0:
                self.account.__exit__(None, None, None)
                if self.collects:
                    gc.enable()

    event.register("numba:compile", Compilation())  # type: ignore[no-untyped-call]
    fast = {"reassoc", "contract", "nsz", "arcp"}
    return partial(njit, nogil=True, error_model="numpy", fastmath=fast, no_cfunc_wrapper=True)


@cache
def _announce() -> None:
    logging.getLogger(__name__).warning("compiling numerical kernels, about %s s, once per installation", COMPILATION_S)
