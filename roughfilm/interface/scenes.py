"""Reading of scenes from TOML files and from nested entries."""

import json
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.toml import set_entry
from roughfilm.contact.foundation.units import in_si
from roughfilm.rom.ladder import scene as scenes
from roughfilm.rom.ladder.kind import Scene, kind_of_name


def load_scene(path: str | os.PathLike[str], *, set: Mapping[str, object] | None = None) -> Scene:  # noqa: A002
    """Read a scene file (TOML) and change some of its entries.

    Parameters
    ----------
    path : the scene file; paths in it are relative to its directory.
    set : new values by dotted key, such as ``{"geometry.depth": "22.5 um"}``; a number is in the SI unit of its key.
        Paths given here are relative to the current directory.

    Returns
    -------
    Scene
        A frozen model of its kind; all quantities in SI units.

    Raises
    ------
    InputError
        If the file cannot be read, or a key or value is wrong: one line with place, value and remedy.

    Examples
    --------
    >>> import roughfilm as rf
    >>> scene = rf.load_scene("scripts/examples/scenes/pocket.toml", set={"geometry.depth": "22.5 um"})
    >>> scene.kind, round(scene.reynolds_number)
    ('pocket', 160)
    """
    if not isinstance(path, str | os.PathLike):
        raise InputError(f"path: got {type(path).__name__}; name a scene file, or give a dict to read_scene")
    if not isinstance(set, Mapping | None):
        raise InputError(f"set: got {set!r:.60}; give a dict such as {{'geometry.depth': '22.5 um'}}")
    numbers = [key for key, value in (set or {}).items() if not isinstance(value, str)]
    return scenes.load_scene(Path(path), [f"{key}={_text(value)}" for key, value in (set or {}).items()], numbers)


def read_scene(entries: Mapping[str, Any]) -> Scene:
    """Read a scene from nested entries, as a scene file holds them.

    Parameters
    ----------
    entries : tables by name: texts with a unit such as "30 um", numbers in the SI unit of their key, lists, arrays and
        tables. A scene file takes no number without a unit where a quantity has one.

    Returns
    -------
    Scene
        A frozen model of its kind; all quantities in SI units.

    Raises
    ------
    InputError
        If a key is unknown or missing, or a value out of range: one line with place, value and remedy.

    Examples
    --------
    >>> import roughfilm as rf
    >>> scene = rf.read_scene({
    ...     "name": "groove", "kind": "pocket",
    ...     "geometry": {
    ...         "length": "1 mm", "film": "30 um", "profile": "cylindrical", "width": "0.3 mm", "depth": "9 um"},
    ...     "lubricant": {"viscosity": "0.01 Pa*s", "density": "1000 kg/m^3"},
    ...     "motion": {"reynolds_number": 40},
    ... })
    >>> round(scene.speed, 2)
    13.33
    """
    if not isinstance(entries, Mapping):
        raise InputError(f"scene: got {type(entries).__name__}; give a dict of tables, or a file name to load_scene")
    try:
        marked = in_si(entries)
    except RecursionError:
        raise InputError("scene: its tables are nested too deeply or hold themselves; give three levels") from None
    return scenes.read_scene(marked)


def replace(scene: Scene, key: str | Mapping[str, object], value: object = ...) -> Scene:
    """Return a new, checked scene with another value at one dotted key or at several; the given one stays as it is.

    Parameters
    ----------
    scene : the scene, which is not changed.
    key : dotted key of a scene file, such as "geometry.depth"; or a dict of several with their values. A number selects
        a table from a list of tables. A key that excludes another takes its place: a speed that of a Reynolds number.
    value : a number in SI units, a text with a unit, a truth value, a list, an array, or a dict for a table; None
        removes the entry, which then has its default. Names of files are relative to the current directory.

    Returns
    -------
    Scene
        A frozen model of the same kind, checked as a whole.

    Raises
    ------
    InputError
        If a key is unknown or a value is out of range: one line with place, value and remedy.

    Examples
    --------
    >>> import roughfilm as rf
    >>> scene = rf.load_scene("scripts/examples/scenes/pocket.toml")
    >>> deep = rf.replace(scene, "geometry.depth", 22.5e-6)
    >>> round(deep.depth / scene.depth, 12)
    3.0
    >>> slow = rf.replace(scene, {"motion.reynolds_number": 40, "lubricant.viscosity": "8 mPa*s"})
    >>> slow.reynolds_number
    40.0

    A number selects an entry of a list of tables:

    >>> dimple = rf.load_scene("scripts/examples/scenes/dimple.toml")
    >>> rf.replace(dimple, "geometry.dimples.0.depth", "9 um").geometry.depth
    9e-06
    """
    if not isinstance(key, str | Mapping):
        raise InputError(f"key: got {repr(key)[:60]}; give a dotted key such as 'geometry.depth', or a dict of several")
    several = isinstance(key, Mapping)
    if several != (value is ...):
        raise InputError(f"value: {'got one beside a dict of keys; leave it out' if several else 'missing; give one'}")
    return with_entries(scene, key if isinstance(key, Mapping) else {key: value})


def with_entries(scene: Scene, values: Mapping[str, object]) -> Scene:
    """The scene with new values at dotted keys; InputError if a key is unknown or a value is out of range."""
    kind = kind_of_name(checked_scene(scene).kind)
    entries = scenes.given_entries(scene)
    for key, value in values.items():
        if not isinstance(key, str) or "=" in key:
            raise InputError(f"key: got {key!r:.60}; give a dotted key such as 'geometry.depth'")
        for taken in set_entry(entries, f"{key}={_json(key, value)}", scenes.EXAMPLE, kind.replaced):
            if taken in values:
                raise InputError(f"{key}: takes the place of {taken}, which is set too; set one of them")
    return read_scene(_without_none(entries))


def checked_scene(scene: object) -> Scene:
    """The argument, if it is a scene; InputError otherwise."""
    if not isinstance(scene, Scene):
        raise InputError(f"scene: got {type(scene).__name__}; give a scene, which load_scene and read_scene return")
    return scene


def _text(value: object) -> str:
    """The text of a value in an assignment ``key=value``."""
    return value if isinstance(value, str) else _json("set", value)


def _json(place: str, value: object) -> str:
    """The value as JSON; InputError that names the place if it is nothing that a scene holds."""
    try:
        return json.dumps(value, default=lambda number: number.tolist())
    except RecursionError:
        got = type(value).__name__
    except (AttributeError, TypeError, ValueError):
        got = f"{value!r:.60}"
    raise InputError(f"{place}: got {got}; give a number, a text with a unit, or a list of these")


def _without_none(entries: dict[str, Any]) -> dict[str, Any]:
    """The nested entries without those that are None, which have their defaults then."""
    return {
        key: _without_none(entry) if isinstance(entry, dict) else entry
        for key, entry in entries.items()
        if entry is not None
    }
