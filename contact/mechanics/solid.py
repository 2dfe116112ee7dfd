"""Material of the bodies in contact, and their composite modulus."""

import math
from dataclasses import dataclass

from roughfilm.contact.foundation.errors import InputError


@dataclass(frozen=True, kw_only=True)
class Solid:
    """A linear elastic, perfectly plastic solid.

    Attributes
    ----------
    modulus : Young's modulus E, Pa.
    poisson : Poisson's ratio ν, 0 to 0.5.
    hardness : H, largest pressure, Pa; infinite for an elastic solid.

    Raises
    ------
    InputError
        If a number is out of range.
    """

    modulus: float
    poisson: float
    hardness: float = math.inf

    def __post_init__(self) -> None:
        if not (self.modulus > 0 and math.isfinite(self.modulus)):
            raise InputError(f"solid.modulus: got {self.modulus:g} Pa; it must be above 0 and finite")
        if not 0 <= self.poisson <= 0.5:
            raise InputError(f"solid.poisson: got {self.poisson:g}; it must be 0 to 0.5")
        if not self.hardness > 0:
            raise InputError(f"solid.hardness: got {self.hardness:g} Pa; it must be above 0, leave it out if elastic")


def composite_modulus(solid: Solid, counter: Solid | None = None) -> float:
    """Composite modulus E* of two solids, 1/E* = (1 − ν1²)/E1 + (1 − ν2²)/E2, Pa; without a counter body it is rigid.

    Source: thesis Eq. E.8; K. L. Johnson, Contact Mechanics (1985), Eq. 4.20.

    Examples
    --------
    >>> round(composite_modulus(Solid(modulus=210e9, poisson=0.3)) / 1e9, 3)
    230.769
    """
    compliance = sum((1 - body.poisson**2) / body.modulus for body in (solid, counter) if body is not None)
    return 1 / compliance
