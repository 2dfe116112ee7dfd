"""The measured profile of a groove: depth at points along the wall, checked, and read from a file."""

import math
from itertools import pairwise
from pathlib import Path
from typing import Any

from roughfilm.contact.foundation.entries import plain_number
from roughfilm.rom.parts.columns_file import MOST, read_rows

Points = tuple[tuple[float, float], ...]
"""(position, depth) in m."""

FEWEST = 3
COLUMNS = {"position": "m", "depth": "m"}
HEADER = "position (um), depth (um)"


def checked(points: object) -> Points:
    """The points of a groove, from rows of two numbers in m or from a file of that name.

    Raises ValueError that says which row is wrong, and how.
    """
    if isinstance(points, str):
        try:
            return checked(read_rows(Path(points), COLUMNS, header=HEADER))
        except ValueError as error:
            raise ValueError(f"file {points!r:.200}: {error}") from error
    if not isinstance(points, list | tuple):
        raise ValueError(f"got {points!r:.60}; name a file, or give [[position, depth], ...] in m")
    if not FEWEST <= len(points) <= MOST:
        raise ValueError(f"got {len(points)} points; a groove needs {FEWEST} to {MOST} of them")
    rows = tuple(_row(row, number) for number, row in enumerate(points, 1))
    for number, ((before, _), (place, depth)) in enumerate(pairwise(rows), 2):
        if not place > before:
            raise ValueError(f"got position {place!r} m at point {number} after {before!r} m; positions must increase")
        if depth < 0:
            raise ValueError(f"got depth {depth!r} m at point {number}; depth counts downward and is never negative")
    for number in (0, -1):
        if rows[number][1] != 0:
            raise ValueError(
                f"got depth {rows[number][1]!r} m at the {'last' if number else 'first'} point; "
                "a groove begins and ends with depth 0"
            )
    if not any(depth > 0 for _, depth in rows):
        raise ValueError("got depth 0 at every point; a groove is deeper than that somewhere")
    return rows


def _row(row: Any, number: int) -> tuple[float, float]:
    if not isinstance(row, list | tuple) or len(row) != 2:
        raise ValueError(f"got {row!r:.60} as point {number}; write position and depth in m")
    place, depth = (plain_number(value) for value in row)
    if not (math.isfinite(place) and math.isfinite(depth)):
        raise ValueError(f"got {row!r} as point {number}; both numbers must be finite")
    return place, depth
