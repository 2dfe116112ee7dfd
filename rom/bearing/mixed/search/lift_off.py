"""The lift-off speed, above which a film separates the asperities of its walls."""

from collections.abc import Callable
from math import nan

import scipy

from roughfilm.contact.foundation.ranges import RANGES

MAX_SPEED_RATIO = 1000
"""Largest speed that is tried over the initial guess."""


def lift_off_speed(excess: Callable[[float], float], near: float, *, tolerance: float) -> float:
    """The speed from which on a film separates the walls under a load, m/s.

    Parameters
    ----------
    excess : excess(speed), which grows with the speed and is 0 there: what the film carries at the separation of first
        contact over the load, or the separation under the load over that of first contact, minus 1.
    near : initial guess, m/s.
    tolerance : relative error of the speed.

    Returns
    -------
    float
        0 if the walls are apart at rest or below the smallest of all speeds, NaN if no speed up to ``MAX_SPEED_RATIO``
        times ``near`` is sufficient.
    """
    if excess(0.0) >= 0:
        return 0.0
    low, high = 0.0, near
    while excess(high) < 0:
        low, high = high, 2 * high
        if high > MAX_SPEED_RATIO * near:
            return nan
    while low == 0.0 or high > 2 * low:
        middle = high / 2
        if middle < RANGES["m/s"].least:
            return 0.0
        if excess(middle) < 0:
            low = middle
        else:
            high = middle
    return float(scipy.optimize.brentq(excess, low, high, xtol=tolerance * low, rtol=tolerance))
