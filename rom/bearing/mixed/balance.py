"""How far apart film and asperities hold the walls under a load: a root, bracketed and found by few films."""

from collections.abc import Callable
from dataclasses import dataclass, field
from math import exp, log
from typing import Generic, Protocol, TypeVar

import numpy as np
import scipy

from roughfilm.contact.foundation.errors import ConvergenceError, InputError, Outcome
from roughfilm.rom.cavitation.network import State
from roughfilm.rom.cavitation.solve import Solution

FILMS = 60
"""Solved for one load, at most; three or four are usual."""

STEEPNESS = 1.5
"""Of a film's load, as a power of the separation, before two films have told it."""

STEEPEST, LARGEST = 1e3, 600.0
"""Of the same, between two films; and of exponents."""

EXTENSION = 4.0
"""Times the separation, where no film has yet been found that carries too little."""

BISECTED, SECANTS, INSIDE = 8, 3, 1e-3
"""After so many films the bracket is halved; after so many a guess keeps this part of the bracket from its ends."""


NEAREST = 0.1
"""Of the separation of touching: least distance from the origin from which a film's power is counted."""


class Carrying(Protocol):
    """A film in balance."""

    @property
    def load(self) -> float:
        """All that it carries, N."""
        ...

    @property
    def solution(self) -> Solution:
        """The film, whose state others may begin from."""
        ...


Found = TypeVar("Found", bound=Carrying, covariant=True)


class Walls(Protocol[Found]):
    """A bearing at any separation and speed, as :class:`roughfilm.rom.bearing.mixed.film.MixedFilm` is one."""

    @property
    def area(self) -> float:
        """Nominal, m²."""
        ...

    @property
    def closest(self) -> float:
        """The least separation that can be asked for, m."""
        ...

    @property
    def touching(self) -> float:
        """The separation from which a search begins, m."""
        ...

    @property
    def widest(self) -> float:
        """The largest separation, m."""
        ...

    def at(self, separation: float, speed: float, start: State | None, /) -> Found:
        """The film in balance, from the state of another if there is one."""
        ...

    def contact_load(self, separation: float, /) -> float:
        """The part of the load that is known without a film, N."""
        ...


@dataclass(kw_only=True)
class Speed(Generic[Found]):
    """What films of one bearing carry at one speed, as far as they have been solved.

    ``loads`` by their separations, beside what is known without a film; ``steepness``, a power, of them as it was last
    seen. Separations may be below 0 where tips are crushed or bodies bent, so that powers are those of ``distance``.
    """

    film: Walls[Found]
    speed: float
    loads: dict[float, float] = field(default_factory=dict)
    steepness: float = STEEPNESS

    def distance(self, separation: float) -> float:
        """The logarithm of how far a separation is from one that is never reached; from 0 if none is below it."""
        return log(separation - min(0.0, self.film.closest - NEAREST * self.film.touching))

    def separation(self, distance: float) -> float:
        """The inverse of ``distance``, m."""
        return exp(distance) + min(0.0, self.film.closest - NEAREST * self.film.touching)

    def at(self, separation: float, start: State | None) -> Found:
        """Solve the film and remember its load."""
        found = self.film.at(separation, self.speed, start)
        self.loads[separation] = found.load - self.film.contact_load(separation)
        return found

    def guess(self, near: float) -> Callable[[float], float]:
        """What the film carries at other distances, as a power, from the two known ones nearest to one."""
        known = sorted((abs(self.distance(at) - near), self.distance(at), load) for at, load in self.loads.items())
        _, one, load = known[0]
        if len(known) > 1:
            _, two, other = known[1]
            if load > 0 and other > 0:
                self.steepness = float(np.clip(-log(other / load) / (two - one), -STEEPEST, STEEPEST))
            else:
                return lambda place: load + (other - load) * (place - one) / (two - one)
        return lambda place: load * exp(min(-self.steepness * (place - one), LARGEST))


def balanced(
    at: Speed[Found],
    pressure: float,
    *,
    tolerance: float,
    guess: float | None = None,
    start: State | None = None,
) -> Found:
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
    low, high = film.closest, film.widest
    carries, floats = False, False
    separation = min(max(film.touching if guess is None else guess, low), high)
    for count in range(FILMS):
        found = at.at(separation, start)
        start = found.solution.state
        miss = found.load / load - 1
        if abs(miss) <= tolerance:
            return found
        if miss > 0:
            low, carries = separation, True
            if separation >= film.widest * (1 - 1e-12):
                raise _floats(at, pressure, found.load)
        else:
            high, floats = separation, True
            if separation <= film.closest:
                raise _too_much(at, pressure, found.load)
        separation = _next(at, load, low, high, separation, bracketed=(carries, floats), count=count)
    raise ConvergenceError(
        f"mixed film: the balance of load misses {tolerance:.1e} by {abs(miss):.1e} after {FILMS} films",
        outcome=Outcome.STALLED,
        iterations=FILMS,
    )


def _next(
    at: Speed[Found], load: float, low: float, high: float, last: float, *, bracketed: tuple[bool, bool], count: int
) -> float:
    """Where the guessed film and the asperities carry the load, within the bracket."""
    here, below, above = (at.distance(place) for place in (last, low, high))
    film = at.guess(here)

    def miss(place: float) -> float:
        separation = min(max(at.separation(place), low), high)
        return film(place) + at.film.contact_load(separation) - load

    if all(bracketed) and count % BISECTED == BISECTED - 1:
        return at.separation((below + above) / 2)
    if not bracketed[1]:
        above = min(above, here + log(EXTENSION))
    if miss(above) >= 0:
        return at.separation((here + above) / 2) if bracketed[1] else min(at.separation(above), high)
    if miss(below) <= 0:
        return at.separation((here + below) / 2) if bracketed[0] else low
    found = float(scipy.optimize.brentq(miss, below, above, xtol=1e-14, rtol=1e-14))
    if all(bracketed) and count > SECANTS:
        slack = INSIDE * (above - below)
        found = min(max(found, below + slack), above - slack)
    return min(max(at.separation(found), low), high)


def _too_much(at: Speed[Found], pressure: float, most: float) -> InputError:
    return InputError(
        f"load: got {pressure:.6g} Pa over the nominal area; at {at.speed:.4g} m/s film and asperities carry at most "
        f"{most / at.film.area:.6g} Pa where they are known, down to a separation of "
        f"{at.film.closest:.4g} m; lower the load, or make a table that reaches further"
    )


def _floats(at: Speed[Found], pressure: float, load: float) -> InputError:
    return InputError(
        f"load: got {pressure:.6g} Pa over the nominal area; at {at.speed:.4g} m/s the film carries "
        f"{load / at.film.area:.6g} Pa however far apart the walls are; raise the load or lower the ends' pressures"
    )
