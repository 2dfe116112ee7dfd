"""A table of flow factors that grows in a file: what was finished is kept whenever the work ends."""

import time
from collections.abc import Callable, Sequence
from pathlib import Path

from roughfilm.contact.foundation.errors import ConvergenceError
from roughfilm.contact.foundation.inputs import Inputs
from roughfilm.rom.homogenization.table.factor_table import FactorTable, Point
from roughfilm.rom.homogenization.table.separation import Separations
from roughfilm.rom.homogenization.table.store import known_points, save_table

EVERY_S = 2.0
"""Between two writings."""

Work = Callable[[Sequence[Point], Callable[[Point], None]], FactorTable]


def kept_table(out: Path | None, inputs: Inputs, work: Work) -> tuple[FactorTable, int]:
    """The table that ``work(known, keep)`` makes, and how many of its points were in the file.

    Parameters
    ----------
    out : the file; None to keep nothing.
    work : takes the points that the file has for these inputs, and what to call with every new one.

    Raises
    ------
    InputError
        If the file cannot be read or written, was damaged, or holds something else.
    """
    body = Separations(heights=inputs.heights)
    known = () if out is None else known_points(out, inputs)
    found = {_key(point): point for point in known}
    kept = time.monotonic()

    def save() -> None:
        if out is not None and len(found) > 1:
            points = tuple(sorted(found.values(), key=lambda point: point.mean_gap))
            save_table(out, inputs, FactorTable(points=points, peak=body.peak, rms=body.rms))

    def keep(point: Point) -> None:
        nonlocal kept
        found[_key(point)] = point
        if time.monotonic() - kept > EVERY_S:
            save()
            kept = time.monotonic()

    try:
        table = work(known, keep)
    except ConvergenceError:
        save()
        raise
    except (KeyboardInterrupt, SystemExit) as stop:
        save()
        end = "; the same command goes on" if out is not None else ", none kept, as no file was named"
        stop.add_note(f"stopped: {len(found)} points{end}")
        raise
    found |= {_key(point): point for point in table.points}
    save()
    before = {_key(point) for point in known}
    return table, sum(_key(point) in before for point in table.points)


def _key(point: Point) -> tuple[float, float]:
    """Of a pressed surface its load, of an open one its separation."""
    return point.load, 0.0 if point.load else point.separation
