"""TOML files: reading, with a message in one line for every error, and replacing single entries."""

import json
import re
import tomllib
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.reading.regular import opened, read_text
from roughfilm.contact.foundation.units import in_si
from roughfilm.contact.foundation.writing.kinds import SIGNATURE, as_input

MAX_BYTES = 1_000_000
"""Largest size of a file that is read, bytes."""

USER_BLOCK_BYTES = 512
"""Size of the header that an HDF5 file of this library has before its signature, bytes."""

MAX_LEVELS = 20
"""Largest number of levels of tables and lists in a file that is read."""

_AT = re.compile(r"\(at line (\d+), column \d+\)")
_UNQUOTED = re.compile(r"""\s*([\w.-]+)\s*=\s*([^"'\[{#=\s][^#"'=]*?)\s*(?:#.*)?""")
_DEEP_KEY = re.compile(rf"""(?<![\w-])(?:[\w"'-]++[ \t]*+\.[ \t]*+){{{2 * MAX_LEVELS}}}""")
"""A dotted key that takes long to read and is nested too deeply."""

_CURLED = "“”„«»‘’‚"


def toml_value(value: Any) -> str:
    """The text in a TOML file, on one line, of a number, a text, a list or a table."""
    if isinstance(value, Mapping):
        return (
            "{ " + ", ".join(f"{key} = {toml_value(entry)}" for key, entry in value.items()) + " }" if value else "{}"
        )
    if isinstance(value, list | tuple):
        return "[" + ", ".join(map(toml_value, value)) + "]"
    return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")


def read_toml(path: Path, example: str) -> dict[str, Any]:
    """The nested entries of a TOML file; messages quote ``example``, a correct line of such a file.

    Raises
    ------
    InputError
        If the file cannot be read, is larger than 1 MB, is not TOML, or is nested too deeply.
    """
    path = Path(path)
    with opened(as_input(path), "name a TOML file") as file:
        if SIGNATURE in file.read(USER_BLOCK_BYTES + len(SIGNATURE)):
            raise InputError(f"{path}: is a result, not a scene; name a TOML file")
    text = read_text(as_input(path), MAX_BYTES, "name a TOML file")
    if _DEEP_KEY.search(text):
        raise InputError(f"{path}: a key has too many parts; at most {MAX_LEVELS} levels are read")
    try:
        entries = tomllib.loads(text)
    except (ValueError, RecursionError) as error:
        raise InputError(_not_toml(path, text, str(error).splitlines()[0], example)) from error
    _refuse_extremes(path, entries)
    return entries


def _refuse_extremes(path: Path, entries: dict[str, Any]) -> None:
    """Raise InputError for entries nested too deeply for others to walk through, and for integers beyond 64 bits."""
    level: list[Any] = [entries]
    for _ in range(MAX_LEVELS):
        inner = [part for part in level if isinstance(part, dict | list)]
        level = [value for part in inner for value in (part.values() if isinstance(part, dict) else part)]
        if any(type(value) is int and value.bit_length() > 64 for value in level):
            raise InputError(
                f"{path}: holds an integer beyond 64 bits, which TOML does not have; write a number with e"
            )
    if level:
        raise InputError(f"{path}: its tables are nested too deeply; at most {MAX_LEVELS} levels are read")


def _not_toml(path: Path, text: str, reason: str, example: str) -> str:
    """The message on a text that is not TOML: the reason, with line and column, and the remedy for that line."""
    at = _AT.search(reason)
    unquoted = None if at is None else _UNQUOTED.fullmatch([*text.splitlines(), ""][int(at[1]) - 1])
    if "overwrite" in reason or "twice" in reason:
        remedy = "a key or a table stands twice, remove one of the two"
    elif unquoted is not None:
        remedy = f'put the value in straight quotes: {unquoted[1]} = "{unquoted[2].strip(_CURLED)}"'
    else:
        remedy = f"write lines such as: {example}"
    return f"{path}: is not TOML ({reason}); {remedy}"


def set_entry(
    entries: dict[str, Any],
    override: str,
    example: str,
    replaced: Callable[[str, Any], Sequence[str]] | None = None,
    *,
    in_si_units: bool = False,
) -> tuple[str, ...]:
    """Set one key of nested entries in place, from a text such as ``geometry.depth=22.5um``.

    A number in the path selects a table from a list of tables.

    Parameters
    ----------
    entries : the nested entries, which are changed.
    override : the assignment, ``dotted.key=value``.
    example : a correct assignment, for messages.
    replaced : replaced(key, value), the keys of the same table that a value removes.
    in_si_units : whether a plain number is in SI units, where a number with a unit is asked.

    Returns
    -------
    the dotted keys that the value removes, whether they were there or not.

    Raises
    ------
    InputError
        If the text is not an assignment, or its path contains a key that is not a table.
    """
    key, equals, text = override.partition("=")
    key = key.strip()
    *path, last = key.split(".")
    if not equals or not all([*path, last]):
        raise InputError(f"set {override}: got no key=value; write for example {example}")
    table: Any = entries
    for depth, part in enumerate(path):
        if isinstance(table, list):
            table = _chosen(
                table, part, f"set {override}: got {part!r} as a number in the list {'.'.join(path[:depth])!r}"
            )
        else:
            table = table.setdefault(part, {})
        if not isinstance(table, dict | list):
            break
    if isinstance(table, list) and not last.isdigit():
        _chosen(table, last, f"set {override}: got {last!r} as a number in the list {'.'.join(path)!r}")
    if not isinstance(table, dict):
        raise InputError(f"set {override}: {path[-1]!r} is not a table; write for example {example}")
    value = _value(text.strip())
    others = replaced(key, value) if replaced else ()
    for other in others:
        table.pop(other, None)
    table[last] = in_si(value) if in_si_units else value
    return tuple(".".join((*path, other)) for other in others)


def _chosen(entries: Sequence[object], number: str, message: str) -> object:
    """The entry of a list with a number, as text; InputError with a message, and the numbers that there are."""
    if number in map(str, range(len(entries))):
        return entries[int(number)]
    allowed = {0: "none, as the list is empty", 1: "0"}.get(len(entries), f"0 to {len(entries) - 1}")
    raise InputError(f"{message}; it must be {allowed}")


def _value(text: str) -> object:
    try:
        return json.loads(text, parse_constant=lambda name: name)
    except (ValueError, RecursionError):
        return text
