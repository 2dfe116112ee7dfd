"""The data of a chart of CPU time against error: a family of points, the reference, and other solvers."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Any

from roughfilm.figures.view import Style, views
from roughfilm.rom.ladder.kind import Scene
from roughfilm.rom.ladder.model import Model, of_kind
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.studies.convergence import converge

MAX_RUNS = 7
"""Largest number of runs of a point; the fastest run counts."""

MAX_RUNS_S = 2.0
"""Largest CPU time of all runs of a point together, s; a model that compiles has at least two runs."""


@dataclass(frozen=True, kw_only=True)
class Measured:
    """One answer: the value of the quantity, the CPU time with that of child processes (s), and details by name."""

    value: float
    cpu_s: float
    details: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True, kw_only=True)
class ReferenceValue:
    """The value that errors refer to, its relative ``uncertainty``, its source in words, and its CPU time, s."""

    value: float
    uncertainty: float
    source: str
    cpu_s: float = 0.0


@dataclass(frozen=True, kw_only=True)
class Ask:
    """One point of a chart, to be measured.

    Attributes
    ----------
    solver : name of the solver.
    resolution : resolution of the point.
    cost : expected CPU time of all runs of the point, s.
    measure : function that returns the answer; raises InputError, ConvergenceError or UnavailableError.
    """

    solver: str
    resolution: int
    cost: float
    measure: Callable[[], Measured]

    @property
    def name(self) -> str:
        """The name of the stored answer."""
        return f"{self.solver}-{self.resolution}"


@dataclass(frozen=True, kw_only=True)
class Peer:
    """A solver of another project for the same problem.

    Attributes
    ----------
    name : name of the solver.
    settings : options of the solver, in words.
    costs : expected CPU time of a point by resolution, s.
    measure : measure(resolution) returns the answer, and raises what that of :class:`Ask` raises.
    absent : function that returns why the solver is not available, with the remedy; None if it is available.
    """

    name: str
    settings: str
    costs: Mapping[int, float]
    measure: Callable[[int], Measured]
    absent: Callable[[], str | None]

    def asks(self) -> list[Ask]:
        """The points of this solver."""
        return [
            Ask(solver=self.name, resolution=n, cost=cost, measure=partial(self.measure, n))
            for n, cost in self.costs.items()
        ]


@dataclass(frozen=True, kw_only=True)
class ChartFamily:
    """One problem that every applicable model and solvers of other projects (peers) solve.

    Attributes
    ----------
    name, work : name of the problem, and a sentence about it.
    quantity, unit : name and unit of the quantity whose error is charted.
    resolution_meaning : meaning of the resolutions, in words.
    truth : function that computes the reference.
    truth_cost : expected CPU time of the reference, s.
    own : points of this project.
    left_out : reason by name for models that do not solve the problem.
    peers : solvers of other projects.
    styles : line styles of this project's models.
    """

    name: str
    work: str
    quantity: str
    unit: str
    resolution_meaning: str
    truth: Callable[[], ReferenceValue]
    truth_cost: float
    own: Sequence[Ask]
    left_out: Mapping[str, str] = field(default_factory=dict)
    peers: Sequence[Peer] = ()
    styles: Mapping[str, Style] = field(default_factory=dict)

    def absent(self) -> dict[str, str]:
        """The peers that are not available on this machine, with the remedy."""
        return {peer.name: why for peer in self.peers if (why := peer.absent()) is not None}

    def asks(self) -> list[Ask]:
        """All points that can be measured here."""
        absent = self.absent()
        return [*self.own, *(ask for peer in self.peers if peer.name not in absent for ask in peer.asks())]

    @property
    def cost(self) -> float:
        """The expected CPU seconds of all points and the reference."""
        return self.truth_cost + sum(ask.cost for ask in self.asks())


def fastest(measure: Callable[[], Measured], *, compiles: bool = True) -> Measured:
    """The answer of the fastest of several runs.

    There are at most ``MAX_RUNS`` runs, and no further ones after ``MAX_RUNS_S`` seconds, but at least two if the first
    one ``compiles``.
    """
    runs = [measure()]
    least = 2 if compiles else 1
    while len(runs) < least or (len(runs) < MAX_RUNS and (len(runs) + 1) * min(run.cpu_s for run in runs) < MAX_RUNS_S):
        runs.append(measure())
    return min(runs, key=lambda run: run.cpu_s)


def solved(model: Model, scene: Scene, resolution: int, quantity: str) -> Measured:
    """The answer of a model to a scene: the ``quantity`` of its result; raises what ``solve`` raises."""
    result = model.solve(scene, Request(resolution=resolution))
    return Measured(
        value=result[quantity].value,
        cpu_s=result.numerics.cpu_s,
        details={
            "iterations": result.numerics.iterations,
            "residual": result.numerics.residual,
            "tolerance": result.numerics.tolerance,
        },
    )


def extrapolated(measure: Callable[[int], Measured], resolutions: Sequence[int], words: str) -> ReferenceValue:
    """The limit of fine grids by :func:`roughfilm.rom.studies.convergence.converge`, with an order of at most 2.

    Parameters
    ----------
    measure : measure(resolution) solves the problem; the details of its answer hold the ``residual``.
    resolutions : resolutions of the grids, coarse to fine.
    words : name of the solver for the source.
    """
    runs = [measure(resolution) for resolution in resolutions]
    values, residual = [run.value for run in runs], runs[-1].details["residual"]
    limit = converge(resolutions, values, formal_order=2, noise=abs(values[-1]) * residual)
    order = f", observed order {limit.order_text}" if limit.order is not None else ""
    return ReferenceValue(
        value=limit.value,
        uncertainty=limit.uncertainty / abs(limit.value),
        source=f"{words} on {', '.join(map(str, resolutions))}, extrapolated ({limit.kind}{order})",
        cpu_s=sum(run.cpu_s for run in runs),
    )


def of_scene(
    models: Sequence[Model],
    scene: Scene,
    *,
    name: str,
    work: str,
    quantity: str,
    unit: str,
    key: str,
    truth: Callable[[], ReferenceValue],
    truth_cost: float,
    resolution_meaning: str,
    peers: Sequence[Peer] = (),
) -> ChartFamily:
    """The chart family of one scene: every model of its kind that applies and is available, at all its resolutions.

    ``key`` is the name of the quantity in a result; the other arguments are those of :class:`ChartFamily`.
    """
    asks, left_out = [], {}
    for model in of_kind(models, scene.kind):
        fits = model.applies(scene)
        if not fits.applies:
            left_out[model.name] = fits.reason
            continue
        if not model.available().available:
            left_out[model.name] = model.available().detail
            continue
        outside = model.outside
        for resolution in model.resolutions_of(scene):
            measure = partial(fastest, partial(solved, model, scene, resolution, key), compiles=not outside)
            cost = model.cost(scene, resolution)
            runs = min(MAX_RUNS, max(1 if outside else 2, MAX_RUNS_S / cost))
            asks.append(Ask(solver=model.name, resolution=resolution, cost=runs * cost, measure=measure))
    return ChartFamily(
        name=name,
        work=work,
        quantity=quantity,
        unit=unit,
        resolution_meaning=resolution_meaning,
        truth=truth,
        truth_cost=truth_cost,
        own=asks,
        left_out=left_out,
        peers=peers,
        styles=views()[scene.kind].styles,
    )
