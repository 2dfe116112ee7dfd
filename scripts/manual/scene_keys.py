"""The keys of each kind of scene as a page in Markdown, from the JSON Schema of scene files."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from roughfilm.contact.foundation.ranges import RANGES
from roughfilm.contact.foundation.toml import toml_value
from roughfilm.rom.ladder.kind import kind_of_name
from roughfilm.scenes.annotated import annotated_scene, forms_of, places_of, sample_of, variants
from roughfilm.scenes.json_schema import UNIT, schema_of

HEAD = "| key | unit | default | range | meaning | example |\n|---|---|---|---|---|---|"

COMPARED = (
    ("exclusiveMinimum", "above"),
    ("minimum", "at least"),
    ("exclusiveMaximum", "below"),
    ("maximum", "at most"),
)
"""The limits of a number in a schema, in words."""


@dataclass(frozen=True, kw_only=True)
class Key:
    """A key of a scene file, in words.

    Attributes
    ----------
    name : the key.
    unit : SI unit, "1" of a plain number, empty of what has none.
    default : value that holds where the key is left out, "required" or "none".
    range : what it may be.
    meaning : what it means.
    example : a value as it stands in a file.
    """

    name: str
    unit: str
    default: str
    range: str
    meaning: str
    example: str

    def row(self) -> str:
        """The key as a row of a table in Markdown."""
        cells = (f"`{self.name}`", self.unit, self.default, self.range, self.meaning, f"`{self.example}`")
        return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"


def tables(kind: str) -> Iterator[tuple[str, str, list[Key]]]:
    """The tables of a kind of scene: the name in a file, the meaning, and the keys.

    Examples
    --------
    >>> name, _, keys = next(tables("pocket"))
    >>> name, keys[0].name, keys[0].default
    ('', 'name', 'required')
    """
    schema = schema_of(kind)
    yield from _tables("", schema, schema.get("$defs", {}))


def page(kind: str) -> str:
    """The page of a kind of scene in Markdown: its first annotated scene, and its keys by table."""
    first, *others = variants()[kind]
    lines = [f"# Keys of `{kind}`", "", _sentence(kind_of_name(kind).summary), "", "## A complete scene", ""]
    also = f"; others are {', '.join(f'`{kind}/{other}`' for other in others)}" if others else ""
    lines += [f"`roughfilm new {kind}/{first}` prints this scene{also}.", ""]
    lines += ["```toml", annotated_scene(kind, first).rstrip(), "```", "", "## Keys by table", ""]
    for name, meaning, keys in dict.fromkeys((name, meaning, tuple(keys)) for name, meaning, keys in tables(kind)):
        lines += [f"### {name or 'Top of the file'}", "", *([_sentence(meaning), ""] if meaning else [])]
        lines += [HEAD, *(key.row() for key in keys), ""]
    return "\n".join(lines)


def _tables(path: str, node: Mapping[str, Any], definitions: Mapping[str, Any]) -> Iterator[tuple[str, str, list[Key]]]:
    keys, inner = [], []
    for name, given in node["properties"].items():
        forms = [*forms_of(given, definitions)]
        items = [item for form in forms if "items" in form for item in forms_of(form["items"], definitions)]
        inner += [(name, given, form) for form in (*forms, *items) if "properties" in form]
        place = f"{path}.{name}" if path else name
        key = _key(name, given, forms, place=place, required=name in node.get("required", ()), node=node)
        keys.append(key)
    yield path and f"[{path}]", node.get("description", ""), keys
    for name, _, form in inner:
        chosen = [f'{key} = "{one["const"]}"' for key, one in form["properties"].items() if "const" in one]
        below = f"{path}.{name}" if path else name
        for place, meaning, entries in _tables(below, form, definitions):
            own = place == f"[{below}]"
            yield place + (f" with {', '.join(chosen)}" if own and chosen else ""), meaning, entries


def _key(
    name: str,
    given: Mapping[str, Any],
    forms: list[Mapping[str, Any]],
    *,
    place: str,
    required: bool,
    node: Mapping[str, Any],
) -> Key:
    plain = [form for form in forms if "properties" not in form]
    one = {**(plain[0] if plain else {}), **given}
    whole = len(plain) < len(forms)
    table = places_of(tuple(place.split("."))[:-1], node)
    several = len(forms) - len(plain) > 1
    meaning = f"one of the {len(forms) - len(plain)} forms below" if several else forms[0].get("description", "")
    default = "required" if required else f"`{toml_value(one['default'])}`" if "default" in one else "none"
    number = one.get("type") in ("number", "integer")
    return Key(
        name=name,
        unit=one.get(UNIT, "1" if number else ""),
        default=default,
        range="a table" if whole and not plain else _range(one) + (", or a table" if whole else ""),
        meaning=_sentence(one.get("description", meaning)),
        example=f"[{place}]" if whole and not plain else toml_value(sample_of(name, one, table)),
    )


def _range(one: Mapping[str, Any]) -> str:
    """What a value may be, in words."""
    if "const" in one:
        return f"`{toml_value(one['const'])}`"
    if "enum" in one:
        return ", ".join(f"`{toml_value(choice)}`" for choice in one["enum"])
    if UNIT in one:
        limits = RANGES.get(one[UNIT])
        positive = one["pattern"].startswith(r"^\s*\+?")
        if not limits:
            return "above 0" if positive else "any sign"
        return f"above 0, from {limits}" if positive else f"any sign; 0, or a magnitude from {limits}"
    words = [f"{word} {one[key]:g}" for key, word in COMPARED if key in one]
    names = {"integer": "whole number", "number": "number", "boolean": "`true` or `false`", "array": "list"}
    return " ".join([names.get(one.get("type", ""), "text"), ", ".join(words)]).strip()


def _sentence(text: str) -> str:
    return f"{text[:1].upper()}{text[1:].rstrip('.')}." if text else ""
