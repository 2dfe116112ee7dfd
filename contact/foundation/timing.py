"""CPU and wall time of a piece of work."""

import os
import time
from collections.abc import Callable


def stopwatch() -> Callable[[], dict[str, float]]:
    """Start a clock and return a function that reads it.

    Returns
    -------
    function without arguments
        It gives ``cpu_s``, the CPU seconds since the start of this process and of its children that have ended, and
        ``wall_s``, the seconds since the start.

    Examples
    --------
    >>> spent = stopwatch()
    >>> sorted(spent())
    ['cpu_s', 'wall_s']
    """
    wall, cpu = time.perf_counter(), sum(os.times()[:4])
    return lambda: {"cpu_s": sum(os.times()[:4]) - cpu, "wall_s": time.perf_counter() - wall}
