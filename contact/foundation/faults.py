"""The faults of entries that pydantic refuses, each as one line with its place and the remedy."""

import difflib
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any, get_args

from pydantic import BaseModel, ValidationError

from roughfilm.contact.foundation.line_numbers import Location, key_lines, line_of

MAX_FAULTS = 20
"""The largest number of faults in one message."""


@dataclass(frozen=True, kw_only=True)
class Fault:
    """One fault.

    Attributes
    ----------
    location : the keys and indices that lead to the entry in the file.
    text : what was got and the remedy, in one line.
    replaced : the missing key that an unknown key probably means; "" for any other fault.
    """

    location: tuple[int | str, ...]
    text: str
    replaced: str = ""


@dataclass(frozen=True, kw_only=True)
class EntriesFile:
    """The file of the entries.

    Attributes
    ----------
    path : the TOML file.
    changed : locations of entries that do not come from the file.
    """

    path: Path
    changed: Iterable[Location] = field(default=())

    @cached_property
    def lines(self) -> Mapping[tuple[int | str, ...], int]:
        """The line of each key; empty if the file cannot be read any more."""
        try:
            return key_lines(self.path.read_text(encoding="utf-8-sig"))
        except (OSError, ValueError):
            return {}

    def holds_not(self, location: Location) -> bool:
        """Whether an entry is changed, or lies in a changed one or around it."""
        return any(all(a == b for a, b in zip(location, other, strict=False)) for other in self.changed if location)

    def line(self, location: Location) -> int | None:
        """The line of an entry or of the table around it; None if it does not come from the file."""
        return None if self.holds_not(location) else line_of(location, self.lines)


def faults_of(
    error: ValidationError,
    unknown: Callable[[Location], tuple[str, str]],
    locate: Callable[[Location], Location] = tuple,
) -> list[Fault]:
    """All faults of a validation, unknown keys first; a missing key that an unknown one probably means is left out.

    Parameters
    ----------
    error : the error of the validation.
    unknown : unknown(location), the remedy for an unknown key at a location in the model, and the key it means.
    locate : locate(location), the location in the file that belongs to a location in the model.
    """
    given: list[Mapping[str, Any]] = sorted(
        map(dict, error.errors(include_url=False)), key=lambda fault: fault["type"] != "extra_forbidden"
    )
    given = [part for one in given if not _short_by_others(one, given) for part in _parts(one)]
    faults = [_fault(one, unknown, tuple(locate(one["loc"]))) for one in given]
    meant = {(*fault.location[:-1], fault.replaced) for fault in faults if fault.replaced}
    missing = [one["type"] == "missing" for one in given]
    kept: dict[tuple[Any, ...], Fault] = {}
    for fault, gone, one in zip(faults, missing, given, strict=True):
        if not (gone and fault.location in meant):
            kept.setdefault(_same(fault, one["loc"]), fault)
    return list(kept.values())


def _parts(given: Mapping[str, Any]) -> list[Mapping[str, Any]]:
    """The fault, or one for each line of its reason."""
    if given["type"] != "value_error":
        return [given]
    return [{**given, "ctx": {"error": line}} for line in str(given["ctx"]["error"]).splitlines()]


def _short_by_others(given: Mapping[str, Any], others: Sequence[Mapping[str, Any]]) -> bool:
    """Whether a list is too short only because pydantic does not count its items with faults of their own."""
    place = given["loc"]
    return given["type"] == "too_short" and any(
        len(one["loc"]) > len(place) and one["loc"][: len(place)] == place for one in others
    )


def _same(fault: Fault, path: Location) -> tuple[Any, ...]:
    """What two faults share of which one is enough: the ways to read one entry, and the parts of a list."""
    for place, name in enumerate(path):
        if isinstance(name, str) and not name.isidentifier():  # a way to read the entry, such as "tuple[int, int]"
            return (*fault.location[:place], None)
    alike = isinstance((*fault.location, "")[len(fault.location) - 1], int)
    return (*fault.location[:-1], fault.text) if alike else (*fault.location, fault.text)


