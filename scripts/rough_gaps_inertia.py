"""What inertia holds back: Navier–Stokes over Stokes on the same mesh, over the Reynolds number."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from rom.convergence import converge
from rom.rough_gap import RoughGap
from scripts.rough_gaps_data import ORDER
from scripts.rough_gaps_runs import Answers, Asked
from scripts.rough_gaps_scenes import CREEPING, over_random, over_waves

REYNOLDS = (3.0, 10.0, 30.0, 100.0, 300.0)
WAVES = ((0.1, 5.0), (0.3, 20.0), (0.3, 5.0), (0.3, 2.5), (0.5, 5.0))
"""Amplitude and length over the mean gap."""

Random = Mapping[tuple[float, float], tuple[float, ...]]

RANDOM: Random = {
    (0.1, 2.5): (10.0, 30.0, 100.0),
    (0.1, 5.0): (10.0, 30.0, 100.0),
    (0.1, 10.0): (30.0, 100.0),
    (0.2, 5.0): (3.0, 10.0, 30.0, 100.0),
    (0.2, 10.0): (10.0, 30.0, 100.0),
}
"""Reynolds numbers of random surfaces by Sq and λ over the mean gap."""

GRIDS, RANDOM_GRIDS = (48, 64), (32, 48, 64)
"""Columns of the waves and of random surfaces."""

LARGEST = 0.012
"""Part of the flow up to which what is held back counts as the beginning of its growth."""

NOISE = 1e-4
"""Part of the flow that the solver's tolerance may hold back."""

KNOWN = 0.4
"""Error bar, over what is held back, up to which it is fitted."""

LEVELS = (0.01, 0.05)


@dataclass(frozen=True, kw_only=True)
class Held:
    """One flow along x.

    Attributes
    ----------
    reynolds_number : Re of a smooth gap under the same gradient.
    flow_reynolds_number : Re* = ρq/η with the flow q of Stokes.
    lost, bar : 1 - A₁₁(Navier–Stokes)/A₁₁(Stokes) on the same mesh, extrapolated from two or three, and its error bar.
    meshes : the same on each mesh.
    """

    name: str
    slope: float
    roughness: float
    wavelength: float
    reynolds_number: float
    flow_reynolds_number: float
    lost: float
    bar: float
    meshes: tuple[float, ...]


MEASURES: Mapping[str, Callable[[Held], float]] = {
    "Re* g′": lambda one: one.flow_reynolds_number * one.slope,
    "Re g′": lambda one: one.reynolds_number * one.slope,
    "Re* h̄/λ": lambda one: one.flow_reynolds_number / one.wavelength,
    "Re* Sq/h̄": lambda one: one.flow_reynolds_number * one.roughness,
    "Re*": lambda one: one.flow_reynolds_number,
    "Re": lambda one: one.reynolds_number,
}
"""What might order them. Re* (h̄/λ)(Sq/h̄) is Re* g′/(2π)."""


@dataclass(frozen=True, kw_only=True)
class Onset:
    """The beginning of what inertia holds back, 1 - NS/Stokes = c X², fitted to all gaps.

    Attributes
    ----------
    measure : X.
    coefficient : c, the geometric mean over the flows.
    spread : the factor by which c scatters, one standard deviation of its logarithm.
    power : of X, were it free.
    count, smallest, largest : flows that were fitted, and the range of their X.
    """

    measure: str
    coefficient: float
    spread: float
    power: float
    count: int
    smallest: float
    largest: float

    def reaches(self, part: float) -> float:
        """X at which so much is held back."""
        return float(np.sqrt(part / self.coefficient))


@dataclass(frozen=True, kw_only=True)
class Inertia:
    """All flows, and the measures from the best to the worst."""

    flows: tuple[Held, ...]
    onsets: tuple[Onset, ...]

    def crossings(self, part: float) -> dict[str, tuple[float, float]]:
        """Re and Re* g′ at which so much is held back, by the name of the gap, between the flows; where that is."""
        found = {}
        for name in dict.fromkeys(one.name for one in self.flows):
            own = [one for one in self.flows if one.name == name and one.lost > 0]
            lost = [one.lost for one in own]
            if not min(lost, default=1.0) <= part <= max(lost, default=0.0):
                continue
            place = float(np.exp(np.interp(np.log(part), np.log(lost), np.log([one.reynolds_number for one in own]))))
            found[name] = (place, place * own[0].flow_reynolds_number / own[0].reynolds_number * own[0].slope)
        return found


