"""The scene entries of the two solids of a contact."""

import math
from typing import Annotated

from pydantic import AfterValidator, BeforeValidator

from roughfilm.contact.foundation.entries import InUnit, Part, plain_number
from roughfilm.contact.mechanics import solid

Pressure = Annotated[float, InUnit("Pa")]


def _ratio(value: float) -> float:
    if not 0 <= value <= 0.5:
        raise ValueError(f"got {value!r}; it must be 0 to 0.5")
    return value


class Counter(Part):
    """An elastic body with Young's modulus, Pa, and Poisson's ratio.

    Attributes
    ----------
    modulus : Young's modulus, Pa.
    poisson : Poisson's ratio, 0 to 0.5.
    """

    modulus: Pressure
    poisson: Annotated[float, BeforeValidator(plain_number), AfterValidator(_ratio)]

    @property
    def solid(self) -> solid.Solid:
        """The body as a solid of contact mechanics."""
        return solid.Solid(modulus=self.modulus, poisson=self.poisson)


class RoughBody(Counter):
    """The rough body, plastic where the pressure reaches its hardness, Pa, and elastic without one.

    Attributes
    ----------
    hardness : pressure at which the body yields, Pa; without it the body is elastic.
    """

    hardness: Pressure | None = None


class HeatConductor(Part):
    """How a solid conducts and stores heat.

    Attributes
    ----------
    conductivity : thermal conductivity k, W/(m K).
    density : density ρ, kg/m³.
    heat_capacity : specific heat capacity c, J/(kg K).
    """

    conductivity: Annotated[float, InUnit("W/(m*K)")]
    density: Annotated[float, InUnit("kg/m^3")]
    heat_capacity: Annotated[float, InUnit("J/(kg*K)")]

    @property
    def heat_per_volume(self) -> float:
        """The heat capacity ρ c of a volume, J/(m³ K)."""
        return self.density * self.heat_capacity


def composite_modulus(body: RoughBody, counter: Counter | None) -> float:
    """The composite modulus E*, Pa; the default counter body is rigid."""
    return solid.composite_modulus(body.solid, None if counter is None else counter.solid)


def hardness(body: RoughBody) -> float:
    """The hardness H, Pa; infinite for an elastic solid."""
    return math.inf if body.hardness is None else body.hardness
