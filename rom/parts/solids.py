"""The two solids of a contact, as a scene file writes them."""

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
    """An elastic body: Young's modulus, Pa, and Poisson's ratio."""

    modulus: Pressure
    poisson: Annotated[float, BeforeValidator(plain_number), AfterValidator(_ratio)]

    @property
    def solid(self) -> solid.Solid:
        """What it is to contact mechanics."""
        return solid.Solid(modulus=self.modulus, poisson=self.poisson)


class RoughBody(Counter):
    """The rough body: elastic, and plastic where pressure reaches its hardness, Pa; elastic alone if it has none."""

    hardness: Pressure | None = None


def composite_modulus(body: RoughBody, counter: Counter | None) -> float:
    """E*, Pa; the counter body is rigid if not given."""
    return solid.composite_modulus(body.solid, None if counter is None else counter.solid)


def hardness(body: RoughBody) -> float:
    """H, Pa; infinite for an elastic solid."""
    return math.inf if body.hardness is None else body.hardness
