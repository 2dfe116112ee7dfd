"""Flow through one rough gap, over that by Reynolds' theory: resolved on finer meshes, corrected, and perturbed."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from roughfilm.rom.rough_gap.flow.corrected import SlopeCorrected, slope_corrected
from roughfilm.rom.rough_gap.flow.factors import RoughGapFactors
from roughfilm.rom.rough_gap.flow.waves import nearly_smooth_flow
from roughfilm.rom.rough_gap.scene import RoughGap
from roughfilm.rom.rough_gap.walls import Walls
from roughfilm.rom.studies.convergence import Convergence, converge
from scripts.studies.rough_gaps.scenes import MILLED
from scripts.studies.runs import Answers, ModelRun

NAMES = ("A11", "A22", "B1", "friction")

ORDER = 2
"""Formal order of the meshes."""


@dataclass(frozen=True, kw_only=True)
class Theory:
    """One coefficient by thin-film theory over that of a smooth gap, and other theories over thin-film theory.

    Attributes
    ----------
    reynolds : thin-film theory over a smooth gap of the mean thickness.
    corrected, bar : thin-film theory with the next order in the slope, and its uncertainty.
    bound : bound by the dissipation of the thin-film flow.
    perturbed : Stokes flow to second order in the height, for any wavelengths.
    """

    reynolds: float
    corrected: float
    bar: float
    bound: float
    perturbed: float


@dataclass(frozen=True, kw_only=True)
class GapComparison:
    """A gap, and its coefficients over those of Reynolds' theory on the same heights.

    Attributes
    ----------
    name, group : names for the reader.
    slope, roughness, wavelength : g', Sq/h̄ and λ/h̄ with λ = 2π Sq/g'.
    smallest : least gap over the mean gap.
    theory : theories by coefficient.
    resolved : Stokes flow in OpenFOAM by coefficient; empty if it was not run.
    """

    name: str
    group: str
    slope: float
    roughness: float
    wavelength: float
    smallest: float
    theory: Mapping[str, Theory]
    resolved: Mapping[str, Convergence]

    @property
    def measured(self) -> bool:
        """Whether the surface was measured."""
        return self.group == MILLED


def values_of(factors: RoughGapFactors) -> dict[str, float]:
    """Return the coefficients over those of a smooth gap, by the names of quantities of a result."""
    one = factors.relative
    a = one.pressure
    return {"A11": float(a[0, 0]), "A22": float(a[1, 1]), "B1": float(one.shear[0]), "friction": float(one.friction)}


def theory_of(walls: Walls, found: SlopeCorrected | None = None) -> dict[str, Theory]:
    """Return all theories of a gap; only those of A if both walls are rough."""
    found = slope_corrected(walls) if found is None else found
    thin, corrected, bar, bound = (
        values_of(one) for one in (found.thin, found.corrected, found.uncertainty, found.bound)
    )
    wavy, flat = (values_of(nearly_smooth_flow(walls, stokes=stokes)) for stokes in (True, False))
    return {
        name: Theory(
            reynolds=thin[name],
            corrected=corrected[name] / thin[name],
            bar=bar[name] / thin[name],
            bound=bound[name] / thin[name],
            perturbed=1 + wavy[name] - flat[name],
        )
        for name in NAMES
        if math.isfinite(thin[name]) and thin[name] > 0
    }


def asked_of(scene: RoughGap, grids: Sequence[int]) -> list[ModelRun]:
    """Return the runs that :func:`compare` needs."""
    return [ModelRun(scene=scene, model="stokes", resolution=grid) for grid in grids]


def compare(name: str, group: str, scene: RoughGap, grids: Sequence[int], answers: Answers) -> GapComparison:
    """Compare theory on the points of a gap with its meshes, each over Reynolds' theory on the same nodes."""
    walls = scene.walls(max(scene.surface().shape))
    return GapComparison(
        name=name,
        group=group,
        slope=scene.rms_slope,
        roughness=scene.rms_height / scene.mean_gap,
        wavelength=1 / scene.gap_over_wavelength,
        smallest=float(walls.gap.min()) / walls.mean_gap,
        theory=theory_of(walls),
        resolved=resolved(scene, grids, answers),
    )


def resolved(scene: RoughGap, grids: Sequence[int], answers: Answers) -> dict[str, Convergence]:
    """Return each coefficient over Reynolds' on the same nodes, extrapolated; empty for fewer than two meshes."""
    found = [(one.resolution, answers[one.key]) for one in asked_of(scene, grids) if one.key in answers]
    if len(found) < 2:
        return {}
    thin = [values_of(slope_corrected(scene.walls(grid)).thin) for grid, _ in found]
    return {
        name: converge(
            [grid for grid, _ in found],
            [answer.quantities[name].value / flat[name] for (_, answer), flat in zip(found, thin, strict=True)],
            formal_order=ORDER,
            noise=max(abs(answer.numerics.residual) for _, answer in found),
        )
        for name in NAMES
        if all(name in answer.quantities for _, answer in found)
    }


def best(one: GapComparison, name: str) -> tuple[float, float]:
    """Return Stokes over Reynolds and its uncertainty: resolved if it was run, else by the slope correction."""
    if name in one.resolved:
        return one.resolved[name].value, one.resolved[name].uncertainty
    return one.theory[name].corrected, one.theory[name].bar
