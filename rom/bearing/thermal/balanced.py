"""The temperature of a film that is the one that its heat brings about: a safeguarded secant method."""

from collections.abc import Callable
from dataclasses import dataclass

from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.rom.lubricants.thermal.law import celsius

MAX_STEP = 20.0
"""Largest step of the temperature before the root is enclosed, K."""

MIN_STEP = 0.05
"""Smallest such step towards a temperature at which no film is found, K."""

HOTTEST = 773.15
"""Temperature above which no lubricant stays liquid, K, at which the search ends as a thermal runaway."""

MAX_SLOPE = 0.9
"""Largest slope dT_eq/dT of a step by the secant method; steeper ones take ``MAX_STEP``."""

SLOW = 0.5
"""Ratio of successive errors above which an enclosed root is approached by bisection."""

MAX_FILMS = 100
"""Largest number of films in one search."""

REMEDY = (
    "lower the speed, the load or the viscosity, supply more or colder lubricant, or give heat.heat_transfer and "
    "heat.area, by which the bearing gives off heat"
)
"""Remedy of a thermal runaway."""


@dataclass(frozen=True, kw_only=True)
class Balanced:
    """A temperature T, K, at which T_eq(T) = T, and the slope dT_eq/dT there."""

    temperature: float
    slope: float


def balanced(
    equilibrium: Callable[[float], float],
    first: float,
    *,
    slope: float = 0.0,
    coldest: float = 0.0,
    tolerance: float,
) -> Balanced:
    """Solve for the temperature at which the heat of a film is balanced, T_eq(T) = T.

    T_eq(T) is the temperature that the heat of a film whose lubricant is at T brings about. The friction of a given
    film falls with the viscosity, and so with T, while its flows grow or stay: T_eq falls, and one T is balanced. Under
    a load, or where asperities touch, T_eq may grow with T, and several T may be balanced; the search then returns the
    first one from ``first`` on at which T_eq crosses T from above, which is stable. It takes secant steps of at most
    ``MAX_STEP`` towards T_eq until the root is enclosed, and then secant steps that stay enclosed, or bisection.

    The film at the result is the last one that ``equilibrium`` was called for.

    Parameters
    ----------
    equilibrium : equilibrium(T), K.
    first : first temperature, K.
    slope : slope dT_eq/dT for the first step.
    coldest : lowest temperature, K.
    tolerance : error of the result, K.

    Raises
    ------
    InputError
        If friction heats the film at every temperature at which there is a film: thermal runaway.
    ConvergenceError
        If a film does not converge, or the temperature does not.

    Examples
    --------
    >>> found = balanced(lambda at: 320 - 0.5 * (at - 300), 300.0, tolerance=1e-6)
    >>> print(f"{found.temperature:.4f} {found.slope:.2f}")
    313.3333 -0.50
    """
    at, here, most = first, equilibrium(first) - first, MAX_STEP
    below, above = (first, None) if here > 0 else (None, first)
    before = abs(here) / SLOW
    for _ in range(MAX_FILMS):
        if abs(here) <= tolerance * (1 - min(slope, MAX_SLOPE)):
            return Balanced(temperature=at, slope=slope)
        if below is not None and above is not None:
            following = at + here / (1 - slope) if slope < 1 else above
            margin = 1e-3 * (above - below)
            if not below + margin < following < above - margin or abs(here) > SLOW * before:
                following = (below + above) / 2
        else:
            wanted = here / (1 - slope) if slope < MAX_SLOPE else here * MAX_STEP
            following = max(at + max(-most, min(most, wanted)), coldest)
        if following >= HOTTEST or following == at:
            raise InputError(_unbalanced(at, here, ""))
        try:
            there = equilibrium(following) - following
        except (InputError, ConvergenceError) as error:
            most = abs(following - at) / 4
            if most < MIN_STEP or (below is not None and above is not None):
                raise InputError(_unbalanced(at, here, f", and beyond it there is no film: {error}")) from None
            continue
        slope, before = 1 + (there - here) / (following - at), abs(here)
        at, here = following, there
        below, above = (at, above) if here > 0 else (below, at)
    raise ConvergenceError(f"heat_balance: the temperature still changes by {here:.2g} K after {MAX_FILMS} films")


def _unbalanced(at: float, excess: float, why: str) -> str:
    here, there = celsius(at), celsius(at + excess)
    if excess > 0:
        return (
            f"heat_balance: thermal runaway: friction heats the film further at every temperature, from {here} to "
            f"{there}{why}; {REMEDY}"
        )
    return (
        f"heat_balance: at {here} the film cools to {there}{why}; raise heat.surroundings or the temperature of the "
        "supply"
    )
