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
"""The coefficients that are judged."""

MAX_EXACT_SLOPE = 2.7
"""Largest rms slope of ridges for the exact Stokes solver."""

MIN_EXACT_DISTANCE = 0.009
"""Least distance of the walls over the mean gap for the exact Stokes solver."""

EXACT_TOLERANCES = (1e-5, 1e-3)
"""Tolerances of the exact Stokes solver; the second where the first fails."""

AGREEMENT = 0.1
"""Relative difference of two meshes up to which a coefficient judges the cheap models."""

THIN_NODES = 256
"""Nodes along a side of the cell problems of bumps."""


@dataclass(frozen=True, kw_only=True)
class Coefficients:
    """Coefficients that are taken for right, by name, with their uncertainties and their source."""

    values: Mapping[str, float]
    uncertainties: Mapping[str, float]
    source: str


def exact_thin(wave: Wave) -> Coefficients:
    """Thin-film theory: a closed form for ridges, cell problems on ``THIN_NODES``² nodes for bumps."""
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
    """Exact Stokes flow between ridges; None for bumps, and beyond the range of the exact solver."""
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
    """The limit of two meshes of second order, one twice as fine; its uncertainty is their whole difference."""
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
    """The coefficients whose uncertainty is at most ``AGREEMENT``; None if there are none."""
    if truth is None:
        return None
    limits = {name: AGREEMENT * abs(value) for name, value in truth.values.items()}
    values = {name: value for name, value in truth.values.items() if truth.uncertainties[name] <= limits[name]}
    return replace(truth, values=values) if values else None
