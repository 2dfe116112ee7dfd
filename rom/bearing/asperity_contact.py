"""The table of a scene that describes contact between the walls of a bearing."""

from typing import Annotated, Self

from pydantic import BeforeValidator, model_validator

from roughfilm.contact.foundation.entries import Part, plain_number
from roughfilm.rom.parts.solids import Counter, RoughBody


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
    """

    friction: Annotated[float, BeforeValidator(_friction_coefficient)] = 0.1
    solid: RoughBody | None = None
    counter: Counter | None = None

    @model_validator(mode="after")
    def _has_a_rough_wall(self) -> Self:
        if self.counter is not None and self.solid is None:
            raise ValueError("solid: is missing, but there is a counter; give the solid of the rough wall")
        return self
