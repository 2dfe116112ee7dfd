"""Placing the points of a table of flow factors: where interpolation between those before is not good enough."""

import time
from collections.abc import Callable, Iterable
from threading import Lock

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.threads import workers
from roughfilm.rom.homogenization.conductance import FaceRule
from roughfilm.rom.homogenization.flow_factors import checked_gap, flow_factors
from roughfilm.rom.homogenization.table.bisection import bisected
from roughfilm.rom.homogenization.table.factor_table import FactorTable, Point, relative_row, told_rows
from roughfilm.rom.homogenization.table.separation import Separations
from roughfilm.rom.ladder.model import Progress, silent

TOLERANCE = 0.005
"""Of the factors that the cells give."""

FIRST = 9
"""Points that are placed before any is judged."""

NEAREST = 1.001
"""How far apart the mean gaps of two points are at least."""

NEGLIGIBLE, LITTLE = 1e-4, 1e-2
"""Of a smooth film's: flow that pressure drives, and that sliding carries, below which errors are over this instead."""

THICK = 16.0
"""Times the rms height: the first guess of where a film is so thick that roughness counts by its mean square alone."""


def tabulate(
    heights: Array,
    spacing: tuple[float, float],
    *,
    tolerance: float = TOLERANCE,
    narrowest: float | None = None,
    rule: FaceRule = FaceRule.LINEAR,
    known: Iterable[Point] = (),
    keep: Callable[[Point], object] = lambda _point: None,
    threads: int = 1,
    progress: Progress = silent,
) -> FactorTable:
    """Flow factors of an undeformed surface from where it seals to thick films.

    Half-way between two points the cell is solved; where it is further from the interpolation than the tolerance, and
    than its own uncertainty, it is done again on both sides of it, until 400 points or next to none between them: the
    table's ``interpolation_error`` is then above the tolerance.

    Parameters
    ----------
    heights : of one period, shape (nx, ny), m, upward, towards the flat wall.
    spacing : (dx, dy), m.
    tolerance : what interpolation may add to A over √(A_ii A_jj) (or 1e-4 ĥ³, if that is more), to B over |B| + 0.01 ĥ,
        and without contact to d and e over d. In contact d has no limit to be near to: at an edge <1/h> grows with the
        logarithm of the nodes.
    narrowest : the mean gap of the first point, m; by default where nothing gets through in either direction.
    known : points that need not be solved again.
    keep : called with every new point, one at a time.
    threads : in which cells are solved at once.

    Raises
    ------
    InputError
        For heights that are no rough surface, or a tolerance that is not between 1e-6 and 1.
    ConvergenceError
        If a cell does not converge.
    """
    if not 1e-6 <= tolerance < 1:
        raise InputError(f"--tolerance: got {tolerance!r}; it must be 1e-6 to 1")
    body = Separations(heights=np.asarray(heights, dtype=np.float64))
    checked_gap(body.heights - np.min(body.heights) + 1.0, spacing)
    if body.rms == 0:
        raise InputError("heights: are all the same; a smooth wall needs no flow factors")
    before = {point.separation: point for point in known if point.load == 0}
    found: dict[float, Point] = {}
    keeping = Lock()

    def solve(separation: float) -> Point:
        point = before.get(separation)
        if point is None:
            point = point_of(body.gap(separation), spacing, separation, rule=rule)
            with keeping:
                keep(point)
        found[separation] = point
        return point

    def made(points: Iterable[Point]) -> FactorTable:
        return FactorTable(points=tuple(sorted(points, key=lambda point: point.mean_gap)), peak=body.peak, rms=body.rms)

    def half_way(one: Point, two: Point) -> Point | None:
        if two.mean_gap < NEAREST * one.mean_gap:
            return None
        return solve(body.at_mean_gap(float(np.sqrt(one.mean_gap * two.mean_gap))))

    low, *others = sorted(set(body.sealing())) if narrowest is None else [body.at_mean_gap(narrowest)]
    first = solve(low)
    last = max(THICK * body.rms, 2 * first.mean_gap)
    wanted = [*others, *map(body.at_mean_gap, np.geomspace(first.mean_gap, last, FIRST).tolist()[1:])]
    with workers(threads) as pool:
        for _ in pool.map(solve, wanted):
            progress(len(found) / 40, f"{len(found)} points")
    while beyond(table := made(found.values()), solve(body.at_mean_gap(2 * table.widest))) > tolerance:
        progress(len(found) / (len(found) + 20), f"{len(found)} points")
    points = bisected(
        made(found.values()).points,
        half_way=half_way,
        made=made,
        off=lambda table, point: (beyond(table, point), 0.0),
        tolerance=tolerance,
        threads=threads,
        progress=progress,
    )
    progress(1.0, f"{len(points)} points")
    return made(points)


def point_of(gap: Array, spacing: tuple[float, float], separation: float, *, rule: FaceRule) -> Point:
    """The flow factors of a gap, m, shape (nx, ny), as a point of a table."""
    cpu = time.thread_time()
    one = flow_factors(gap, spacing, rule=rule)
    return Point(
        separation=separation,
        contact=one.contact,
        factors=one.factors,
        uncertainty=one.uncertainty,
        unsolved=one.unsolved,
        iterations=one.iterations,
        residual=one.residual,
        cpu_s=time.thread_time() - cpu,
    )


def beyond(table: FactorTable, point: Point) -> float:
    """How far a table is from a point that it does not have, in the tolerance's measure; 0 within its uncertainty."""
    h, row, doubt = point.mean_gap, relative_row(point.factors), point.uncertainty
    a = doubt.pressure / h**3
    unsure = np.array([a[0, 0], a[1, 1], a[0, 1], *(doubt.shear / h), 0, 0])
    rub = np.inf if point.contact > 0 else row[5]
    carried = np.hypot(row[3], row[4]) + LITTLE
    size = np.array([row[0], row[1], np.sqrt(row[0] * row[1]), carried, carried, rub, rub]) + NEGLIGIBLE
    off = np.abs(told_rows(table, np.array([h]))[0] - row)
    return float(np.max(np.where(off > unsure, off / size, 0.0)))
