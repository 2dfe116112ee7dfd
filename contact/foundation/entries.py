"""Building blocks of tables in TOML files: numbers with units, and tables that refuse unknown keys."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Annotated, Any

from pydantic import AfterValidator, BaseModel, BeforeValidator, ConfigDict, GetCoreSchemaHandler
from pydantic_core import core_schema

from roughfilm.contact.foundation.units import to_si, with_unit


class Part(BaseModel):
    """Base class of a table in a TOML file; it is immutable and refuses unknown keys."""

    model_config = ConfigDict(frozen=True, extra="forbid", defer_build=True)


def _positive(value: float) -> float:
    if not 0 < value < float("inf"):
        raise ValueError(f"got {value!r}; it must be above zero and finite")
    return value


def any_number(value: float) -> float:
    """The value, unchanged; this is the check of a number that may have any sign."""
    return value


def plain_number(value: object) -> float:
    """The number as a float; raises ValueError for anything that is not a plain number without unit."""
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise ValueError(f"got {value!r}; write a plain number, without unit or quotes")
    try:
        return float(value)
    except OverflowError:
        raise ValueError("got a number beyond 1e308; write a smaller one") from None


@dataclass(frozen=True)
class InUnit:
    """Annotation of an SI number that is read from text with a unit and written back as such text.

    Attributes
    ----------
    base : SI unit, such as "m".
    check : function that returns an admissible number and raises ValueError for others; the default accepts positive
        finite numbers.
    """

    base: str
    check: Callable[[float], float] = _positive

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> core_schema.CoreSchema:
        return core_schema.no_info_before_validator_function(
            lambda value: self.check(to_si(value, self.base)),
            handler(source),
            serialization=core_schema.plain_serializer_function_ser_schema(lambda value: with_unit(value, self.base)),
        )


Length = Annotated[float, InUnit("m")]
Coordinate = Annotated[float, InUnit("m", any_number)]
Angle = Annotated[float, InUnit("rad", any_number)]
PositiveNumber = Annotated[float, BeforeValidator(plain_number), AfterValidator(_positive)]
