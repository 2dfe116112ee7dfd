"""The lift-off speed, above which a film separates the asperities of its walls."""

from math import nan

import scipy

from roughfilm.contact.foundation.ranges import RANGES
from roughfilm.rom.bearing.mixed.film import MixedFilm
from roughfilm.rom.cavitation.network import State

MAX_SPEED_RATIO = 1000
"""Largest speed that is tried over the initial guess."""


def lift_off_speed(film: MixedFilm, pressure: float, near: float, *, tolerance: float) -> float:
    """The speed at which the film alone carries a load at the separation of first contact, m/s.

    Parameters
    ----------
    pressure : the load over the nominal area, Pa.
    near : initial guess, m/s.
    tolerance : relative error of the speed.

    Returns
    -------
    float
        0 if the load is carried at rest or below the smallest of all speeds, NaN if no speed up to ``MAX_SPEED_RATIO``
        times ``near`` is sufficient.
    """
    separation = film.touching
    if separation >= film.widest:
        return nan
    state: State | None = None

    def excess(speed: float) -> float:
        nonlocal state
        solved = film.at(separation, speed, state)
        state = solved.solution.state
        return solved.load / (pressure * film.area) - 1

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
