"""Scenes from TOML files: read into the frozen model of their kind, with every fault named in one line."""

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from pydantic import ConfigDict, ValidationError, field_validator

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.toml import in_one_line, read_toml, set_entry
from roughfilm.rom.ladder.kind import Kind, Scene, kind_names, kind_of_name, kinds


class _OfNoKind(Scene):
    """Entries that say no kind that is known: what is wrong with their beginning."""

    model_config = ConfigDict(extra="ignore")

    @field_validator("kind")
    @classmethod
    def _is_known(cls, name: str) -> str:
        raise ValueError(f"got {name!r:.60}; it must be {' or '.join(map(repr, kind_names()))}")


def load_entries(path: Path) -> dict[str, Any]:
    """The nested entries of a TOML file, the files that it names sought beside it.

    Raises InputError in one line if the file cannot be read or is not TOML.
    """
    entries = read_toml(path, 'film = "30 um"')
    try:
        kind = kind_named(entries)
        keys = kind.files if kind else frozenset[str]().union(*(kind.files for kind in kinds().values()))
        kept = kind.no_files if kind else frozenset[str]()
        _seek_files(entries, Path(path).parent, keys, kept)
    except RecursionError as error:
        raise InputError(f"{path}: its tables are nested too deeply; a scene has three levels") from error
    return entries


def load_scene(path: Path, overrides: Iterable[str] = ()) -> Scene:
    """Read a scene file and apply overrides such as ``geometry.depth=22.5um``.

    A key may replace others of its table: setting the speed of a pocket takes its Reynolds number away. A file that the
    scene names is sought beside it, one that an override names in the current directory.

    Raises
    ------
    InputError
        One line that names the key, what was got there and what to write instead.
    """
    entries = load_entries(path)
    kind = kind_named(entries)
    replaces = kind.replaces if kind else {}
    given: set[str] = set()
    for override in overrides:
        set_entry(entries, override, "geometry.depth=22.5um", replaces)
        key = override.partition("=")[0].strip()
        table = key.rpartition(".")[0]
        for other in replaces.get(key, ()):
            if (taken := f"{table}.{other}") in given:
                raise InputError(f"set {override}: it takes the place of {taken}, which is set too; set one of them")
        given.add(key)
    return read_scene(entries)


def kind_named(entries: Mapping[str, Any]) -> Kind | None:
    """The kind that the entries of a scene name; None if there is none, or none such."""
    name = entries.get("kind")
    return kind_of_name(name) if isinstance(name, str) and name in kind_names() else None


def read_scene(entries: Mapping[str, Any]) -> Scene:
    """A scene from nested entries as a TOML file holds them; raises InputError as ``load_scene`` does."""
    kind = kind_named(entries)
    if kind is not None:
        return kind.read(entries)
    try:
        return _OfNoKind.model_validate(entries)
    except ValidationError as error:
        raise InputError(in_one_line(error, "scene", str)) from None


def scene_entries(scene: Scene) -> dict[str, Any]:
    """The complete scene, defaults written out, units as text; ``read_scene`` reads it back unchanged."""
    return scene.model_dump(mode="json", exclude_none=True)


def _seek_files(entry: Any, directory: Path, keys: frozenset[str], kept: frozenset[str]) -> None:
    """Put the directory before every name of a file that does not begin at a root or a home."""

    def sought(name: object) -> object:
        if not isinstance(name, str) or name in kept or name.startswith("~"):
            return name
        return str(directory / name)

    if isinstance(entry, dict):
        for key in keys & entry.keys():
            names = entry[key]
            entry[key] = [sought(name) for name in names] if isinstance(names, list) else sought(names)
        for inner in entry.values():
            _seek_files(inner, directory, keys, kept)
    elif isinstance(entry, list):
        for inner in entry:
            _seek_files(inner, directory, keys, kept)
