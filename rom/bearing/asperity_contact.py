"""What happens where the walls of a bearing touch, as a scene file writes it."""

from typing import Annotated, Self

from pydantic import BeforeValidator, model_validator

from roughfilm.contact.foundation.entries import Part, plain_number
from roughfilm.rom.parts.solids import Counter, RoughBody


def _not_negative(value: object) -> float:
    number = plain_number(value)
    if not 0 <= number <= 10:
        raise ValueError(f"got {number!r}; it must be 0 to 10")
    return number


class AsperityContact(Part):
    """Boundary ``friction`` where asperities touch, and the solids: of the rough wall, and of the smooth one.

    The smooth wall is rigid without ``counter``, the rough one elastic without a hardness. A roughness that is a stored
    table was made for its solids, and here are none then.
    """

    friction: Annotated[float, BeforeValidator(_not_negative)] = 0.1
    solid: RoughBody | None = None
    counter: Counter | None = None

    @model_validator(mode="after")
    def _has_a_rough_wall(self) -> Self:
        if self.counter is not None and self.solid is None:
            raise ValueError("solid: is missing, but there is a counter; say of what the rough wall is")
        return self
