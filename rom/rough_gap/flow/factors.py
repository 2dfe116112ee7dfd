"""Permeability, shear flow and friction of a rough gap in Stokes flow."""

from dataclasses import dataclass

import numpy as np

from roughfilm.rom.homogenization.factors import FlowFactors, GapCoefficients


@dataclass(frozen=True, kw_only=True)
class RoughGapFactors(GapCoefficients):
    """Factors of a gap between a lower wall at rest and a flat upper wall that slides along x at u.

    Flow per width q = (u/2) B - A∇p/(12η), friction on the sliding wall τ = ηu f + B·∇p/2, p averaged. In Stokes flow A
    is symmetric, and by the reciprocal theorem B is the same in flow and friction.

    Attributes
    ----------
    mean_gap : h̄, m.
    pressure : A, shape (2, 2), m³.
    shear : B, shape (2,), m; NaN if the upper wall is not flat.
    friction : f, 1/m, the d + 3e of thin-film theory; NaN if the upper wall is not flat.
    """

    inverse_lengths = ("friction",)
    friction: float


def of_thin_film(factors: FlowFactors, *, slides: bool = True) -> RoughGapFactors:
    """The factors of thin-film theory with f = d + 3e, or their uncertainties, which add up in the same way."""
    return RoughGapFactors(
        mean_gap=factors.mean_gap,
        pressure=factors.pressure,
        shear=factors.shear if slides else np.full(2, np.nan),
        friction=factors.couette + 3 * factors.shear_couette if slides else np.nan,
    )
