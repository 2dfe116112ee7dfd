"""Files of unfinished work: regular saves, and tables of flow factors that are completed from their file."""

import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from roughfilm.contact.foundation.errors import ConvergenceError
from roughfilm.contact.foundation.inputs import Inputs
from roughfilm.rom.homogenization.table.factor_table import FactorTable, Point
from roughfilm.rom.homogenization.table.separation import Separations
from roughfilm.rom.homogenization.table.store import known_points, save_table

SAVE_INTERVAL_S = 2.0
"""Shortest time between two regular saves, s."""

Work = Callable[[Sequence[Point], Callable[[Point], None]], FactorTable]


@contextmanager
def regular_saves(save: Callable[[], None], note: Callable[[], str]) -> Iterator[Callable[[], None]]:
    """Give the work a function that saves at most every ``SAVE_INTERVAL_S``, and save if the work is stopped or fails.

    Parameters
    ----------
    save : save(), writes the file.
    note : note(), the text that an interruption adds to its exception.
    """
    last = time.monotonic()

    def save_regularly() -> None:
        nonlocal last
        if time.monotonic() - last > SAVE_INTERVAL_S:
            save()
            last = time.monotonic()

    try:
        yield save_regularly
    except ConvergenceError:
        save()
        raise
    except (KeyboardInterrupt, SystemExit) as stop:
        save()
        stop.add_note(note())
        raise


def resumed_table(out: Path | None, inputs: Inputs, work: Work) -> tuple[FactorTable, int]:
    """The table that ``work(known, keep)`` makes, and the number of its points that were in the file.

    Parameters
    ----------
    out : path of the file; None to store nothing.
    inputs : the surface and the settings of the table.
    work : takes the points of the file for these inputs, and the function to call with each new point.

    Raises
    ------
    InputError
        If the file cannot be read or written, is damaged, or holds something else.
    """
    body = Separations(heights=inputs.heights)
    known = () if out is None else known_points(out, inputs)
    points = {_key(point): point for point in known}

    def save() -> None:
        if out is not None and len(points) > 1:
            ordered = tuple(sorted(points.values(), key=lambda point: point.mean_gap))
            save_table(out, inputs, FactorTable(points=ordered, peak=body.peak, rms=body.rms))

    def note() -> str:
        end = "; the same command goes on" if out is not None else ", none kept, as no file was named"
        return f"stopped: {len(points)} points{end}"

    with regular_saves(save, note) as save_regularly:

        def keep(point: Point) -> None:
            points[_key(point)] = point
            save_regularly()

        table = work(known, keep)
    points |= {_key(point): point for point in table.points}
    save()
    before = {_key(point) for point in known}
    return table, sum(_key(point) in before for point in table.points)


def _key(point: Point) -> tuple[float, float]:
    """The load of a point in contact, or the separation of a point without contact."""
    return point.load, 0.0 if point.load else point.separation
