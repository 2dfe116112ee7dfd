"""Computation of tables of flow factors and contact pressures, from thick films to flattened asperities."""

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from itertools import pairwise
from threading import Lock

import numpy as np

from roughfilm.contact.foundation.arrays import Array, unmasked
from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.contact.foundation.threads import workers
from roughfilm.contact.mechanics.contact import Contact
from roughfilm.contact.mechanics.moments import wave_power
from roughfilm.contact.mechanics.press import Press
from roughfilm.rom.bearing.mixed.asperity_table import AsperityTable
from roughfilm.rom.homogenization.conductance import FaceRule
from roughfilm.rom.homogenization.table.bisection import bisected
from roughfilm.rom.homogenization.table.factor_table import Point
from roughfilm.rom.homogenization.table.separation import Separations
from roughfilm.rom.homogenization.table.tabulate import (
    INTERPOLATION_TOLERANCE,
    point_of,
    table_errors,
    tabulate,
    with_friction_errors,
)
from roughfilm.rom.ladder.model import Progress, silent

CONTACT_TOLERANCE = 1e-6
"""Complementarity error of contacts over the rms height."""

MIN_LOAD_RATIO = 1.05
"""Smallest ratio of two neighbouring loads."""

LOAD_STEP = 4.0
"""Ratio of successive loads with light contact."""

SHORT_LOAD_STEP = 1.5
"""Ratio of successive loads with heavier contact."""

LIGHT_CONTACT = 0.1
"""Fraction of the surface in contact that separates light and heavier contact."""

MAX_HARDNESS_RATIO = 0.9
"""Largest load over the hardness in a default series of loads."""

MAX_CONTACT = 0.9
"""Largest fraction of the surface in contact in a default series of loads."""

MIN_COARSE_NODES = 8
"""Smallest number of nodes along a side of the coarser grid for the uncertainty of separations."""

GRID_SAFETY_FACTOR = 1.5
"""Safety factor of the difference of two grids, at first order."""


def tabulate_pressed(
    heights: Array,
    spacing: tuple[float, float],
    composite_modulus: float,
    *,
    hardness: float = math.inf,
    loads: Sequence[float] | None = None,
    required_load: float = 0.0,
    tolerance: float = INTERPOLATION_TOLERANCE,
    rule: FaceRule = FaceRule.LINEAR,
    known: Iterable[Point] = (),
    keep: Callable[[Point], object] = lambda _point: None,
    stored: Callable[[float], Contact | None] = lambda _load: None,
    threads: int = 1,
    progress: Progress = silent,
) -> AsperityTable:
    """Compute flow factors and contact pressures over the separation of a rough and a flat surface.

    Without contact the points are those of :func:`roughfilm.rom.homogenization.table.tabulate.tabulate` down to first
    contact. In contact the surface deforms elastically and plastically. Loads are added half-way between two loads
    until the interpolation error is below the tolerance and below the uncertainty, or neighbouring loads differ by 5 %.

    Parameters
    ----------
    heights : heights of one period, shape (nx, ny), m, upward, towards the flat wall.
    spacing : (dx, dy), m.
    composite_modulus : E*, Pa.
    hardness : H, Pa.
    loads : two or more loads of the table, Pa; by default a series from about one pixel in contact until both
        directions are sealed, 0.9 H, or 90 % contact.
    required_load : load that the table includes, Pa.
    tolerance : largest error of flow factors as in :func:`roughfilm.rom.homogenization.table.tabulate.tabulate`, and of
        the separation over the rms height.
    known : points that are not solved again.
    keep : called with each new point.
    stored : stored(load), a stored contact or None.
    threads : number of cells that are solved at once, which does not change the table.

    Raises
    ------
    InputError
        If the heights are not a rough surface, or a number is out of range.
    ConvergenceError
        If a contact or a cell does not converge, or two loads close the gap equally.
    """
    body = Separations(heights=np.asarray(unmasked("heights", heights), dtype=np.float64))
    open_table = tabulate(
        body.heights,
        spacing,
        tolerance=tolerance,
        narrowest=body.peak if body.rms > 0 else None,
        rule=rule,
        known=known,
        keep=keep,
        threads=threads,
        progress=lambda done, words: progress(0.4 * done, words),
    )
    press = Press(body.heights, spacing, composite_modulus, hardness=hardness)
    coarser = _coarser(press)
    solved = {point.load: point for point in known if point.load > 0}
    pressing, keeping = Lock(), Lock()

    def solve(load: float) -> Point | None:
        if load in solved:
            return solved[load]
        with pressing:
            contact = stored(load) or press.at(load, tolerance=CONTACT_TOLERANCE)
            alpha = body.peak - contact.approach
            uncertainty = _separation_uncertainty(body, coarser, load, alpha)
        if not contact.gap.any():
            return None
        point = replace(
            point_of(contact.gap, spacing, alpha, rule=rule, deformed=True),
            load=load,
            area_fraction=contact.area_fraction,
            plastic_fraction=contact.plastic_fraction,
            peak_pressure=float(contact.pressure.max()),
            separation_uncertainty=uncertainty,
        )
        with keeping:
            keep(point)
        return point

    def half_way(one: Point, two: Point) -> Point | None:
        return None if two.load < MIN_LOAD_RATIO * one.load else solve(math.sqrt(one.load * two.load))

    def made(points: Iterable[Point]) -> AsperityTable:
        ordered = sorted((*open_table.points, *points), key=lambda point: point.mean_gap)
        for one, two in pairwise(ordered):
            if math.log(two.mean_gap) <= math.log(one.mean_gap):
                raise ConvergenceError(
                    f"asperities: loads of {two.load:.3g} and {one.load:.3g} Pa close the gap equally; bring the "
                    f"hardness of {hardness:.3g} Pa nearer to the composite modulus of {composite_modulus:.3g} Pa"
                )
        return AsperityTable(factors=replace(open_table, points=tuple(ordered), composite_modulus=composite_modulus))

    def errors(others: Sequence[Point], point: Point) -> tuple[float, float, float]:
        table = made(others)
        separation = table.separation_at(point.load)
        return *table_errors(table.factors, point), abs(separation - point.separation) / body.rms

    def later(done: float, words: str) -> None:
        progress(0.4 + 0.6 * done, words)

    points = bisected(
        _series(solve, press, loads, required_load, threads, later),
        place=lambda point: math.log(point.load),
        half_way=half_way,
        errors=errors,
        order=3,
        tolerance=tolerance,
        threads=threads,
        progress=later,
    )
    progress(1.0, f"{len(points) + len(open_table.points)} points")
    return made(with_friction_errors(points, lambda others: made(others).factors))


