"""The errors of the points, the Pareto front, and the cheapest point within a tolerance."""

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any

from roughfilm.charts.family import ChartFamily, ReferenceValue
from roughfilm.charts.store import TRUTH, Answers
from roughfilm.rom.studies.comparison import Point, pareto_front
from roughfilm.rom.studies.table import Column

UNITS = {"cpu_s": "s", "error": "1", "error_that_counts": "1", "truth_uncertainty": "1"}
"""Units of the columns of numbers; the unit of the values is in the column ``unit``."""

MAX_ERROR_RATIO = 0.95
"""Largest error of a point on the front, divided by the error of the cheaper point before it."""

WITHIN = (0.1, 0.01, 0.001)
"""Relative tolerances for which the cheapest point is named."""


@dataclass(frozen=True, kw_only=True)
class Chart:
    """One family with all its points, their errors, and the Pareto front.

    Attributes
    ----------
    family, answers : family and its measured answers.
    points : points with their errors, in the order of the family.
    counted : the same points with the errors of :func:`counting`.
    front : Pareto front of the counted points: no other point has both a smaller CPU time and a smaller error. A point
        that the reference does not distinguish from a cheaper one on the front is left out.
    cheapest : by tolerance, the cheapest counted point whose error plus the uncertainty of the reference is within it;
        None if there is none.
    absent : reason by name for peers that are not available.
    """

    family: ChartFamily
    answers: Answers
    points: tuple[Point, ...]
    counted: tuple[Point, ...]
    front: tuple[Point, ...]
    cheapest: Mapping[float, Point | None]
    absent: Mapping[str, str]

    @property
    def truth(self) -> ReferenceValue:
        """The reference of the errors."""
        return self.answers.truth

    @property
    def solvers(self) -> tuple[str, ...]:
        """The solvers with a point, in the order of the family."""
        return tuple(dict.fromkeys(point.model for point in self.points))

    @property
    def peers(self) -> tuple[str, ...]:
        """The solvers of other projects with a point."""
        return tuple(peer.name for peer in self.family.peers if peer.name in self.solvers)

    def error(self, point: Point) -> float:
        """The relative error of a point."""
        return point.error[self.family.quantity]


def judged(family: ChartFamily, answers: Answers, absent: Mapping[str, str]) -> Chart:
    """The chart of a family with the errors of all points, the front, and the cheapest points."""
    points = {
        (ask.solver, ask.resolution): Point(
            model=ask.solver,
            resolution=ask.resolution,
            cpu_s=answers.points[ask.name].cpu_s,
            error={family.quantity: abs(answers.points[ask.name].value / answers.truth.value - 1)},
        )
        for ask in family.asks()
        if ask.name in answers.points
    }
    counted = counting(tuple(points.values()), family.quantity, answers.truth.uncertainty)
    return Chart(
        family=family,
        answers=answers,
        points=tuple(points.values()),
        counted=counted,
        front=_worthwhile(pareto_front(counted, family.quantity, answers.truth.uncertainty), family.quantity),
        cheapest={part: _cheapest(counted, family.quantity, part - answers.truth.uncertainty) for part in WITHIN},
        absent=absent,
    )


def counting(points: Sequence[Point], quantity: str, uncertainty: float) -> tuple[Point, ...]:
    """The points with errors that do not benefit from a coincidence.

    The error is the largest of the point's own error, that of the next finer grid, and the relative ``uncertainty`` of
    the reference. A coarse grid whose errors happen to cancel thus has no advantage.
    """
    counted = []
    for point in points:
        finer = [other for other in points if other.model == point.model and other.resolution > point.resolution]
        next_one = min(finer, key=lambda other: other.resolution, default=point)
        error = max(point.error[quantity], next_one.error[quantity], uncertainty)
        counted.append(replace(point, error={quantity: error}))
    return tuple(counted)


def _worthwhile(front: Sequence[Point], quantity: str) -> tuple[Point, ...]:
    """The front without points whose error is above ``MAX_ERROR_RATIO`` times that of the cheaper point before them."""
    chosen: list[Point] = []
    for point in front:
        if not chosen or point.error[quantity] <= MAX_ERROR_RATIO * chosen[-1].error[quantity]:
            chosen.append(point)
    return tuple(chosen)


def _cheapest(counted: Sequence[Point], quantity: str, part: float) -> Point | None:
    good = [point for point in counted if point.error[quantity] <= part]
    return min(good, key=lambda point: point.cpu_s, default=None)


def entries_of(chart: Chart) -> dict[str, Any]:
    """The entries of a chart for JSON."""
    family, answers = chart.family, chart.answers
    front = {(point.model, point.resolution) for point in chart.front}

    def named(point: Point | None) -> dict[str, Any] | None:
        return None if point is None else {"solver": point.model, "resolution": point.resolution, "cpu_s": point.cpu_s}

    return {
        "name": family.name,
        "work": family.work,
        "quantity": family.quantity,
        "unit": family.unit,
        "resolution_meaning": family.resolution_meaning,
        "truth": asdict(answers.truth) | {"taken": answers.taken[TRUTH]},
        "points": [
            {
                "solver": point.model,
                "peer": point.model in chart.peers,
                "resolution": point.resolution,
                "cpu_s": point.cpu_s,
                "value": answers.points[_name(point)].value,
                "error": chart.error(point),
                "error_that_counts": chart.error(counted),
                "on_front": (point.model, point.resolution) in front,
                "details": dict(answers.points[_name(point)].details),
                "taken": answers.taken[_name(point)],
            }
            for point, counted in zip(chart.points, chart.counted, strict=True)
        ],
        "cheapest": [{"within": part, "point": named(point)} for part, point in chart.cheapest.items()],
        "peers": {peer.name: peer.settings for peer in family.peers},
        "absent": dict(chart.absent),
        "left_out": dict(family.left_out),
        "failed": dict(answers.failed),
    }


def columns_of(charts: Sequence[Chart]) -> dict[str, Column]:
    """The columns of a table of all charts with a row for each point."""
    rows = []
    for chart in charts:
        entries = entries_of(chart)
        shared = {"family": entries["name"], "quantity": entries["quantity"], "unit": entries["unit"]}
        truth = {"truth": entries["truth"]["value"], "truth_uncertainty": entries["truth"]["uncertainty"]}
        for point in entries["points"]:
            own = {key: point[key] for key in ("solver", "resolution", "cpu_s", "value", "error", "error_that_counts")}
            flags = {key: float(point[key]) for key in ("peer", "on_front")}
            rows.append({**shared, **own, **flags, **truth, **point["taken"]})
    return {name: Column(values=[row[name] for row in rows], unit=UNITS.get(name, "")) for name in rows[0]}


def _name(point: Point) -> str:
    return f"{point.model}-{point.resolution}"