def _fault(given: Mapping[str, Any], unknown: Callable[[Location], tuple[str, str]], location: Location) -> Fault:
    got = repr(given["input"])
    got = got if len(got) <= 60 else got[:57] + "..."
    inner: tuple[int | str, ...] = ()
    replaced = ""
    match given["type"]:
        case "extra_forbidden":
            text, replaced = unknown(given["loc"])
        case "missing":
            text = "missing; add it"
        case "literal_error":
            text = f"got {got}; it must be {given['ctx']['expected']}"
        case "union_tag_invalid":
            inner = (str(given["ctx"]["discriminator"]).strip("'"),)
            text = f"got {given['ctx']['tag']!r}; it must be one of {given['ctx']['expected_tags']}"
        case "union_tag_not_found":
            inner = (str(given["ctx"]["discriminator"]).strip("'"),)
            text = "missing; add it"
        case "int_type" | "bool_type" if isinstance(given["input"], str):
            text = f"got {got}; write it without quotes"
        case "int_type" | "int_from_float" | "int_parsing":
            text = f"got {got}; write a whole number"
        case "greater_than_equal":
            text = f"got {got}; it must be at least {given['ctx']['ge']}"
        case "less_than_equal":
            text = f"got {got}; it must be at most {given['ctx']['le']}"
        case "tuple_type" if isinstance(given["input"], Mapping):
            text = f"got one table; write [[{given['loc'][-1]}]], in two brackets, above each of them"
        case "tuple_type" if str(given["input"]).lstrip().startswith("["):
            text = f'got {got}; it is no list of TOML, write numbers with units in quotes, such as ["1 s", "2 s"]'
        case "tuple_type":
            text = f"got {got}; write a list in brackets"
        case "too_short":
            least = given["ctx"]["min_length"]
            text = f"got {got}; write {least} {'entry' if least == 1 else 'entries'} or more"
        case "too_long":
            text = f"got {got}; write no more entries than {given['ctx']['max_length']}"
        case "model_type" | "model_attributes_type" | "dict_type":
            text = f"got {got}; write a table, with a line for each of its keys"
        case "value_error":
            text = str(given["ctx"]["error"])
            before, colon, rest = text.partition(": ")
            if colon and before.replace(".", "").isidentifier():
                inner, text = tuple(int(key) if key.isdigit() else key for key in before.split(".")), rest
        case _:
            text = f"got {got}; {given['msg'][0].lower()}{given['msg'][1:]}"
    return Fault(location=(*location, *inner), text=" ".join(text.split()), replaced=replaced)


def in_lines(faults: Sequence[Fault], root: str, file: EntriesFile | None = None) -> str:
    """A line for each fault, ``root.key: got value; remedy``, or ``file:line: key: got value; remedy``.

    Parameters
    ----------
    faults : at least one.
    root : name of the outermost table, for entries that do not come from a file.
    file : the file of the entries; the faults are then in the order of its lines.
    """
    lines = [None if file is None else file.line(fault.location) for fault in faults]
    in_order = sorted(zip(lines, faults, strict=True), key=lambda one: one[0] or 0)
    shown = [f"{_place(fault.location, root, file, line)}: {fault.text}" for line, fault in in_order]
    shown = [line.replace("\n", r"\n") for line in shown]  # of a name
    others = len(shown) - MAX_FAULTS
    return "\n".join(shown[:MAX_FAULTS] + ([f"{root}: {others} more faults"] if others > 0 else []))


def _place(location: Location, root: str, file: EntriesFile | None, line: int | None) -> str:
    if file is None or file.holds_not(location):
        return ".".join([root, *map(str, location)])
    place = str(file.path) if line is None else f"{file.path}:{line}"
    return ": ".join([place, *filter(None, [".".join(map(str, location))])])


def known_keys(model: type[BaseModel], path: Location) -> list[str]:
    """The keys of the table at ``path`` in a pydantic model; the fields on the path are models, optional or not."""
    table: Any = model
    for name in path:
        annotation = table.model_fields[name].annotation
        table = next(one for one in (annotation, *get_args(annotation)) if hasattr(one, "model_fields"))
    return [*table.model_fields]


def unknown_key(key: int | str, known: Iterable[str]) -> tuple[str, str]:
    """The remedy for an unknown key: the most similar known key, or a list of all known keys; and that similar key."""
    names = list(known)
    near = difflib.get_close_matches(str(key), names, n=1)
    remedy = f"did you mean {near[0]!r}?" if near else f"known here: {', '.join(names)}"
    return f"unknown key; {remedy}", near[0] if near else ""
