"""What a chart of speed against accuracy is made of: a family, its truth, and the points that are asked for."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Any

from roughfilm.figures.view import Style, views
from roughfilm.rom.ladder.kind import Scene
from roughfilm.rom.ladder.model import Model, of_kind
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.studies.convergence import converge

REPEATS, ENOUGH_S = 7, 2.0
"""Points are the fastest of so many runs, of fewer where these would take longer than this; what compiles, of two."""


@dataclass(frozen=True, kw_only=True)
class Measured:
    """One answer: the family's quantity, its CPU seconds, children included, and what else is told of it."""

    value: float
    cpu_s: float
    told: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True, kw_only=True)
class Truth:
    """What answers are judged by, ``uncertainty`` as a part of it, and in words where it comes from."""

    value: float
    uncertainty: float
    source: str
    cpu_s: float = 0.0


@dataclass(frozen=True, kw_only=True)
class Ask:
    """One point of a chart: who is asked, at which resolution, how, and the CPU seconds that it may take in all.

    ``measure`` raises InputError, ConvergenceError or UnavailableError where there is no answer.
    """

    solver: str
    resolution: int
    cost: float
    measure: Callable[[], Measured]

    @property
    def name(self) -> str:
        """By which its answer is kept."""
        return f"{self.solver}-{self.resolution}"


@dataclass(frozen=True, kw_only=True)
class Peer:
    """Someone else's solver of the same problem.

    Attributes
    ----------
    settings : with what it is run, in words.
    costs : the resolutions, each with the CPU seconds that its point may take in all.
    measure : measure(resolution), as that of :class:`Ask`.
    absent : why it cannot be asked here, with the remedy; None where it can.
    """

    name: str
    settings: str
    costs: Mapping[int, float]
    measure: Callable[[int], Measured]
    absent: Callable[[], str | None]

    def asks(self) -> list[Ask]:
        """Its points."""
        return [
            Ask(solver=self.name, resolution=n, cost=cost, measure=partial(self.measure, n))
            for n, cost in self.costs.items()
        ]


@dataclass(frozen=True, kw_only=True)
class Family:
    """One kind of work, done by every model that can and by peers.

    Attributes
    ----------
    name, work : of the family, and what is computed, in a sentence.
    quantity, unit : by what it is judged.
    resolution_meaning : what the numbers beside the points count.
    truth : made before the points are judged, at ``truth_cost`` CPU seconds.
    own : the points of this project.
    left_out : models that do not solve this, with the reason.
    peers : other solvers.
    styles : how this project's own are drawn.
    """

    name: str
    work: str
    quantity: str
    unit: str
    resolution_meaning: str
    truth: Callable[[], Truth]
    truth_cost: float
    own: Sequence[Ask]
    left_out: Mapping[str, str] = field(default_factory=dict)
    peers: Sequence[Peer] = ()
    styles: Mapping[str, Style] = field(default_factory=dict)

    def absent(self) -> dict[str, str]:
        """The peers that cannot be asked on this machine, with the remedy."""
        return {peer.name: why for peer in self.peers if (why := peer.absent()) is not None}

    def asks(self) -> list[Ask]:
        """All points that can be asked for here."""
        absent = self.absent()
        return [*self.own, *(ask for peer in self.peers if peer.name not in absent for ask in peer.asks())]

    @property
    def cost(self) -> float:
        """Expected CPU seconds."""
        return self.truth_cost + sum(ask.cost for ask in self.asks())


def fastest(measure: Callable[[], Measured], *, compiles: bool = True) -> Measured:
    """The fastest of a few runs; where loops are compiled at the first one, of two at least."""
    runs = [measure()]
    least = 2 if compiles else 1
    while len(runs) < least or (len(runs) < REPEATS and (len(runs) + 1) * min(run.cpu_s for run in runs) < ENOUGH_S):
        runs.append(measure())
    return min(runs, key=lambda run: run.cpu_s)


def solved(model: Model, scene: Scene, resolution: int, quantity: str) -> Measured:
    """A model's answer; raises what its ``solve`` raises."""
    found = model.solve(scene, Request(resolution=resolution))
    return Measured(
        value=found.quantities[quantity].value,
        cpu_s=found.numerics.cpu_s,
        told={
            "iterations": found.numerics.iterations,
            "residual": found.numerics.residual,
            "tolerance": found.numerics.tolerance,
        },
    )


def extrapolated(measure: Callable[[int], Measured], resolutions: Sequence[int], words: str) -> Truth:
    """What ever finer grids tend to, by :func:`roughfilm.rom.studies.convergence.converge` at second order at most.

    ``measure`` solves at a resolution and tells the ``residual``; ``words`` say by what.
    """
    runs = [measure(resolution) for resolution in resolutions]
    values, residual = [run.value for run in runs], runs[-1].told["residual"]
    found = converge(resolutions, values, formal_order=2, noise=abs(values[-1]) * residual)
    order = f", observed order {found.order_told}" if found.order is not None else ""
    return Truth(
        value=found.value,
        uncertainty=found.uncertainty / abs(found.value),
        source=f"{words} on {', '.join(map(str, resolutions))}, extrapolated ({found.kind}{order})",
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
    truth: Callable[[], Truth],
    truth_cost: float,
    resolution_meaning: str,
    peers: Sequence[Peer] = (),
) -> Family:
    """The family of one scene: every model of its kind that applies and is here, at all of its resolutions.

    ``key`` is the quantity as results have it.
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
            runs = min(REPEATS, max(1 if outside else 2, ENOUGH_S / cost))
            asks.append(Ask(solver=model.name, resolution=resolution, cost=runs * cost, measure=measure))
    return Family(
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
