"""Data of the report on rough gaps, and its summary numbers."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from scripts.studies.rough_gaps.data import GapComparison
from scripts.studies.rough_gaps.inertia import Inertia
from scripts.studies.rough_gaps.map import ModelErrors
from scripts.studies.rough_gaps.range_of_validity import SurfaceValidity
from scripts.studies.rough_gaps.waves import Wave, Waves

MAX_FITTED_SLOPE = 0.35
"""Rms slope g' below which a law in g'² is fitted."""


@dataclass(frozen=True, kw_only=True)
class Agreement:
    """The agreement of a cheap answer with a costly one, over some coefficients of some gaps.

    Attributes
    ----------
    worst : largest difference over the costly answer.
    within : number of differences within both uncertainties.
    count : number of differences.
    """

    worst: float
    within: int
    count: int


@dataclass(frozen=True, kw_only=True)
class RoughGapStudy:
    """All data of the report.

    Attributes
    ----------
    surfaces : random surfaces, and the milled window at several mean gaps if it is available.
    reach : measured and synthetic surfaces by theory alone.
    runs, cpu_s : number and CPU time (s) of the runs of OpenFOAM.
    failed : reason of each failure.
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
        """The gaps over synthetic random surfaces."""
        return [one for one in self.surfaces if not one.measured]

    @property
    def milled(self) -> list[GapComparison]:
        """The gaps over the measured window, at its mean gaps."""
        return [one for one in self.surfaces if one.measured]

    def wave(self, amplitude: float, length: float) -> Wave | None:
        """Return the resolved wave of this amplitude and length; None if there is none."""
        found = [one for one in self.waves.resolved if (one.amplitude, one.length) == (amplitude, length)]
        return found[0] if found else None

    @property
    def factors(self) -> list[float]:
        """The relative error of Reynolds' equation divided by g'², for every gentle surface and mean gap."""
        return [off.error / one.slope**2 for one in self.reach if one.slope < MAX_FITTED_SLOPE for off in one.found]


def mesh_meets_exact(waves: Sequence[Wave]) -> Agreement:
    """Return the agreement of OpenFOAM with exact flow."""
    pairs = [
        (found.value, exact, found.uncertainty)
        for wave in waves
        for name, exact in wave.exact.items()
        if (found := wave.found.resolved.get(name)) is not None
    ]
    return _agreement(pairs)


def theory_meets_mesh(gaps: Sequence[GapComparison], names: Sequence[str] = ("A11", "A22")) -> Agreement:
    """Return the agreement of the slope correction with OpenFOAM."""
    pairs = [
        (one.theory[name].corrected, found.value, one.theory[name].bar + found.uncertainty)
        for one in gaps
        for name in names
        if (found := one.resolved.get(name)) is not None
    ]
    return _agreement(pairs)


def bounds_hold(gaps: Sequence[GapComparison], names: Sequence[str] = ("A11", "A22")) -> Agreement:
    """Return the number of resolved factors within both bounds and uncertainty; ``worst`` is the largest excess."""
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
