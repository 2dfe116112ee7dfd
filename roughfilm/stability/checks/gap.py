"""What answers about a rough gap are judged by: thin-film theory, exact Stokes flow, and what two meshes tend to."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from roughfilm.contact.foundation.errors import ConvergenceError
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.rough_gap.flow.exact import sinusoidal_ridge_flow
from roughfilm.rom.rough_gap.flow.factors import RoughGapFactors, of_thin_film
from roughfilm.stability.wave import Wave

JUDGED = ("A11", "A22", "B1", "friction")

REACH, NEAREST_EXACT, EXACT = 2.7, 0.009, (1e-5, 1e-3)
"""The exact solver is asked for ridges up to this rms slope and down to this least distance, to these tolerances."""

AGREEING = 0.1
"""Cheap rungs are judged by two meshes where these differ by a smaller part of a coefficient."""

THIN_NODES = 256


@dataclass(frozen=True, kw_only=True)
class Truth:
    """Coefficients taken for right, by name, what they may be off, and where from."""

    values: Mapping[str, float]
    off: Mapping[str, float]
    source: str


def exact_thin(wave: Wave) -> Truth:
    """Thin-film theory: of ridges in closed form, of bumps by cell problems on ``THIN_NODES``² nodes."""
    a = wave.amplitude
    if not wave.bumps:
        cubes = 1 + a * a / 2
        values = {
            "A11": (1 - a * a) ** 2.5 / cubes,
            "A22": 1 + 1.5 * a * a,
            "B1": (1 - a * a) / cubes,
            "friction": (4 - 3 / cubes) / np.sqrt(1 - a * a),
        }
        return Truth(values=values, off=dict.fromkeys(values, 0.0), source="a formula")
    from roughfilm.rom.homogenization.flow_factors import flow_factors  # numba is slow to import

    one = np.cos(2 * np.pi * np.arange(THIN_NODES) / THIN_NODES)
    found = flow_factors(1 - a * np.outer(one, one), (wave.wavelength / THIN_NODES,) * 2)
    right, bar = of_thin_film(found.factors), of_thin_film(found.uncertainty)

    def named(of: RoughGapFactors) -> dict[str, float]:
        a11, a22 = np.diag(of.pressure)
        return {"A11": float(a11), "A22": float(a22), "B1": float(of.shear[0]), "friction": of.friction}

    return Truth(values=named(right), off=named(bar), source=f"{THIN_NODES} nodes")


def exact_stokes(wave: Wave) -> Truth | None:
    """Of ridges that the exact solver reaches."""
    if wave.bumps or wave.slope > REACH or 1 - wave.amplitude < NEAREST_EXACT:
        return None
    for tolerance in EXACT:
        try:
            found = sinusoidal_ridge_flow(wave.amplitude, wave.wavelength, tolerance=tolerance)
        except ConvergenceError:
            continue
        values = {"A11": found.across, "A22": found.along, "B1": found.drag, "friction": found.friction}
        off = {name: tolerance * value for name, value in values.items()}
        return Truth(values=values, off=off, source="the exact solver")
    return None


def extrapolated(coarse: Result, fine: Result) -> Truth:
    """From two meshes of second order, one half as fine, of what both tell; may be off by their whole difference."""
    values, off = {}, {}
    for name in JUDGED:
        if name not in coarse.quantities or name not in fine.quantities:
            continue
        one, two = coarse.quantities[name].value, fine.quantities[name].value
        values[name], off[name] = two + (two - one) / 3, abs(two - one)
    return Truth(values=values, off=off, source="two meshes")


def agreeing(truth: Truth | None) -> Truth | None:
    """What two meshes agree about; None if about nothing."""
    if truth is None:
        return None
    values = {name: value for name, value in truth.values.items() if truth.off[name] <= AGREEING * abs(value)}
    return replace(truth, values=values) if values else None
