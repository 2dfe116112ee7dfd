"""Annotated scenes: every key of a kind with its meaning, its unit and its default, ready to be solved."""

import textwrap
import tomllib
from collections.abc import Iterable, Iterator, Mapping
from functools import cache, partial
from pathlib import Path
from typing import Any

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.toml import toml_value
from roughfilm.rom.ladder.kind import kind_of_name
from roughfilm.scenes.json_schema import UNIT, schema_of

Node = Mapping[str, Any]
"""A part of a JSON Schema."""

COLUMN, WIDTH = 31, 116
"""The column of the comments, and the longest line."""

EXAMPLES = Path(__file__).with_name("examples.toml")


@cache
def _examples() -> dict[str, Any]:
    return tomllib.loads(EXAMPLES.read_text(encoding="utf-8"))


def variants() -> Mapping[str, tuple[str, ...]]:
    """The variants of each kind for which there is an annotated scene; the first is the default.

    Examples
    --------
    >>> variants()["rough_gap"]
    ('sinusoid', 'self_affine')
    """
    return {kind: tuple(named) for kind, named in _examples().items() if kind != "optional"}


def annotated_scene(kind: str, variant: str | None = None) -> str:
    """The text of a scene file with all keys of a kind; those that may be left out are comments.

    Parameters
    ----------
    kind : name of the kind of scene.
    variant : shape of a bearing, profile of a pocket or kind of a surface; None for the default.

    Raises
    ------
    InputError
        If there is no such kind or variant.

    Examples
    --------
    >>> print(annotated_scene("pocket").splitlines()[6])
    length = "1 mm"                 # length of one period along the sliding direction, m
    """
    known = variants()
    if kind not in known:
        raise InputError(f"KIND: got {kind!r:.60}; it must be one of {', '.join(known)}")
    chosen = known[kind][0] if variant is None else variant
    if chosen not in known[kind]:
        raise InputError(
            f"kind: got {f'{kind}/{chosen}'!r:.60}; it must be {kind}/ and one of {', '.join(known[kind])}"
        )
    schema = schema_of(kind)
    example = {"name": f"{kind} {chosen}".replace("_", " "), "kind": kind, **_examples()[kind][chosen]}
    others = [f"{kind}/{other}" for other in known[kind] if other != chosen]
    head = f"{kind_of_name(kind).summary}. Lines behind # may be left out"
    lines = [
        *_wrapped("", f"{head[0].upper()}{head[1:]}."),
        *(_wrapped("", f"Others: roughfilm new {', '.join(others)}.") if others else ()),
        *_table((), schema, example, schema.get("$defs", {})),
    ]
    return "\n".join(lines) + "\n"


def _table(
    path: tuple[str, ...], node: Node, example: Node | None, definitions: Node, others: Node | None = None
) -> Iterator[str]:
    """The lines of a table: its own keys, and then the tables in it; all are comments without an example.

    ``others`` are the entries of a table beside it, from which keys without a value take theirs.
    """
    tables, lists = [], []
    for key, given in node["properties"].items():
        ways = [*forms_of(given, definitions)]
        plain = [way for way in ways if "properties" not in way]
        whole = [way for way in ways if "properties" in way]
        value = None if example is None else example.get(key)
        # A table shows all its forms, unless the entry is usually the name of a file.
        rows = _rows(plain, definitions)
        if rows and (value or given.get("default") == []):
            lists.append((key, given, rows, value or []))
        elif whole and (isinstance(value, dict) or (value is None and not (plain and key in _examples()["optional"]))):
            tables.append((key, given, whole, value))
        else:
            yield from _line(key, {**plain[0], **given}, value, others or {}, places_of(path, node))
    for key, given, whole, value in tables:
        for way in [max(whole, key=lambda way: _fit(way, value))] if value is not None else whole:
            inner = (*path, key)
            yield ""
            header = f"{'# ' if value is None else ''}[{'.'.join(inner)}]"
            meaning = way.get("description") if len(whole) > 1 else given.get("description", way.get("description"))
            form = f"one of {len(whole)} forms: " if len(whole) > 1 and value is None else ""
            yield from _wrapped(header, form + (meaning or ""))
            yield from _table(inner, way, value, definitions)
    for key, given, rows, entries in lists:
        inner = (*path, key)
        best = [max(rows, key=partial(_fit, value=entry)) for entry in entries]
        for way, entry in [*zip(best, entries, strict=True), *((way, None) for way in rows if way not in best)]:
            yield ""
            meaning = way.get("description", given.get("description", ""))
            form = "" if entry is not None else "another form: " if entries else f"one of {len(rows)} forms: "
            yield from _wrapped(f"{'# ' if entry is None else ''}[[{'.'.join(inner)}]]", form + meaning)
            yield from _table(inner, way, entry, definitions, entries[0] if entries else None)


