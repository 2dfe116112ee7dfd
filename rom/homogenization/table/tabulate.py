"""Tables of flow factors of an undeformed surface, refined where interpolation is not accurate enough."""

import time
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from functools import partial
from threading import Lock

import numpy as np

from roughfilm.contact.foundation.arrays import Array, unmasked
from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.contact.foundation.threads import workers
from roughfilm.rom.homogenization.cell import factors_of_correctors
from roughfilm.rom.homogenization.conductance import FaceRule
from roughfilm.rom.homogenization.factors import FlowFactors
from roughfilm.rom.homogenization.flow_factors import Estimated, checked_gap, flow_factors
from roughfilm.rom.homogenization.table.bisection import MAX_POINTS, bisected
from roughfilm.rom.homogenization.table.factor_table import (
    UNKNOWN_SLOPES,
    FactorTable,
    Point,
    relative_row,
    relative_rows,
)
from roughfilm.rom.homogenization.table.separation import Separations
from roughfilm.rom.ladder.model import Progress, silent

INTERPOLATION_TOLERANCE = 0.005
"""Default largest relative interpolation error."""

FIRST_POINTS = 9
"""Number of points before the refinement."""

SLOPE_STEP = 1e-5
"""Step of the separation over the mean gap in the derivatives of factors."""

MIN_GAP_RATIO = 1.001
"""Smallest ratio of the mean gaps of neighbouring points that is bisected."""

NEGLIGIBLE_PRESSURE_FLOW = 1e-4
"""Pressure flow, over that of a smooth film, below which errors are relative to this value."""

NEGLIGIBLE_SHEAR_FLOW = 1e-2
"""Couette flow, over that of a smooth film, below which errors are relative to this value."""

THICK_FILM = 16.0
"""First guess of the mean gap over the rms height above which roughness acts by its mean square alone."""


def tabulate(
    heights: Array,
    spacing: tuple[float, float],
    *,
    tolerance: float = INTERPOLATION_TOLERANCE,
    narrowest: float | None = None,
    rule: FaceRule = FaceRule.LINEAR,
    known: Iterable[Point] = (),
    keep: Callable[[Point], object] = lambda _point: None,
    threads: int = 1,
    progress: Progress = silent,
) -> FactorTable:
    """The table of flow factors of an undeformed surface, from sealing to thick films.

    Each point is predicted from its neighbours; an error below its own uncertainty counts as 0. Intervals of which this
    indicates an error above the tolerance are bisected, until there are 400 points or neighbours almost coincide; the
    table's ``interpolation_error`` then exceeds the tolerance.

    Parameters
    ----------
    heights : heights of one period, m, shape (nx, ny), positive towards the flat wall.
    spacing : (dx, dy), m.
    tolerance : largest interpolation error of A over √(A_ii A_jj) + 1e-4 ĥ³, of B over |B| + 0.01 ĥ, and at points
        without contact of d and e over d and of d + 3e, each beyond the uncertainty of the points. With contact d does
        not converge: at an edge <1/h> grows with the logarithm of the number of nodes.
    narrowest : mean gap of the first point, m; by default that at which the surface seals in both directions.
    known : points that are not solved again.
    keep : called with every new point, one at a time.
    threads : number of threads that solve cells.

    Raises
    ------
    InputError
        If the heights are not those of a rough surface, or the tolerance is not between 1e-6 and 1.
    ConvergenceError
        If a cell does not converge, or the tolerance is not met in a film of any thickness.
    """
    checked_tolerance(tolerance)
    body = Separations(heights=np.asarray(unmasked("heights", heights), dtype=np.float64))
    checked_gap(body.heights - np.min(body.heights) + 1.0, spacing)
    if body.rms == 0:
        raise InputError("heights: are all the same; give a rough surface (a smooth wall needs no flow factors)")
    before = {point.separation: point for point in known if point.load == 0}
    keeping = Lock()

    def solve(separation: float) -> Point:
        point = before.get(separation)
        if point is None:
            point = point_of(body.gap(separation), spacing, separation, rule=rule, deformed=False)
            with keeping:
                keep(point)
        return point

    ends = sorted(set(body.sealing())) if narrowest is None else [body.at_mean_gap(narrowest)]
    return refined(
        [partial(solve, separation) for separation in ends],
        lambda mean_gap: solve(body.at_mean_gap(mean_gap)),
        peak=body.peak,
        rms=body.rms,
        tolerance=tolerance,
        threads=threads,
        progress=progress,
    )


