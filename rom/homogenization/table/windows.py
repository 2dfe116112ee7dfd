"""Tables of the mean flow factors of several windows of a surface, and the scatter between the windows."""

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from functools import partial
from threading import Lock

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.units import Quantity
from roughfilm.contact.windows.average import ScatteredQuantity, WindowAverage, window_average
from roughfilm.rom.homogenization.conductance import FaceRule
from roughfilm.rom.homogenization.factors import NAMES, FactorScatter, FlowFactors, relative_quantities
from roughfilm.rom.homogenization.flow_factors import flow_factors
from roughfilm.rom.homogenization.table.factor_table import FactorTable, Point
from roughfilm.rom.homogenization.table.separation import Separations
from roughfilm.rom.homogenization.table.tabulate import (
    INTERPOLATION_TOLERANCE,
    as_point,
    checked_tolerance,
    point_of,
    refined,
)
from roughfilm.rom.ladder.model import Progress, silent

POSITIVE = ("A11", "A22", "d")
"""Factors that are 0 or more, and vary between windows by factors rather than by differences."""


def tabulate_windows(
    cells: Sequence[Array],
    spacing: tuple[float, float],
    *,
    independent: float | None = None,
    tolerance: float = INTERPOLATION_TOLERANCE,
    rule: FaceRule = FaceRule.LINEAR,
    known: Iterable[Point] = (),
    keep: Callable[[Point], object] = lambda _point: None,
    threads: int = 1,
    progress: Progress = silent,
) -> FactorTable:
    """The table of the mean flow factors of several undeformed windows at common mean gaps.

    All windows have the same mean gap ĥ at a point, whose factors are their arithmetic means with a ``scatter``. The
    table is refined as that of one surface, see :func:`roughfilm.rom.homogenization.table.tabulate.tabulate`. It begins
    where every window is sealed in both directions.

    Parameters
    ----------
    cells : heights of one period of each window, m, shape (nx, ny), positive towards the flat wall.
    spacing : (dx, dy), m.
    independent : effective number of independent windows; by default their number.
    tolerance, rule, threads : those of a table of one surface.
    known : points of such a table that are not solved again.
    keep : called with every new point, one at a time.

    Raises
    ------
    InputError
        If the heights of a window are not those of a rough surface, or the tolerance is out of range.
    ConvergenceError
        If a cell does not converge, or the tolerance is not met in a film of any thickness.
    """
    checked_tolerance(tolerance)
    bodies = [Separations(heights=np.asarray(cell, dtype=np.float64)) for cell in cells]
    flat = sum(body.rms == 0 for body in bodies)
    if flat:
        raise InputError(f"heights: {flat} of {len(bodies)} windows are flat; give rough ones")
    before, keeping = {point.mean_gap: point for point in known}, Lock()
    sealing = [{_mean_gap(body, height): height for height in body.sealing()} for body in bodies]

    def solve(mean_gap: float) -> Point:
        if mean_gap in before:
            return before[mean_gap]
        points = []
        for body, own in zip(bodies, sealing, strict=True):
            separation = own[mean_gap] if mean_gap in own else body.at_mean_gap(mean_gap)
            points.append(point_of(body.gap(separation), spacing, separation, rule=rule, deformed=False))
        point = mean_point(points, mean_gap, independent)
        with keeping:
            keep(point)
        return point

    return refined(
        [partial(solve, gap) for gap in _sealing_gaps(bodies)],
        solve,
        peak=max(body.peak for body in bodies),
        rms=math.sqrt(float(np.mean([body.rms**2 for body in bodies]))),
        tolerance=tolerance,
        threads=threads,
        progress=progress,
    )


def factors_at(
    cells: Sequence[Array],
    spacing: tuple[float, float],
    mean_gap: float,
    *,
    independent: float | None = None,
    rule: FaceRule = FaceRule.LINEAR,
    offset: float = 0.0,
    progress: Progress = silent,
) -> Point:
    """The flow factors of one surface, or the means over several windows, at one mean gap.

    Parameters
    ----------
    cells : heights of one period of each window, m, shape (nx, ny), positive towards the flat wall.
    spacing : (dx, dy), m.
    mean_gap : mean gap ĥ before the offset, m.
    independent : effective number of independent windows; None for a single surface, which has no scatter.
    rule, offset : those of :func:`roughfilm.rom.homogenization.flow_factors.flow_factors`.

    Raises
    ------
    InputError
        If a number is out of range.
    ConvergenceError
        If a cell does not converge.
    """
    points = []
    for number, cell in enumerate(cells):
        body = Separations(heights=cell)
        separation = body.at_mean_gap(mean_gap)

        def advance(done: float, words: str, number: int = number) -> None:
            progress((number + done) / len(cells), words)

        found = flow_factors(body.gap(separation), spacing, rule=rule, offset=offset, progress=advance)
        points.append(as_point(found, separation))
    return points[0] if independent is None else mean_point(points, points[0].mean_gap, independent)


