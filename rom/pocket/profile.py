"""The measured profile of a groove: depth at points along the wall, as numbers or from a file."""

from itertools import pairwise

from roughfilm.rom.parts.columns_file import MAX_ROWS, number_pairs, read_rows

Points = tuple[tuple[float, float], ...]
"""Points (position, depth) in m."""

MIN_POINTS = 3
"""Smallest number of points of a groove."""

COLUMNS = {"position": "m", "depth": "m"}
HEADER = "position (um), depth (um)"


def checked(points: object) -> Points:
    """The points of a groove from rows of two numbers in m, or from the file of that name.

    Raises
    ------
    ValueError
        If a row is invalid, or the file cannot be read.
    """
    if isinstance(points, str):
        try:
            return checked(read_rows(points, COLUMNS, header=HEADER))
        except ValueError as error:
            raise ValueError(f"file {points!r:.200}: {error}") from error
    if not isinstance(points, list | tuple):
        raise ValueError(f"got {points!r:.60}; name a file, or give [[position, depth], ...] in m")
    if not MIN_POINTS <= len(points) <= MAX_ROWS:
        raise ValueError(f"got {len(points)} points; a groove needs {MIN_POINTS} to {MAX_ROWS} of them")
    rows = number_pairs(points, COLUMNS, name="point")
    for number, ((before, _), (place, depth)) in enumerate(pairwise(rows), 2):
        if place == before:
            raise ValueError(
                f"got two points at {place!r} m, numbers {number - 1} and {number}; films need walls of finite slope, "
                "move one of the two"
            )
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
        raise ValueError("got depth 0 at every point; give a depth above 0 somewhere")
    return rows
