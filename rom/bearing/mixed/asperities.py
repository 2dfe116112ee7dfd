"""The interface of the roughness of a mixed film: flow factors and contact pressure over the separation."""

from typing import Protocol

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.homogenization.gap_factors import GapFactors


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
