"""Flow factors: the averaged coefficients of a rough gap."""

from dataclasses import dataclass, replace
from typing import ClassVar, Self

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.units import Quantity

NAMES = ("A11", "A12", "A21", "A22", "B1", "B2", "d", "e")
"""Names of the numbers of flow factors, in the order of their definition."""


@dataclass(frozen=True, kw_only=True)
class GapCoefficients:
    """Coefficients A and B of a gap, which scale with its size; subclasses name theirs that are inverse lengths."""

    inverse_lengths: ClassVar[tuple[str, ...]] = ()
    mean_gap: float
    pressure: Array
    shear: Array

    @property
    def relative(self) -> Self:
        """The coefficients over those of a smooth film of the mean gap: A/ĥ³, B/ĥ and inverse lengths times ĥ."""
        return self.scaled(1 / self.mean_gap)

    def scaled(self, factor: float) -> Self:
        """The coefficients of the gap and its period multiplied by ``factor``."""
        return replace(
            self,
            mean_gap=self.mean_gap * factor,
            pressure=self.pressure * factor**3,
            shear=self.shear * factor,
            **{name: getattr(self, name) / factor for name in self.inverse_lengths},
        )


@dataclass(frozen=True, kw_only=True)
class FlowFactors(GapCoefficients):
    """Homogenized coefficients of a gap between a rough wall at rest and a smooth wall sliding along x at u.

    Flow per width q = (u/2) B − A∇p/(12η), friction on the sliding wall τ = ηu (d + 3e) + C·∇p/2, p the pressure
    averaged over the cell; C = B by the symmetry of the cell problems. A smooth gap has A = h³I, B = (h, 0), d = 1/h,
    e = 0. The same factors hold for a lubricant of constant bulk modulus, with θ before each term (Almqvist and Dasht).

    Attributes
    ----------
    mean_gap : m.
    pressure : A, shape (2, 2), m³; symmetric, positive semidefinite; rows and columns of a sealed direction are 0.
    shear : B, shape (2,), m.
    couette : d = <1/h> over the open gap, 1/m; contact is left out.
    shear_couette : e = <h ∂χ₃/∂x>, 1/m, from the pressure that sliding alone generates.
    sealed : whether no open path leads through the gap in x, and in y. Paths with h³ below 1e-14 of the largest count
        as open, but their flow is neglected.

    Sources: Sahlin 2008, E.2.3 to E.2.5 (whose C, d and e have the factors 1/2 and 6η u left out in print).
    """

    inverse_lengths = ("couette", "shear_couette")
    couette: float
    shear_couette: float
    sealed: tuple[bool, bool] = (False, False)


@dataclass(frozen=True, kw_only=True)
class FactorScatter:
    """The scatter of flow factors between windows of a surface, NaN where it is unknown.

    Attributes
    ----------
    mean : half width of the 95 % confidence interval of the mean of each factor.
    low, high : ends of the 95 % prediction interval for one further window.
    """

    mean: FlowFactors
    low: FlowFactors
    high: FlowFactors


def relative_quantities(factors: FlowFactors, uncertainty: FlowFactors) -> dict[str, Quantity]:
    """The numbers by their ``NAMES`` over those of a smooth film of the same mean gap, with uncertainties."""
    values, half_widths = (
        np.array([*one.pressure.ravel(), *one.shear, one.couette, one.shear_couette])
        for one in (factors.relative, replace(uncertainty, mean_gap=factors.mean_gap).relative)
    )
    return {
        name: Quantity(value=float(value), unit="1", uncertainty=float(width) if np.isfinite(width) else None)
        for name, value, width in zip(NAMES, values, half_widths, strict=True)
    }
