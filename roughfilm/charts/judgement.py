"""Points judged: their errors, the front of the best, and the cheapest within a tolerance."""

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any

from roughfilm.charts.family import Family, Truth
from roughfilm.charts.store import TRUTH, Answers
from roughfilm.rom.studies.comparison import Point, pareto_front
from roughfilm.rom.studies.table import Column

UNITS = {"cpu_s": "s", "error": "1", "error_that_counts": "1", "truth_uncertainty": "1"}
"""Of the columns of numbers whose unit is not told by another column."""

WORTH = 0.95
"""A point on the front errs by no more than this part of what the cheaper one before it does."""

WITHIN = (0.1, 0.01, 0.001)
"""Parts of the truth within which the cheapest point is named."""


@dataclass(frozen=True, kw_only=True)
class Chart:
    """One family with all its points.

    ``points`` are in the order in which they were asked for, ``counted`` are the same as :func:`counting` has them;
    of these ``front`` holds those that nothing beats in both CPU time and error, and ``cheapest`` is by tolerance, None
    where nothing is good enough.
    """

    family: Family
    answers: Answers
    points: tuple[Point, ...]
    counted: tuple[Point, ...]
    front: tuple[Point, ...]
    cheapest: Mapping[float, Point | None]
    absent: Mapping[str, str]

    @property
    def truth(self) -> Truth:
        """What the points are judged by."""
        return self.answers.truth

    @property
    def solvers(self) -> tuple[str, ...]:
        """Everyone with a point, in the order of the family."""
        return tuple(dict.fromkeys(point.model for point in self.points))

    @property
    def peers(self) -> tuple[str, ...]:
        """Those of the solvers that are not this project's."""
        return tuple(peer.name for peer in self.family.peers if peer.name in self.solvers)

    def error(self, point: Point) -> float:
        """Of a point, over the truth."""
        return point.error[self.family.quantity]


def judged(family: Family, found: Answers, absent: Mapping[str, str]) -> Chart:
    """Errors of all points against the truth, and what follows from them."""
    points = {
        (ask.solver, ask.resolution): Point(
            model=ask.solver,
            resolution=ask.resolution,
            cpu_s=found.points[ask.name].cpu_s,
            error={family.quantity: abs(found.points[ask.name].value / found.truth.value - 1)},
        )
        for ask in family.asks()
        if ask.name in found.points
    }
    counted = counting(tuple(points.values()), family.quantity, found.truth.uncertainty)
    return Chart(
        family=family,
        answers=found,
        points=tuple(points.values()),
        counted=counted,
        front=_worth_it(pareto_front(counted, family.quantity), family.quantity),
        cheapest={part: _cheapest(counted, family.quantity, part) for part in WITHIN},
        absent=absent,
    )


def counting(points: Sequence[Point], quantity: str, known: float) -> tuple[Point, ...]:
    """The points with the errors that count: the larger of a grid's own and that of its solver's next finer one.

    So a coarse grid whose errors happen to cancel wins nothing. Below what is ``known`` of the truth none is better.
    """
    counted = []
    for point in points:
        finer = [other for other in points if other.model == point.model and other.resolution > point.resolution]
        next_one = min(finer, key=lambda other: other.resolution, default=point)
        error = max(point.error[quantity], next_one.error[quantity], known)
        counted.append(replace(point, error={quantity: error}))
    return tuple(counted)


def _worth_it(front: Sequence[Point], quantity: str) -> tuple[Point, ...]:
    """The front without points that err hardly less than the cheaper one before them."""
    kept: list[Point] = []
    for point in front:
        if not kept or point.error[quantity] <= WORTH * kept[-1].error[quantity]:
            kept.append(point)
    return tuple(kept)


def _cheapest(counted: Sequence[Point], quantity: str, part: float) -> Point | None:
    good = [point for point in counted if point.error[quantity] <= part]
    return min(good, key=lambda point: point.cpu_s, default=None)


def entries_of(chart: Chart) -> dict[str, Any]:
    """A family as JSON holds it."""
    family, found = chart.family, chart.answers
    front = {(point.model, point.resolution) for point in chart.front}

    def named(point: Point | None) -> dict[str, Any] | None:
        return None if point is None else {"solver": point.model, "resolution": point.resolution, "cpu_s": point.cpu_s}

    return {
        "name": family.name,
        "work": family.work,
        "quantity": family.quantity,
        "unit": family.unit,
        "resolution_meaning": family.resolution_meaning,
        "truth": asdict(found.truth) | {"taken": found.taken[TRUTH]},
        "points": [
            {
                "solver": point.model,
                "peer": point.model in chart.peers,
                "resolution": point.resolution,
                "cpu_s": point.cpu_s,
                "value": found.points[_name(point)].value,
                "error": chart.error(point),
                "error_that_counts": chart.error(counted),
                "on_front": (point.model, point.resolution) in front,
                "told": dict(found.points[_name(point)].told),
                "taken": found.taken[_name(point)],
            }
            for point, counted in zip(chart.points, chart.counted, strict=True)
        ],
        "cheapest": [{"within": part, "point": named(point)} for part, point in chart.cheapest.items()],
        "peers": {peer.name: peer.settings for peer in family.peers},
        "absent": dict(chart.absent),
        "left_out": dict(family.left_out),
        "failed": dict(found.failed),
    }


def columns_of(charts: Sequence[Chart]) -> dict[str, Column]:
    """All families as one table: a row for each point; times in s, errors over the truth."""
    rows = []
    for chart in charts:
        told = entries_of(chart)
        shared = {"family": told["name"], "quantity": told["quantity"], "unit": told["unit"]}
        truth = {"truth": told["truth"]["value"], "truth_uncertainty": told["truth"]["uncertainty"]}
        for point in told["points"]:
            own = {key: point[key] for key in ("solver", "resolution", "cpu_s", "value", "error", "error_that_counts")}
            flags = {key: float(point[key]) for key in ("peer", "on_front")}
            rows.append({**shared, **own, **flags, **truth, **point["taken"]})
    return {name: Column(values=[row[name] for row in rows], unit=UNITS.get(name, "")) for name in rows[0]}


def _name(point: Point) -> str:
    return f"{point.model}-{point.resolution}"
