"""A study: a scene with lists of values, whose combinations are all checked and named before the first is solved."""

import hashlib
import itertools
import json
import math
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from copy import deepcopy
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from roughfilm.contact.foundation.brief import brief
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.faults import EntriesFile
from roughfilm.contact.foundation.toml import toml_value
from roughfilm.rom.ladder.kind import Scene
from roughfilm.rom.ladder.model import Model
from roughfilm.rom.ladder.scene import kind_named, load_entries, read_scene, scene_entries
from roughfilm.rom.ladder.setting import Setting, read_settings
from roughfilm.rom.studies.relative import resolve_relative

MAX_CASES = 1_000_000

MAX_LABEL_LENGTH = 150
"""Largest number of characters of the varied values in the name of a case; the digest follows them."""

Key = tuple[str | int, ...]
"""The location of an entry: names of tables and indices in lists of tables, from the outermost."""


@dataclass(frozen=True, kw_only=True)
class Case:
    """One scene of a study.

    Attributes
    ----------
    name : varied values and digest, as the name of a directory that is valid on any system.
    digest : first 16 hexadecimal digits of the SHA-256 digest of the complete scene.
    scene : the scene.
    varied : varied values by short name, as the study file contains them.
    """

    name: str
    digest: str
    scene: Scene
    varied: Mapping[str, Any]


@dataclass(frozen=True, kw_only=True)
class Study:
    """The cases of a study, each of which is solved in every setting.

    Attributes
    ----------
    name : name of the first scene.
    keys : location in the scene of each varied entry, by short name.
    cases : all cases.
    settings : models, each with a resolution and a scheme.
    """

    name: str
    keys: Mapping[str, Key]
    cases: tuple[Case, ...]
    settings: tuple[Setting, ...]

    __repr__ = brief


def load_study(path: Path, models: Callable[[str | None], Sequence[Model]]) -> Study:
    """Read a study file: a scene in which lists of numbers or texts are swept, in every combination.

    ``[[variants]]`` are tables that replace entries of the scene, one table at a time, to vary several keys together.
    ``[study]`` names ``models`` (by default all that are available) and, by model, ``resolution`` and ``scheme``, one
    or a list. In geometry a length may be a multiple of another one: "0.3 width". Lists of lists and lists of tables
    are values themselves, and so are lists for keys whose value is a list in this kind of scene; the lists inside such
    tables are swept.

    Parameters
    ----------
    path : the study file (TOML).
    models : gives the models of a kind of scene.

    Raises
    ------
    InputError
        If a key, a value or a case is wrong; the one-line message names it and gives the remedy.
    UnavailableError
        If a model that the study names cannot run on this machine.
    """
    entries = load_entries(path)
    kind = kind_named(entries)
    table = entries.pop("study", {})
    variants = entries.pop("variants", [{}])
    if not isinstance(variants, list) or not all(isinstance(variant, dict) for variant in variants):
        raise InputError("variants: is not a list of tables; write each under [[variants]]")
    if any("kind" in variant for variant in variants):
        raise InputError("variants: got a kind; write it once for all, and a study for each kind of scene")
    try:
        bases = [_merged(entries, variant) for variant in variants]
        if bases and "kind" not in entries:  # the message names the file
            read_scene(bases[0], EntriesFile(path=Path(path)))
        keys, cases = _multiplied(bases, frozenset[Key]() if kind is None else kind.lists)
    except RecursionError:
        raise InputError(f"{path}: tables are nested too deep; a scene has two or three levels") from None
    settings = read_settings(table, models(None if kind is None else kind.name))
    return Study(name=cases[0].scene.name, keys=keys, cases=cases, settings=settings)


def _multiplied(bases: Sequence[Mapping[str, Any]], lists: frozenset[Key]) -> tuple[dict[str, Key], tuple[Case, ...]]:
    """The varied keys by short name, and the cases of all bases; ``lists`` are the keys whose value is a list."""
    axes = [dict(_axes(base, lists)) for base in bases]
    count = sum(math.prod(len(values) for values in options.values()) for options in axes)
    if not 1 <= count <= MAX_CASES:
        raise InputError(f"the lists make {count} cases; a study has 1 to {MAX_CASES}")
    labels = _labels(axes)
    cases: dict[str, Case] = {}
    for base, options in zip(bases, axes, strict=True):
        for values in itertools.product(*options.values()):
            case = _case(base, dict(zip(options, values, strict=True)), labels)
            if case.digest in cases:
                raise InputError(f"two cases are the same scene, {case.name}; drop one of the values")
            cases[case.digest] = case
    return {label: key for key, label in labels.items()}, tuple(cases.values())