def checked_tolerance(tolerance: float) -> None:
    """Raise InputError unless the tolerance of a table is between 1e-6 and 1."""
    if not 1e-6 <= tolerance < 1:
        raise InputError(f"tolerance: got {tolerance!r}; it must be 1e-6 to 1")


def refined(
    first: Sequence[Callable[[], Point]],
    solve: Callable[[float], Point],
    *,
    peak: float,
    rms: float,
    tolerance: float,
    threads: int,
    progress: Progress,
) -> FactorTable:
    """A table from the narrowest gap to thick films, refined where interpolation is not accurate enough.

    Parameters
    ----------
    first : calls that give the points that the table holds in any case, the narrowest first.
    solve : solve(mean_gap), the point at a mean gap, m.
    peak, rms : highest point above the mean and rms height of the surface, m.
    tolerance : largest interpolation error, see :func:`tabulate`.
    threads : number of threads that call ``solve``.

    Raises
    ------
    ConvergenceError
        If a cell does not converge, or the tolerance is not met in a film of any thickness.
    """
    solved: dict[float, Point] = {}

    def add(call: Callable[[], Point]) -> Point:
        point = call()
        solved[point.mean_gap] = point
        return point

    def at(mean_gap: float) -> Point:
        return add(partial(solve, mean_gap))

    def made(points: Iterable[Point]) -> FactorTable:
        return FactorTable(points=tuple(sorted(points, key=lambda point: point.mean_gap)), peak=peak, rms=rms)

    def half_way(one: Point, two: Point) -> Point | None:
        if two.mean_gap < MIN_GAP_RATIO * one.mean_gap:
            return None
        return at(float(np.sqrt(one.mean_gap * two.mean_gap)))

    narrowest, *others = first
    lowest = add(narrowest).mean_gap
    gaps = np.geomspace(lowest, max(THICK_FILM * rms, 2 * lowest), FIRST_POINTS).tolist()[1:]
    with workers(threads) as pool:
        for _ in pool.map(add, [*others, *(partial(solve, gap) for gap in gaps)]):
            progress(len(solved) / 40, f"{len(solved)} points")
    while max(table_errors(table := made(solved.values()), at(2 * table.widest))) > tolerance:
        progress(len(solved) / (len(solved) + 20), f"{len(solved)} points")
        if len(solved) > MAX_POINTS:
            raise ConvergenceError(
                f"table of flow factors: at a mean gap of {table.widest:.3g} m, {table.widest / rms:.3g} times "
                f"the rms height, roughness still acts; loosen the tolerance of {tolerance:g}"
            )
    points = bisected(
        made(solved.values()).points,
        place=lambda point: float(np.log(point.mean_gap)),
        half_way=half_way,
        errors=lambda others, point: (*table_errors(made(others), point), 0.0),
        order=4,
        tolerance=tolerance,
        threads=threads,
        progress=progress,
    )
    progress(1.0, f"{len(points)} points")
    return made(with_friction_errors(points, made))


def point_of(gap: Array, spacing: tuple[float, float], separation: float, *, rule: FaceRule, deformed: bool) -> Point:
    """The point of a table for a gap, m, shape (nx, ny), at a separation, m; with slopes if it is not deformed."""
    cpu = time.thread_time()
    one = flow_factors(gap, spacing, rule=rule)
    slopes = UNKNOWN_SLOPES if deformed else _slopes(gap, spacing, one, rule)
    return replace(as_point(one, separation), cpu_s=time.thread_time() - cpu, slopes=slopes)


