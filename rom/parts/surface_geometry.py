"""The surface of a scene: a file beside it, or the description of a synthetic one."""

import hashlib
import json
from functools import lru_cache
from pathlib import Path
from typing import Annotated, Any, Self

from pydantic import BeforeValidator, PlainSerializer, model_validator

from roughfilm.contact.foundation.entries import Length, Part
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.units import with_unit
from roughfilm.contact.mechanics.moments import WavePower, wave_power
from roughfilm.contact.surfaces.files import read_surface
from roughfilm.contact.surfaces.store import is_surface
from roughfilm.contact.surfaces.surface import Surface

PLAIN = (".npy", ".csv")
"""Files that say nothing of periods; what they hold is taken as one."""


def _described(value: object) -> object:
    """A file's name as it is; a description, in a table or in a file of its own, with every default written out."""
    from roughfilm.contact.synthetic.description import description_entries, read_description, read_entries

    if isinstance(value, str):
        if not value.lower().endswith(".toml"):
            return value
        try:
            return description_entries(read_description(Path(value).expanduser()))
        except InputError as error:
            raise ValueError(f"in {value}: {error}") from None
    if isinstance(value, dict):
        try:
            return description_entries(read_entries(value))
        except InputError as error:
            raise ValueError(str(error).removeprefix("surface.").removeprefix("surface: ")) from None
    raise ValueError(f"got {value!r:.60}; name a file of heights, or write a table that describes a surface")


def _pair(value: object) -> object:
    return value if isinstance(value, list | tuple) else (value, value)


class SurfaceGeometry(Part):
    """A rough surface, one period of it.

    ``surface`` names a file of heights (HDF5 of our own, NPY or CSV) or describes a synthetic surface; the description
    may stand in a TOML file. ``spacing`` is for files that do not tell it: a length, or two, along x and y. ``digest``
    is that of the heights in the file: a scene that was written back is not read over another surface.
    """

    surface: Annotated[str | dict[str, Any], BeforeValidator(_described)]
    spacing: Annotated[
        tuple[Length, Length] | None,
        BeforeValidator(_pair),
        PlainSerializer(lambda pair: None if pair is None else [with_unit(length, "m") for length in pair]),
    ] = None
    digest: str | None = None

    @model_validator(mode="after")
    def _is_there(self) -> Self:
        try:
            surface = self.read()
        except InputError as error:
            told = str(error).removeprefix(f"{self._kind}: ")
            inner = told.removeprefix(f"{self._kind}.")
            raise ValueError(f"surface: {told}" if inner == told or not self._kind else f"surface.{inner}") from None
        if surface.invalid.any():
            count = int(surface.invalid.sum())
            raise ValueError(f"surface: has {count} invalid points; fill them by preparing it: roughfilm surface")
        if self._kind:
            return self if self.digest is None else self.model_copy(update={"digest": None})
        found = digest_of(surface)
        if self.digest not in (None, found):
            raise ValueError(
                f"digest: got {self.digest!r:.40}, but {self.surface} holds other heights by now, {found!r}; "
                "leave the digest out to take them"
            )
        return self.model_copy(update={"digest": found})

    @property
    def _kind(self) -> str:
        """Of a described surface; "" for a file."""
        return "" if isinstance(self.surface, str) else str(self.surface["kind"])

    @property
    def described(self) -> bool:
        """Whether it is made from a description, and so repeats itself without a joint."""
        return bool(self._kind)

    @property
    def name(self) -> str:
        """What people call the surface: the file's name, or the kind of a described one."""
        return Path(self.surface).name if isinstance(self.surface, str) else self._kind

    def read(self) -> Surface:
        """The surface; the latest are kept. Raises InputError if the file cannot be read or the description made."""
        if not isinstance(self.surface, str):
            return _made(json.dumps(self.surface, sort_keys=True))
        path = Path(self.surface).expanduser()
        try:
            found = path.stat()
            ours = path.is_file() and is_surface(path)
        except OSError as error:
            told = "no such file" if isinstance(error, FileNotFoundError) else f"cannot be read ({error.strerror})"
            raise InputError(f"in {path}: {told}; name a file of heights") from None
        if ours and self.spacing is not None:
            raise InputError(f"in {path}: it tells its spacing itself; leave the key spacing out")
        if not ours and path.suffix.lower() not in PLAIN:
            told = "neither a surface of roughfilm nor NPY nor CSV; prepare it with: roughfilm surface"
            raise InputError(f"in {path}: it is {told}")
        if path.suffix.lower() == ".npy" and not ours and self.spacing is None:
            raise InputError(f'in {path}: it gives no spacing of its points; add spacing = "1 um"')
        return _read(str(path), self.spacing, found.st_mtime_ns, found.st_size)

    def spectrum(self) -> WavePower | None:
        """Mean square of the heights by wave; None of a flat surface."""
        return _spectrum(self.model_dump_json(exclude_none=True))


def digest_of(surface: Surface) -> str:
    """A digest of heights and spacing: equal ones are the same surface to the last bit."""
    digest = hashlib.sha256(repr((surface.shape, surface.spacing)).encode())
    digest.update(surface.heights.tobytes())
    return digest.hexdigest()[:32]


@lru_cache(maxsize=2)
def _made(description: str) -> Surface:
    from roughfilm.contact.synthetic.description import make, read_entries  # slow to import

    return make(read_entries(json.loads(description)))


@lru_cache(maxsize=2)
def _read(path: str, spacing: tuple[float, float] | None, _modified: int, _size: int) -> Surface:
    try:
        return read_surface(Path(path), spacing=spacing)
    except InputError as error:
        raise InputError(f"in {error}") from None


@lru_cache(maxsize=2)
def _spectrum(geometry: str) -> WavePower | None:
    surface = SurfaceGeometry.model_validate_json(geometry).read()
    try:
        return wave_power(surface.heights, surface.spacing)
    except InputError:  # the heights are finite, so they are all the same
        return None
