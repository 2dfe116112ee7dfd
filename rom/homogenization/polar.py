"""Flow factors in polar coordinates, for roughness aligned with the angle and the radius of a thrust bearing."""

from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.homogenization.factors import FlowFactors


@dataclass(frozen=True, kw_only=True)
class PolarFactors:
    """Coefficients of the homogenized Reynolds equation in x = (θ, r), one wall at rest, the other rotating at ω.

        ∇·(𝓑) − ∇·(𝓐∇p/(6ηω)) = 0,  ∇ = (∂/∂θ, ∂/∂r),    T = ∫ ηω r³ (d + 3e) + 𝓑·∇p/2 dθ dr

    Attributes
    ----------
    pressure : 𝓐, shape (2, 2), m², m³; m³, m⁴.
    shear : 𝓑, shape (2,), m² and m³: flow across a radius, and across a circle per angle, over ω/2.
    couette, shear_couette : d and e, 1/m.
    radius : r, m.
    """

    pressure: Array
    shear: Array
    couette: float
    shear_couette: float
    radius: float


def in_polar(factors: FlowFactors, radius: float) -> PolarFactors:
    """Flow factors at radius r, with x along θ and y along r, converted to the equation in (θ, r).

    The cell of a roughness that is periodic in θ and r grows with r: solve it with the spacing (r dθ, dr). In terms of
    the factors A and B in the lengths (r θ, r), 𝓐 = ((A₁₁/r, A₁₂), (A₂₁, r A₂₂)), 𝓑 = (r B₁, r² B₂).

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
