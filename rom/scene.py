"""A scene: what is there, read from a TOML file into frozen models, with every fault named in one line."""

import difflib
import json
import tomllib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, Literal, Self

from pydantic import (
    AfterValidator,
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Field,
    GetCoreSchemaHandler,
    ValidationError,
    model_validator,
)
from pydantic_core import core_schema

from contact.errors import InputError
from rom import groove
from rom.gap import Gap
from rom.units import to_si, with_unit

LARGEST_SCENE = 1_000_000
"""Bytes; a longer scene file is refused unread."""


def _positive(value: float) -> float:
    if not 0 < value < float("inf"):
        raise ValueError(f"got {value!r}; it must be above zero and finite")
    return value


def _plain_number(value: object) -> object:
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise ValueError(f"got {value!r}; write a plain number, without unit or quotes")
    try:
        return float(value)
    except OverflowError:
        raise ValueError("got a number beyond 1e308; write a smaller one") from None


@dataclass(frozen=True)
class _Quantity:
    """Marks a positive SI number that is read from text with a unit and written back as such."""

    base: str

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> core_schema.CoreSchema:
        return core_schema.no_info_before_validator_function(
            lambda value: _positive(to_si(value, self.base)),
            handler(source),
            serialization=core_schema.plain_serializer_function_ser_schema(lambda value: with_unit(value, self.base)),
        )


Length = Annotated[float, _Quantity("m")]
Viscosity = Annotated[float, _Quantity("Pa*s")]
Density = Annotated[float, _Quantity("kg/m^3")]
Speed = Annotated[float, _Quantity("m/s")]
PositiveNumber = Annotated[float, BeforeValidator(_plain_number), AfterValidator(_positive)]


