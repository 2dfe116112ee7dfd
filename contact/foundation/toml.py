"""TOML files: reading, with a message in one line for every error, and replacing single entries."""

import json
import re
import tomllib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.units import in_si

MAX_BYTES = 1_000_000
"""Largest size of a file that is read, bytes."""

_AT = re.compile(r"\(at line (\d+), column \d+\)")
_UNQUOTED = re.compile(r"""\s*([\w.-]+)\s*=\s*([^"'\[{#=\s][^#"'=]*?)\s*(?:#.*)?""")
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
        If the file cannot be read, is larger than 1 MB or is not TOML.
    """
    path = Path(path)
    try:
        if not path.is_file():
            raise InputError(f"{path}: {'is no' if path.exists() else 'no such'} file; name a TOML file")
        if path.stat().st_size > MAX_BYTES:
            raise InputError(f"{path}: larger than {MAX_BYTES} bytes; write a short TOML file")
        text = path.read_text(encoding="utf-8-sig")
        return tomllib.loads(text)
    except OSError as error:
        raise InputError(f"{path}: cannot be read ({error.strerror}); check its permissions") from error
    except UnicodeDecodeError as error:
        line = error.object[: error.start].count(b"\n") + 1
        raise InputError(f"{path}:{line}: byte {error.start} is not UTF-8; save the file as UTF-8 text") from error
    except InputError:
        raise
    except (ValueError, RecursionError) as error:
        raise InputError(_not_toml(path, text, str(error).splitlines()[0], example)) from error


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
    replaces: Mapping[str, Sequence[str]] | None = None,
    *,
    in_si_units: bool = False,
) -> None:
    """Set one key of nested entries in place, from a text such as ``geometry.depth=22.5um``.

    A number in the path selects a table from a list of tables.

    Parameters
    ----------
    entries : the nested entries, which are changed.
    override : the assignment, ``dotted.key=value``.
    example : a correct assignment, for messages.
    replaces : by dotted key, the keys of the same table that are removed when it is set.
    in_si_units : whether a plain number is in SI units, where a number with a unit is asked.

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
    for part in path:
        if isinstance(table, list):
            table = {str(number): one for number, one in enumerate(table)}.get(part)
        else:
            table = table.setdefault(part, {})
        if not isinstance(table, dict | list):
            break
    if not isinstance(table, dict):
        raise InputError(f"set {override}: {path[-1]!r} is not a table; write for example {example}")
    for other in (replaces or {}).get(key, ()):
        table.pop(other, None)
    value = _value(text.strip())
    table[last] = in_si(value) if in_si_units else value


def _value(text: str) -> object:
    try:
        return json.loads(text, parse_constant=lambda name: name)
    except (ValueError, RecursionError):
        return text
