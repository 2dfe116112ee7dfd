"""The speed from which on a film keeps the asperities of its walls apart."""

from math import nan

import scipy

from roughfilm.rom.bearing.mixed.film import MixedFilm
from roughfilm.rom.cavitation.network import State

FASTEST = 1000
"""Times the speed near which it is sought."""


def lift_off_speed(film: MixedFilm, pressure: float, near: float, *, tolerance: float) -> float:
    """The speed at which the film alone carries a pressure over the nominal area where the walls just touch, m/s.

    Sought round ``near``; 0 if the wall floats at rest, NaN if no speed up to 1000 times ``near`` is enough.
    """
    separation = film.touching
    if separation >= film.widest:
        return nan
    state: State | None = None

    def excess(speed: float) -> float:
        nonlocal state
        found = film.at(separation, speed, state)
        state = found.solution.state
        return found.load / (pressure * film.area) - 1

    if excess(0.0) >= 0:
        return 0.0
    low, high = 0.0, near
    while excess(high) < 0:
        low, high = high, 2 * high
        if high > FASTEST * near:
            return nan
    while low == 0.0 or high > 2 * low:
        middle = high / 2
        if excess(middle) < 0:
            low = middle
        else:
            high = middle
    return float(scipy.optimize.brentq(excess, low, high, xtol=tolerance * low, rtol=tolerance))
