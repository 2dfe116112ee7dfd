"""Stokes flow in three dimensions over random surfaces and a milled window, against Reynolds' on the same heights."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from roughfilm.rom.rough_gap.scene import RoughGap
from scripts.studies.rough_gaps.data import GapComparison, asked_of, compare
from scripts.studies.rough_gaps.scenes import MILLED, gap, over_random, peak_over_rms
from scripts.studies.runs import Answers, ModelRun

GRIDS = (24, 32, 48)

ROUGHNESSES = (0.1, 0.2, 0.3)
WAVELENGTHS = (10.0, 5.0, 2.5)
"""Wavelengths λ over the mean gap."""

STRIATED = ((0.2, 5.0),)
"""Sq and λ over the mean gap of the surface with a lay."""

ABOVE_PEAK = (1.5, 2.5, 5.0)
"""Mean gaps of the milled window over the height of its highest point."""

WINDOW_GRIDS = (32, 48, 64)
LAYERS = 8
"""Number of layers of the meshes of that window; its low slopes need few layers."""


@dataclass(frozen=True, kw_only=True)
class ResolvedGap:
    """A gap that is resolved in three dimensions."""

    name: str
    group: str
    scene: RoughGap
    grids: Sequence[int] = GRIDS


def cases(
    window: Path | None,
    roughnesses: Sequence[float] = ROUGHNESSES,
    wavelengths: Sequence[float] = WAVELENGTHS,
    above: Sequence[float] = ABOVE_PEAK,
) -> list[ResolvedGap]:
    """Return random gaps, gaps with a lay, and gaps over the milled window if it is available."""
    found = [
        ResolvedGap(
            name=f"Sq/h̄ {roughness:g}, λ/h̄ {wavelength:g}", group="isotropic", scene=over_random(roughness, wavelength)
        )
        for roughness in roughnesses
        for wavelength in wavelengths
    ]
    found += [
        ResolvedGap(
            name=f"Sq/h̄ {roughness:g}, λ/h̄ {wavelength:g}, ridges along x",
            group="with a lay",
            scene=over_random(roughness, wavelength, lay=True),
        )
        for roughness, wavelength in STRIATED
    ]
    if window is not None:
        surface = gap({"surface": str(window)}, mean_gap=1e-3).surface()
        peak = peak_over_rms(surface) * float(surface.heights.std())
        found += [
            ResolvedGap(
                name=f"h̄ = {part:g} times the highest point",
                group=MILLED,
                scene=gap({"surface": str(window)}, mean_gap=part * peak, layers=LAYERS),
                grids=WINDOW_GRIDS,
            )
            for part in above
        ]
    return found


def asked(all_cases: Sequence[ResolvedGap]) -> list[ModelRun]:
    """Return the runs of OpenFOAM that :func:`surfaces` needs."""
    return [one for case in all_cases for one in asked_of(case.scene, case.grids)]


def surfaces(all_cases: Sequence[ResolvedGap], answers: Answers) -> tuple[GapComparison, ...]:
    """Compare all gaps."""
    return tuple(compare(case.name, case.group, case.scene, case.grids, answers) for case in all_cases)
