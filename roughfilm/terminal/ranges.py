"""Numbers as people write series of them: "1MPa..1GPa:25", "1MPa, 10MPa", "50MPa"."""

import re
from collections.abc import Callable, Sequence

import numpy as np

from roughfilm.contact.foundation.errors import InputError

MOST = 1000
"""Numbers of one series."""

_UNIT = re.compile(r"^\s*[-+.\d]*([eE][-+]?\d+)?\s*")
"""What stands before a unit."""


def numbers_of(text: str, read: Callable[[str], float], *, option: str, what: str, example: str) -> tuple[float, ...]:
    """The numbers of A..B:N, of a list, or of a single one, rising, each once.

    A range has N of them, each by the same factor above the last, or by the same difference if it begins at 0. A unit
    may be left out where the last number has one: it counts for all.

    Parameters
    ----------
    read : the number that a text with a unit stands for, 0 or more; InputError or ValueError if none.
    option, what, example : for messages: "--loads", "load", "1MPa..1GPa:25".

    Raises
    ------
    InputError
        If the text says anything else.
    """
    place, told = f"{option} {text:.60}", f"write for example {example}"
    if ".." not in text:
        return tuple(sorted(set(_all(text.split(","), read, place, what, told))))
    ends, _, count = text.rpartition(":")
    if not (re.fullmatch(r"\s*[0-9]{1,6}\s*", count) and 2 <= int(count) <= MOST):
        raise InputError(f"{place}: a range ends with how many {what}s, 2 to {MOST}; {told}")
    first, last = _all(ends.split("..", 1), read, place, what, told)
    if not first < last:
        raise InputError(f"{place}: the first of a range must be below the last; {told}")
    spaced = np.geomspace if first > 0 else np.linspace
    inner = spaced(first, last, int(count))[1:-1]
    numbers = dict.fromkeys((first, *(float(number) for number in inner), last))
    if len(numbers) < int(count):
        raise InputError(f"{place}: its ends are too close for {int(count)} different {what}s; {told}")
    return tuple(numbers)


def _all(parts: Sequence[str], read: Callable[[str], float], place: str, what: str, told: str) -> list[float]:
    unit = _UNIT.sub("", parts[-1])
    numbers = []
    for part in parts:
        if not part.strip():
            raise InputError(f"{place}: a {what} is missing; {told}")
        try:
            numbers.append(read(part.strip() if _UNIT.sub("", part) else f"{part.strip()} {unit}"))
        except (InputError, ValueError) as error:
            raise InputError(f"{place}: {error}") from None
    return numbers
