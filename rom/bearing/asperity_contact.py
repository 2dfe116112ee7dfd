"""The table of a scene that describes contact between the walls of a bearing."""

from typing import Annotated, Self

from pydantic import BeforeValidator, model_validator

from roughfilm.contact.foundation.entries import Part, plain_number
from roughfilm.rom.parts.solids import Counter, HeatConductor, RoughBody


def _friction_coefficient(value: object) -> float:
    number = plain_number(value)
    if not 0 <= number <= 10:
        raise ValueError(f"got {number!r}; it must be 0 to 10")
    return number


class AsperityContact(Part):
    """Contact between the asperities of the rough wall and the smooth wall.

    Attributes
    ----------
    friction : coefficient of boundary friction where asperities touch.
    solid : solid of the rough wall, elastic if it has no hardness; left out with a stored table, which has its own.
    counter : solid of the smooth wall; without it that wall is rigid.
    solid_heat : heat conduction of the solid of the rough wall; the model then estimates the flash temperature of the
        spots in contact.
    counter_heat : that of the solid of the smooth wall; by default the same.
    """

    friction: Annotated[float, BeforeValidator(_friction_coefficient)] = 0.1
    solid: RoughBody | None = None
    counter: Counter | None = None
    solid_heat: HeatConductor | None = None
    counter_heat: HeatConductor | None = None

    @model_validator(mode="after")
    def _has_a_rough_wall(self) -> Self:
        if self.counter is not None and self.solid is None:
            raise ValueError("solid: is missing, but there is a counter; give the solid of the rough wall")
        if self.counter_heat is not None and self.solid_heat is None:
            raise ValueError("solid_heat: is missing, but there is counter_heat; give that of the rough wall")
        return self
