"""The measurement of CPU time and wall time."""

import os
import time
from collections.abc import Callable


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
