"""The surface of a scene: a file, or the description of a synthetic surface."""

import hashlib
import json
from collections.abc import Sequence
from functools import lru_cache
from pathlib import Path
from typing import Annotated, Any, Self

from pydantic import BeforeValidator, PlainSerializer, model_validator

from roughfilm.contact.foundation.entries import LengthPair, NamesFile, Part
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.reading.regular import file_size
from roughfilm.contact.foundation.timing import one_time
from roughfilm.contact.foundation.units import with_unit
from roughfilm.contact.mechanics.moments import WavePower, wave_power
from roughfilm.contact.surfaces.files import has_header, read_surface
from roughfilm.contact.surfaces.plausibility import implausible, preparation_doubts
from roughfilm.contact.surfaces.store import is_surface
from roughfilm.contact.surfaces.surface import Surface

PLAIN_FORMATS = (".npy", ".csv")
"""Suffixes of files without metadata; their heights are taken as one period."""


def surface_entry(value: object) -> object:
    """The name of a file of heights, or a description from a table or TOML file with all defaults."""
    from roughfilm.contact.synthetic.description import description_entries, read_description, read_entries

    if isinstance(value, str):
        if not value.lower().endswith(".toml"):
            return value
        try:
            return description_entries(read_description(Path(value).expanduser()))
        except InputError as error:
            raise ValueError("\n".join(f"in {value}: {line}" for line in str(error).splitlines())) from None
    if isinstance(value, dict):
        try:
            return description_entries(read_entries(value))
        except InputError as error:
            lines = str(error).splitlines()
            raise ValueError(
                "\n".join(one.removeprefix("surface.").removeprefix("surface: ") for one in lines)
            ) from None
    raise ValueError(f"got {value!r:.60}; name a file of heights, or write a table that describes a surface")


class SurfaceGeometry(Part):
    """One period of a rough surface.

    ``surface`` names a file of heights (HDF5 of roughfilm, NPY or CSV) or describes a synthetic surface; the
    description may be a TOML file. ``spacing`` is a length, or two along x and y, for files without it. ``digest`` is
    that of the heights in the file, so that a saved scene is not read with a changed surface.

    Attributes
    ----------
    surface : name of a file of heights, or a table that describes a synthetic surface.
    spacing : distance of the points, m, one or two along x and y; for files without it.
    digest : digest of the heights in the file; a file that has changed since is rejected.
    """

    surface: Annotated[str | dict[str, Any], BeforeValidator(surface_entry), NamesFile()]
    spacing: Annotated[
        LengthPair | None,
        PlainSerializer(lambda pair: None if pair is None else [with_unit(length, "m") for length in pair]),
    ] = None
    digest: str | None = None

    @model_validator(mode="after")
    def _is_there(self) -> Self:
        try:
            surface = self.read()
        except InputError as error:
            message = str(error).removeprefix(f"{self._kind}: ")
            key = message.removeprefix(f"{self._kind}.")
            raise ValueError(f"surface: {message}" if key == message or not self._kind else f"surface.{key}") from None
        if surface.invalid.any():
            count = int(surface.invalid.sum())
            raise ValueError(f"surface: has {count} invalid points; fill them by preparing it: roughfilm surface")
        if self._kind:
            return self if self.digest is None else self.model_copy(update={"digest": None})
        digest = digest_of(surface)
        if self.digest not in (None, digest):
            raise ValueError(
                f"digest: got {self.digest!r:.40}, but {self.surface} holds other heights by now, {digest!r}; "
                "leave the digest out to take them"
            )
        return self.model_copy(update={"digest": digest})

    @property
    def _kind(self) -> str:
        """The kind of a described surface; "" for a file."""
        return "" if isinstance(self.surface, str) else str(self.surface["kind"])

    @property
    def described(self) -> bool:
        """Whether a description defines the surface, which is then periodic."""
        return bool(self._kind)

    @property
    def name(self) -> str:
        """The name of the file, or the kind of a described surface."""
        return Path(self.surface).name if isinstance(self.surface, str) else self._kind

    def read(self) -> Surface:
        """The surface, cached; InputError if the file cannot be read or the description is invalid."""
        if not isinstance(self.surface, str):
            return _made(json.dumps(self.surface, sort_keys=True))
        path = Path(self.surface).expanduser()
        try:
            size = file_size(path, "name a file of heights")
            native = is_surface(path)
        except InputError as error:
            raise InputError(f"in {error}") from None
        if native and self.spacing is not None:
            raise InputError(f"in {path}: it contains its spacing; leave the key spacing out")
        if not native and path.suffix.lower() not in PLAIN_FORMATS:
            raise InputError(
                f"in {path}: it is neither a surface of roughfilm nor NPY nor CSV; prepare it with: roughfilm surface"
            )
        if path.suffix.lower() == ".npy" and not native and self.spacing is None:
            raise InputError(f'in {path}: it gives no spacing of its points; add spacing = "1 um"')
        return _read(str(path), self.spacing, path.stat().st_mtime_ns, size)

    def warnings(self) -> tuple[str, ...]:
        """The warnings on a unit and on the preparation of the file, cached; none for a described surface."""
        if self.described:
            return ()
        return _unit_warnings(self.model_dump_json(include={"surface", "spacing", "digest"}, exclude_none=True))

    def spectrum(self) -> WavePower | None:
        """The mean square of the heights by wave; None for a flat surface."""
        return _spectrum(self.model_dump_json(exclude_none=True))


def replaced_by(surface: object) -> Sequence[str]:
    """The keys beside a surface that a new one replaces: its digest, and the spacing if the new one has its own."""
    return "digest", *(() if isinstance(surface, str) and _lacks_spacing(Path(surface)) else ("spacing",))


def _lacks_spacing(path: Path) -> bool:
    """Whether a file holds heights without the spacing of its points."""
    if path.suffix.lower() not in PLAIN_FORMATS:
        return False
    try:
        return not (is_surface(path) or has_header(path))
    except InputError:  # which the reading of the scene raises again, with its place
        return True


def digest_of(surface: Surface) -> str:
    """The digest of heights and spacing, equal only for surfaces that are equal bit for bit."""
    digest = hashlib.sha256(repr((surface.shape, surface.spacing)).encode())
    digest.update(surface.heights.tobytes())
    return digest.hexdigest()[:32]


@lru_cache(maxsize=2)
def _made(description: str) -> Surface:
    from roughfilm.contact.synthetic.description import make, read_entries  # slow to import

    with one_time("surface"):
        return make(read_entries(json.loads(description)))


@lru_cache(maxsize=2)
def _read(path: str, spacing: tuple[float, float] | None, _modified: int, _size: int) -> Surface:
    try:
        with one_time("surface"):
            return read_surface(Path(path), spacing=spacing)
    except InputError as error:
        raise InputError(f"in {error}") from None


@lru_cache(maxsize=2)
def _unit_warnings(geometry: str) -> tuple[str, ...]:
    scene = SurfaceGeometry.model_validate_json(geometry)
    surface = scene.read()
    return *implausible(surface, scene.name), *preparation_doubts(surface, scene.name)


@lru_cache(maxsize=2)
def _spectrum(geometry: str) -> WavePower | None:
    surface = SurfaceGeometry.model_validate_json(geometry).read()
    try:
        return wave_power(surface.heights, surface.spacing)
    except InputError:  # the heights are finite, so they are all the same
        return None
