"""What any model of a rough gap tells of it: what it lets through, drags along and how it rubs."""

from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.homogenization.factors import FlowFactors


@dataclass(frozen=True, kw_only=True)
class RoughGapFactors:
    """Factors of a gap, lower wall at rest and a flat upper one sliding along x at u.

    Flow per width q = (u/2) B - A∇p/(12η), friction on the sliding wall τ = ηu f + B·∇p/2, p averaged. In Stokes flow A
    is symmetric, and the B of flow and friction are one, by the reciprocal theorem.

    Attributes
    ----------
    mean_gap : h̄, m.
    pressure : A, shape (2, 2), m³.
    shear : B, shape (2,), m; NaN where the upper wall is not flat.
    friction : f, 1/m; NaN likewise. It is d + 3e of thin-film theory.
    """

    mean_gap: float
    pressure: Array
    shear: Array
    friction: float

    @property
    def relative(self) -> Self:
        """Over those of a smooth film as thick as the mean gap: A/h̄³, B/h̄, f h̄."""
        return self.scaled(1 / self.mean_gap)

    def scaled(self, factor: float) -> Self:
        """Of the gap and its period ``factor`` times as large."""
        return replace(
            self,
            mean_gap=self.mean_gap * factor,
            pressure=self.pressure * factor**3,
            shear=self.shear * factor,
            friction=self.friction / factor,
        )


def of_thin_film(factors: FlowFactors, *, slides: bool = True) -> RoughGapFactors:
    """Those of thin-film theory, with f = d + 3e; of uncertainties likewise, as those of both parts add up."""
    return RoughGapFactors(
        mean_gap=factors.mean_gap,
        pressure=factors.pressure,
        shear=factors.shear if slides else np.full(2, np.nan),
        friction=factors.couette + 3 * factors.shear_couette if slides else np.nan,
    )
