"""Read scenes from TOML files into the class of their kind, and report each fault in one line."""

from collections.abc import Container, Iterable, Mapping
from pathlib import Path
from typing import Any

from pydantic import ConfigDict, ValidationError, field_validator

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.faults import EntriesFile, faults_of, in_lines
from roughfilm.contact.foundation.toml import read_toml, set_entry
from roughfilm.rom.ladder.kind import Kind, Scene, kind_names, kind_of_name, kinds


class _OfNoKind(Scene):
    """A scene whose entries name no known kind; its validation reports the faults of name and kind."""

    model_config = ConfigDict(extra="ignore")

    @field_validator("kind")
    @classmethod
    def _is_known(cls, name: str) -> str:
        raise ValueError(f"got {name!r:.60}; it must be {' or '.join(map(repr, kind_names()))}")


def load_entries(path: Path) -> dict[str, Any]:
    """The nested entries of a TOML file, with its folder put before the relative names of files in it.

    Raises
    ------
    InputError
        In one line, if the file cannot be read, is not TOML, or is nested too deeply.
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


def load_scene(path: Path, overrides: Iterable[str] = (), in_si_units: Container[str] = ()) -> Scene:
    """Read a scene file and apply overrides such as ``geometry.depth=22.5um``.

    An override of a key may remove other keys of its table: the speed of a pocket replaces its Reynolds number. Names
    of files in the scene file are relative to its folder, and those in an override to the current directory.

    Parameters
    ----------
    path : the TOML file of the scene.
    overrides : texts of the form ``key=value``.
    in_si_units : keys of overrides whose plain numbers are in SI units; those of others need a unit.

    Raises
    ------
    InputError
        A line for each fault, with file and line, the key, its value and the allowed values.
    """
    entries = load_entries(path)
    kind = kind_named(entries)
    replaces = kind.replaces if kind else {}
    given: dict[str, tuple[int | str, ...]] = {}
    for override in overrides:
        key = override.partition("=")[0].strip()
        set_entry(entries, override, "geometry.depth=22.5um", replaces, in_si_units=key in in_si_units)
        table = key.rpartition(".")[0]
        for other in replaces.get(key, ()):
            if (taken := f"{table}.{other}") in given:
                raise InputError(f"set {override}: it takes the place of {taken}, which is set too; set one of them")
        given[key] = tuple(int(part) if part.isdigit() else part for part in key.split("."))
    return read_scene(entries, EntriesFile(path=Path(path), changed=given.values()))


def kind_named(entries: Mapping[str, Any]) -> Kind | None:
    """The kind that the entries of a scene name; None if they name none, or one that does not exist."""
    name = entries.get("kind")
    return kind_of_name(name) if isinstance(name, str) and name in kind_names() else None


def read_scene(entries: Mapping[str, Any], file: EntriesFile | None = None) -> Scene:
    """Make a scene from nested entries as in a TOML file; InputError as in ``load_scene``.

    Numbers that ``in_si`` marks are in SI units; other numbers are dimensionless.
    """
    kind = kind_named(entries)
    if kind is not None:
        return kind.read(entries, file)
    try:
        return _OfNoKind.model_validate(entries)
    except ValidationError as error:
        raise InputError(in_lines(faults_of(error, lambda place: (str(place), "")), "scene", file)) from None


def scene_entries(scene: Scene) -> dict[str, Any]:
    """The complete entries of a scene, with its defaults, for JSON; ``read_scene`` makes an equal scene from them."""
    return scene.model_dump(mode="json", exclude_none=True)


def given_entries(scene: Scene) -> dict[str, Any]:
    """The entries of a scene, to change some: without those that others determine, such as the density of an oil."""
    return scene.model_dump(mode="json", exclude_none=True, context={"given": True})


def _seek_files(entry: Any, directory: Path, keys: frozenset[str], kept: frozenset[str]) -> None:
    """Put the directory before every name of a file that is neither absolute nor begins with "~"."""

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