class _Part(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid")


class PocketGeometry(_Part):
    """One period of a channel whose still lower wall has a groove in its middle. Lengths in m."""

    length: Length
    film: Length
    profile: Literal["cylindrical"] = "cylindrical"
    width: Length
    depth: Length

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if self.width >= self.length:
            raise ValueError(f"width: got {self.width!r} m; it must be below length, {self.length!r} m")
        if self.depth > self.width / 2:
            raise ValueError(
                f"depth: got {self.depth!r} m; the arc would be more than a half circle, "
                f"it must be at most width / 2 = {self.width / 2!r} m"
            )
        return self


class Lubricant(_Part):
    """A Newtonian, incompressible liquid: viscosity in Pa s, density in kg/m³."""

    viscosity: Viscosity
    density: Density


class Motion(_Part):
    """How fast the upper wall slides: its speed in m/s, or the Reynolds number that gives it; exactly one."""

    speed: Speed | None = None
    reynolds_number: PositiveNumber | None = None

    @model_validator(mode="after")
    def _one_of_two(self) -> Self:
        if (self.speed is None) == (self.reynolds_number is None):
            found = "neither" if self.speed is None else "both"
            raise ValueError(f"got {found} of speed and reynolds_number; give exactly one")
        return self


class Scene(_Part):
    """A groove under a sliding wall: steady, isothermal, incompressible, periodic, no mean pressure drop."""

    name: Annotated[str, Field(min_length=1, max_length=200)]
    kind: Literal["pocket"]
    geometry: PocketGeometry
    lubricant: Lubricant
    motion: Motion

    @model_validator(mode="after")
    def _numbers_stay_in_range(self) -> Self:
        for place, value in (
            ("geometry.length", self.geometry.length / self.geometry.film),
            ("geometry.width", self.geometry.width / self.geometry.film),
        ):
            if not 1e-2 <= value <= 1e5:
                raise ValueError(f"{place}: got {value:.3g} film thicknesses; it must be 0.01 to 100000 of them")
        if not self.geometry.depth / self.geometry.film >= 1e-9:
            raise ValueError("geometry.depth: got less than 1e-9 film thicknesses; a flat wall needs no model")
        if not 1e-12 <= self.reynolds_number <= 1e12:
            raise ValueError(
                f"motion: got Reynolds number {self.reynolds_number:.3g}; it must be 1e-12 to 1e12, look at the units"
            )
        return self

    @property
    def speed(self) -> float:
        """Sliding speed u of the upper wall, m/s."""
        if self.motion.speed is not None:
            return self.motion.speed
        assert self.motion.reynolds_number is not None
        return self.motion.reynolds_number * self.lubricant.viscosity / (self.lubricant.density * self.geometry.film)

    @property
    def reynolds_number(self) -> float:
        """Re = ρ u Ly / η, with Ly the film thickness outside the groove."""
        if self.motion.reynolds_number is not None:
            return self.motion.reynolds_number
        return self.lubricant.density * self.speed * self.geometry.film / self.lubricant.viscosity

    @property
    def pressure_unit(self) -> float:
        """η u / Ly, Pa: the unit of pressure and shear stress inside the solvers."""
        return self.lubricant.viscosity * self.speed / self.geometry.film

    @property
    def plus_factor(self) -> float:
        """What turns p / (η u / Ly) into the thesis's p+ = 100 p Ly² / (η u Lx)."""
        return 100 * self.geometry.film / self.geometry.length

    def gap(self) -> Gap:
        """The gap this scene's geometry leaves open."""
        part = self.geometry
        shape = groove.cylindrical(width=part.width, depth=part.depth)
        return groove.channel(length=part.length, film=part.film, grooves=[(0.0, shape)])


def load_entries(path: Path) -> dict[str, Any]:
    """The nested entries of a TOML file; InputError in one line if it cannot be read or is not TOML."""
    path = Path(path)
    try:
        if not path.is_file():
            raise InputError(f"{path}: {'is no' if path.exists() else 'no such'} file; name a TOML file")
        if path.stat().st_size > LARGEST_SCENE:
            raise InputError(f"{path}: larger than {LARGEST_SCENE} bytes; a scene is a short TOML file")
        return tomllib.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise InputError(f"{path}: cannot be read ({error.strerror}); check its permissions") from error
    except UnicodeDecodeError as error:
        raise InputError(f"{path}: byte {error.start} is not UTF-8; save the scene as UTF-8 text") from error
    except (ValueError, RecursionError) as error:
        reason = str(error).splitlines()[0]
        raise InputError(f'{path}: is not TOML ({reason}); write lines such as: film = "30 um"') from error


def load_scene(path: Path, overrides: Iterable[str] = ()) -> Scene:
    """Read a scene file and apply overrides such as ``geometry.depth=22.5um``.

    Setting one of ``motion.speed`` and ``motion.reynolds_number`` replaces the other.

    Raises
    ------
    InputError
        One line that names the key, what was got there and what to write instead.
    """
    entries = load_entries(path)
    for override in overrides:
        _override(entries, override)
    return read_scene(entries)


def read_scene(entries: Mapping[str, Any]) -> Scene:
    """A scene from nested entries as a TOML file holds them; raises InputError as ``load_scene`` does."""
    try:
        return Scene.model_validate(entries)
    except ValidationError as error:
        raise InputError(_one_line(error)) from None


def scene_entries(scene: Scene) -> dict[str, Any]:
    """The complete scene, defaults written out, units as text; ``read_scene`` reads it back unchanged."""
    return scene.model_dump(exclude_none=True)


def _override(entries: dict[str, Any], override: str) -> None:
    key, equals, text = override.partition("=")
    parts = key.strip().split(".")
    if not equals or not all(parts):
        raise InputError(f"--set {override}: got no key=value; write for example geometry.depth=22.5um")
    table: Any = entries
    for part in parts[:-1]:
        table = table.setdefault(part, {})
        if not isinstance(table, dict):
            raise InputError(
                f"--set {override}: {part!r} is not a table of the scene; write for example geometry.depth"
            )
    for one, other in (("speed", "reynolds_number"), ("reynolds_number", "speed")):
        if parts == ["motion", one]:
            table.pop(other, None)
    table[parts[-1]] = _value(text.strip())


def _value(text: str) -> object:
    try:
        return json.loads(text, parse_constant=lambda name: name)
    except (ValueError, RecursionError):
        return text


def _one_line(error: ValidationError) -> str:
    faults = error.errors(include_url=False)
    fault = faults[0]
    place = ".".join(["scene", *(str(part) for part in fault["loc"])])
    got = repr(fault["input"])
    got = got if len(got) <= 60 else got[:57] + "..."
    match fault["type"]:
        case "extra_forbidden":
            near = difflib.get_close_matches(str(fault["loc"][-1]), _keys(fault["loc"][:-1]), n=1)
            known = f"did you mean {near[0]!r}?" if near else f"known here: {', '.join(_keys(fault['loc'][:-1]))}"
            text = f"{place}: unknown key; {known}"
        case "missing":
            text = f"{place}: missing; add it to the scene"
        case "literal_error":
            text = f"{place}: got {got}; it must be {fault['ctx']['expected']}"
        case "value_error":
            reason = str(fault["ctx"]["error"])
            inner, colon, rest = reason.partition(": ")
            inside = colon and inner.replace(".", "").isidentifier()
            text = f"{place}.{inner}: {rest}" if inside else f"{place}: {reason}"
        case _:
            text = f"{place}: got {got}; {fault['msg'][0].lower()}{fault['msg'][1:]}"
    return " ".join(text.split()) + (f" (and {len(faults) - 1} more)" if len(faults) > 1 else "")


def _keys(path: tuple[int | str, ...]) -> list[str]:
    part: Any = Scene
    for name in path:
        part = part.model_fields[name].annotation
    return list(part.model_fields)
