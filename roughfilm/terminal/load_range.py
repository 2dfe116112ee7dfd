"""Loads and speeds as people write them: "1MPa..1GPa:25", "1MPa, 10MPa", "0, 30rpm, 2m/s"."""

import re

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.units import to_si
from roughfilm.terminal.ranges import numbers_of

LEAST, GREATEST = 1e-30, 1e30
"""Pa."""

FASTEST = 1e5
"""m/s."""


def loads_of(text: str) -> tuple[float, ...]:
    """The loads of A..B:N (N of them, each by the same factor above the last), of a list, or of a single one, rising.

    A unit may be left out where the last load has one: it counts for all.

    Returns
    -------
    Pa, each above 0 and once.

    Raises
    ------
    InputError
        If the text says anything else.

    Examples
    --------
    >>> loads_of("1..100MPa:3")
    (1000000.0, 10000000.0, 100000000.0)
    >>> loads_of("2MPa, 500kPa")
    (500000.0, 2000000.0)
    """
    return numbers_of(text, _pressure, option="--loads", what="load", example="1MPa..1GPa:25 or 1MPa,10MPa")


def _pressure(text: str) -> float:
    pressure = to_si(text, "Pa")
    if not pressure > 0:
        raise InputError(f"got {text}; a load must be above 0")
    if not LEAST <= pressure <= GREATEST:
        raise InputError(f"got {text}; look at the unit")
    return pressure


def speeds_of(text: str, radius: float | None) -> tuple[float, ...]:
    """The speeds of A..B:N, of a list, or of a single one, rising; evenly spaced if a range begins at 0.

    Parameters
    ----------
    text : in units of speed, or of turns ("rpm") where something turns.
    radius : at which the speed counts of what turns, m; None if nothing does.

    Returns
    -------
    m/s, each 0 or more and once.

    Raises
    ------
    InputError
        If the text says anything else.

    Examples
    --------
    >>> speeds_of("0..1m/s:3", None)
    (0.0, 0.5, 1.0)
    """

    def speed(text: str) -> float:
        if re.fullmatch(r"\s*0+(\.0*)?\s*", text):
            return 0.0
        try:
            found = to_si(text, "m/s")
        except ValueError:
            try:
                turns = to_si(text, "rad/s")
            except ValueError:
                raise InputError(f"got {text!r}; write a speed, for example '1 m/s' or '30 rpm'") from None
            if radius is None:
                raise InputError(f"got {text!r}, but nothing turns here; write a speed, for example '1 m/s'") from None
            found = turns * radius
        if not 0 <= found <= FASTEST:
            raise InputError(f"got {text}; a speed must be 0 or more, and {FASTEST:g} m/s at most")
        return found

    return numbers_of(text, speed, option="--speeds", what="speed", example="1rpm..600rpm:60 or 0,30rpm")
