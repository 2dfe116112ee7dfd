"""Flow across and along ridges over the wavelength: exact Stokes flow, cheaper theories, and OpenFOAM."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from roughfilm.contact.foundation.errors import ConvergenceError
from roughfilm.rom.rough_gap.flow.exact import sinusoidal_ridge_flow
from scripts.studies.rough_gaps.data import GapComparison, asked_of, compare
from scripts.studies.rough_gaps.scenes import over_waves
from scripts.studies.runs import Answers, ModelRun
from scripts.studies.study import kept

AMPLITUDES = (0.1, 0.3, 0.5)
MARKED = (20.0, 5.0, 2.5)
"""Main wavelengths of the report, over the mean gap."""

LENGTHS = (40.0, *MARKED, 1.0)
DRAWN = tuple(float(length) for length in np.geomspace(1, 40, 15))
GRIDS = (32, 48, 64)

FLOW_TOLERANCE = 1e-5
"""Relative tolerance of the exact flow, far below all errors of the report."""


@dataclass(frozen=True, kw_only=True)
class Wave:
    """One sinusoid of amplitude and length over the mean gap.

    ``exact`` is Stokes over Reynolds by coefficient; empty where the exact solver failed.
    """

    amplitude: float
    length: float
    exact: dict[str, float]
    found: GapComparison

    @property
    def slope(self) -> float:
        """The rms slope g' = √2 π a/L."""
        return float(2 * np.pi * self.amplitude / self.length / np.sqrt(2))


@dataclass(frozen=True, kw_only=True)
class Waves:
    """All waves: ``resolved`` by theory and OpenFOAM, ``drawn`` by theory alone."""

    resolved: tuple[Wave, ...]
    drawn: tuple[Wave, ...]


def bare_coefficient(amplitude: float, *, across: bool = True) -> float:
    """Return the factor c of Stokes/Reynolds = 1 - c<h'²> for a gap 1 + a cos kx, k → 0.

    Across the crests 1/A = <h⁻³(1 + 4/5 h'²)>, with <h⁻³> = (1 + a²/2)/(1 - a²)^(5/2) and <h⁻³ sin²> =
    1/2 (1 - a²)^(-3/2): c = 4/5 (1 - a²)/(1 + a²/2). Along them A = <h³(1 - h'²)>: c = (1 + 3a²/4)/(1 + 3a²/2).
    """
    square = amplitude**2
    return 0.8 * (1 - square) / (1 + square / 2) if across else (1 + 0.75 * square) / (1 + 1.5 * square)


def exact_ratios(amplitude: float, length: float, folder: Path) -> dict[str, float]:
    """Return exact Stokes flow over Reynolds' closed forms by coefficient; empty if the exact solver fails."""

    def make() -> dict[str, float]:
        try:
            flow = sinusoidal_ridge_flow(amplitude, length, tolerance=FLOW_TOLERANCE)
        except ConvergenceError:
            return {}
        thin = thin_ratios(amplitude)
        return {
            "A11": flow.across / thin["A11"],
            "A22": flow.along / thin["A22"],
            "B1": flow.drag / thin["B1"],
            "friction": flow.friction / thin["friction"],
        }

    inputs = {"amplitude": amplitude, "length": length, "tolerance": FLOW_TOLERANCE}
    found: dict[str, float] = kept(folder / f"exact-{amplitude:.4g}-{length:.4g}.json", inputs, make)
    return found


def thin_ratios(amplitude: float) -> dict[str, float]:
    """Return the coefficients of waves under a sliding flat wall by Reynolds' theory, over those of a smooth gap.

    A₁₁ = 1/m₃, A₂₂ = <h³>, B₁ = m₂/m₃, f = 4 m₁ - 3 m₂²/m₃, with m_n = <h⁻ⁿ>.
    """
    left = 1 - amplitude**2
    m1, m2, m3 = left**-0.5, left**-1.5, (1 + amplitude**2 / 2) * left**-2.5
    return {"A11": 1 / m3, "A22": 1 + 1.5 * amplitude**2, "B1": m2 / m3, "friction": 4 * m1 - 3 * m2**2 / m3}


def asked(amplitudes: Sequence[float] = AMPLITUDES, lengths: Sequence[float] = LENGTHS) -> list[ModelRun]:
    """Return the runs of OpenFOAM that :func:`waves` needs."""
    return [one for a in amplitudes for length in lengths for one in asked_of(over_waves(a, length), GRIDS)]


def waves(
    answers: Answers,
    folder: Path,
    amplitudes: Sequence[float] = AMPLITUDES,
    lengths: Sequence[float] = LENGTHS,
    drawn: Sequence[float] = DRAWN,
) -> Waves:
    """Return all waves with their results."""

    def wave(amplitude: float, length: float, grids: Sequence[int]) -> Wave:
        name = f"a = {amplitude:g}, L = {length:.4g}"
        return Wave(
            amplitude=amplitude,
            length=length,
            exact=exact_ratios(amplitude, length, folder),
            found=compare(name, "sinusoid", over_waves(amplitude, length), grids, answers),
        )

    return Waves(
        resolved=tuple(wave(a, length, GRIDS) for a in amplitudes for length in lengths),
        drawn=tuple(wave(a, length, ()) for a in amplitudes for length in drawn),
    )