def as_toml(scene: Scene) -> str:
    """The text of a scene file with all entries of a scene; ``load_scene`` reads it back unchanged."""
    lines = []
    for key, value in scene_entries(scene).items():
        if isinstance(value, dict):
            lines += ["", f"[{key}]", *(f"{name} = {toml_value(item)}" for name, item in value.items())]
        else:
            lines.append(f"{key} = {toml_value(value)}")
    return "\n".join(lines) + "\n"


def _merged(base: Mapping[str, Any], over: Mapping[str, Any]) -> dict[str, Any]:
    both = {key: _merged(base[key], over[key]) for key in base.keys() & over.keys() if _tables(base[key], over[key])}
    return {**base, **over, **both}


def _tables(*values: object) -> bool:
    return all(isinstance(value, dict) for value in values)


def _axes(entry: Any, lists: frozenset[Key], key: Key = ()) -> Iterator[tuple[Key, list[Any]]]:
    """Every entry that is not a table, with its location and the list of its values."""
    if isinstance(entry, dict):
        for name, value in entry.items():
            yield from _axes(value, lists, (*key, name))
    elif isinstance(entry, list) and entry and _tables(*entry):
        for place, value in enumerate(entry):
            yield from _axes(value, lists, (*key, place))
    elif isinstance(entry, list) and key in lists:
        swept = bool(entry) and all(isinstance(value, list) for value in entry)
        yield key, entry if swept else [entry]
    elif isinstance(entry, list) and not any(isinstance(value, list) for value in entry):
        kinds = {_kind(value) for value in entry}
        if len(kinds) != 1:
            content = f"a mixture of {' and '.join(sorted(kinds))}" if kinds else "an empty list"
            raise InputError(f"{_dotted(key)}: got {content}; list values of one kind to sweep it")
        yield key, entry
    else:
        yield key, [entry]


def _kind(value: object) -> str:
    if isinstance(value, bool):
        return "truth values"
    if isinstance(value, int | float):
        return "numbers"
    if isinstance(value, str):
        return "texts"
    return "tables" if isinstance(value, dict) else "dates"


def _dotted(key: Key) -> str:
    return ".".join(str(part) for part in key)


def _labels(axes: Sequence[Mapping[Key, list[Any]]]) -> dict[Key, str]:
    """The keys that vary in a study, each with its last part as name, or its dotted name where last parts coincide."""
    keys = dict.fromkeys(key for options in axes for key in options)
    varied = [key for key in keys if len({repr(options.get(key)) for options in axes}) > 1 or len(axes[0][key]) > 1]
    ends = [key[-1] for key in varied]
    return {key: str(key[-1]) if ends.count(key[-1]) == 1 else _dotted(key) for key in varied}


def _case(base: Mapping[str, Any], values: Mapping[Key, Any], labels: Mapping[Key, str]) -> Case:
    entries = deepcopy(dict(base))
    for key, value in values.items():
        table: Any = entries
        for part in key[:-1]:
            table = table[part]
        table[key[-1]] = value
    varied = {label: values[key] for key, label in labels.items() if key in values}
    label = "_".join(f"{name}-{_portable(value)}" for name, value in varied.items())[:MAX_LABEL_LENGTH] or "case"
    try:
        if isinstance(entries.get("geometry"), dict):
            entries["geometry"] = resolve_relative(entries["geometry"], "scene.geometry")
        scene = read_scene(entries)
    except InputError as error:
        faults = [f"case {label}: {line}" if varied else line for line in str(error).splitlines()]
        raise InputError("\n".join(faults)) from None
    digest = digest_of_entries(scene_entries(scene))
    return Case(name=f"{label}-{digest}", digest=digest, scene=scene, varied=varied)


def digest_of_entries(entries: Mapping[str, Any]) -> str:
    """The first 16 hexadecimal digits of the SHA-256 digest of the complete entries of a scene."""
    return hashlib.sha256(json.dumps(entries, sort_keys=True).encode()).hexdigest()[:16]


def _portable(value: object) -> str:
    return re.sub(r"[^A-Za-z0-9.+_-]", "_", str(value).replace(" ", "").replace("µ", "u").replace("μ", "u"))
