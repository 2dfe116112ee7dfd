"""What a mixed film asks of the roughness between its walls: flow factors, and the pressure where tips touch."""

from typing import Protocol

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.homogenization.gap_factors import GapFactors


class Asperities(Protocol):
    """Flow factors and contact pressure over the separation α of the rigid mean planes, m.

    While nothing touches α is the mean gap; :class:`rom.bearing.mixed.asperity_table.AsperityTable` is one, from a
    surface.
    """

    @property
    def touching(self) -> float:
        """α where the highest point touches, m."""
        ...

    @property
    def closest(self) -> float:
        """The least α that is known, m; InputError below it."""
        ...

    @property
    def largest_pressure(self) -> float:
        """Contact pressure there, Pa."""
        ...

    def __call__(self, separation: Array, /) -> GapFactors:
        """The factors, each of the shape of ``separation``."""
        ...

    def contact_pressure(self, separation: Array) -> Array:
        """p_c(α), Pa: 0 from touching on, strictly falling below it."""
        ...

    def mean_gap(self, separation: Array) -> Array:
        """ĥ, m."""
        ...

    def area_fraction(self, separation: Array) -> Array:
        """The part of the surface that touches."""
        ...

    def doubt_above(self, separation: float) -> float:
        """The part by which factors may be off where no separation is below this, m."""
        ...

    def friction_doubt(self, separation: float) -> float:
        """The part by which the film's friction factor d + 3e may be off at a separation, m."""
        ...

    def pressure_doubt(self, separation: Array) -> Array:
        """The part by which contact pressures may be off."""
        ...

    def separation_at(self, pressure: float) -> float:
        """α, m, of a contact pressure above 0, Pa."""
        ...
