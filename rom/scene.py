"""A scene: what is there, read from a TOML file into frozen models, with every fault named in one line."""

import difflib
import json
import tomllib
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Annotated, Any, Literal, Self

from pydantic import Field, ValidationError, model_validator

from contact.errors import InputError
from rom.entries import Density, Part, PositiveNumber, Speed, Viscosity
from rom.gap import Gap
from rom.geometry import PROFILES, AnyGroove, PocketGeometry

LARGEST_SCENE = 1_000_000
"""Bytes; a longer scene file is refused unread."""

REPLACES = {
    "motion.speed": ("reynolds_number",),
    "motion.reynolds_number": ("speed",),
    "geometry.points": ("width", "depth", "shift"),
}
"""Keys that an override makes meaningless: it takes them away from the same table."""


class Lubricant(Part):
    """A Newtonian, incompressible liquid: viscosity in Pa s, density in kg/m³."""

    viscosity: Viscosity
    density: Density


class Motion(Part):
    """How fast the upper wall slides: its speed in m/s, or the Reynolds number that gives it; exactly one."""

    speed: Speed | None = None
    reynolds_number: PositiveNumber | None = None

    @model_validator(mode="after")
    def _one_of_two(self) -> Self:
        if (self.speed is None) == (self.reynolds_number is None):
            found = "neither" if self.speed is None else "both"
            raise ValueError(f"got {found} of speed and reynolds_number; give exactly one")
        return self


class Scene(Part):
    """A groove under a sliding wall: steady, isothermal, incompressible, periodic, no mean pressure drop."""

    name: Annotated[str, Field(min_length=1, max_length=200)]
    kind: Literal["pocket"]
    geometry: PocketGeometry
    lubricant: Lubricant
    motion: Motion

    @model_validator(mode="after")
    def _reynolds_number_stays_in_range(self) -> Self:
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

    @property
    def grooves(self) -> tuple[AnyGroove, ...]:
        """The grooves of the lower wall."""
        return self.geometry.grooves

    @property
    def reduced_reynolds_number(self) -> float:
        """Re Ly / w of the narrowest groove: inertia against viscous stress where the film changes fastest."""
        return self.reynolds_number * self.geometry.film / min(groove.width for groove in self.grooves)

    @property
    def depth(self) -> float:
        """Depth of the deepest groove over the film thickness outside, d / Ly."""
        return max(groove.depth for groove in self.grooves) / self.geometry.film

    @property
    def slope(self) -> float:
        """Mean slope of the steepest groove, from its lowest point to the nearer edge: 2d / w if it is symmetric."""
        return max(groove.slope for groove in self.grooves)

    def gap(self) -> Gap:
        """The gap this scene's geometry leaves open."""
        return self.geometry.gap()


def load_entries(path: Path) -> dict[str, Any]:
    """The nested entries of a TOML file, files of points named from where they are sought: beside it.

    Raises InputError in one line if the file cannot be read or is not TOML.
    """
    path = Path(path)
    try:
        entries = tomllib.loads(_text(path))
        _seek_points(entries, path.parent)
        return entries
    except InputError:
        raise
    except (ValueError, RecursionError) as error:
        reason = str(error).splitlines()[0]
        raise InputError(f'{path}: is not TOML ({reason}); write lines such as: film = "30 um"') from error


def _text(path: Path) -> str:
    try:
        if not path.is_file():
            raise InputError(f"{path}: {'is no' if path.exists() else 'no such'} file; name a TOML file")
        if path.stat().st_size > LARGEST_SCENE:
            raise InputError(f"{path}: larger than {LARGEST_SCENE} bytes; a scene is a short TOML file")
        return path.read_text(encoding="utf-8")
    except OSError as error:
        raise InputError(f"{path}: cannot be read ({error.strerror}); check its permissions") from error
    except UnicodeDecodeError as error:
        raise InputError(f"{path}: byte {error.start} is not UTF-8; save the scene as UTF-8 text") from error


