"""Flow factors as functions of the mean gap: what a film asks of the roughness that it averages."""

from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.homogenization.factors import FlowFactors


@dataclass(frozen=True, kw_only=True)
class GapFactors:
    """Homogenized coefficients at many mean gaps, arrays of one shape, as :class:`FlowFactors` has them for one.

    Attributes
    ----------
    along, across, cross : A₁₁, A₂₂ and A₁₂ = A₂₁, m³; 0 where no open path leads through.
    drag, drag_across : B₁ and B₂, m.
    couette, shear_couette : d and e, 1/m.
    streaming : friction over ηuξ where liquid fills the part ξ of the gap and no pressure is: B₁ <h⁻²>, 1/m, where
        streamers go straight on, thin where they are wide.
    least : the least gap, m; 0 where the walls touch.
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
    """factors(mean_gap): the coefficients where the gap, averaged over the roughness, is that; m, of any shape."""

    def __call__(self, mean_gap: Array, /) -> GapFactors:
        """The coefficients, each of the shape of ``mean_gap``."""
        ...


def mirrored_factors(factors: FactorsOverGap) -> FactorsOverGap:
    """Of the roughness seen in a mirror across the sliding, x turned round, slid towards growing x as before."""

    def mirrored(mean_gap: Array) -> GapFactors:
        found = factors(mean_gap)
        return replace(found, cross=-found.cross, drag_across=-found.drag_across)

    return mirrored


def flow_factors_at(mean_gap: float, factors: FactorsOverGap) -> FlowFactors:
    """The coefficients at one mean gap, m; a direction in which A is 0 is sealed."""
    found = factors(np.array([mean_gap]))
    along, across, cross = (float(values[0]) for values in (found.along, found.across, found.cross))
    return FlowFactors(
        mean_gap=mean_gap,
        pressure=np.array([[along, cross], [cross, across]]),
        shear=np.array([found.drag[0], found.drag_across[0]]),
        couette=float(found.couette[0]),
        shear_couette=float(found.shear_couette[0]),
        sealed=(along == 0, across == 0),
    )
