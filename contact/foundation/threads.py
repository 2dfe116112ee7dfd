"""Threads that share work; loops compiled by numba and transforms leave the interpreter, so that they run at once."""

import os
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from itertools import pairwise

from roughfilm.contact.foundation.errors import InputError

DEFAULT_THREADS, MOST_THREADS = 2, 256


def checked_threads(threads: int | None) -> int:
    """The number of threads asked for, or two where there are two cores; InputError if it is out of range."""
    if threads is None:
        return min(DEFAULT_THREADS, os.cpu_count() or 1)
    if not 1 <= threads <= MOST_THREADS:
        raise InputError(f"threads: got {threads} threads; it must be 1 to {MOST_THREADS}")
    return threads


@contextmanager
def workers(threads: int) -> Iterator[ThreadPoolExecutor]:
    """Threads for independent tasks; those that still wait are dropped when something goes wrong."""
    pool = ThreadPoolExecutor(threads)
    try:
        yield pool
    finally:
        pool.shutdown(cancel_futures=True)


class Team:
    """Threads that share a loop by ranges; the calling thread is one of them."""

    def __init__(self, members: int) -> None:
        self.members = members
        self._others = ThreadPoolExecutor(members - 1) if members > 1 else None

    def ranges(self, count: int, unit: int = 1) -> list[tuple[int, int]]:
        """``count`` things cut into a range [low, high) for each member, at whole units."""
        bounds = [count * member // (self.members * unit) * unit for member in range(self.members)]
        return list(pairwise([*bounds, count]))

    def share(self, work: Callable[[int], None]) -> None:
        """Let every member, 0 and on, do its work; over when all have."""
        if self._others is None:
            work(0)
            return
        begun = [self._others.submit(work, member) for member in range(1, self.members)]
        try:
            work(0)
        finally:
            for other in begun:
                other.result()