def _rows(ways: Iterable[Node], definitions: Node) -> list[Node]:
    """The forms of the tables in a list of tables, their fixed values first; none for another entry."""
    rows = [row for way in ways for row in forms_of(way.get("items", {}), definitions) if "properties" in row]
    ordered = [dict(sorted(row["properties"].items(), key=lambda one: "const" not in one[1])) for row in rows]
    return [{**row, "properties": keys} for row, keys in zip(rows, ordered, strict=True)]


def forms_of(node: Node, definitions: Node) -> Iterator[Node]:
    """The forms that an entry may have."""
    if "$ref" in node:
        yield from forms_of(definitions[node["$ref"].rpartition("/")[2]], definitions)
    elif "anyOf" in node or "oneOf" in node:
        for way in node.get("anyOf", node.get("oneOf", ())):
            yield from forms_of(way, definitions)
    else:
        yield node


def _fit(way: Node, value: Node) -> tuple[bool, int]:
    """How well a table fits an example: whether its fixed values agree, and how many of the keys it has."""
    fixed = {key: one["const"] for key, one in way["properties"].items() if "const" in one}
    agrees = all(value.get(key, const) == const for key, const in fixed.items())
    return agrees, len(value.keys() & way["properties"].keys()) - len(value.keys() - way["properties"].keys()) * 100


def _line(key: str, node: Node, value: object, others: Node, places: tuple[str, ...]) -> Iterator[str]:
    """The line of a key, as a comment if it has no value and may be left out, or its table is one."""
    notes = [node.get("description", "")]
    if "enum" in node and not all(str(one) in notes[0] for one in node["enum"]):
        notes.append(" or ".join(map(toml_value, node["enum"])))
    if value is None and "default" in node:
        notes.append("default")
    own = "const" in node or "default" in node
    sample = sample_of(key, node, places) if own or key not in others else others[key]
    shown = toml_value(sample if value is None else value)
    return _wrapped(f"{'# ' if value is None else ''}{key} = {shown}", "; ".join(filter(None, notes)))


def places_of(path: tuple[str, ...], node: Node) -> tuple[str, ...]:
    """The names by which examples may be given for the keys of a table alone: its fixed values, and its own key."""
    return (*(one["const"] for one in node["properties"].values() if "const" in one), *path[-1:])


def sample_of(key: str, node: Node, places: tuple[str, ...] = ()) -> object:
    """A value for a key without one: its default, or one that makes sense.

    Parameters
    ----------
    key, node : the key, and what its schema says about it.
    places : names of its table from :func:`places_of`; the example of the first of them counts.
    """
    if "default" in node:
        return node["default"]
    if "const" in node:
        return node["const"]
    optional = _examples()["optional"]
    for place in places:
        if f"{place}.{key}" in optional:
            return optional[f"{place}.{key}"]
    if node.get("type") == "array" and f"{key}[]" in optional:
        return optional[f"{key}[]"]
    if any("prefixItems" in one for one in node.get("prefixItems", ())):  # rows of quantities
        rows = enumerate(node["prefixItems"])
        return [[optional[f"{cell[UNIT]}[]"][number] for cell in row["prefixItems"]] for number, row in rows]
    if key in optional:
        return optional[key]
    if "enum" in node:
        return node["enum"][0]
    if key in _values():
        return _values()[key]
    return optional.get(node[UNIT], f"1 {node[UNIT]}") if UNIT in node else "..." if node.get("type") == "string" else 1


@cache
def _values() -> Mapping[str, object]:
    """The first value of each key in the examples."""
    found: dict[str, object] = {}

    def collect(table: Mapping[str, object]) -> None:
        for key, value in table.items():
            if isinstance(value, dict):
                collect(value)
            else:
                found.setdefault(key, value)

    collect(_examples())
    return found


def _wrapped(text: str, meaning: str) -> Iterator[str]:
    """A text with a comment behind it, which goes on below where the line is too long, or begins there."""
    if len(text) > WIDTH - 43:
        yield text
        text = " " * COLUMN
    width = WIDTH - max(len(text), COLUMN) - 3 if text else WIDTH - 2
    comments = textwrap.wrap(meaning, max(width, 40)) or [""]
    for place, comment in enumerate(comments):
        before = text if place == 0 else ""
        yield f"{before:<{COLUMN if text else 0}}{' ' if text else ''}# {comment}".rstrip() if comment else before
        text = text and " " * max(len(text), COLUMN)