def as_point(estimated: Estimated, separation: float) -> Point:
    """The point of a table from flow factors at a separation, m, with unknown slopes."""
    return Point(
        separation=separation,
        contact=estimated.contact,
        factors=estimated.factors,
        uncertainty=estimated.uncertainty,
        unsolved=estimated.unsolved,
        iterations=estimated.iterations,
        residual=estimated.residual,
        cpu_s=0.0,
    )


def _slopes(gap: Array, spacing: tuple[float, float], solved: Estimated, rule: FaceRule) -> Array:
    """The derivatives of :func:`relative_row` with respect to ln ĥ of an undeformed surface, shape (7,).

    A, B and e are stationary in the correctors, which therefore stay as they are. In contact d and e have no
    derivatives: their integrals over the gap that opens at its edges diverge.
    """
    raised = np.where(gap > 0, gap + SLOPE_STEP * solved.factors.mean_gap, 0.0)
    after = factors_of_correctors(raised, spacing, solved.correctors, rule=rule)
    before = solved.factors
    slopes = (relative_row(after) - relative_row(before)) / np.log(after.mean_gap / before.mean_gap)
    flows = np.diag(before.pressure) > 0
    known = np.array([*flows, flows.all(), *flows, *(2 * [solved.contact == 0])])
    return np.asarray(np.where(known, slopes, np.nan))


def table_errors(table: FactorTable, point: Point) -> tuple[float, float]:
    """The errors of A and B, and of friction, of a table at a point that it lacks, in the measures of the tolerance.

    They are the parts beyond the uncertainty of the point, for friction also beyond that of the points beside it.
    Friction, which is d, e and d + 3e, counts where nothing touches.
    """
    h, row = point.mean_gap, relative_row(point.factors)
    error = np.abs(relative_rows(table, np.array([h]))[0] - row)
    beyond = (error - relative_row(replace(point.uncertainty, mean_gap=h)))[:5]
    sheared = np.hypot(row[3], row[4]) + NEGLIGIBLE_SHEAR_FLOW
    size = np.array([row[0], row[1], np.sqrt(row[0] * row[1]), sheared, sheared]) + NEGLIGIBLE_PRESSURE_FLOW
    flow = max(0.0, float(np.max(beyond / size)))
    if point.contact > 0:
        return flow, 0.0
    after = sum(other.mean_gap < h for other in table.points)
    near = (point, *table.points[max(0, after - 1) : after + 1])
    uncertain = np.max([_friction_parts(other.uncertainty, other.factors) for other in near], axis=0)
    return flow, max(0.0, float(np.max(_friction_errors(table, point) - uncertain)))


def with_friction_errors(points: Sequence[Point], table_of: Callable[[Sequence[Point]], FactorTable]) -> list[Point]:
    """The points in order, those in contact with the errors of friction of a table that lacks them or one beside them.

    In contact d depends on single nodes that hardly touch; more points do not reduce its error.
    """
    errors = [
        float(_friction_errors(table_of([*points[:i], *points[i + 1 :]]), point)[2]) if 0 < i < len(points) - 1 else 0.0
        for i, point in enumerate(points)
    ]
    return [
        replace(point, friction_missed=max(errors[max(0, i - 1) : i + 2])) if point.contact > 0 else point
        for i, point in enumerate(points)
    ]


def _friction_errors(table: FactorTable, point: Point) -> Array:
    """The errors of d, e and d + 3e of a table at a point that it lacks, over d, d and d + 3e, shape (3,)."""
    h, row = point.mean_gap, relative_row(point.factors)
    couette, shear_couette = np.abs(relative_rows(table, np.array([h]))[0] - row)[5:] / h
    return _friction_parts(replace(point.factors, couette=couette, shear_couette=shear_couette), point.factors)


def _friction_parts(part: FlowFactors, whole: FlowFactors) -> Array:
    """The d and e of a part over the whole d, and its d + 3e over that of the whole; infinite where that is 0."""
    parts = np.array([part.couette, part.shear_couette, part.couette + 3 * part.shear_couette])
    d, e = whole.couette, whole.shear_couette
    return np.asarray(np.divide(parts, [d, d, d + 3 * e], out=np.full(3, np.inf), where=d > 0))
