"""The JSON Schema of scene files, with the unit and the meaning of every key."""

import re
from collections.abc import Callable, Mapping
from functools import cache
from typing import Any

from pydantic import BaseModel, TypeAdapter
from pydantic.json_schema import GenerateJsonSchema
from pydantic_core import core_schema

from roughfilm.contact.foundation.entries import InUnit
from roughfilm.contact.foundation.units import with_unit
from roughfilm.contact.synthetic.description import Description
from roughfilm.rom.ladder.kind import kind_of_name, kinds
from roughfilm.rom.pocket.geometry import PROFILES, Cylindrical, PocketGeometry

DIALECT = "https://json-schema.org/draft/2020-12/schema"

UNIT = "x-unit"
"""The key of a schema that holds the SI unit of a quantity."""

_QUANTITY = r"(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?\s*(1\s*)?[A-Za-zµμ°/].*$"
_ENTRY = re.compile(r"^(\w+(?:, \w+)*) : (.*(?:\n(?![\w, ]+ : )\s*\S.*)*)", re.MULTILINE)

INTERNAL = frozenset({"digest"})
"""Keys that results hold and that nobody writes."""


def quantity(annotation: InUnit) -> dict[str, Any]:
    """The schema of a text with a unit."""
    sign = "[-+]?" if annotation.any_sign else r"\+?"
    return {"type": "string", "pattern": rf"^\s*{sign}{_QUANTITY}", UNIT: annotation.base}


def meanings(model: type) -> dict[str, str]:
    """The meaning of each key of a table, from the section "Attributes" of its docstring and those of its bases."""
    found: dict[str, str] = {}
    for one in reversed(model.__mro__):
        section = (one.__doc__ or "").partition("Attributes\n    ----------\n")[2].partition("\n\n")[0]
        lines = re.sub(r"^ {4}", "", section, flags=re.MULTILINE)
        for names, text in _ENTRY.findall(lines):
            found |= dict.fromkeys(names.split(", "), _plain(text))
    return found


def _plain(text: str) -> str:
    """A sentence of a docstring in the words of a file, which has no None: "; None if wide" is "; left out if wide"."""
    words = re.sub(r", see roughfilm[\w.]+", "", text)
    return " ".join(words.replace("``", "").replace("; None ", "; left out ").split())


class _SceneSchema(GenerateJsonSchema):
    """The schema of entries as a file holds them, not of the numbers that they become."""

    def function_before_schema(self, schema: core_schema.BeforeValidatorFunctionSchema) -> dict[str, Any]:
        function: Any = schema["function"]["function"]
        owner = getattr(function, "__self__", None)
        if isinstance(owner, InUnit):
            return quantity(owner)
        inner = super().function_before_schema(schema)
        also = _ALSO.get(function.__name__)
        return inner if also is None else also(self, inner)

    def model_schema(self, schema: core_schema.ModelSchema) -> dict[str, Any]:
        made = super().model_schema(schema)
        texts = meanings(schema["cls"])
        first = (schema["cls"].__doc__ or "").strip().split("\n\n")[0]
        made["description"] = _plain(first).removesuffix(".")
        properties = made.get("properties", {})
        for key in INTERNAL & properties.keys():
            del properties[key]
        for key, one in properties.items():
            one.pop("title", None)
            if key in texts:
                one["description"] = texts[key].removesuffix(".")
        return made

    def _of_surface(self, _inner: dict[str, Any]) -> dict[str, Any]:
        return {"anyOf": [{"type": "string"}, self.generate_inner(TypeAdapter(Description).core_schema)]}


def _or_text(_generator: _SceneSchema, inner: dict[str, Any]) -> dict[str, Any]:
    return {"anyOf": [inner, {"type": "string"}]}


def _or_heat_capacity(_generator: _SceneSchema, inner: dict[str, Any]) -> dict[str, Any]:
    return {"anyOf": [quantity(InUnit("J/(kg*K)")), inner]}


def _or_number(_generator: _SceneSchema, inner: dict[str, Any]) -> dict[str, Any]:
    return {"anyOf": [{"type": "number"}, inner]}


def _or_one(_generator: _SceneSchema, inner: dict[str, Any]) -> dict[str, Any]:
    return {"anyOf": [inner["prefixItems"][0], inner]}


