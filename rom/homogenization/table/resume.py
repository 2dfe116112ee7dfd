"""Files of unfinished work: regular saves, and tables of flow factors that are completed from their file."""

import time
from collections.abc import Callable, Iterable, Iterator, Sequence
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
    note : note(), the text that an interruption adds to its exception if that has none.
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
        if not hasattr(stop, "__notes__"):
            stop.add_note(note())
        raise


def resumed_table(out: Path | None, inputs: Inputs, work: Work) -> tuple[FactorTable, int]:
    """The table that ``work(known, keep)`` makes, and the number of its points that it did not solve.

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
    known = () if out is None else known_points(out, inputs)

    def save(points: Sequence[Point]) -> None:
        if out is not None:
            save_table(out, inputs, table_of(points, inputs))

    end = "; the same command goes on" if out is not None else ", none kept, as no file was named"
    table, new = grown_table(known, work, save, f"points{end}")
    return table, len(table.points) - len(new & {key_of(point) for point in table.points})


def grown_table(
    known: Sequence[Point], work: Work, save: Callable[[Sequence[Point]], None], note: str
) -> tuple[FactorTable, set[tuple[float, float]]]:
    """The table that ``work(known, keep)`` makes, and the keys of the points that it solved.

    Parameters
    ----------
    known : points that are not solved again.
    work : makes the table.
    save : save(points), called with two or more points regularly, at the end, and if the work is stopped or fails.
    note : text that an interruption adds to its exception, behind the number of points.
    """
    points = {key_of(point): point for point in known}
    new: set[tuple[float, float]] = set()

    def save_all() -> None:
        if len(points) > 1:
            save(sorted(points.values(), key=lambda point: point.mean_gap))

    with regular_saves(save_all, lambda: f"stopped: {len(points)} {note}") as save_regularly:

        def keep(point: Point) -> None:
            points[key_of(point)] = point
            new.add(key_of(point))
            save_regularly()

        table = work(known, keep)
    points |= {key_of(point): point for point in table.points}
    save_all()
    return table, new


def table_of(points: Iterable[Point], inputs: Inputs) -> FactorTable:
    """A table of points in order of the mean gap, of the surface of the inputs."""
    body = Separations(heights=inputs.heights)
    return FactorTable(points=tuple(points), peak=body.peak, rms=body.rms)


def key_of(point: Point) -> tuple[float, float]:
    """The load of a point in contact, or the separation of a point without contact."""
    return point.load, 0.0 if point.load else point.separation
