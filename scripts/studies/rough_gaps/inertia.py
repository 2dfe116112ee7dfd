"""Loss of flow by inertia over the Reynolds number, from Navier–Stokes and Stokes flow on the same mesh."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np
from scipy.optimize import least_squares

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.rough_gap.scene import RoughGap
from roughfilm.rom.studies.convergence import converge
from scripts.studies.rough_gaps.data import ORDER
from scripts.studies.rough_gaps.scenes import CREEPING, over_random, over_waves
from scripts.studies.runs import Answers, ModelRun

REYNOLDS = (3.0, 10.0, 30.0, 100.0, 300.0)
WAVES = ((0.1, 5.0), (0.3, 20.0), (0.3, 5.0), (0.3, 2.5), (0.5, 5.0))
"""Amplitudes and lengths of the waves over the mean gap."""

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
"""Numbers of mesh columns for waves and for random surfaces."""

MAX_FITTED_LOSS, MIN_FITTED_FLOWS = 0.1, 4
"""Largest relative loss of flow that is fitted, and least number of flows for a fit."""

RIDGES, SURFACES = "waves", "random surfaces"

NOISE = 1e-4
"""Relative loss of flow that the tolerance of the solver may cause."""

MAX_RELATIVE_UNCERTAINTY = 0.4
"""Largest uncertainty of a fitted loss, relative to the loss."""

LEVELS = (0.01, 0.05)


@dataclass(frozen=True, kw_only=True)
class InertialLoss:
    """The loss of flow by inertia in one gap along x.

    Attributes
    ----------
    reynolds_number : Re of a smooth gap under the same gradient.
    flow_reynolds_number : Re* = ρq/η with the flow q of Stokes.
    lost, bar : loss 1 - A₁₁(Navier–Stokes)/A₁₁(Stokes), extrapolated from two or three meshes, and its uncertainty.
    meshes : loss on each mesh.
    """

    name: str
    group: str
    slope: float
    roughness: float
    wavelength: float
    reynolds_number: float
    flow_reynolds_number: float
    lost: float
    bar: float
    meshes: tuple[float, ...]


@dataclass(frozen=True, kw_only=True)
class InertiaLaw:
    """Loss of flow by inertia, 1 - NS/Stokes = c (Re* g')² / (1 + b Re* h̄/λ), fitted to gaps of one group.

    The loss is quadratic in Re at small Re, because it is even in Re, and nearly linear in Re at large Re.

    Attributes
    ----------
    coefficient, saturation : c and b.
    spread : factor by which flows scatter about the law, one standard deviation of its logarithm.
    worst : factor of the flow that is farthest from the law.
    count : number of fitted flows.
    """

    group: str
    coefficient: float
    saturation: float
    spread: float
    worst: float
    count: int

    def lost(self, one: InertialLoss) -> float:
        """Return the relative loss of flow by the law."""
        square = (one.flow_reynolds_number * one.slope) ** 2
        return self.coefficient * square / (1 + self.saturation * one.flow_reynolds_number / one.wavelength)


@dataclass(frozen=True, kw_only=True)
class Inertia:
    """All flows and the law of each group of gaps."""

    flows: tuple[InertialLoss, ...]
    laws: tuple[InertiaLaw, ...]

    def earliest(self, part: float) -> float | None:
        """Return the least Re* g' at which a gap loses the fraction ``part`` of its flow; None if no gap does."""
        return min((place for _, place in self.crossings(part).values()), default=None)

    def crossings(self, part: float) -> dict[str, tuple[float, float]]:
        """Return Re and Re* g′ at which the fraction ``part`` is lost, interpolated, by the name of the gap."""
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
    """A gap at one Reynolds number, and its runs: Stokes and Navier–Stokes flow on each mesh."""

    group: str
    name: str
    scene: RoughGap
    asked: tuple[tuple[ModelRun, ModelRun], ...]


def _flow(group: str, name: str, make: Callable[..., RoughGap], reynolds_number: float, grids: Sequence[int]) -> _Flow:
    scene, creeping = (make(reynolds_number=number) for number in (reynolds_number, CREEPING))
    return _Flow(
        group=group,
        name=name,
        scene=scene,
        asked=tuple(
            (
                ModelRun(scene=creeping, model="stokes", resolution=grid),
                ModelRun(scene=scene, model="navier_stokes", resolution=grid),
            )
            for grid in grids
        ),
    )


def _flows(shapes: Sequence[tuple[float, float]], reynolds: Sequence[float], random: Random) -> list[_Flow]:
    """Return the flows over sinusoids and over random surfaces."""
    flows = [
        _flow(RIDGES, f"a = {a:g}, L = {length:g}", partial(over_waves, a, length), number, GRIDS)
        for a, length in shapes
        for number in reynolds
    ]
    for (roughness, length), numbers in random.items():
        name, make = f"random, Sq = {roughness:g}, λ = {length:g}", partial(over_random, roughness, length)
        flows += [_flow(SURFACES, name, make, number, RANDOM_GRIDS) for number in numbers]
    return flows


def asked(
    shapes: Sequence[tuple[float, float]] = WAVES, reynolds: Sequence[float] = REYNOLDS, random: Random = RANDOM
) -> list[ModelRun]:
    """Return the runs of OpenFOAM that :func:`inertia` needs."""
    return [one for flow in _flows(shapes, reynolds, random) for pair in flow.asked for one in pair]


def inertia(
    answers: Answers,
    shapes: Sequence[tuple[float, float]] = WAVES,
    reynolds: Sequence[float] = REYNOLDS,
    random: Random = RANDOM,
) -> Inertia:
    """Return all flows that were solved on every mesh, and the laws fitted to them."""
    found = [
        _held(flow, answers)
        for flow in _flows(shapes, reynolds, random)
        if all(one.key in answers for pair in flow.asked for one in pair)
    ]
    laws = (_fit(group, found) for group in (RIDGES, SURFACES))
    return Inertia(flows=tuple(found), laws=tuple(law for law in laws if law))


def _held(flow: _Flow, answers: Answers) -> InertialLoss:
    passed = [[answers[one.key].quantities["A11"].value for one in pair] for pair in flow.asked]
    lost = [1 - inert / creeping for creeping, inert in passed]
    grids = [stokes.resolution for stokes, _ in flow.asked]
    found = converge(grids, lost, formal_order=ORDER, noise=NOISE)
    return InertialLoss(
        name=flow.name,
        group=flow.group,
        slope=flow.scene.rms_slope,
        roughness=flow.scene.rms_height / flow.scene.mean_gap,
        wavelength=1 / flow.scene.gap_over_wavelength,
        reynolds_number=flow.scene.reynolds_number,
        flow_reynolds_number=flow.scene.reynolds_number * passed[-1][0],
        lost=found.value,
        bar=found.uncertainty,
        meshes=tuple(lost),
    )


def _fit(group: str, found: Sequence[InertialLoss]) -> InertiaLaw | None:
    own = [
        one
        for one in found
        if one.group == group and 0 < one.lost < MAX_FITTED_LOSS and one.bar < MAX_RELATIVE_UNCERTAINTY * one.lost
    ]
    if len(own) < MIN_FITTED_FLOWS:
        return None
    reynolds = np.array([one.flow_reynolds_number for one in own])
    squares = np.log((reynolds * np.array([one.slope for one in own])) ** 2)
    ratios, lost = reynolds / np.array([one.wavelength for one in own]), np.log([one.lost for one in own])

    def missed(law: Array) -> Array:
        return np.asarray(law[0] + squares - np.log1p(law[1] * ratios) - lost)

    best = least_squares(missed, [-7.0, 0.1], bounds=([-np.inf, 0.0], np.inf), xtol=1e-12, ftol=1e-12)
    return InertiaLaw(
        group=group,
        coefficient=float(np.exp(best.x[0])),
        saturation=float(best.x[1]),
        spread=float(np.exp(best.fun.std())),
        worst=float(np.exp(np.abs(best.fun).max())),
        count=len(own),
    )