def gap_of(point: Point, press: Press) -> Array:
    """The gap at a point of a table, m, shape (nx, ny); a point in contact is solved again."""
    if point.load:
        return press.at(point.load, tolerance=CONTACT_TOLERANCE).gap
    return Separations(heights=press.heights).gap(point.separation)


def _series(
    solve: Callable[[float], Point | None],
    press: Press,
    loads: Sequence[float] | None,
    required_load: float,
    threads: int,
    progress: Progress,
) -> list[Point]:
    """The points at the given loads, or at a default series of loads."""
    largest = MAX_HARDNESS_RATIO * press.hardness
    if loads is not None:
        remaining = sorted(set(map(float, loads)))
        if len(remaining) < 2 or not (remaining[0] > 0 and math.isfinite(remaining[-1])):
            raise InputError(f"loads: got {list(loads)[:5]} Pa; give two or more above 0")
    else:
        slope = wave_power(press.heights, press.spacing).moments.rms_slope
        remaining = [min(press.composite_modulus * slope / 2, press.hardness) / press.heights.size]
    if max(required_load, remaining[-1]) > press.hardness:
        raise InputError(
            f"loads: got up to {max(required_load, remaining[-1]):.6g} Pa; they must not exceed the hardness of "
            f"{press.hardness:.6g} Pa, lower them"
        )
    points: list[Point] = []
    with workers(threads) as pool:
        while remaining:
            for load, point in zip(remaining, pool.map(solve, remaining), strict=True):
                progress(0.5 * len(points) / (len(points) + len(remaining)), f"{load / 1e6:.4g} MPa")
                if point is None and (loads is not None or load <= required_load):
                    raise InputError(f"loads: got {load:.6g} Pa, which closes the gap everywhere; lower the load")
                if point is None:
                    return points
                points.append(point)
            last, remaining = points[-1], []
            if last.load < required_load or (loads is None and _leaves_open(last, largest)):
                following = last.load * (LOAD_STEP if last.contact < LIGHT_CONTACT else SHORT_LOAD_STEP)
                remaining = [
                    min(following, max(largest, required_load)) if loads is None else min(following, required_load)
                ]
    return points


def _leaves_open(point: Point, largest: float) -> bool:
    return not all(point.factors.sealed) and point.load < largest and point.contact < MAX_CONTACT


def _separation_uncertainty(body: Separations, coarser: Press | None, load: float, separation: float) -> float:
    """The uncertainty of a separation from a grid of every second node, m; infinite without such a grid."""
    if coarser is None:
        return math.inf
    contact = coarser.at(load, tolerance=CONTACT_TOLERANCE)
    peak = float(coarser.heights.max() - body.heights.mean())
    return GRID_SAFETY_FACTOR * abs(peak - contact.approach - separation)


def _coarser(press: Press) -> Press | None:
    """The surface on every second node; None if the grid is too small or has an odd number of nodes."""
    if min(press.heights.shape) < 2 * MIN_COARSE_NODES or any(count % 2 for count in press.heights.shape):
        return None
    dx, dy = press.spacing
    return Press(press.heights[::2, ::2], (2 * dx, 2 * dy), press.composite_modulus, hardness=press.hardness)
