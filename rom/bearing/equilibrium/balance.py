"""The film thickness at which a bearing carries a load: a bracketed root from few film solves."""

from collections.abc import Callable
from dataclasses import dataclass, field
from math import exp, inf, log
from typing import Generic, Protocol, TypeVar

import numpy as np
import scipy

from roughfilm.contact.foundation.errors import ConvergenceError, InputError, Outcome
from roughfilm.rom.cavitation.network import State
from roughfilm.rom.cavitation.solve import Level, Solution

MAX_FILMS = 60
"""Largest number of film solves for one load; three or four are usual."""

STEEPNESS = 1.5
"""Initial exponent n of a film's load over the separation, load ~ separation⁻ⁿ."""

STEEP = 20.0
"""Absolute value of the exponent above which the load is interpolated linearly: it goes to 0, as of a centred shaft."""

MAX_STEEPNESS = 1e3
"""Largest absolute value of the exponent between two films."""

MAX_EXPONENT = 600.0
"""Largest argument of the exponential function."""

MAX_EXTENSION = 4.0
"""Largest factor of the separation in a step without an upper bracket."""

MAX_REDUCTION = 16.0
"""Largest factor by which the separation is reduced in a step without a lower bracket."""

SCAN_RATIO = 2.0
"""Ratio of successive separations where the load is sampled, if the search without a bracket fails."""

MAX_SCANNED = 30
"""Largest number of these separations."""

BISECTION_INTERVAL = 8
"""Number of films after which the bracket is halved."""

SECANT_FILMS = 3
"""Number of films after which a guess keeps a distance from the ends of the bracket."""

BRACKET_MARGIN = 1e-3
"""That distance over the length of the bracket."""

ROUNDING = 1e-9
"""Largest load of a bearing over the wanted one that counts as none."""

NARROW_BRACKET = 1e-9
"""Length of the bracket over its upper end below which round-off of the films hides the load between its ends."""

ROUND_OFF = 1e-5
"""Largest relative error of the load in such a bracket; the result states it as that of its load."""

ORIGIN_DISTANCE = 0.1
"""Smallest distance from the origin of the power law, over the separation of first contact."""


class LoadedFilm(Protocol):
    """A converged film with its load."""

    @property
    def load(self) -> float:
        """The load of film and asperities, N."""
        ...

    @property
    def solution(self) -> Solution:
        """The film, whose state can start the next film."""
        ...


FilmT = TypeVar("FilmT", bound=LoadedFilm, covariant=True)


class SeparableBearing(Protocol[FilmT]):
    """A bearing that can be solved at any separation and speed, such as a mixed film."""

    @property
    def area(self) -> float:
        """The nominal area, m²."""
        ...

    @property
    def cells(self) -> int:
        """The number of cells along a side."""
        ...

    @property
    def closest(self) -> float:
        """The smallest separation that can be solved, m."""
        ...

    @property
    def touching(self) -> float:
        """The separation at which a search begins, m."""
        ...

    @property
    def widest(self) -> float:
        """The largest separation, m."""
        ...

    def at(self, separation: float, speed: float, start: State | None, /) -> FilmT:
        """Solve the film, starting from the state of another film if given."""
        ...

    def contact_load(self, separation: float, /) -> float:
        """The part of the load that is known without solving a film, N."""
        ...

    @property
    def remedy(self) -> str:
        """The remedy for a load that is too large, as the end of a sentence."""
        ...


@dataclass(kw_only=True)
class FilmsAtSpeed(Generic[FilmT]):
    """The solved films of one bearing at one speed.

    Attributes
    ----------
    film : the bearing.
    speed : sliding speed, m/s.
    loads : load of each solved film without its contact load, N, by the separation, m.
    solved : number of cells along and across, and of iterations, of each solved film.
    steepness : last exponent n of the load over the distance, load ~ distance⁻ⁿ; separations may be negative where
        asperities are flattened or bodies bend.
    """

    film: SeparableBearing[FilmT]
    speed: float
    loads: dict[float, float] = field(default_factory=dict)
    solved: list[Level] = field(default_factory=list)
    steepness: float = STEEPNESS

    def distance(self, separation: float) -> float:
        """The logarithm of the distance of a separation, m, from the origin of the power law."""
        return log(separation - min(0.0, self.film.closest - ORIGIN_DISTANCE * self.film.touching))

    def separation(self, distance: float) -> float:
        """The inverse of :meth:`distance`, m."""
        return exp(distance) + min(0.0, self.film.closest - ORIGIN_DISTANCE * self.film.touching)

    def at(self, separation: float, start: State | None) -> FilmT:
        """Solve the film at a separation, m, and store its load."""
        film = self.film.at(separation, self.speed, start)
        self.loads[separation] = film.load - self.film.contact_load(separation)
        self.solved.extend(film.solution.levels)
        return film

    def guess(self, near: float) -> Callable[[float], float]:
        """The load over the distance through the two solved films nearest to ``near``, as a power law or linear."""
        known = sorted((abs(self.distance(at) - near), self.distance(at), load) for at, load in self.loads.items())
        _, one, load = known[0]
        if len(known) > 1:
            _, two, other = known[1]
            steepness = -log(other / load) / (two - one) if load > 0 and other > 0 and two != one else inf
            if abs(steepness) < inf:
                self.steepness = float(np.clip(steepness, -MAX_STEEPNESS, MAX_STEEPNESS))
            if abs(steepness) > STEEP and two != one:
                return lambda place: load + (other - load) * (place - one) / (two - one)
        return lambda place: load * exp(min(-self.steepness * (place - one), MAX_EXPONENT))


