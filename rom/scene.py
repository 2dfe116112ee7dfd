"""A scene: what is there, read from a TOML file into frozen models, with every fault named in one line."""

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Annotated, Any, Literal, Self

from pydantic import Field, ValidationError, model_validator

from contact.entries import InUnit, Part, PositiveNumber
from contact.errors import InputError
from contact.toml import Location, in_one_line, known_keys, read_toml, set_entry, unknown_key
from rom.gap import Gap
from rom.geometry import PROFILES, AnyGroove, PocketGeometry

Viscosity = Annotated[float, InUnit("Pa*s")]
Density = Annotated[float, InUnit("kg/m^3")]
Speed = Annotated[float, InUnit("m/s")]

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
    def aspect(self) -> float:
        """2d / w of the groove where it is greatest: its mean slope if the lowest point is in the middle."""
        return max(2 * groove.depth / groove.width for groove in self.grooves)

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
    entries = read_toml(path, 'film = "30 um"')
    try:
        _seek_points(entries, Path(path).parent)
    except RecursionError as error:
        raise InputError(f"{path}: its tables are nested too deeply; a scene has three levels") from error
    return entries


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
        set_entry(entries, override, "geometry.depth=22.5um", REPLACES)
    return read_scene(entries)


def read_scene(entries: Mapping[str, Any]) -> Scene:
    """A scene from nested entries as a TOML file holds them; raises InputError as ``load_scene`` does."""
    try:
        return Scene.model_validate(entries)
    except ValidationError as error:
        raise InputError(_fault(error, entries)) from None


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


def _location(path: Location, entries: Mapping[str, Any]) -> tuple[list[int | str], str | None]:
    """Where a fault stands in the file, and the profile of the groove that it is in, if it is in one."""
    location = list(path)
    if location[:2] != ["geometry", "grooves"] or len(location) < 3:
        return location, None
    profile = str(location.pop(3)) if len(location) > 3 else None
    if "grooves" not in entries["geometry"]:
        del location[1:3]
    return location, profile


def _fault(error: ValidationError, entries: Mapping[str, Any]) -> str:
    fault = sorted(error.errors(include_url=False), key=lambda fault: fault["type"] != "extra_forbidden")[0]
    _, profile = _location(fault["loc"], entries)

    def unknown(location: Location) -> str:
        *path, key = location
        known = [*PROFILES[profile].model_fields] if profile else known_keys(Scene, path)
        if path == ["geometry"]:
            known = [*dict.fromkeys([*PocketGeometry.model_fields, *known])]
        if profile and any(key in other.model_fields for other in PROFILES.values()):
            return f"no key of profile {profile!r}; known here: {', '.join(known)}"
        return unknown_key(key, known)

    return in_one_line(error, "scene", unknown, lambda path: _location(path, entries)[0])
