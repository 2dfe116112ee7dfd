"""The interface of the roughness of a mixed film: flow factors and contact pressure over the separation."""

from dataclasses import dataclass
from typing import Protocol

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.mechanics.solid import beyond_elasticity
from roughfilm.rom.homogenization.gap_factors import GapFactors


@dataclass(frozen=True, kw_only=True)
class SpotPressures:
    """The pressures on the spots in contact, beside the limit of linear elasticity.

    Attributes
    ----------
    mean : mean over the area in contact, Pa; 0 without contact.
    peak : largest one, Pa; NaN where it is unknown.
    composite_modulus : E*, Pa; infinite where it is unknown.
    """

    mean: float
    peak: float
    composite_modulus: float

    @property
    def warnings(self) -> tuple[str, ...]:
        """The sentence on a peak above 0.3 E* (:func:`roughfilm.contact.mechanics.solid.beyond_elasticity`)."""
        return beyond_elasticity(self.peak, self.composite_modulus, "peak pressure of the contacts")

    @property
    def outside(self) -> tuple[str, ...]:
        """The sentence on a mean above 0.3 E*, beyond which no error is known."""
        return beyond_elasticity(self.mean, self.composite_modulus, "mean pressure of the contacts")


class Asperities(Protocol):
    """Flow factors and contact pressure over the separation α of the mean planes of the undeformed walls, m.

    Without contact α is the mean gap. :class:`roughfilm.rom.bearing.mixed.asperity_table.AsperityTable` implements it.
    """

    @property
    def touching(self) -> float:
        """α at first contact, m."""
        ...

    @property
    def closest(self) -> float:
        """The smallest known α, m; the methods raise InputError below it."""
        ...

    @property
    def largest_pressure(self) -> float:
        """The contact pressure at the smallest α, Pa."""
        ...

    def __call__(self, separation: Array, /) -> GapFactors:
        """The flow factors, each of the shape of ``separation``."""
        ...

    def contact_pressure(self, separation: Array) -> Array:
        """The contact pressure p_c(α), Pa: 0 without contact, strictly falling in contact."""
        ...

    def mean_gap(self, separation: Array) -> Array:
        """The mean gap ĥ, m."""
        ...

    def area_fraction(self, separation: Array) -> Array:
        """The fraction of the nominal area in contact."""
        ...

    def spot_pressures(self, separation: float) -> SpotPressures:
        """The pressures on the spots in contact at a separation, m."""
        ...

    def factor_uncertainty(self, separation: float) -> float:
        """The relative uncertainty of the flow factors at separations of at least this, m."""
        ...

    def friction_uncertainty(self, separation: float) -> float:
        """The relative uncertainty of the friction factor d + 3e at a separation, m."""
        ...

    def pressure_uncertainty(self, separation: Array) -> Array:
        """The relative uncertainty of the contact pressure."""
        ...

    def separation_at(self, pressure: float) -> float:
        """The separation α, m, at a contact pressure above 0, Pa."""
        ...
