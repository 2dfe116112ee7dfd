"""Everything that the report on rough gaps shows, and its summary numbers."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from scripts.studies.rough_gaps.data import GapComparison
from scripts.studies.rough_gaps.inertia import Inertia
from scripts.studies.rough_gaps.map import ModelErrors
from scripts.studies.rough_gaps.range_of_validity import SurfaceValidity
from scripts.studies.rough_gaps.waves import Wave, Waves

MAX_FITTED_SLOPE = 0.35
"""g' from which on no law in g'² is fitted."""


@dataclass(frozen=True, kw_only=True)
class Agreement:
    """How a cheap answer meets a dear one, over some coefficients of some gaps.

    Attributes
    ----------
    worst : the largest difference, over the dear one.
    within : how many lie within both error bars, of ``count``.
    """

    worst: float
    within: int
    count: int


@dataclass(frozen=True, kw_only=True)
class RoughGapStudy:
    """Everything that the report shows.

    Attributes
    ----------
    surfaces : random ones, and the milled window at several mean gaps if it is there.
    reach : measured and made surfaces by theory alone.
    runs, cpu_s : of OpenFOAM.
    failed : why, of what failed.
    """

    waves: Waves
    surfaces: tuple[GapComparison, ...]
    inertia: Inertia
    reach: tuple[SurfaceValidity, ...]
    map: tuple[ModelErrors, ...]
    runs: int
    cpu_s: float
    failed: Mapping[str, str]

    @property
    def random(self) -> list[GapComparison]:
        """Made random surfaces."""
        return [one for one in self.surfaces if not one.measured]

    @property
    def milled(self) -> list[GapComparison]:
        """The measured window over its mean gaps."""
        return [one for one in self.surfaces if one.measured]

    def wave(self, amplitude: float, length: float) -> Wave | None:
        """One of those that were resolved."""
        found = [one for one in self.waves.resolved if (one.amplitude, one.length) == (amplitude, length)]
        return found[0] if found else None

    @property
    def factors(self) -> list[float]:
        """Relative error of Reynolds' equation divided by g'², for every gentle surface and mean gap."""
        return [off.error / one.slope**2 for one in self.reach if one.slope < MAX_FITTED_SLOPE for off in one.found]


def mesh_meets_exact(waves: Sequence[Wave]) -> Agreement:
    """OpenFOAM beside exact flow."""
    pairs = [
        (found.value, exact, found.uncertainty)
        for wave in waves
        for name, exact in wave.exact.items()
        if (found := wave.found.resolved.get(name)) is not None
    ]
    return _agreement(pairs)


def theory_meets_mesh(gaps: Sequence[GapComparison], names: Sequence[str] = ("A11", "A22")) -> Agreement:
    """Slope correction beside OpenFOAM."""
    pairs = [
        (one.theory[name].corrected, found.value, one.theory[name].bar + found.uncertainty)
        for one in gaps
        for name in names
        if (found := one.resolved.get(name)) is not None
    ]
    return _agreement(pairs)


def bounds_hold(gaps: Sequence[GapComparison], names: Sequence[str] = ("A11", "A22")) -> Agreement:
    """How many resolved factors lie between both bounds, but for their error bars; ``worst``: how far one is beyond."""
    past, count, within = 0.0, 0, 0
    for one in gaps:
        for name in names:
            if (found := one.resolved.get(name)) is None:
                continue
            outside = max(one.theory[name].bound - found.value, found.value - 1.0)
            count, within, past = count + 1, within + (outside <= found.uncertainty), max(past, outside)
    return Agreement(worst=past, within=within, count=count)


def _agreement(pairs: Sequence[tuple[float, float, float]]) -> Agreement:
    differences = [abs(one / other - 1) for one, other, _ in pairs]
    within = sum(abs(one - other) <= bar for one, other, bar in pairs)
    return Agreement(worst=float(np.max(differences, initial=0.0)), within=within, count=len(pairs))
