"""The map of intervals from few windows: how often they contain the truth of a known ensemble."""

from collections.abc import Callable, Iterator, Sequence
from functools import cache, partial
from typing import Any

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.preparation.prepare import cell_of, level
from roughfilm.contact.preparation.recipe import read_recipe
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.contact.windows.places import independent_windows, window_places
from roughfilm.contact.windows.scatter import scatter
from roughfilm.contact.windows.size_trend import growth_of, size_trend
from roughfilm.stability.checks.coverage import Coverage, coverage_of, of_measurements, of_subsets
from roughfilm.stability.form import (
    BAD,
    Judgement,
    MapOutcome,
    Probe,
    Spot,
    StabilityMap,
    count,
    in_groups,
    in_turn,
    listed,
)
from roughfilm.stability.questions.windows import (
    GEOMETRIC,
    JOINT_OF_SIDE,
    MIN_PIXELS,
    PRESSED,
    RATES,
    SEED,
    SIDES,
    Extrapolation,
    Measurement,
    extrapolations,
    geometric,
    measurements,
    pressed_bank,
    scratched_bank,
)

MIN_COVERAGE = 0.90
"""Least fraction of the intervals that must contain the truth, to one standard error of the count."""

MAX_COVERAGE = 0.99
"""Fraction of the intervals that contain the truth above which they may be too wide."""

MAX_WIDTH = 1.5
"""Largest width of such intervals over that which would contain the truth in 95 of 100 tries."""

MIN_GIVEN = 0.1
"""Fraction of the tries below which an interval counts as not given."""

NUMBERS = (2, 3, 5, 10, 20, 50)
"""Numbers of windows."""

USUAL_NUMBER = 10
"""Number of windows at which their side is varied."""

USUAL_SIDE = 4
"""Side of the windows, correlation lengths, at which their number is varied."""

DRAWS = 200
"""Number of subsets of the windows."""

MEASUREMENTS = 100
"""Number of measurements of which windows are cut."""

PLACED = (9, 16, 25)
"""Numbers of windows of one measurement, four windows wide: 16 cover it, 25 overlap."""

EXTRAPOLATED = 24
"""Number of measurements of which windows of three sizes are cut, 16 of each."""

JOINED_EXTRAPOLATED = 16
"""Number of these measurements where the windows are joined."""

MEAN, FURTHER = "mean", "one further window"
"""What the intervals are for."""


