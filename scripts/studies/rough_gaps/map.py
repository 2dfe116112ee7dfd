"""The cheapest model that is accurate enough for a sinusoid of one slope and wavelength."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from scripts.studies.rough_gaps.data import theory_of
from scripts.studies.rough_gaps.scenes import over_waves
from scripts.studies.rough_gaps.waves import exact_ratios, thin_ratios

MODELS = ("smooth_gap", "homogenized", "slope_corrected", "stokes")
"""Models, the cheapest first; without inertia the last one is always accurate enough."""

SLOPES = tuple(float(slope) for slope in np.geomspace(0.02, 1, 14))
LENGTHS = tuple(float(length) for length in np.geomspace(2, 60, 12))
"""Wavelengths λ/h̄; ``SLOPES`` are rms slopes g'."""

MAX_AMPLITUDE = 0.8
"""Largest amplitude over the mean gap."""

NEGLIGIBLE_UNCERTAINTY = 1e-3
"""Largest uncertainty of a slope correction that replaces the exact flow."""


@dataclass(frozen=True, kw_only=True)
class ModelErrors:
    """Errors of the cheaper models in the worse flow, across or along a wave; infinite without an exact flow."""

    slope: float
    length: float
    smooth_gap: float
    homogenized: float
    slope_corrected: float

    def cheapest(self, level: float) -> str:
        """Return the first model whose error is within ``level``."""
        for name in MODELS[:-1]:
            if getattr(self, name) <= level:
                return name
        return MODELS[-1]


def errors(
    folder: Path, slopes: Sequence[float] = SLOPES, lengths: Sequence[float] = LENGTHS
) -> tuple[ModelErrors, ...]:
    """Return the errors for all waves that fit into the gap."""
    return tuple(one for length in lengths for slope in slopes if (one := _errors(slope, length, folder)) is not None)


def _errors(slope: float, length: float, folder: Path) -> ModelErrors | None:
    amplitude = float(slope * np.sqrt(2) * length / (2 * np.pi))
    if amplitude > MAX_AMPLITUDE:
        return None
    scene = over_waves(amplitude, length)
    theory, thin = theory_of(scene.walls(max(scene.surface().shape))), thin_ratios(amplitude)
    names = ("A11", "A22")
    sure = max(theory[name].bar for name in names) < NEGLIGIBLE_UNCERTAINTY
    exact = {name: theory[name].corrected for name in names} if sure else exact_ratios(amplitude, length, folder)
    worst = [
        max(abs(row[name] / exact[name] - 1) for name in names) if exact else np.inf
        for row in (
            {name: 1 / thin[name] for name in names},
            dict.fromkeys(names, 1.0),
            {name: theory[name].corrected for name in names},
        )
    ]
    if sure:
        worst[2] = max(theory[name].bar for name in names)
    return ModelErrors(slope=slope, length=length, smooth_gap=worst[0], homogenized=worst[1], slope_corrected=worst[2])


def serves(found: Sequence[ModelErrors], name: str, level: float) -> float:
    """Return the largest slope up to which a model is within ``level`` for waves of all lengths; 0 if there is none."""
    bad = min((one.slope for one in found if getattr(one, name) > level), default=np.inf)
    return max((one.slope for one in found if one.slope < bad), default=0.0)
