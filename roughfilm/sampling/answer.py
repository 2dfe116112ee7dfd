"""Scatter, trend with the size, number of windows needed, and warnings, from the rows of all windows."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
import scipy

from roughfilm.contact.foundation.brief import brief
from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.contact.windows.scatter import MIN_INDEPENDENT, Scatter, scatter, windows_needed
from roughfilm.contact.windows.size_trend import SizeTrend, Verdict, growth_of, size_trend
from roughfilm.sampling.asked import Asked
from roughfilm.sampling.plan import DECAY_LENGTHS, Group, Plan
from roughfilm.sampling.quantities import Row
from roughfilm.sampling.run import Rows
from roughfilm.sampling.warnings import counted

SIGNED = ("Ssk", "Rsk", "A12", "B2")
"""Quantities of either sign, whose scatter is not that of their logarithms."""

FEW = 5.0
"""Effective number of independent windows below which a warning is given."""

DRIFT = 1e-3
"""Probability of a difference between two halves of a measurement below which they count as different."""

MAX_LACKING = 0.5
"""Fraction of the windows without a value above which a quantity is left out."""


@dataclass(frozen=True, kw_only=True)
class WindowQuantity:
    """A quantity over all windows.

    Attributes
    ----------
    unit : SI unit; "1" for plain numbers.
    scatter : of the largest windows.
    numerical : numerical uncertainty of the mean, the mean of those of the windows; None if one is unknown.
    trend : with the size of the windows.
    needed : number of independent windows for the tolerance; None if it is unknown.
    lacking : number of the largest windows without a value.
    drift : probability that two halves of the measurement differ this much by chance; NaN if it is unknown.
    by_size : scatter by the size of the windows, m, the largest first.
    """

    unit: str
    scatter: Scatter
    numerical: float | None
    trend: SizeTrend
    needed: int | None
    lacking: int
    drift: float
    by_size: Mapping[float, Scatter]

    __repr__ = brief


@dataclass(frozen=True, kw_only=True)
class Answer:
    """The quantities of a surface over all of its windows.

    Attributes
    ----------
    name : name of the surface.
    size : shorter side of the largest windows, m.
    count : number of the largest windows.
    independent : effective number of independent ones.
    headline : name of the quantity that is sought most.
    quantities : by name, that of the headline first.
    tolerance : relative tolerance for which ``needed`` counts windows.
    cells : periodic cells of the largest windows.
    warnings : sentences.
    """

    name: str
    size: float
    count: int
    independent: float
    headline: str
    quantities: Mapping[str, WindowQuantity]
    tolerance: float
    cells: tuple[Surface, ...]
    warnings: tuple[str, ...]

    __repr__ = brief


def answer_of(plan: Plan, asked: Asked, rows: Rows, tolerance: float) -> Answer:
    """The answer of all windows.

    Raises
    ------
    InputError, ConvergenceError
        If none of the largest windows has an answer.
    """
    main, own = plan.groups[0], rows.by_group[0]
    failures = [row.failure for row in own if row.failure is not None]
    if len(failures) == len(own):
        kind = InputError if failures[0].kind == InputError.__name__ else ConvergenceError
        raise kind(f"no window has an answer; the first: {failures[0].message}")
    growth = growth_of([group.size for group in plan.groups], [group.rms_height for group in plan.groups])
    names = dict.fromkeys([asked.headline, *(name for row in own for name in row.quantities)])
    quantities = {
        name: found
        for name in names
        if (found := _quantity(name, plan.groups, rows.by_group, growth, tolerance)) is not None
    }
    answer = Answer(
        name=plan.name,
        size=main.size,
        count=len(main.cells),
        independent=main.independent,
        headline=asked.headline if asked.headline in quantities else next(iter(quantities)),
        quantities=quantities,
        tolerance=tolerance,
        cells=main.cells,
        warnings=(),
    )
    return replace(answer, warnings=tuple(_warnings(plan, rows, answer)))


def _quantity(
    name: str, groups: Sequence[Group], rows: Sequence[Sequence[Row]], growth: float, tolerance: float
) -> WindowQuantity | None:
    by_size = {}
    for group, own in zip(groups, rows, strict=True):
        values = [row.quantities[name].value for row in own if name in row.quantities]
        if len(values) < max(1.0, MAX_LACKING * len(own)):
            continue
        worth = min(max(group.independent * len(values) / len(own), 1.0), len(values))
        by_size[group.size] = scatter(values, worth, name not in SIGNED and min(values) >= 0)
    if groups[0].size not in by_size:
        return None
    main, own = by_size[groups[0].size], rows[0]
    some = [row.quantities[name] for row in own if name in row.quantities]
    half = [one.uncertainty for one in some]
    known = [one for one in half if one is not None and math.isfinite(one)]
    return WindowQuantity(
        unit=some[0].unit,
        scatter=main,
        numerical=float(np.mean(known)) if len(known) == len(half) else None,
        trend=size_trend(
            list(by_size),
            [one.mean for one in by_size.values()],
            [one.mean_uncertainty for one in by_size.values()],
            growth,
        ),
        needed=windows_needed(main, tolerance),
        lacking=len(own) - len(some),
        drift=_drift(name, groups[0], own, main),
        by_size=by_size,
    )


def _drift(name: str, group: Group, rows: Sequence[Row], main: Scatter) -> float:
    """The smaller probability of the difference between the halves of the measurement in x, and in y, by chance.

    The halves have as many independent windows as their part of all; t is that of two samples of equal variance, which
    is that within the halves.
    """
    if not group.windows or main.independent < 2 * MIN_INDEPENDENT or main.deviation == 0:
        return math.nan
    some = [number for number, row in enumerate(rows) if name in row.quantities]
    values = np.array([rows[number].quantities[name].value for number in some])
    found = [math.nan]
    for axis in (0, 1):
        places = np.array([group.windows[number].start[axis] for number in some])
        first = places < np.median(places)
        worth = [main.independent * part.mean() for part in (first, ~first)]
        if min(worth) < 2:
            continue
        within = float(np.mean((values - np.where(first, values[first].mean(), values[~first].mean())) ** 2))
        deviation = math.sqrt(within / (1 - 2 / main.independent))
        difference = abs(values[first].mean() - values[~first].mean())
        t = difference / (deviation * math.sqrt(sum(1 / n for n in worth))) if deviation > 0 else math.inf
        found.append(2 * float(scipy.special.stdtr(sum(worth) - 2, -t)))
    return float(np.fmin.reduce(found))


def _warnings(plan: Plan, rows: Rows, answer: Answer) -> Iterator[str]:
    main, own = plan.groups[0], rows.by_group[0]
    yield from plan.warnings
    sal, (nx, ny) = plan.decay[0], main.cells[0].shape
    if main.size < DECAY_LENGTHS * sal:
        yield (
            f"a window of {1e6 * main.size:.4g} µm ({nx} x {ny} points) is {main.size / sal:.2g} decay lengths Sal "
            f"long; below {DECAY_LENGTHS:g} it does not represent the surface; take larger ones or measure more"
        )
    if answer.independent < answer.count / 2:
        yield (
            f"the {answer.count} windows overlap, or lie along one lay: they are worth {answer.independent:.2g} "
            "independent ones; more of them add little, measure a larger area or take smaller windows"
        )
    if answer.independent < FEW:
        yield (
            f"the windows are worth {answer.independent:.2g} independent ones: the scatter itself is uncertain"
            + (", and no interval is given" if answer.independent < MIN_INDEPENDENT else "")
            + f"; take windows of which {FEW:g} or more fit, or measure more places"
        )
    growth = answer.quantities[answer.headline].trend.growth
    if answer.quantities[answer.headline].trend.verdict is Verdict.NO_PLATEAU and math.isfinite(growth):
        yield (
            f"Sq grows as L^{growth:.2g} with the side L of the windows: the spectrum does not roll off within them, "
            "so that no value of the whole surface is known; larger windows have larger values"
        )
    drifting = [name for name, one in answer.quantities.items() if one.drift < DRIFT]
    if drifting:
        yield (
            f"two halves of the measurement differ in {', '.join(drifting)} by more than the scatter of their windows: "
            "the surface is not the same everywhere, or its form is not removed"
        )
    failed = [row.failure for group in rows.by_group for row in group if row.failure is not None]
    if failed:
        total = sum(map(len, rows.by_group))
        yield f"{len(failed)} of {total} windows have no answer and are left out; the first: {failed[0].message}"
    for name, one in answer.quantities.items():
        if one.lacking > len(own) - sum(bool(row.quantities) for row in own):
            yield f"{one.lacking} of {answer.count} windows have no {name}, which is that of the others"
    yield from counted([row.warnings for row in own])
