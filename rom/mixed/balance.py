"""How far apart film and asperities hold the walls under a load: a root, bracketed and found by few films."""

from collections.abc import Callable
from dataclasses import dataclass, field
from math import exp, log

import numpy as np
from scipy.optimize import brentq

from contact.errors import ConvergenceError, InputError, Outcome
from rom.cavitation.network import State
from rom.mixed.film import MixedFilm, MixedState

FILMS = 60
"""Solved for one load, at most; three or four are usual."""

STEEPNESS = 1.5
"""Of a film's load, as a power of the separation, before two films have told it."""

STEEPEST = 12.0
"""Of the same; between two films."""

EXTENSION = 4.0
"""Times the separation, where no film has yet been found that carries too little."""

LEAST = 0.01
"""Of the separation at which asperities touch: the least that is tried, as mean planes may lie beyond each other."""

BISECTED = 8
"""Films after which the bracket is halved, if that should ever be needed."""


@dataclass(kw_only=True)
class Speed:
    """What films of one bearing carry at one speed, as far as they have been solved.

    ``loads`` by their separations; ``steepness`` of the load as it was last seen.
    """

    film: MixedFilm
    speed: float
    loads: dict[float, float] = field(default_factory=dict)
    steepness: float = STEEPNESS

    def at(self, separation: float, start: State | None) -> MixedState:
        """Solve the film and remember its load."""
        found = self.film.at(separation, self.speed, start)
        self.loads[separation] = found.film_load
        return found

    def guess(self, near: float) -> Callable[[float], float]:
        """What the film carries at other separations, as a power of them, from the two known ones nearest to one."""
        known = sorted(self.loads, key=lambda separation: abs(log(separation / near)))[:2]
        one, load = known[0], self.loads[known[0]]
        if len(known) > 1:
            other = self.loads[known[1]]
            apart = log(known[1] / one)
            if load > 0 and other > 0:
                self.steepness = float(np.clip(-log(other / load) / apart, -STEEPEST, STEEPEST))
            else:
                return lambda separation: load + (other - load) * log(separation / one) / apart
        return lambda separation: load * (separation / one) ** -self.steepness


def balanced(
    at: Speed,
    pressure: float,
    *,
    tolerance: float,
    guess: float | None = None,
    start: State | None = None,
) -> MixedState:
    """The film whose load and that of its asperities are together a pressure over the nominal area.

    The total falls as the walls part. The asperities' part is known at once for any separation, so that only that of
    the film is guessed from those that were solved, as a power of the separation: a secant method for the smooth part
    of the balance, safe in the bracket that the films before leave.

    Parameters
    ----------
    at : films at the speed; those that other loads have left there help.
    pressure : Pa.
    tolerance : of the balance, relative to the load.
    guess : of the separation, m.
    start : the state of a film near the guess.

    Raises
    ------
    InputError
        If the walls cannot carry the load even where they are closest, naming the largest, or if the film carries more
        however far apart they are.
    ConvergenceError
        If a film does not come into balance, or the load does not.
    """
    film, load = at.film, pressure * at.film.area
    closest = max(film.asperities.closest, LEAST * film.asperities.touching) + film.dip
    widest = film.widest
    low, high = closest, widest
    carries, floats = False, False
    separation = min(max(film.asperities.touching + film.dip if guess is None else guess, low), high)
    for count in range(FILMS):
        found = at.at(separation, start)
        start = found.solution.state
        miss = found.load / load - 1
        if abs(miss) <= tolerance:
            return found
        if miss > 0:
            low, carries = separation, True
            if separation >= widest * (1 - 1e-12):
                raise _floats(at, pressure, found.load)
        else:
            high, floats = separation, True
            if separation <= closest * (1 + 1e-12):
                raise _too_much(at, pressure, found.load)
        separation = _next(at, load, low, high, separation, bracketed=(carries, floats), count=count)
    raise ConvergenceError(
        f"mixed film: the balance of load misses {tolerance:.1e} by {abs(miss):.1e} after {FILMS} films",
        outcome=Outcome.STALLED,
        iterations=FILMS,
    )


def _next(
    at: Speed, load: float, low: float, high: float, last: float, *, bracketed: tuple[bool, bool], count: int
) -> float:
    """Where the guessed film and the asperities carry the load, within the bracket."""
    film = at.guess(last)

    def miss(place: float) -> float:
        return film(exp(place)) + at.film.contact_load(exp(place)) - load

    below, above = log(low), log(high)
    if all(bracketed) and count % BISECTED == BISECTED - 1:
        return exp((below + above) / 2)
    if not bracketed[1]:
        above = min(above, log(EXTENSION * last))
    if miss(above) >= 0:
        return exp(above if not bracketed[1] else (log(last) + above) / 2)
    if miss(below) <= 0:
        return exp(below if not bracketed[0] else (log(last) + below) / 2)
    found = float(brentq(miss, below, above, xtol=1e-14, rtol=1e-14))
    slack = 1e-3 * (above - below)
    return exp(min(max(found, below + slack), above - slack)) if all(bracketed) and count > 3 else exp(found)


def _too_much(at: Speed, pressure: float, most: float) -> InputError:
    return InputError(
        f"load: got {pressure:.6g} Pa over the nominal area; at {at.speed:.4g} m/s film and asperities carry at most "
        f"{most / at.film.area:.6g} Pa where they are known, down to a separation of "
        f"{at.film.asperities.closest:.4g} m; lower the load, or make a table that reaches further"
    )


def _floats(at: Speed, pressure: float, load: float) -> InputError:
    return InputError(
        f"load: got {pressure:.6g} Pa over the nominal area; at {at.speed:.4g} m/s the film carries "
        f"{load / at.film.area:.6g} Pa however far apart the walls are; raise the load or lower the ends' pressures"
    )
