"""Read scenes from TOML files into the class of their kind, and report each fault in one line."""

from collections.abc import Container, Iterable, Mapping
from pathlib import Path
from typing import Any

from pydantic import ConfigDict, ValidationError, field_validator

from roughfilm.contact.foundation.entries import in_folder
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.faults import EntriesFile, faults_of, in_lines
from roughfilm.contact.foundation.toml import read_toml, set_entry
from roughfilm.rom.ladder.kind import Kind, Scene, kind_names, kind_of_name

EXAMPLE = "geometry.depth=22.5um"
"""A correct override, for messages."""


class _OfNoKind(Scene):
    """A scene whose entries name no known kind; its validation reports the faults of name and kind."""

    model_config = ConfigDict(extra="ignore")

    @field_validator("kind")
    @classmethod
    def _is_known(cls, name: str) -> str:
        raise ValueError(f"got {name!r:.60}; it must be {' or '.join(map(repr, kind_names()))}")


def load_entries(path: Path) -> dict[str, Any]:
    """The nested entries of a TOML file; the names of files in it are relative to its folder.

    Raises
    ------
    InputError
        In one line, if the file cannot be read, is not TOML, or is nested too deeply.
    """
    entries: dict[str, Any] = in_folder(read_toml(path, 'film = "30 um"'), Path(path).parent)
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
    replaced = kind.replaced if kind else None
    given: dict[str, tuple[int | str, ...]] = {}
    for override in overrides:
        key = override.partition("=")[0].strip()
        for taken in set_entry(entries, override, EXAMPLE, replaced, in_si_units=key in in_si_units):
            if taken in given:
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


def named_files(scene: Scene) -> frozenset[str]:
    """The names of the files that a scene reads whenever it is solved, such as those of surfaces."""
    names = set[str]()
    scene.model_dump(context={"files": names})
    return frozenset(names)


def given_entries(scene: Scene) -> dict[str, Any]:
    """The entries of a scene, to change some: without those that others determine, such as the density of an oil."""
    return scene.model_dump(mode="json", exclude_none=True, context={"given": True})
