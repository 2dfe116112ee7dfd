"""Flow factors of a surface over the mean gap, sampled at some separations and interpolated between them."""

from dataclasses import dataclass, replace

import numpy as np
from scipy.interpolate import PchipInterpolator

from rom.gap import Array
from rom.homogenization.flow_factors import flow_factors
from rom.homogenization.gap_factors import GapFactors

SAMPLES = 25
NARROWEST, WIDEST = 0.5, 30.0
"""Separations over the highest point: from deep in contact, where heights are cut off, to a thick film."""


@dataclass(frozen=True, kw_only=True)
class SampledFactors:
    """``values`` over ln(mean gap): A₁₁, A₂₂ and A₁₂ over ĥ³, B₁ and B₂ over ĥ, d ĥ, e ĥ, B₁ <h⁻²> ĥ.

    ``widest`` is the widest of the gaps, ``peak`` the greatest height above the mean, m.
    """

    values: PchipInterpolator
    widest: float
    peak: float
    scale: float = 1.0

    def scaled(self, factor: float) -> "SampledFactors":
        """Of the surface with its heights multiplied."""
        return replace(self, scale=self.scale * factor)

    def __call__(self, mean_gap: Array, /) -> GapFactors:
        """Beyond the widest gap what roughness does falls with its square; below the narrowest it is as there."""
        h = np.asarray(mean_gap, dtype=float)
        inside = np.clip(h / self.scale, np.exp(self.values.x[0]), self.widest)
        smooth = np.array([1.0, 1, 0, 1, 0, 1, 0, 1])
        share = (inside * self.scale / np.maximum(h, inside * self.scale)) ** 2
        found = smooth + (self.values(np.log(inside)) - smooth) * share[..., None]
        along, across, cross, drag, drag_across, couette, shear_couette, streaming = np.moveaxis(found, -1, 0)
        return GapFactors(
            along=along * h**3,
            across=across * h**3,
            cross=cross * h**3,
            drag=drag * h,
            drag_across=drag_across * h,
            couette=couette / h,
            shear_couette=shear_couette / h,
            streaming=streaming / h,
            least=np.maximum(h - self.peak * self.scale, 0.0),
        )


def sampled_factors(heights: Array, spacing: tuple[float, float], samples: int = SAMPLES) -> SampledFactors:
    """Solve the cell problems of a periodic surface, m, at ``samples`` separations."""
    above = heights - heights.mean()
    gaps, rows = [], []
    for separation in float(above.max()) * np.geomspace(NARROWEST, WIDEST, samples):
        gap = np.maximum(separation - above, 0.0)
        factors = flow_factors(gap, spacing).factors
        a, b, h = factors.pressure, factors.shear, factors.mean_gap
        gaps.append(h)
        rows.append(
            [
                *(value / h**3 for value in (a[0, 0], a[1, 1], a[0, 1])),
                *(b / h),
                factors.couette * h,
                factors.shear_couette * h,
                (factors.couette if (gap == 0).any() else b[0] * float((gap**-2).mean())) * h,
            ]
        )
    values = PchipInterpolator(np.log(gaps), np.array(rows), axis=0)
    return SampledFactors(values=values, widest=gaps[-1], peak=float(above.max()))
