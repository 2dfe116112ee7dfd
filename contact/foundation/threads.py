"""Threads that share work; compiled loops and transforms release the interpreter's lock and so run in parallel."""

import os
from collections.abc import Callable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import contextmanager
from contextvars import copy_context
from itertools import pairwise
from typing import Any

from roughfilm.contact.foundation.errors import InputError

DEFAULT_THREADS, MOST_THREADS = 2, 256


def checked_threads(threads: int | None) -> int:
    """The requested number of threads, 1 to 256; None means two threads, or one on a machine with one core.

    Raises InputError if the number is out of range.
    """
    if threads is None:
        return min(DEFAULT_THREADS, os.cpu_count() or 1)
    if not 1 <= threads <= MOST_THREADS:
        raise InputError(f"threads: got {threads} threads; it must be 1 to {MOST_THREADS}")
    return threads


class _Pool(ThreadPoolExecutor):
    """Threads that work in the context of the caller, in which NumPy keeps what it does about an overflow."""

    def submit(self, work: Callable[..., Any], /, *arguments: Any, **options: Any) -> Future[Any]:
        """Call ``work`` in one of the threads, in a copy of the current context."""
        return super().submit(copy_context().run, work, *arguments, **options)


@contextmanager
def workers(threads: int) -> Iterator[ThreadPoolExecutor]:
    """A pool of threads for independent tasks; at the end of the block, tasks that have not started are cancelled."""
    pool = _Pool(threads)
    try:
        yield pool
    finally:
        pool.shutdown(cancel_futures=True)


class Team:
    """A group of threads that share a loop by ranges of its index; the calling thread is a member."""

    def __init__(self, members: int) -> None:
        self.members = members
        self._others = _Pool(members - 1) if members > 1 else None

    def ranges(self, count: int, unit: int = 1) -> list[tuple[int, int]]:
        """The range [low, high) of indices below ``count`` for each member; each low is a multiple of ``unit``."""
        bounds = [count * member // (self.members * unit) * unit for member in range(self.members)]
        return list(pairwise([*bounds, count]))

    def share(self, work: Callable[[int], None]) -> None:
        """Call ``work(member)`` for members 0 to ``members`` - 1 at the same time; return when all have finished.

        An exception of a member is raised again in the calling thread.
        """
        if self._others is None:
            work(0)
            return
        begun = [self._others.submit(work, member) for member in range(1, self.members)]
        try:
            work(0)
        finally:
            for other in begun:
                other.result()
