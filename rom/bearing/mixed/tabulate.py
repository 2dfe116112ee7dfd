"""A table of flow factors and contact pressures of a surface, from thick films to crushed asperities."""

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from threading import Lock

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.threads import workers
from roughfilm.contact.mechanics.contact import Contact
from roughfilm.contact.mechanics.moments import wave_power
from roughfilm.contact.mechanics.press import Press
from roughfilm.rom.bearing.mixed.asperity_table import AsperityTable
from roughfilm.rom.homogenization.conductance import FaceRule
from roughfilm.rom.homogenization.table.bisection import bisected
from roughfilm.rom.homogenization.table.factor_table import Point
from roughfilm.rom.homogenization.table.separation import Separations
from roughfilm.rom.homogenization.table.tabulate import INTERPOLATION_TOLERANCE, point_of, table_error, tabulate
from roughfilm.rom.ladder.model import Progress, silent

COMPLEMENTARITY = 1e-6
"""Of contacts, over the rms height."""

NEAREST = 1.05
"""How far apart two loads are at least."""

STEP, SHORT_STEP, LIGHT = 4.0, 1.5, 0.1
"""From load to load, where none are given: with less contact than the last, and with more."""

MOST_OF_HARDNESS, MOST_AREA = 0.9, 0.9
"""Loads go no further by themselves."""

FEWEST = 8
"""Nodes along a side of the coarser grid that says how far off separations are."""

SAFETY = 1.5
"""Of the difference between two grids, at the first order."""


def tabulate_pressed(
    heights: Array,
    spacing: tuple[float, float],
    composite_modulus: float,
    *,
    hardness: float = math.inf,
    loads: Sequence[float] | None = None,
    reach: float = 0.0,
    tolerance: float = INTERPOLATION_TOLERANCE,
    rule: FaceRule = FaceRule.LINEAR,
    known: Iterable[Point] = (),
    keep: Callable[[Point], object] = lambda _point: None,
    stored: Callable[[float], Contact | None] = lambda _load: None,
    threads: int = 1,
    progress: Progress = silent,
) -> AsperityTable:
    """Flow factors and contact pressures over the separation of a surface and a flat one.

    Open, the surface is as :func:`rom.homogenization.table.tabulate.tabulate` takes it, from its first touch on;
    pressed, it deforms elastically and plastically. Half-way between two loads it is pressed again: where the table is
    off by more than the tolerance, and than what is unsure, that is done on both sides of it, to within 5 % in load.

    Parameters
    ----------
    heights : of one period, shape (nx, ny), m, upward, towards the flat wall.
    spacing : (dx, dy), m.
    composite_modulus : E*, Pa.
    hardness : H, Pa.
    loads : two or more, Pa, that the table has at least; by default from about one pixel in contact to where both
        directions are sealed, 0.9 H, or 90 % contact.
    reach : a load that it reaches in any case, Pa.
    tolerance : as :func:`rom.homogenization.table.tabulate.tabulate` takes it, and of the separation over the rms
        height.
    known : points that need not be solved again.
    keep : called with every new point.
    stored : gives the contact at a load where there is one already.
    threads : in which cells are solved at once; the table does not depend on it.

    Raises
    ------
    InputError
        For heights that are no rough surface, or numbers out of range.
    ConvergenceError
        If a contact or a cell does not converge.
    """
    body = Separations(heights=np.asarray(heights, dtype=np.float64))
    open_table = tabulate(
        body.heights,
        spacing,
        tolerance=tolerance,
        narrowest=body.peak if body.rms > 0 else None,
        rule=rule,
        known=known,
        keep=keep,
        threads=threads,
        progress=lambda part, words: progress(0.4 * part, words),
    )
    press = Press(body.heights, spacing, composite_modulus, hardness=hardness)
    coarser = _coarser(press)
    before = {point.load: point for point in known if point.load > 0}
    pressing, keeping = Lock(), Lock()

    def solve(load: float) -> Point | None:
        if load in before:
            return before[load]
        with pressing:
            contact = stored(load) or press.at(load, tolerance=COMPLEMENTARITY)
            alpha = body.peak - contact.approach
            doubt = _doubt(body, coarser, load, alpha)
        if not contact.gap.any():
            return None
        point = replace(
            point_of(contact.gap, spacing, alpha, rule=rule),
            load=load,
            area_fraction=contact.area_fraction,
            plastic_fraction=contact.plastic_fraction,
            separation_uncertainty=doubt,
        )
        with keeping:
            keep(point)
        return point

    def half_way(one: Point, two: Point) -> Point | None:
        return None if two.load < NEAREST * one.load else solve(math.sqrt(one.load * two.load))

    def made(points: Iterable[Point]) -> AsperityTable:
        ordered = sorted((*open_table.points, *points), key=lambda point: point.mean_gap)
        return AsperityTable(factors=replace(open_table, points=tuple(ordered)))

    def missed(table: AsperityTable, point: Point) -> float:
        return abs(table.separation_at(point.load) - point.separation) / body.rms

    def off(table: AsperityTable, point: Point) -> tuple[float, float]:
        return table_error(table.factors, point), missed(table, point)

    def told(part: float, words: str) -> None:
        progress(0.4 + 0.6 * part, words)

    points = _series(solve, press, loads, reach, threads, told)
    found = bisected(
        points, half_way=half_way, made=made, errors=off, tolerance=tolerance, threads=threads, progress=told
    )
    progress(1.0, f"{len(found) + len(open_table.points)} points")
    return made(found)