def point_quantities(point: Point) -> dict[str, Quantity]:
    """The factors of a point by their ``NAMES`` over those of a smooth film of its mean gap, with uncertainties.

    Those of a point over windows have their scatter too.
    """
    own = relative_quantities(point.factors, point.uncertainty)
    if point.scatter is None:
        return own
    halves, lows, highs = (
        relative_quantities(part, part) for part in (point.scatter.mean, point.scatter.low, point.scatter.high)
    )
    scattered: dict[str, Quantity] = {}
    for name, one in own.items():
        half, low, high = halves[name].value, lows[name].value, highs[name].value
        scattered[name] = ScatteredQuantity(
            value=one.value,
            unit=one.unit,
            uncertainty=one.uncertainty,
            scatter=half if math.isfinite(half) else None,
            window_interval=(low, high) if math.isfinite(low) and math.isfinite(high) else None,
        )
    return scattered


def _mean_gap(body: Separations, separation: float) -> float:
    return float(body.gap(separation).mean())


def _sealing_gaps(bodies: Sequence[Separations]) -> list[float]:
    """The mean gaps at which the first and the last window seal in x and in y, m, in increasing order, each once."""
    by_axis = zip(*([_mean_gap(body, height) for height in body.sealing()] for body in bodies), strict=True)
    return sorted({end for gaps in by_axis for end in (min(gaps), max(gaps))})


def mean_point(points: Sequence[Point], mean_gap: float, independent: float | None = None) -> Point:
    """The point of the means over windows at one mean gap, m, with the scatter of the factors.

    A direction counts as sealed if it is sealed in every window.
    """
    factors, uncertainty, scatter = mean_factors(
        [point.factors for point in points], [point.uncertainty for point in points], independent
    )
    return Point(
        separation=float(np.mean([point.separation for point in points])),
        contact=float(np.mean([point.contact for point in points])),
        factors=replace(factors, mean_gap=mean_gap),
        uncertainty=uncertainty,
        unsolved=max(point.unsolved for point in points),
        iterations=sum(point.iterations for point in points),
        residual=max(point.residual for point in points),
        cpu_s=sum(point.cpu_s for point in points),
        slopes=np.mean([_slopes(point, factors.sealed) for point in points], axis=0),
        scatter=scatter,
    )


def _slopes(point: Point, sealed: tuple[bool, bool]) -> Array:
    """The slopes of a window; those of A and B are 0 in a direction in which it is sealed and others are not."""
    own = [one and not every for one, every in zip(point.factors.sealed, sealed, strict=True)]
    shut = np.array([*own, any(own), *own, False, False])
    return np.where(shut & np.isnan(point.slopes), 0.0, point.slopes)


def mean_factors(
    factors: Sequence[FlowFactors], uncertainties: Sequence[FlowFactors], independent: float | None = None
) -> tuple[FlowFactors, FlowFactors, FactorScatter]:
    """The mean flow factors of windows with the same mean gap, their mean numerical uncertainty, and their scatter."""
    averages = factor_averages(factors, independent)
    sealed = (all(one.sealed[0] for one in factors), all(one.sealed[1] for one in factors))
    mean_gap = float(np.mean([one.mean_gap for one in factors]))

    def of(numbers: Sequence[float]) -> FlowFactors:
        return FlowFactors(
            mean_gap=mean_gap,
            pressure=np.reshape(numbers[:4], (2, 2)),
            shear=np.array(numbers[4:6]),
            couette=float(numbers[6]),
            shear_couette=float(numbers[7]),
            sealed=sealed,
        )

    halves = [math.nan if one.scatter is None else one.scatter for one in averages.values()]
    lows, highs = zip(*(one.interval or (math.nan, math.nan) for one in averages.values()), strict=True)
    numerical = np.mean([_numbers(one) for one in uncertainties], axis=0)
    gap = float(np.mean([one.mean_gap for one in uncertainties]))
    return (
        of([one.value for one in averages.values()]),
        replace(of(numerical.tolist()), mean_gap=gap),
        FactorScatter(mean=of(halves), low=of(lows), high=of(highs)),
    )


def factor_averages(factors: Sequence[FlowFactors], independent: float | None = None) -> dict[str, WindowAverage]:
    """The mean of each number of flow factors over windows, by its name in ``NAMES``, in SI units."""
    columns = np.array([_numbers(one) for one in factors]).T
    return {
        name: window_average(column.tolist(), independent=independent, positive=name in POSITIVE)
        for name, column in zip(NAMES, columns, strict=True)
    }


def _numbers(factors: FlowFactors) -> list[float]:
    return [*factors.pressure.ravel().tolist(), *factors.shear.tolist(), factors.couette, factors.shear_couette]
