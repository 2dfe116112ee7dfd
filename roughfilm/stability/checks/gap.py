"""References of the coefficients of a rough gap: thin-film theory, exact Stokes flow, and the limit of two meshes."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from roughfilm.contact.foundation.errors import ConvergenceError
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.rough_gap.flow.exact import sinusoidal_ridge_flow
from roughfilm.rom.rough_gap.flow.factors import RoughGapFactors, of_thin_film
from roughfilm.stability.wave import Wave

JUDGED = ("A11", "A22", "B1", "friction")
"""Names of the coefficients that are judged."""

MAX_EXACT_SLOPE = 2.7
"""Largest rms slope of ridges for the exact Stokes solver."""

MIN_EXACT_DISTANCE = 0.009
"""Least distance of the walls over the mean gap for the exact Stokes solver."""

EXACT_TOLERANCES = (1e-5, 1e-3)
"""Relative tolerances of the exact Stokes solver; the second is used if the first fails."""

AGREEMENT = 0.1
"""Largest relative difference of two meshes whose limit judges models without a mesh."""

THIN_NODES = 256
"""Nodes along a side of the cell problems of bumps."""


@dataclass(frozen=True, kw_only=True)
class Coefficients:
    """Reference coefficients over those of a smooth gap, by name, with their uncertainties and their source."""

    values: Mapping[str, float]
    uncertainties: Mapping[str, float]
    source: str


def exact_thin(wave: Wave) -> Coefficients:
    """The coefficients of a wave by thin-film theory: a closed form for ridges, cell problems for bumps.

    The ridges of amplitude a (over the mean gap) have A11 = (1 − a²)^(5/2)/c, A22 = 1 + 3a²/2, B1 = (1 − a²)/c and
    friction (4 − 3/c)/√(1 − a²), with c = 1 + a²/2. The cell problems have ``THIN_NODES`` nodes along each side.
    """
    a = wave.amplitude
    if not wave.bumps:
        cubes = 1 + a * a / 2
        values = {
            "A11": (1 - a * a) ** 2.5 / cubes,
            "A22": 1 + 1.5 * a * a,
            "B1": (1 - a * a) / cubes,
            "friction": (4 - 3 / cubes) / np.sqrt(1 - a * a),
        }
        return Coefficients(values=values, uncertainties=dict.fromkeys(values, 0.0), source="a formula")
    from roughfilm.rom.homogenization.flow_factors import flow_factors  # numba is slow to import

    one = np.cos(2 * np.pi * np.arange(THIN_NODES) / THIN_NODES)
    average = flow_factors(1 - a * np.outer(one, one), (wave.wavelength / THIN_NODES,) * 2)

    def named(factors: RoughGapFactors) -> dict[str, float]:
        a11, a22 = np.diag(factors.pressure)
        return {"A11": float(a11), "A22": float(a22), "B1": float(factors.shear[0]), "friction": factors.friction}

    values, uncertainties = (named(of_thin_film(one)) for one in (average.factors, average.uncertainty))
    return Coefficients(values=values, uncertainties=uncertainties, source=f"{THIN_NODES} nodes")


def exact_stokes(wave: Wave) -> Coefficients | None:
    """The coefficients of exact Stokes flow over ridges; None for bumps, beyond the solver's range, or if it fails."""
    if wave.bumps or wave.slope > MAX_EXACT_SLOPE or 1 - wave.amplitude < MIN_EXACT_DISTANCE:
        return None
    for tolerance in EXACT_TOLERANCES:
        try:
            flow = sinusoidal_ridge_flow(wave.amplitude, wave.wavelength, tolerance=tolerance)
        except ConvergenceError:
            continue
        values = {"A11": flow.across, "A22": flow.along, "B1": flow.drag, "friction": flow.friction}
        uncertainties = {name: tolerance * value for name, value in values.items()}
        return Coefficients(values=values, uncertainties=uncertainties, source="the exact solver")
    return None


def extrapolated(coarse: Result, fine: Result) -> Coefficients:
    """The limit f₂ + (f₂ − f₁)/3 of two meshes of second order, the second twice as fine; uncertainty |f₂ − f₁|."""
    pairs = {
        name: (coarse[name].value, fine[name].value)
        for name in JUDGED
        if name in coarse.quantities and name in fine.quantities
    }
    return Coefficients(
        values={name: two + (two - one) / 3 for name, (one, two) in pairs.items()},
        uncertainties={name: abs(two - one) for name, (one, two) in pairs.items()},
        source="two meshes",
    )


def agreeing(truth: Coefficients | None) -> Coefficients | None:
    """The coefficients whose relative uncertainty is at most ``AGREEMENT``; None if there are none."""
    if truth is None:
        return None
    limits = {name: AGREEMENT * abs(value) for name, value in truth.values.items()}
    values = {name: value for name, value in truth.values.items() if truth.uncertainties[name] <= limits[name]}
    return replace(truth, values=values) if values else None