_ALSO: Mapping[str, Callable[[_SceneSchema, dict[str, Any]], dict[str, Any]]] = {
    "_pair": _or_one,
    "_law": _or_text,
    "checked": _or_text,
    "rows": _or_text,
    "_constant": _or_heat_capacity,
    "_number_or_table": _or_number,
    "surface_entry": _SceneSchema._of_surface,
}
"""What a file may hold in other forms than that of the class, by the function that reads it."""


@cache
def schema_of(kind: str) -> dict[str, Any]:
    """The JSON Schema of the scenes of a kind; KeyError if there is no such kind.

    Quantities are texts with a unit; ``x-unit`` is their SI unit, and ``description`` the meaning of each key.
    """
    model: type[BaseModel] = kind_of_name(kind).scene
    made = {"$schema": DIALECT, **model.model_json_schema(schema_generator=_SceneSchema)}
    if PocketGeometry.__name__ in made["$defs"]:
        _lay_grooves_flat(made["$defs"])
    cleaned: dict[str, Any] = _cleaned(made)
    return cleaned


def _cleaned(schema: Any) -> Any:
    """The schema without null, which TOML has not, and with units on the defaults of quantities."""
    if isinstance(schema, list):
        return [_cleaned(one) for one in schema]
    if not isinstance(schema, dict):
        return schema
    made = {key: _cleaned(value) for key, value in schema.items() if key not in ("discriminator", "title")}
    if made.get("default", "") is None:
        del made["default"]
    ways = [way for way in made.get("anyOf", []) if way != {"type": "null"}]
    if len(ways) == 1:
        del made["anyOf"]
        made = {**ways[0], **made}
    elif ways:
        made["anyOf"] = ways
    if UNIT in made and isinstance(made.get("default"), float):
        made["default"] = with_unit(made["default"], made[UNIT])
    units = [one.get(UNIT) for one in made.get("prefixItems", ())]
    if all(units) and isinstance(made.get("default"), list):
        made["default"] = [with_unit(value, unit) for value, unit in zip(made["default"], units, strict=True)]
    return made


def _lay_grooves_flat(definitions: dict[str, Any]) -> None:
    """Let the geometry of a pocket hold the keys of a single groove in place of a list of grooves."""
    geometry = definitions[PocketGeometry.__name__]
    own = {key: geometry["properties"][key] for key in ("length", "film")}
    default = definitions[Cylindrical.__name__]
    default["required"].remove("profile")
    ways = [{"properties": geometry["properties"], "required": ["length", "film", "grooves"]}]
    for model in PROFILES.values():
        groove = definitions[model.__name__]
        ways.append({"properties": own | groove["properties"], "required": ["length", "film", *groove["required"]]})
    definitions[PocketGeometry.__name__] = {
        "description": geometry["description"],
        "anyOf": [{"type": "object", "additionalProperties": False, **way} for way in ways],
    }


def schema_of_scenes() -> dict[str, Any]:
    """The JSON Schema of all scenes: ``kind`` selects the one that holds."""
    names = [*kinds()]
    definitions: dict[str, Any] = {}
    for name in names:
        own = {key: value for key, value in _renamed(schema_of(name), name).items() if key != "$schema"}
        definitions |= {f"{name}.{key}": value for key, value in own.pop("$defs", {}).items()}
        definitions[name] = own
    return {
        "$schema": DIALECT,
        "title": "A scene of roughfilm",
        "type": "object",
        "required": ["name", "kind"],
        "properties": {"kind": {"enum": names, "description": "The kind of the scene."}},
        "allOf": [
            {"if": {"properties": {"kind": {"const": name}}, "required": ["kind"]}, "then": {"$ref": f"#/$defs/{name}"}}
            for name in names
        ],
        "$defs": definitions,
    }


def _renamed(schema: Any, kind: str) -> Any:
    """The schema with references to the definitions of its kind."""
    if isinstance(schema, dict):
        return {
            key: value.replace("#/$defs/", f"#/$defs/{kind}.") if key == "$ref" else _renamed(value, kind)
            for key, value in schema.items()
        }
    return [_renamed(value, kind) for value in schema] if isinstance(schema, list) else schema