def balanced(
    at: FilmsAtSpeed[FilmT],
    pressure: float,
    *,
    tolerance: float,
    guess: float | None = None,
    start: State | None = None,
    bracket: tuple[float, float] | None = None,
) -> FilmT:
    """Solve for the film whose load, together with that of the asperities, equals a pressure over the nominal area.

    The load falls with the separation. The contact load is known at any separation without a film solve; the load of
    the film is approximated by a power law through two solved films. This secant method is safeguarded by a bracket.

    Parameters
    ----------
    at : films at the speed, with those that were solved for other loads.
    pressure : the load over the nominal area, Pa.
    tolerance : relative error of the load at which the search stops.
    guess : initial separation, m.
    start : state of a film near the guess.
    bracket : a separation that carries more than the load and a larger one that carries less, m, if they are known.

    Raises
    ------
    InputError
        If the walls cannot carry the load at the smallest separation, or carry more at the largest one.
    ConvergenceError
        If a film or the load does not converge.
    """
    film, load = at.film, pressure * at.film.area
    low, high = bracket or (film.closest, film.widest)
    has_lower = has_upper = bracket is not None
    separation = min(max(film.touching if guess is None else guess, low), high)
    for count in range(MAX_FILMS):
        solved = at.at(separation, start)
        start = solved.solution.state
        error = solved.load / load - 1
        if abs(error) <= tolerance:
            return solved
        if error > 0:
            low, has_lower = separation, True
            if separation >= film.widest * (1 - 1e-12):
                raise _load_too_low(at, pressure, solved.load)
        else:
            high, has_upper = separation, True
            if separation <= film.closest:
                raise _load_too_high(at, pressure, solved.load)
        if has_lower and has_upper and high - low <= NARROW_BRACKET * abs(high) and abs(error) <= ROUND_OFF:
            return solved
        if has_lower and has_upper and at.distance(high) - at.distance(low) <= tolerance / MAX_STEEPNESS:
            raise _load_jumps(at, pressure, separation, error)
        separation = _next(at, load, low, high, separation, bracketed=(has_lower, has_upper), count=count)
    raise ConvergenceError(
        f"load: the relative error of the load is {abs(error):.1e} after {MAX_FILMS} films, above the tolerance "
        f"of {tolerance:.1e}; take more cells or a larger tolerance",
        outcome=Outcome.STALLED,
        iterations=MAX_FILMS,
    )


def _next(
    at: FilmsAtSpeed[FilmT],
    load: float,
    low: float,
    high: float,
    last: float,
    *,
    bracketed: tuple[bool, bool],
    count: int,
) -> float:
    """The next separation, m, within the bracket: the approximated film and the asperities carry the load there."""
    here, below, above = (at.distance(place) for place in (last, low, high))
    film = at.guess(here)

    def excess(place: float) -> float:
        separation = min(max(at.separation(place), low), high)
        return film(place) + at.film.contact_load(separation) - load

    if all(bracketed) and count % BISECTION_INTERVAL == BISECTION_INTERVAL - 1:
        return at.separation((below + above) / 2)
    if not bracketed[1]:
        above = min(above, here + log(MAX_EXTENSION))
    if not bracketed[0] and here - log(MAX_REDUCTION) > below:
        below = here - log(MAX_REDUCTION)
        low = at.separation(below)
    if excess(above) >= 0:
        return at.separation((here + above) / 2) if bracketed[1] else min(at.separation(above), high)
    if excess(below) <= 0:
        return at.separation((here + below) / 2) if bracketed[0] else low
    root = float(scipy.optimize.brentq(excess, below, above, xtol=1e-14, rtol=1e-14))
    if all(bracketed) and count > SECANT_FILMS:
        margin = BRACKET_MARGIN * (above - below)
        root = min(max(root, below + margin), above - margin)
    return min(max(at.separation(root), low), high)


