"""Flow factors as functions of the mean gap: the interface between averaged roughness and a film."""

from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.homogenization.factors import FlowFactors


@dataclass(frozen=True, kw_only=True)
class GapFactors:
    """Homogenized coefficients at many mean gaps, arrays of one shape; see :class:`FlowFactors`.

    Attributes
    ----------
    along, across, cross : A₁₁, A₂₂ and A₁₂ = A₂₁, m³; 0 where the gap is sealed.
    drag, drag_across : B₁ and B₂, m.
    couette, shear_couette : d and e, 1/m.
    streaming : friction over ηuξ of straight streamers without pressure that fill the fraction ξ of the gap, B₁ <h⁻²>,
        1/m.
    least : smallest gap, m; 0 where the walls touch.
    """

    along: Array
    across: Array
    cross: Array
    drag: Array
    drag_across: Array
    couette: Array
    shear_couette: Array
    streaming: Array
    least: Array


class FactorsOverGap(Protocol):
    """factors(mean_gap): the coefficients at mean gaps over the roughness, m, of any shape."""

    def __call__(self, mean_gap: Array, /) -> GapFactors:
        """The coefficients, each of the shape of ``mean_gap``."""
        ...


def mirrored_factors(factors: FactorsOverGap) -> FactorsOverGap:
    """The factors of the roughness mirrored in x, with sliding towards increasing x as before."""

    def mirrored(mean_gap: Array) -> GapFactors:
        own = factors(mean_gap)
        return replace(own, cross=-own.cross, drag_across=-own.drag_across)

    return mirrored


def flow_factors_at(mean_gap: float, factors: FactorsOverGap) -> FlowFactors:
    """The coefficients at one mean gap, m; directions with A = 0 are sealed."""
    own = factors(np.array([mean_gap]))
    along, across, cross = (float(values[0]) for values in (own.along, own.across, own.cross))
    return FlowFactors(
        mean_gap=mean_gap,
        pressure=np.array([[along, cross], [cross, across]]),
        shear=np.array([own.drag[0], own.drag_across[0]]),
        couette=float(own.couette[0]),
        shear_couette=float(own.shear_couette[0]),
        sealed=(along == 0, across == 0),
    )
