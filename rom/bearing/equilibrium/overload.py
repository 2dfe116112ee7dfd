"""Loads that no speed of a curve carries."""

from collections.abc import Callable, Sequence

from roughfilm.contact.foundation.errors import ConvergenceError, InputError

FEWEST_SPEEDS = 4
"""Smallest number of speeds for which some are tried first."""


def refuse_overload(at: Callable[[float], object], speeds: Sequence[float]) -> None:
    """Raise the error of the largest speed of a curve, if it and the middle one are refused like the smallest one.

    It saves the other speeds of a curve whose load is too large. Nothing is raised where a film does not converge.

    Parameters
    ----------
    at : at(speed), solves the bearing at a speed, m/s.
    speeds : the speeds in increasing order, of which the first one has been refused.

    Raises
    ------
    InputError
        If the bearing is refused at both speeds.
    """
    if len(speeds) < FEWEST_SPEEDS:
        return
    try:
        at(speeds[len(speeds) // 2])
    except ConvergenceError:
        return
    except InputError:
        try:
            at(speeds[-1])
        except ConvergenceError:
            return