def expected(at: FilmsAtSpeed[FilmT], separation: float, film_load: float, pressure: float) -> float:
    """The separation, m, that is expected to carry a pressure, from the load of the film at one without solving it.

    Parameters
    ----------
    at : films at the speed, with the exponent of their load.
    separation : a separation, m.
    film_load : load of the film there without its contact load, N.
    pressure : the load over the nominal area, Pa.
    """
    film = at.film
    if not film_load > 0:
        return separation
    known = FilmsAtSpeed(film=film, speed=at.speed, loads={separation: film_load}, steepness=at.steepness)
    ends = film.closest, film.widest
    return _next(known, pressure * film.area, *ends, separation, bracketed=(False, False), count=0)


def robustly_balanced(
    at: FilmsAtSpeed[FilmT],
    pressure: float,
    *,
    tolerance: float,
    guess: float | None = None,
    start: State | None = None,
) -> FilmT:
    """Solve as :func:`balanced`, also for films whose load has a maximum over the separation.

    If the search fails, or ends where the load grows with the separation, so that the film is unstable, the load is
    sampled from large to small separations, and the largest separation that carries the load is taken.

    Parameters
    ----------
    at, pressure, tolerance, guess, start : parameters of :func:`balanced`.

    Raises
    ------
    InputError
        If no separation carries the load, or all carry more.
    ConvergenceError
        If a film or the load does not converge.
    """
    failure: InputError | ConvergenceError | None = None
    film: FilmT | None = None
    try:
        film = balanced(at, pressure, tolerance=tolerance, guess=guess, start=start)
        if len(at.loads) == 1 or _falls(at):
            return film
    except (InputError, ConvergenceError) as error:
        failure = error
    load, place = pressure * at.film.area, at.film.widest
    known = [
        separation for separation, carried in at.loads.items() if carried + at.film.contact_load(separation) < load
    ]
    place = min(place, SCAN_RATIO**MAX_EXTENSION * max(known)) if known else place
    above: float | None = None
    for _ in range(MAX_SCANNED):
        try:
            carried = at.at(place, None).load
        except ConvergenceError:
            break
        if carried >= load and above is not None:
            return balanced(at, pressure, tolerance=tolerance, guess=place, bracket=(place, above))
        if carried < load:
            above = place
        if place <= at.film.closest:
            break
        place = max(place / SCAN_RATIO, at.film.closest)
    if failure is not None:
        found = {separation: one + at.film.contact_load(separation) for separation, one in at.loads.items()}
        if found and isinstance(failure, InputError) and min(found.values()) < load < found[max(found)]:
            raise InputError(
                f"load: got {pressure:.6g} Pa over the nominal area; at {at.speed:.4g} m/s it is carried only where "
                "the load of the film grows with its thickness, so that no equilibrium is stable; raise the load, or "
                "lower the pressures at the ends and of supplies"
            ) from None
        raise failure
    assert film is not None
    return film


def _falls(at: FilmsAtSpeed[FilmT]) -> bool:
    """Whether the load falls with the separation between the last two solved films."""
    (one, load), (two, other) = list(at.loads.items())[-2:]
    load, other = load + at.film.contact_load(one), other + at.film.contact_load(two)
    return (load - other) * (two - one) >= 0


def _load_too_high(at: FilmsAtSpeed[FilmT], pressure: float, largest: float) -> InputError:
    carried = {place: load + at.film.contact_load(place) for place, load in at.loads.items()}
    place = max(carried, key=lambda separation: carried[separation], default=at.film.closest)
    largest = max(largest, carried.get(place, largest))
    if largest <= ROUNDING * pressure * at.film.area:
        return InputError(
            f"load: got {pressure:.6g} Pa over the nominal area; no film carries a load at {at.speed:.4g} m/s, as the "
            "walls are parallel or widen along the sliding; give the wall a rise or pockets, or reverse the speed"
        )
    return InputError(
        f"load: got {pressure:.6g} Pa over the nominal area; at {at.speed:.4g} m/s film and walls carry at most "
        f"{largest / at.film.area:.6g} Pa on {at.film.cells} cells along a side, at a minimum film thickness of "
        f"{place:.4g} m; {at.film.remedy}"
    )


def _load_jumps(at: FilmsAtSpeed[FilmT], pressure: float, separation: float, error: float) -> ConvergenceError:
    return ConvergenceError(
        f"load: got {pressure:.6g} Pa over the nominal area; the load of the film jumps at a minimum film thickness of "
        f"{separation:.4g} m, where its relative error is {error:.1e}; take more cells, or another load",
        outcome=Outcome.STALLED,
        iterations=len(at.loads),
    )


def _load_too_low(at: FilmsAtSpeed[FilmT], pressure: float, load: float) -> InputError:
    return InputError(
        f"load: got {pressure:.6g} Pa over the nominal area; at {at.speed:.4g} m/s the film carries at "
        f"least {load / at.film.area:.6g} Pa at any separation; raise the load, or lower the "
        "pressures at the ends and of supplies"
    )
