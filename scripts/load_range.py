"""Loads as people write them: "1MPa..1GPa:25", "1MPa, 10MPa", "50MPa"."""

import re
from collections.abc import Sequence

import numpy as np

from contact.errors import InputError
from contact.units import to_si

MOST = 1000
"""Loads of one series."""

LEAST, GREATEST = 1e-30, 1e30
"""Pa."""

_UNIT = re.compile(r"^\s*[-+.\d]*([eE][-+]?\d+)?\s*")
"""What stands before a unit."""

EXAMPLE = "write for example 1MPa..1GPa:25 or 1MPa,10MPa"


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
    if ".." not in text:
        return tuple(sorted(set(_pressures(text, text.split(",")))))
    ends, _, count = text.rpartition(":")
    if not (re.fullmatch(r"\s*[0-9]{1,6}\s*", count) and 2 <= int(count) <= MOST):
        raise InputError(f"--loads {text:.60}: a range ends with how many loads, 2 to {MOST}; {EXAMPLE}")
    first, last = _pressures(text, ends.split("..", 1))
    if not first < last:
        raise InputError(f"--loads {text}: the first of a range must be below the last; {EXAMPLE}")
    inner = np.geomspace(first, last, int(count))[1:-1]
    loads = dict.fromkeys((first, *(float(load) for load in inner), last))
    if len(loads) < int(count):
        raise InputError(f"--loads {text}: its ends are too close for {int(count)} different loads; {EXAMPLE}")
    return tuple(loads)


def _pressures(text: str, parts: Sequence[str]) -> list[float]:
    unit = _UNIT.sub("", parts[-1])
    pressures = []
    for part in parts:
        if not part.strip():
            raise InputError(f"--loads {text}: a load is missing; {EXAMPLE}")
        told = part if _UNIT.sub("", part) else f"{part.strip()} {unit}"
        try:
            pressure = to_si(told.strip(), "Pa")
        except ValueError as error:
            raise InputError(f"--loads {text}: {error}") from None
        if not pressure > 0:
            raise InputError(f"--loads {text}: got {part.strip()}; a load must be above 0")
        if not LEAST <= pressure <= GREATEST:
            raise InputError(f"--loads {text}: got {part.strip()}; look at the unit")
        pressures.append(pressure)
    return pressures
