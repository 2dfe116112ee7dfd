"""A synthetic surface described by a TOML table, and made from it."""

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Field, TypeAdapter, ValidationError

from contact.entries import Coordinate, InUnit, Length, Part, PositiveNumber, plain_number
from contact.errors import InputError
from contact.surface import Surface
from contact.synthetic.gaussian import Autocorrelation, gaussian
from contact.synthetic.self_affine import self_affine
from contact.synthetic.waves import Amplitudes
from contact.toml import Location, in_one_line, read_toml, unknown_key


def _count(value: object) -> object:
    if isinstance(value, bool) or not isinstance(value, int):
        raise ValueError(f"got {value!r}; write a whole number")
    return value


def _any(value: float) -> float:
    return value


Count = Annotated[int, BeforeValidator(_count)]
Angle = Annotated[float, InUnit("rad", _any)]


class _Made(Part):
    size: tuple[Length, Length]
    points: tuple[Count, Count]


class SelfAffine(_Made):
    """See ``contact.synthetic.self_affine``."""

    kind: Literal["self_affine"]
    seed: Count
    hurst: PositiveNumber
    roll_off: Length
    cut_off: Length
    rms_height: Length | None = None
    rms_slope: PositiveNumber | None = None
    amplitudes: Amplitudes = "fixed"


class Gaussian(_Made):
    """See ``contact.synthetic.gaussian``."""

    kind: Literal["gaussian"]
    seed: Count
    rms_height: Length
    correlation_length: Length
    anisotropy: PositiveNumber = 1.0
    lay_angle: Angle = 0.0
    autocorrelation: Autocorrelation = "gaussian"
    amplitudes: Amplitudes = "fixed"


Description = Annotated[SelfAffine | Gaussian, Field(discriminator="kind")]

MAKERS = {"self_affine": self_affine, "gaussian": gaussian}
_READER: TypeAdapter[Any] = TypeAdapter(Description)


def read_description(path: Path) -> Any:
    return read_entries(read_toml(path, 'kind = "self_affine"'))


def read_entries(entries: Mapping[str, Any]) -> Any:
    try:
        return _READER.validate_python(entries)
    except ValidationError as error:
        raise InputError(in_one_line(error, "surface", lambda location: "", lambda loc: loc[1:])) from None


def make(description: Any) -> Surface:
    names = [name for name in type(description).model_fields if name != "kind"]
    return MAKERS[description.kind](**{name: getattr(description, name) for name in names})