def probes(pixels: int) -> Iterator[Probe]:
    """All probes on windows of about ``pixels`` along a side."""
    yield from _independent(pixels)
    yield from _scratched(pixels // 2)
    for measurement in measurements(pixels // 2):
        yield from _placed(measurement, pixels // 2)
    for extrapolation in extrapolations(pixels):
        yield from _extrapolated(extrapolation, pixels)


def _independent(pixels: int) -> Iterator[Probe]:
    sides = [side for side in SIDES if pixels / side >= MIN_PIXELS]
    for number, (what, quantity) in enumerate((what, one) for what in (MEAN, FURTHER) for one in PRESSED):
        column_of = number % len(PRESSED)
        for side in sides:
            ask = partial(_of_bank, pressed_bank, side, pixels, column_of, USUAL_NUMBER, what)
            group = f"{what}, {USUAL_NUMBER} windows"
            yield _probe(group, quantity, f"L = {side} λ", ask)
        for windows in NUMBERS:
            ask = partial(_of_bank, pressed_bank, USUAL_SIDE, pixels, column_of, windows, what)
            group = f"{what}, L = {USUAL_SIDE} λ"
            yield _probe(group, quantity, f"{windows} windows", ask, refused=windows < 3)


def _scratched(pixels: int) -> Iterator[Probe]:
    for what in (MEAN, FURTHER):
        for rate in RATES:
            for windows in NUMBERS[1:]:
                ask = partial(_of_bank, scratched_bank, rate, pixels, GEOMETRIC.index("gap cubed"), windows, what)
                yield _probe(f"{what}, gap cubed, scratches", f"{rate:g} a window", f"{windows} windows", ask)


def _of_bank(
    bank: Callable[[Any, int], Array], key: float, pixels: int, quantity: int, windows: int, what: str
) -> Coverage:
    rng = np.random.default_rng([SEED, windows, quantity])
    return of_subsets(bank(key, pixels)[:, quantity], windows, DRAWS, rng)[what == FURTHER]


def _placed(measurement: Measurement, side: int) -> Iterator[Probe]:
    @cache
    def answers() -> dict[tuple[int, str, str], Coverage]:
        return _of_places(measurement, side)

    for windows in PLACED:
        for quantity in (GEOMETRIC[0], GEOMETRIC[2]):
            for what in (MEAN, FURTHER):
                ask = partial(lambda *key: answers()[key], windows, quantity, what)
                yield _probe(f"{what}, {quantity}, one measurement", measurement.row, f"{windows} windows", ask)


def _of_places(measurement: Measurement, side: int) -> dict[tuple[int, str, str], Coverage]:
    rng = np.random.default_rng(SEED)
    amplitudes = measurement.surface.amplitudes()
    places = {windows: window_places((4 * side, 4 * side), (side, side), windows) for windows in PLACED}
    values: dict[int, list[Array]] = {windows: [] for windows in PLACED}
    worth: dict[int, list[float]] = {windows: [] for windows in PLACED}
    for _ in range(MEASUREMENTS):
        surface = measurement.draw(rng, amplitudes, 4 * side)
        for windows, own in places.items():
            values[windows].append(geometric(np.stack([surface.heights[one.slices] for one in own])))
            worth[windows].append(independent_windows(own, surface))
    return {
        (windows, quantity, what): found
        for windows in PLACED
        for number, quantity in enumerate(GEOMETRIC)
        for what, found in zip(
            (MEAN, FURTHER),
            of_measurements(np.array(values[windows])[..., number], np.array(worth[windows])),
            strict=True,
        )
    }


def _extrapolated(question: Extrapolation, side: int) -> Iterator[Probe]:
    @cache
    def answers() -> dict[str, Coverage]:
        return _of_sizes(question, side)

    for quantity in GEOMETRIC:
        ask = partial(lambda one: answers()[one], quantity)
        yield _probe("whole surface", quantity, question.column, ask, refused=question.refused)


def _of_sizes(question: Extrapolation, side: int) -> dict[str, Coverage]:
    rng = np.random.default_rng(SEED)
    amplitudes, truth = question.surface.amplitudes(), question.surface.truth()
    tries = JOINED_EXTRAPOLATED if question.joined else EXTRAPOLATED
    sides = [side // ratio for ratio in (1, 2, 4)]
    places = [window_places((4 * side, 4 * side), (one, one), 16) for one in sides]
    width = f"{max(JOINT_OF_SIDE * sides[-1], 0.5)} m"
    joint = {"direction": "both", "width": width} if question.joined else {"direction": "none"}
    recipe = read_recipe({"form": "none", "grid": {"points": "kept"}, "edges": joint, "smoothing": 1})
    limits: dict[str, list[tuple[float, float]]] = {quantity: [] for quantity in GEOMETRIC}
    for _ in range(tries):
        heights = question.surface.draw(rng, amplitudes)[: 4 * side, : 4 * side]
        surface = Surface(heights=heights, spacing=(1.0, 1.0))
        levelled = level(surface, recipe) if question.joined else None
        found = []
        for own in places:
            cells = np.stack(
                [
                    heights[one.slices] if levelled is None else cell_of(levelled, recipe, one).surface.heights
                    for one in own
                ]
            )
            worth = independent_windows(own, surface)
            found.append([scatter(values, worth, positive=True) for values in geometric(cells).T])
        growth = growth_of(sides, [one[0].mean for one in found])
        for number, quantity in enumerate(GEOMETRIC):
            means = [one[number].mean for one in found]
            trend = size_trend(sides, means, [one[number].mean_uncertainty for one in found], growth)
            if trend.limit is not None and trend.limit_uncertainty is not None:
                limits[quantity].append((trend.limit / truth[number] - 1, trend.limit_uncertainty / truth[number]))
    return {
        quantity: coverage_of(
            [float(abs(off) <= half) for off, half in own],
            tries,
            [half for _, half in own],
            [off for off, _ in own],
            len(own),
        )
        for quantity, own in limits.items()
    }


def _probe(group: str, row: str, column: str, ask: Callable[[], Coverage], *, refused: bool = False) -> Probe:
    def given() -> Coverage:
        found = ask()
        if found.given < MIN_GIVEN:
            raise InputError(f"none given: {100 * found.given:.0f} % of the tries have an interval")
        return found

    return Probe(group=group, row=row, column=column, ask=given, judge=judged, refused=refused)


def judged(found: Coverage) -> Judgement:
    """The judgement of intervals: they hold, are too narrow (wrong), or are too wide, which their width reports."""
    narrow = found.rate + found.error < MIN_COVERAGE
    wide = found.rate > MAX_COVERAGE and found.half_width > MAX_WIDTH * found.needed
    rate, half = f"{100 * found.rate:.0f} %", f"{100 * found.half_width:.2g} %"
    return Judgement(
        iterations=None,
        right=not (narrow or wide),
        error=1 - found.rate,
        reported=wide,
        why="too narrow" if narrow else "too wide" if wide else "",
        numbers={"coverage": found.rate, "half_width": found.half_width, "needed": found.needed, "given": found.given},
        message=f"{rate} contain the truth, half width {half}; {100 * found.needed:.2g} % would contain it in 95 %",
    )


def summary(spots: Sequence[Spot]) -> list[str]:
    """Sentences about the map: each group, and the intervals that are too narrow."""
    return [f"{name}: {_in_numbers(own)}." for name, own in in_groups(spots).items()] + listed(spots, *BAD)


def _in_numbers(spots: Sequence[Spot]) -> str:
    words = {
        MapOutcome.CONVERGED: "hold",
        MapOutcome.INACCURATE: "are too wide",
        MapOutcome.WRONG: "are too narrow",
        MapOutcome.REFUSED: "are rightly not given",
    }
    parts = [f"{count(spots, outcome)} {text}" for outcome, text in words.items() if count(spots, outcome)]
    return f"of {len(spots)} kinds of intervals " + ", ".join(parts)


WINDOWS = StabilityMap(
    name="windows",
    title="Intervals from few windows of a surface",
    axes="Gaussian surfaces of known spectrum. Windows far apart, joined and pressed, from 1 to 30 correlation lengths "
    "λ (at which the autocorrelation is 0.2) wide, 2 to 50 of them; with rare scratches; windows of one measurement, "
    "four windows wide, also along a lay, overlapping, and with a roll-off beyond them; and windows of L, L/2 and L/4 "
    "extrapolated to the whole surface.",
    judge="The mean over a large ensemble, and for the whole surface its spectrum. An interval holds if it contains "
    f"the truth in at least {MIN_COVERAGE:.0%} of the tries, to one standard error. It is too wide if it contains it "
    f"in more than {MAX_COVERAGE:.0%} and has more than {MAX_WIDTH:g} times the width that would contain it in 95 %. "
    "The error is the fraction of the tries without the truth.",
    resolution=64,
    resolution_meaning="points along a side of the windows",
    least=32,
    most=128,
    allowed="the windows take 32 to 128 points along a side",
    solve=in_turn(probes),
    summary=summary,
    cell_numbers=("coverage", "half_width"),
    cell_words="Each cell has the percentage of the intervals that contain the truth, and below it the median "
    "of their half widths in percent of it.",
)
