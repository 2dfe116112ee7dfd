"""Placing the points of a table: half-way between two, wherever interpolation is not good enough there."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from itertools import pairwise, zip_longest
from typing import TypeVar

from roughfilm.contact.foundation.threads import workers
from roughfilm.rom.homogenization.table.factor_table import Point
from roughfilm.rom.ladder.model import Progress

Table = TypeVar("Table")

MOST = 400
"""Points; where factors jump, as over a plateau, more help nothing."""


def bisected(
    points: Sequence[Point],
    *,
    half_way: Callable[[Point, Point], Point | None],
    made: Callable[[Sequence[Point]], Table],
    off: Callable[[Table, Point], tuple[float, float]],
    tolerance: float,
    threads: int,
    progress: Progress,
) -> list[Point]:
    """All points, each with the errors that were last seen beside it: ``missed`` and ``separation_missed``.

    Parameters
    ----------
    points : in order.
    half_way : the point half-way between two; None where they are next to each other.
    made : the table of some points.
    off : by how much a table that does not have a point misses it, in factors and in the separation, in one measure.
    threads : in which points are made at once.
    tolerance : where one of them exceeds it, both sides of the point are tried.
    """
    found = list(points)
    missed = {point.mean_gap: (0.0, 0.0) for point in points}
    intervals = [(one, two, (0.0, 0.0)) for one, two in pairwise(points)]
    with workers(threads) as pool:
        while intervals:
            table = made(found)
            wider = []
            begun = intervals[: max(0, MOST - len(found))]
            middles = pool.map(half_way, *zip(*((one, two) for one, two, _ in begun), strict=True)) if begun else ()
            for (one, two, before), middle in zip_longest(intervals, middles):
                progress(len(found) / (len(found) + len(intervals)), f"{len(found)} points")
                if middle is None:
                    for end in (one, two):
                        missed[end.mean_gap] = _larger(missed[end.mean_gap], before)
                    continue
                found.append(middle)
                error = off(table, middle)
                if max(error) > tolerance:
                    wider += [(one, middle, error), (middle, two, error)]
                    error = (0.0, 0.0)
                missed[middle.mean_gap] = error
            intervals = wider
    return [
        replace(point, missed=factors, separation_missed=separation)
        for point in found
        for factors, separation in [missed[point.mean_gap]]
    ]


def _larger(one: tuple[float, float], other: tuple[float, float]) -> tuple[float, float]:
    return max(one[0], other[0]), max(one[1], other[1])
