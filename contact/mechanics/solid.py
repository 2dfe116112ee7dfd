"""Material of the bodies in contact, and their composite modulus."""

import math
from dataclasses import dataclass

from roughfilm.contact.foundation.errors import InputError

LINEAR_LIMIT = 0.3
"""Largest pressure over E* at which strains are small enough for linear elasticity."""


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


def contact_outside(load: float, area_fraction: float, composite_modulus: float) -> tuple[str, ...]:
    """The sentence on a mean pressure of the area in contact above 0.3 E*; see :func:`beyond_elasticity`.

    Parameters
    ----------
    load : pressure over the nominal area, Pa.
    area_fraction : area in contact over the nominal area.
    composite_modulus : E*, Pa.
    """
    mean = load / area_fraction if area_fraction > 0 else 0.0
    return beyond_elasticity(mean, composite_modulus, "mean pressure of the contacts")


def beyond_elasticity(pressure: float, composite_modulus: float, what: str = "peak pressure") -> tuple[str, ...]:
    """The sentence on a pressure above 0.3 E*, for which linear elasticity does not hold; none below it.

    Under a sphere of radius R this pressure, 2 a E*/(π R), is reached at a contact radius a of 0.47 R, where the
    parabola that stands for the sphere is wrong as well. A hardness below the limit bounds the pressure.

    Parameters
    ----------
    pressure : a pressure on the surface, Pa.
    composite_modulus : E*, Pa.
    what : name of the pressure.

    Examples
    --------
    >>> beyond_elasticity(4.2e9, 1.1e9)
    ('peak pressure 4200 MPa exceeds 0.3 E* = 330 MPa, beyond which linear elasticity does not hold',)
    """
    limit = LINEAR_LIMIT * composite_modulus
    if not pressure > limit:
        return ()
    return (
        f"{what} {pressure / 1e6:.4g} MPa exceeds {LINEAR_LIMIT:g} E* = {limit / 1e6:.4g} MPa, beyond which linear "
        "elasticity does not hold",
    )
