"""Refinement of a table by bisection, wherever interpolation is not accurate enough."""

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.threads import workers
from roughfilm.rom.homogenization.table.factor_table import Point
from roughfilm.rom.ladder.model import Progress

ERRORS = ("missed", "friction_missed", "separation_missed")
"""The attributes of a point that hold estimated interpolation errors."""

MAX_POINTS = 400
"""Largest number of points of a table; where factors jump, as over a plateau, more do not reduce the error."""

NEIGHBOURS = 3
"""Number of points on each side from which a point is predicted; a monotone cubic depends on two on each side."""

SAFETY_FACTOR = 2.0
"""Safety factor of the error of an interval that is scaled from the errors of the predictions of its ends."""

LEAST_ERROR = 1e-12
"""Smallest estimated error to which a found error is compared."""


def bisected(
    points: Sequence[Point],
    *,
    place: Callable[[Point], float],
    half_way: Callable[[Point, Point], Point | None],
    errors: Callable[[Sequence[Point], Point], tuple[float, ...]],
    order: int,
    tolerance: float,
    threads: int,
    progress: Progress,
) -> list[Point]:
    """All points of the refined table in order, each with the errors beside it that are its ``ERRORS``.

    Every inner point is predicted from its neighbours. As an interpolation of order n has the error
    C (x − x₁)^(n/2) (x₂ − x)^(n/2), that of the interval of length l before the point is estimated as the error of the
    prediction times 2 (l/4r)^(n/2) with the length r of the interval after it, and at most the error of the prediction,
    which counts in full at the ends of the table, where the course may be singular.
    Where the middle of a bisected interval shows a larger error than had been estimated, as at a jump, the estimates
    of both halves are larger by the same ratio. Intervals are bisected until their errors are below the tolerance,
    there are 400 points, or neighbours almost coincide.

    Parameters
    ----------
    points : initial points in order.
    place : place(point), the variable of the interpolation.
    half_way : half_way(one, two), the point between two points; None if they almost coincide.
    errors : errors(others, point), the interpolation errors of a table of others at a point, its ``ERRORS``.
    order : n.
    tolerance : largest of all errors of an interval that is not bisected.
    threads : number of threads that compute points.
    """
    points, ratios = list(points), np.ones((len(points) - 1, len(ERRORS)))
    ended = np.zeros(len(points) - 1, dtype=bool)
    known: dict[tuple[float, ...], Array] = {}

    def error_of(before: Sequence[Point], point: Point, after: Sequence[Point]) -> Array:
        """The error of the prediction of a point from those before and after it."""
        others = [*before[-NEIGHBOURS:], *after[:NEIGHBOURS]]
        key = tuple(map(place, [point, *others]))
        if key not in known:
            known[key] = np.array(errors(others, point))
        return known[key]

    with workers(threads) as pool:
        while True:
            predictions = [error_of(points[:i], points[i], points[i + 1 :]) for i in range(1, len(points) - 1)]
            plain, largest = _estimates([*map(place, points)], predictions, order)
            left = np.minimum(plain * ratios, largest)
            wide = np.flatnonzero((left.max(axis=1) > tolerance) & ~ended)
            wide = wide[np.argsort(-left[wide].max(axis=1), kind="stable")][: max(0, MAX_POINTS - len(points))]
            if not wide.size:
                break
            found: dict[int, Point] = {}
            pairs = ([points[i + end] for i in wide] for end in (0, 1))
            for i, middle in zip(wide.tolist(), pool.map(half_way, *pairs), strict=True):
                progress(len(points) / (len(points) + wide.size), f"{len(points) + len(found)} points")
                if middle is None:
                    ended[i] = True
                    continue
                found[i] = middle
                error = error_of(points[: i + 1], middle, points[i + 1 :])
                ratios[i] = np.maximum(1.0, error / np.maximum(plain[i], LEAST_ERROR))
            repeats = np.array([2 if i in found else 1 for i in range(len(ratios))])
            ratios, ended = np.repeat(ratios, repeats, axis=0), np.repeat(ended, repeats)
            points = [point for i, own in enumerate(points) for point in ([own, found[i]] if i in found else [own])]
    beside = np.maximum(np.vstack([left[:1], left]), np.vstack([left, left[-1:]])).tolist()
    return [replace(point, **dict(zip(ERRORS, own, strict=True))) for point, own in zip(points, beside, strict=True)]


def _estimates(places: Sequence[float], predictions: Sequence[Array], order: int) -> tuple[Array, Array]:
    """The estimated errors of intervals, and the largest errors of the predictions of their ends, shape (n, 3) each."""
    if not predictions:
        return np.full((1, len(ERRORS)), np.inf), np.full((1, len(ERRORS)), np.inf)
    inner, lengths = np.array(predictions), np.abs(np.diff(places))
    neighbour = (lengths[1:] / lengths[:-1])[:, None]
    before, after = (SAFETY_FACTOR * inner * (ratio / 4) ** (order / 2) for ratio in (neighbour, 1 / neighbour))
    plain, largest = np.zeros((2, lengths.size, len(ERRORS)))
    plain[1:], largest[1:] = before, inner
    plain[:-1], largest[:-1] = np.maximum(plain[:-1], after), np.maximum(largest[:-1], inner)
    plain[[0, -1]] = largest[[0, -1]]
    return plain, largest
