"""TOML files that people write: read, overridden key by key, every fault told in one line."""

import difflib
import json
import tomllib
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, get_args

from pydantic import BaseModel, ValidationError

from roughfilm.contact.foundation.errors import InputError

LARGEST = 1_000_000
"""Bytes; a longer file is refused unread."""

Location = Sequence[int | str]
"""The keys that lead to a place in a file."""


def toml_value(value: Any) -> str:
    """A number, a text, a list or a table as a TOML file writes it, on one line."""
    if isinstance(value, Mapping):
        return (
            "{ " + ", ".join(f"{key} = {toml_value(entry)}" for key, entry in value.items()) + " }" if value else "{}"
        )
    if isinstance(value, list | tuple):
        return "[" + ", ".join(map(toml_value, value)) + "]"
    return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")


def read_toml(path: Path, example: str) -> dict[str, Any]:
    """The nested entries of a TOML file; ``example`` is a line of it as it should be.

    Raises InputError in one line if the file cannot be read or is not TOML.
    """
    path = Path(path)
    try:
        if not path.is_file():
            raise InputError(f"{path}: {'is no' if path.exists() else 'no such'} file; name a TOML file")
        if path.stat().st_size > LARGEST:
            raise InputError(f"{path}: larger than {LARGEST} bytes; write a short TOML file")
        return tomllib.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise InputError(f"{path}: cannot be read ({error.strerror}); check its permissions") from error
    except UnicodeDecodeError as error:
        raise InputError(f"{path}: byte {error.start} is not UTF-8; save the file as UTF-8 text") from error
    except InputError:
        raise
    except (ValueError, RecursionError) as error:
        reason = str(error).splitlines()[0]
        raise InputError(f"{path}: is not TOML ({reason}); write lines such as: {example}") from error


def set_entry(
    entries: dict[str, Any], override: str, example: str, replaces: Mapping[str, Sequence[str]] | None = None
) -> None:
    """Set one key of nested entries in place, from a text such as ``geometry.depth=22.5um``.

    A number in the path picks from a list of tables. ``replaces`` names the keys of the same table that a key makes
    meaningless, and takes away. Raises InputError if the text is no assignment, or leads through what is no table.
    """
    key, equals, text = override.partition("=")
    key = key.strip()
    *path, last = key.split(".")
    if not equals or not all([*path, last]):
        raise InputError(f"--set {override}: got no key=value; write for example {example}")
    table: Any = entries
    for part in path:
        if isinstance(table, list):
            table = {str(number): one for number, one in enumerate(table)}.get(part)
        else:
            table = table.setdefault(part, {})
        if not isinstance(table, dict | list):
            break
    if not isinstance(table, dict):
        raise InputError(f"--set {override}: {path[-1]!r} is not a table; write for example {example}")
    for other in (replaces or {}).get(key, ()):
        table.pop(other, None)
    table[last] = _value(text.strip())


def _value(text: str) -> object:
    try:
        return json.loads(text, parse_constant=lambda name: name)
    except (ValueError, RecursionError):
        return text


def in_one_line(
    error: ValidationError,
    root: str,
    unknown: Callable[[Location], str],
    locate: Callable[[Location], Location] = tuple,
) -> str:
    """The first of pydantic's faults as ``root.key: got value; remedy``, unknown keys before all others.

    ``locate`` turns pydantic's path into the file's; ``unknown`` says what to do about an unknown key at such a path.
    """
    faults = sorted(error.errors(include_url=False), key=lambda fault: fault["type"] != "extra_forbidden")
    fault = faults[0]
    location = locate(fault["loc"])
    place = ".".join([root, *map(str, location)])
    got = repr(fault["input"])
    got = got if len(got) <= 60 else got[:57] + "..."
    match fault["type"]:
        case "extra_forbidden":
            text = f"{place}: {unknown(location)}"
        case "missing":
            text = f"{place}: missing; add it"
        case "literal_error":
            text = f"{place}: got {got}; it must be {fault['ctx']['expected']}"
        case "union_tag_invalid":
            key = str(fault["ctx"]["discriminator"]).strip("'")
            text = f"{place}.{key}: got {fault['ctx']['tag']!r}; it must be one of {fault['ctx']['expected_tags']}"
        case "union_tag_not_found":
            text = f"{place}.{str(fault['ctx']['discriminator']).strip(chr(39))}: missing; add it"
        case "value_error":
            reason = str(fault["ctx"]["error"])
            inner, colon, rest = reason.partition(": ")
            inside = colon and inner.replace(".", "").isidentifier()
            text = f"{place}.{inner}: {rest}" if inside else f"{place}: {reason}"
        case _:
            text = f"{place}: got {got}; {fault['msg'][0].lower()}{fault['msg'][1:]}"
    return " ".join(text.split()) + (f" (and {len(faults) - 1} more)" if len(faults) > 1 else "")


def known_keys(model: type[BaseModel], path: Location) -> list[str]:
    """The keys of the table at ``path`` inside a model whose tables are models too, some of them optional."""
    part: Any = model
    for name in path:
        annotation = part.model_fields[name].annotation
        part = next(one for one in (annotation, *get_args(annotation)) if hasattr(one, "model_fields"))
    return [*part.model_fields]


def unknown_key(key: int | str, known: Iterable[str]) -> str:
    """What to say of an unknown key: the known one it is nearest to, or all that are known."""
    names = list(known)
    near = difflib.get_close_matches(str(key), names, n=1)
    return "unknown key; " + (f"did you mean {near[0]!r}?" if near else f"known here: {', '.join(names)}")
