"""Refinement of a table by bisection, wherever interpolation is not accurate enough."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from itertools import pairwise, zip_longest
from typing import TypeVar

from roughfilm.contact.foundation.threads import workers
from roughfilm.rom.homogenization.table.factor_table import Point
from roughfilm.rom.ladder.model import Progress

Table = TypeVar("Table")

MAX_POINTS = 400
"""Largest number of points of a table; where factors jump, as over a plateau, more do not reduce the error."""


def bisected(
    points: Sequence[Point],
    *,
    half_way: Callable[[Point, Point], Point | None],
    made: Callable[[Sequence[Point]], Table],
    errors: Callable[[Table, Point], tuple[float, float]],
    tolerance: float,
    threads: int,
    progress: Progress,
) -> list[Point]:
    """All points of the refined table, each with its last interpolation errors ``missed`` and ``separation_missed``.

    Parameters
    ----------
    points : initial points in order.
    half_way : half_way(one, two), the point between two points; None if they are adjacent.
    made : made(points), the table of these points.
    errors : errors(table, point), the interpolation errors at a point that the table lacks: factors, separation.
    tolerance : largest of both errors for which the intervals on both sides of a point are not bisected.
    threads : number of threads that compute points.
    """
    all_points = list(points)
    missed = {point.mean_gap: (0.0, 0.0) for point in points}
    intervals = [(one, two, (0.0, 0.0)) for one, two in pairwise(points)]
    with workers(threads) as pool:
        while intervals:
            table = made(all_points)
            wider = []
            begun = intervals[: max(0, MAX_POINTS - len(all_points))]
            middles = pool.map(half_way, *zip(*((one, two) for one, two, _ in begun), strict=True)) if begun else ()
            for (one, two, before), middle in zip_longest(intervals, middles):
                progress(len(all_points) / (len(all_points) + len(intervals)), f"{len(all_points)} points")
                if middle is None:
                    for end in (one, two):
                        missed[end.mean_gap] = _larger(missed[end.mean_gap], before)
                    continue
                all_points.append(middle)
                error = errors(table, middle)
                if max(error) > tolerance:
                    wider += [(one, middle, error), (middle, two, error)]
                    error = (0.0, 0.0)
                missed[middle.mean_gap] = error
            intervals = wider
    return [
        replace(point, missed=factors, separation_missed=separation)
        for point in all_points
        for factors, separation in [missed[point.mean_gap]]
    ]


def _larger(one: tuple[float, float], other: tuple[float, float]) -> tuple[float, float]:
    return max(one[0], other[0]), max(one[1], other[1])
