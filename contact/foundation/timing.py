"""The measurement of CPU time and wall time, and the account of costs that arise once."""

import builtins
import os
import sys
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from threading import Lock
from typing import Any


def stopwatch() -> Callable[[], dict[str, float]]:
    """Start a clock and return a function that reads it.

    Returns
    -------
    function without arguments
        It returns a dict with ``cpu_s``, the CPU time of this process and of its ended children since the start, s, and
        ``wall_s``, the wall time since the start, s.

    Examples
    --------
    >>> spent = stopwatch()
    >>> sorted(spent())
    ['cpu_s', 'wall_s']
    """
    wall, cpu = time.perf_counter(), sum(os.times()[:4])
    return lambda: {"cpu_s": sum(os.times()[:4]) - cpu, "wall_s": time.perf_counter() - wall}


_spent: dict[str, float] = {}
_claimed: dict[str, float] = {}
_running: list[str] = []
_apart: list[object] = []
_changing = Lock()
_import = builtins.__import__


@contextmanager
def one_time(name: str, clock: Callable[[], float] = time.process_time) -> Iterator[None]:
    """Add the CPU time of a block to the account of one-time costs.

    A block within another counts under its own name only.

    Parameters
    ----------
    name : name of the cost, such as "table".
    clock : the clock that measures the block, s.

    Examples
    --------
    >>> with one_time("example"):
    ...     _ = sum(range(1000))
    >>> "example" in claimed_costs()
    True
    """
    started, before = clock(), sum(_spent.values())
    _running.append(name)
    try:
        yield
    finally:
        with _changing:
            _running.remove(name)
            inner = sum(_spent.values()) - before
            _spent[name] = _spent.get(name, 0.0) + max(clock() - started - inner, 0.0)


@contextmanager
def imports_apart() -> Iterator[None]:
    """Count the CPU time of what is imported during a block as the one-time cost "start".

    Many modules are imported at the first call of a function that needs them. Without this, the first solution of a
    process would seem to take the longer. Blocks may overlap in several threads.

    Examples
    --------
    >>> with imports_apart():
    ...     import calendar
    """
    global _import
    with _changing:
        if not _apart and builtins.__import__ is not _timed_import:
            _import = builtins.__import__  # another library may have put its own there
        _apart.append(block := object())
        builtins.__import__ = _timed_import
    try:
        yield
    finally:
        with _changing:
            _apart.remove(block)
            if not _apart:
                builtins.__import__ = _import


def _timed_import(name: str, *where: Any, **more: Any) -> Any:
    """Import a module as Python does; its CPU time is a one-time cost, unless all is there already."""
    names = where[2] if len(where) > 2 else more.get("fromlist")
    known = getattr(sys.modules.get(name), "__dict__", {})
    if "__name__" in known and all(one in known for one in names or ()):
        return _import(name, *where, **more)
    with one_time("start", time.thread_time):
        return _import(name, *where, **more)


def running_cost() -> str:
    """The name of the one-time cost that arises now, of the innermost if there are several; "" if there is none."""
    return next(reversed(_running), "")


def working_time() -> float:
    """The CPU time of this process without its one-time costs, s."""
    return time.process_time() - sum(_spent.values())


def claimed_costs() -> Mapping[str, float]:
    """The one-time costs by name, s, that have arisen in this process since the last call; the largest first."""
    with _changing:
        new = {name: spent - _claimed.get(name, 0.0) for name, spent in _spent.items()}
        _claimed.update(_spent)
    return {name: new[name] for name in sorted(new, key=lambda name: -new[name]) if new[name] > 0}