@dataclass(frozen=True, kw_only=True)
class _Flow:
    """A gap at one Reynolds number, and what to ask for it: Stokes and Navier–Stokes on each mesh."""

    name: str
    scene: RoughGap
    asked: tuple[tuple[Asked, Asked], ...]


def _flow(name: str, make: Callable[[float], RoughGap], reynolds_number: float, grids: Sequence[int]) -> _Flow:
    scene, creeping = make(reynolds_number), make(CREEPING)
    return _Flow(
        name=name,
        scene=scene,
        asked=tuple(
            (
                Asked(scene=creeping, model="stokes", resolution=grid),
                Asked(scene=scene, model="navier_stokes", resolution=grid),
            )
            for grid in grids
        ),
    )


def _over(shape: tuple[float, float]) -> Callable[[float], RoughGap]:
    return lambda reynolds_number: over_waves(*shape, reynolds_number)


def _over_random(shape: tuple[float, float]) -> Callable[[float], RoughGap]:
    return lambda reynolds_number: over_random(*shape, reynolds_number=reynolds_number)


def _flows(shapes: Sequence[tuple[float, float]], reynolds: Sequence[float], random: Random) -> list[_Flow]:
    """Of sinusoids, and of random surfaces."""
    return [
        *(
            _flow(f"a = {shape[0]:g}, L = {shape[1]:g}", _over(shape), one, GRIDS)
            for shape in shapes
            for one in reynolds
        ),
        *(
            _flow(f"random, Sq = {shape[0]:g}, λ = {shape[1]:g}", _over_random(shape), one, RANDOM_GRIDS)
            for shape, own in random.items()
            for one in own
        ),
    ]


def asked(
    shapes: Sequence[tuple[float, float]] = WAVES, reynolds: Sequence[float] = REYNOLDS, random: Random = RANDOM
) -> list[Asked]:
    """The runs of OpenFOAM that :func:`inertia` looks for."""
    return [one for flow in _flows(shapes, reynolds, random) for pair in flow.asked for one in pair]


def inertia(
    answers: Answers,
    shapes: Sequence[tuple[float, float]] = WAVES,
    reynolds: Sequence[float] = REYNOLDS,
    random: Random = RANDOM,
) -> Inertia:
    """All flows that were solved on every mesh, and fits over them."""
    found = [
        _held(flow, answers)
        for flow in _flows(shapes, reynolds, random)
        if all(one.key in answers for pair in flow.asked for one in pair)
    ]
    return Inertia(flows=tuple(found), onsets=tuple(sorted(_fits(found), key=lambda one: one.spread)))


def _held(flow: _Flow, answers: Answers) -> Held:
    passed = [[answers[one.key].quantities["A11"].value for one in pair] for pair in flow.asked]
    lost = [1 - inert / creeping for creeping, inert in passed]
    grids = [stokes.resolution for stokes, _ in flow.asked]
    found = converge(grids, lost, formal_order=ORDER, noise=NOISE)
    return Held(
        name=flow.name,
        slope=flow.scene.rms_slope,
        roughness=flow.scene.rms_height / flow.scene.mean_gap,
        wavelength=1 / flow.scene.gap_over_wavelength,
        reynolds_number=flow.scene.reynolds_number,
        flow_reynolds_number=flow.scene.reynolds_number * passed[-1][0],
        lost=found.value,
        bar=found.uncertainty,
        meshes=tuple(lost),
    )


def _fits(found: Sequence[Held]) -> list[Onset]:
    begun = [one for one in found if 0 < one.lost < LARGEST and one.bar < KNOWN * one.lost]
    if len(begun) < 3:
        return []
    lost = np.log([one.lost for one in begun])
    fits = []
    for name, measure in MEASURES.items():
        x = np.log([measure(one) for one in begun])
        logs = lost - 2 * x
        fits.append(
            Onset(
                measure=name,
                coefficient=float(np.exp(logs.mean())),
                spread=float(np.exp(logs.std())),
                power=float(np.polyfit(x, lost, 1)[0]),
                count=len(begun),
                smallest=float(np.exp(x.min())),
                largest=float(np.exp(x.max())),
            )
        )
    return fits