def load_scene(path: Path, overrides: Iterable[str] = ()) -> Scene:
    """Read a scene file and apply overrides such as ``geometry.depth=22.5um``.

    Setting one of ``motion.speed`` and ``motion.reynolds_number`` replaces the other; setting ``geometry.points``
    replaces width, depth and shift. A file of points that the scene names is sought beside it, one that an override
    names in the current directory.

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
        raise InputError(_one_line(error, entries)) from None


def scene_entries(scene: Scene) -> dict[str, Any]:
    """The complete scene, defaults written out, units as text; ``read_scene`` reads it back unchanged."""
    return scene.model_dump(mode="json", exclude_none=True)


def _seek_points(entry: Any, directory: Path) -> None:
    """Put the directory before every name of a file of points that does not begin at a root or a home."""

    def sought(name: object) -> object:
        return str(directory / name) if isinstance(name, str) and not name.startswith("~") else name

    if isinstance(entry, dict):
        if "points" in entry:
            names = entry["points"]
            entry["points"] = [sought(name) for name in names] if isinstance(names, list) else sought(names)
        for inner in entry.values():
            _seek_points(inner, directory)
    elif isinstance(entry, list):
        for inner in entry:
            _seek_points(inner, directory)


def _override(entries: dict[str, Any], override: str) -> None:
    key, equals, text = override.partition("=")
    key = key.strip()
    *path, last = key.split(".")
    if not equals or not all([*path, last]):
        raise InputError(f"--set {override}: got no key=value; write for example geometry.depth=22.5um")
    table: Any = entries
    for part in path:
        if isinstance(table, list):
            table = {str(number): one for number, one in enumerate(table)}.get(part)
        else:
            table = table.setdefault(part, {})
        if not isinstance(table, dict | list):
            break
    if not isinstance(table, dict):
        raise InputError(
            f"--set {override}: {path[-1]!r} is not a table of the scene; write for example geometry.depth"
        )
    for other in REPLACES.get(key, ()):
        table.pop(other, None)
    table[last] = _value(text.strip())


def _value(text: str) -> object:
    try:
        return json.loads(text, parse_constant=lambda name: name)
    except (ValueError, RecursionError):
        return text


def _one_line(error: ValidationError, entries: Mapping[str, Any]) -> str:
    faults = sorted(error.errors(include_url=False), key=lambda fault: fault["type"] != "extra_forbidden")
    fault = faults[0]
    location, profile = _location(fault["loc"], entries)
    place = ".".join(["scene", *map(str, location)])
    got = repr(fault["input"])
    got = got if len(got) <= 60 else got[:57] + "..."
    match fault["type"]:
        case "extra_forbidden":
            text = f"{place}: {_unknown(location, profile)}"
        case "missing":
            text = f"{place}: missing; add it to the scene"
        case "literal_error":
            text = f"{place}: got {got}; it must be {fault['ctx']['expected']}"
        case "union_tag_invalid":
            text = f"{place}.profile: got {fault['ctx']['tag']!r}; it must be one of {fault['ctx']['expected_tags']}"
        case "value_error":
            reason = str(fault["ctx"]["error"])
            inner, colon, rest = reason.partition(": ")
            inside = colon and inner.replace(".", "").isidentifier()
            text = f"{place}.{inner}: {rest}" if inside else f"{place}: {reason}"
        case _:
            text = f"{place}: got {got}; {fault['msg'][0].lower()}{fault['msg'][1:]}"
    return " ".join(text.split()) + (f" (and {len(faults) - 1} more)" if len(faults) > 1 else "")


def _location(path: tuple[int | str, ...], entries: Mapping[str, Any]) -> tuple[list[int | str], str | None]:
    """Where a fault stands in the file, and the profile of the groove that it is in, if it is in one."""
    location = list(path)
    if location[:2] != ["geometry", "grooves"] or len(location) < 3:
        return location, None
    profile = str(location.pop(3)) if len(location) > 3 else None
    if "grooves" not in entries["geometry"]:
        del location[1:3]
    return location, profile


def _unknown(location: list[int | str], profile: str | None) -> str:
    *path, key = location
    part: Any = PROFILES[profile] if profile else Scene
    for name in () if profile else path:
        part = part.model_fields[name].annotation
    known = [*part.model_fields]
    if path == ["geometry"]:
        known = [*dict.fromkeys([*PocketGeometry.model_fields, *known])]
    near = difflib.get_close_matches(str(key), known, n=1)
    if profile and any(key in other.model_fields for other in PROFILES.values()):
        return f"no key of profile {profile!r}; known here: {', '.join(known)}"
    return "unknown key; " + (f"did you mean {near[0]!r}?" if near else f"known here: {', '.join(known)}")
