"""Flow factors in polar coordinates: a roughness that follows the angle and the radius, as on a thrust bearing."""

from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.homogenization.factors import FlowFactors


@dataclass(frozen=True, kw_only=True)
class PolarFactors:
    """Coefficients of the homogenized Reynolds equation in x = (θ, r), a wall at rest, the other turning at ω.

        ∇·(𝓑) − ∇·(𝓐∇p/(6ηω)) = 0,  ∇ = (∂/∂θ, ∂/∂r),    T = ∫ ηω r³ (d + 3e) + 𝓑·∇p/2 dθ dr

    Attributes
    ----------
    pressure : 𝓐, shape (2, 2), m², m³; m³, m⁴.
    shear : 𝓑, shape (2,), m² and m³: over ω/2, what flows across a radius, and across a circle per angle.
    couette, shear_couette : d and e, 1/m.
    radius : r, m.
    """

    pressure: Array
    shear: Array
    couette: float
    shear_couette: float
    radius: float


def in_polar(factors: FlowFactors, radius: float) -> PolarFactors:
    """Flow factors of a roughness at a radius r, x along θ and y along r, as the equation in (θ, r) has them.

    The cell of a roughness that is periodic in θ and r is r times as long at r as at 1: solve it with the spacing
    (r dθ, dr). With lengths (r θ, r) in place of (θ, r), 𝓐 = ((A₁₁/r, A₁₂), (A₂₁, r A₂₂)), 𝓑 = (r B₁, r² B₂).

    Source: Sahlin 2008, Eqs. E.19 to E.21 and E.34.
    """
    r = radius
    return PolarFactors(
        pressure=factors.pressure * np.array([[1 / r, 1.0], [1.0, r]]),
        shear=factors.shear * np.array([r, r * r]),
        couette=factors.couette,
        shear_couette=factors.shear_couette,
        radius=r,
    )