def gap_of(point: Point, press: Press) -> Array:
    """The gap at a point of a table, m: of the surface as it is, or pressed again."""
    if point.load:
        return press.at(point.load, tolerance=COMPLEMENTARITY).gap
    return Separations(heights=press.heights).gap(point.separation)


def _series(
    solve: Callable[[float], Point | None],
    press: Press,
    loads: Sequence[float] | None,
    reach: float,
    threads: int,
    progress: Progress,
) -> list[Point]:
    """The points at the loads that are given, or up to where little is left open."""
    most = MOST_OF_HARDNESS * press.hardness
    if loads is not None:
        asked = sorted(set(map(float, loads)))
        if len(asked) < 2 or not (asked[0] > 0 and math.isfinite(asked[-1])):
            raise InputError(f"loads: got {list(loads)[:5]} Pa; give two or more above 0")
    else:
        slope = wave_power(press.heights, press.spacing).moments.rms_slope
        asked = [min(press.composite_modulus * slope / 2, press.hardness) / press.heights.size]
    if max(reach, asked[-1]) > press.hardness:
        raise InputError(
            f"loads: got up to {max(reach, asked[-1]):.6g} Pa, above the hardness of {press.hardness:.6g} Pa, which is "
            "all that the whole area can bear; lower them"
        )
    points: list[Point] = []
    with workers(threads) as pool:
        while asked:
            for load, point in zip(asked, pool.map(solve, asked), strict=True):
                progress(0.5 * len(points) / (len(points) + len(asked)), f"{load / 1e6:.4g} MPa")
                if point is None and (loads is not None or load <= reach):
                    told = f"loads: {load:.6g} Pa closes the gap everywhere, so that there is no film"
                    raise InputError(f"{told}; lower it")
                if point is None:
                    return points
                points.append(point)
            last, asked = points[-1], []
            if last.load < reach or (loads is None and _leaves_open(last, most)):
                following = last.load * (STEP if last.contact < LIGHT else SHORT_STEP)
                asked = [min(following, max(most, reach)) if loads is None else min(following, reach)]
    return points


def _leaves_open(point: Point, most: float) -> bool:
    return not all(point.factors.sealed) and point.load < most and point.contact < MOST_AREA


def _doubt(body: Separations, coarser: Press | None, load: float, separation: float) -> float:
    """By how much a separation may be off, from that on every second node, m; infinite without such a grid."""
    if coarser is None:
        return math.inf
    found = coarser.at(load, tolerance=COMPLEMENTARITY)
    peak = float(coarser.heights.max() - body.heights.mean())
    return SAFETY * abs(peak - found.approach - separation)


def _coarser(press: Press) -> Press | None:
    if min(press.heights.shape) < 2 * FEWEST or any(count % 2 for count in press.heights.shape):
        return None
    dx, dy = press.spacing
    return Press(press.heights[::2, ::2], (2 * dx, 2 * dy), press.composite_modulus, hardness=press.hardness)
