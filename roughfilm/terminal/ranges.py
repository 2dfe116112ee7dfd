"""Loads and speeds as people write them: "1MPa..1GPa:25", "1MPa, 10MPa", "5kN", "0, 30rpm, 2m/s"."""

import re
from collections.abc import Callable, Sequence
from functools import partial

import numpy as np

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.ranges import RANGES
from roughfilm.contact.foundation.units import rotational_speed, to_si

MAX_COUNT = 1000
"""The longest series of numbers."""

_BEFORE_UNIT = re.compile(r"^\s*[-+.\d]*([eE][-+]?\d+)?\s*")


def loads_of(text: str, area: float | None = None) -> tuple[float, ...]:
    """The loads of a range A..B:N (N loads by a constant factor), of a list, or of a single number, rising.

    A unit may be left out where the last load has one: it counts for all.

    Parameters
    ----------
    text : pressures, or forces on the nominal area.
    area : nominal area, m²; without it a force is refused.

    Returns
    -------
    Pa, each above 0 and once.

    Raises
    ------
    InputError
        For any other text.

    Examples
    --------
    >>> loads_of("1..100MPa:3")
    (1000000.0, 10000000.0, 100000000.0)
    >>> loads_of("2MPa, 500kPa")
    (500000.0, 2000000.0)
    >>> loads_of("5kN", area=0.01)
    (500000.0,)
    """
    return _numbers_of(
        text, partial(_pressure, area=area), option="--loads", what="load", example="1MPa..1GPa:25 or 1MPa,10MPa"
    )


def _pressure(text: str, area: float | None) -> float:
    force = None if area is None else _force(text)
    pressure = to_si(text, "Pa") if force is None or area is None else force / area
    if not pressure > 0:
        raise InputError(f"got {text}; a load must be above 0")
    if pressure not in RANGES["Pa"]:
        raise InputError(f"got {text}, {pressure:.3g} Pa; a load must be {RANGES['Pa']} Pa, check the unit")
    return pressure


def _force(text: str) -> float | None:
    """The force of a text, N; None if it is none."""
    try:
        return to_si(text, "N")
    except ValueError:
        return None


def speeds_of(text: str, radius: float | None) -> tuple[float, ...]:
    """The speeds of a range A..B:N, of a list, or of a single number, rising; evenly spaced if a range begins at 0.

    Parameters
    ----------
    text : speeds, or rotational speeds ("rpm") of a bearing that turns.
    radius : radius at which a rotational speed gives the sliding speed, m; None if nothing turns.

    Returns
    -------
    m/s, each 0 or more and once.

    Raises
    ------
    InputError
        For any other text.

    Examples
    --------
    >>> speeds_of("0..1m/s:3", None)
    (0.0, 0.5, 1.0)
    """

    def speed(text: str) -> float:
        if re.fullmatch(r"\s*0+(\.0*)?\s*", text):
            return 0.0
        turning = rotational_speed(text)
        if turning is not None and radius is None:
            raise InputError(f"got {text!r}, but nothing turns here; write a speed, for example '1 m/s'")
        sliding = to_si(text, "m/s") if turning is None or radius is None else turning * radius
        if not sliding >= 0 or sliding not in RANGES["m/s"]:
            raise InputError(f"got {text}; a speed must be 0 or {RANGES['m/s']} m/s, check the unit")
        return sliding

    return _numbers_of(text, speed, option="--speeds", what="speed", example="1rpm..600rpm:60 or 0,30rpm")


def _numbers_of(text: str, read: Callable[[str], float], *, option: str, what: str, example: str) -> tuple[float, ...]:
    """The numbers of a range, of a list, or of a single one; ``read`` turns a text with a unit into a number."""
    place, remedy = f"{option} {text:.60}", f"write for example {example}"

    def numbers(parts: Sequence[str]) -> list[float]:
        unit = _BEFORE_UNIT.sub("", parts[-1])
        if any(not part.strip() for part in parts):
            raise InputError(f"{place}: a {what} is missing; {remedy}")
        try:
            return [read(part.strip() if _BEFORE_UNIT.sub("", part) else f"{part.strip()} {unit}") for part in parts]
        except (InputError, ValueError) as error:
            raise InputError(f"{place}: {error}") from None

    if ".." not in text:
        return tuple(sorted(set(numbers(text.split(",")))))
    ends, _, count = text.rpartition(":")
    if not (re.fullmatch(r"\s*[0-9]{1,6}\s*", count) and 2 <= int(count) <= MAX_COUNT):
        raise InputError(f"{place}: a range ends with how many {what}s, 2 to {MAX_COUNT}; {remedy}")
    first, last = numbers(ends.split("..", 1))
    if not first < last:
        raise InputError(f"{place}: the first of a range must be below the last; {remedy}")
    spaced = np.geomspace if first > 0 else np.linspace
    series = dict.fromkeys((first, *(float(number) for number in spaced(first, last, int(count))[1:-1]), last))
    if len(series) < int(count):
        raise InputError(f"{place}: its ends are too close for {int(count)} different {what}s; {remedy}")
    return tuple(series)


def in_si(option: str, text: str, unit: str) -> float:
    """The number of an option with a unit, such as "0.4mm", in an SI unit or per cent; InputError if it has none."""
    try:
        return to_si(text.strip(), unit)
    except ValueError as error:
        raise InputError(f"{option}: {error}") from None
