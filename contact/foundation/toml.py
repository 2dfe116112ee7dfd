"""TOML files: reading, replacing single entries, and one-line messages for every error."""

import difflib
import json
import tomllib
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, get_args

from pydantic import BaseModel, ValidationError

from roughfilm.contact.foundation.errors import InputError

MAX_BYTES = 1_000_000
"""Largest size of a file that is read, bytes."""

Location = Sequence[int | str]
"""The location of an entry: the keys and list indices that lead to it, from the outermost."""


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

    A number in the path selects a table from a list of tables.

    Parameters
    ----------
    entries : the nested entries, which are changed.
    override : the assignment, ``dotted.key=value``.
    example : a correct assignment, for messages.
    replaces : by dotted key, the keys of the same table that are removed when it is set.

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
    """The first error of a pydantic validation as ``root.key: got value; remedy``; unknown keys come first.

    Parameters
    ----------
    error : the error of the validation.
    root : name of the outermost table, for the message.
    unknown : unknown(location), the remedy for an unknown key at a location.
    locate : locate(location), the location in the file that belongs to a location in the model.
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
        case "tuple_type":
            text = f"{place}: got {got}; write a list in brackets"
        case "value_error":
            reason = str(fault["ctx"]["error"])
            inner, colon, rest = reason.partition(": ")
            inside = colon and inner.replace(".", "").isidentifier()
            text = f"{place}.{inner}: {rest}" if inside else f"{place}: {reason}"
        case _:
            text = f"{place}: got {got}; {fault['msg'][0].lower()}{fault['msg'][1:]}"
    others = len(faults) - 1
    return " ".join(text.split()) + (f" (and {others} more error{'s' if others > 1 else ''})" if others else "")


def known_keys(model: type[BaseModel], path: Location) -> list[str]:
    """The keys of the table at ``path`` in a pydantic model; the fields on the path are models, optional or not."""
    table: Any = model
    for name in path:
        annotation = table.model_fields[name].annotation
        table = next(one for one in (annotation, *get_args(annotation)) if hasattr(one, "model_fields"))
    return [*table.model_fields]


def unknown_key(key: int | str, known: Iterable[str]) -> str:
    """The remedy for an unknown key: the most similar known key, or a list of all known keys."""
    names = list(known)
    near = difflib.get_close_matches(str(key), names, n=1)
    return "unknown key; " + (f"did you mean {near[0]!r}?" if near else f"known here: {', '.join(names)}")
