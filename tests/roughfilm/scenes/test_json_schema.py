"""The JSON Schema accepts the example scenes and refuses typing errors in them."""

import json
import re
import tomllib

import pytest
from places import SCENES
from typer.testing import CliRunner

from roughfilm.cli.main import app
from roughfilm.rom.ladder.kind import kind_names
from roughfilm.scenes.annotated import annotated_scene, variants
from roughfilm.scenes.json_schema import schema_of, schema_of_scenes

TYPES = {"object": dict, "array": list, "string": str, "number": (int, float), "integer": int, "boolean": bool}
BOUNDS = {
    "minimum": lambda value, bound: value >= bound,
    "maximum": lambda value, bound: value <= bound,
    "exclusiveMinimum": lambda value, bound: value > bound,
    "minLength": lambda value, bound: len(value) >= bound,
    "maxLength": lambda value, bound: len(value) <= bound,
    "minItems": lambda value, bound: len(value) >= bound,
    "maxItems": lambda value, bound: len(value) <= bound,
    "pattern": lambda value, bound: re.search(bound, value) is not None,
    "const": lambda value, bound: value == bound,
    "enum": lambda value, bound: value in bound,
}


def holds(schema, value, root):
    """Whether a value holds a schema, for the words of JSON Schema that the schemas use."""
    if "$ref" in schema:
        target = root
        for key in schema["$ref"].removeprefix("#/").split("/"):
            target = target[key]
        if not holds(target, value, root):
            return False
    if "type" in schema:
        wanted = TYPES[schema["type"]]
        if not isinstance(value, wanted) or (isinstance(value, bool) and wanted is not bool):
            return False
    if not all(bound(value, schema[word]) for word, bound in BOUNDS.items() if word in schema):
        return False
    if "anyOf" in schema and not any(holds(one, value, root) for one in schema["anyOf"]):
        return False
    if "oneOf" in schema and sum(holds(one, value, root) for one in schema["oneOf"]) != 1:
        return False
    for one in schema.get("allOf", []):
        if ("if" not in one or holds(one["if"], value, root)) and not holds(one.get("then", one), value, root):
            return False
    if isinstance(value, dict):
        known = schema.get("properties", {})
        return (
            value.keys() >= set(schema.get("required", ()))
            and (schema.get("additionalProperties") is not False or value.keys() <= known.keys())
            and all(holds(known[key], one, root) for key, one in value.items() if key in known)
        )
    if isinstance(value, list):
        first = schema.get("prefixItems", [])
        return all(holds(one, part, root) for one, part in zip(first, value, strict=False)) and all(
            holds(schema["items"], part, root) for part in (value[len(first) :] if "items" in schema else ())
        )
    return True


def scenes():
    for path in sorted(SCENES.glob("*.toml")):
        entries = tomllib.loads(path.read_text(encoding="utf-8"))
        if entries["kind"] in kind_names():
            yield pytest.param(entries, id=path.stem)
    for kind, known in variants().items():
        for variant in known:
            yield pytest.param(tomllib.loads(annotated_scene(kind, variant)), id=f"{kind}/{variant}")


@pytest.mark.parametrize("entries", [*scenes()])
def test_every_example_is_valid(entries):
    for schema in (schema_of(entries["kind"]), schema_of_scenes()):
        assert holds(schema, entries, schema)


@pytest.mark.parametrize(
    ("table", "key", "value"),
    [
        ("geometry", "depht", "1 um"),
        ("geometry", "depth", 7.5),
        ("geometry", "depth", "7,5"),
        ("geometry", "depth", "-1 um"),
        ("geometry", "profile", "square"),
        ("motion", "reynolds_number", "160"),
        ("boundry", "ambient_pressure", "1 bar"),
    ],
)
def test_a_typing_error_is_refused(table, key, value):
    entries = tomllib.loads((SCENES / "pocket.toml").read_text(encoding="utf-8"))
    entries.setdefault(table, {})[key] = value
    for schema in (schema_of("pocket"), schema_of_scenes()):
        assert not holds(schema, entries, schema)


def test_an_unknown_kind_is_refused():
    schema = schema_of_scenes()
    assert not holds(schema, {"name": "a", "kind": "gearbox"}, schema)


@pytest.mark.parametrize("kind", kind_names())
def test_every_key_has_a_meaning_and_every_quantity_a_unit(kind):
    schema = schema_of(kind)
    for table in (schema, *schema["$defs"].values()):
        for key, one in table.get("properties", {}).items():
            fixed_or_table = {"const", "$ref", "oneOf", "anyOf"} & one.keys()
            assert "description" in one or fixed_or_table, key
            assert "pattern" not in one or "x-unit" in one, key


def test_the_command_prints_the_schemas():
    run = CliRunner().invoke
    assert json.loads(run(app, ["schema"]).stdout) == schema_of_scenes()
    assert json.loads(run(app, ["schema", "seal"]).stdout) == schema_of("seal")
    assert run(app, ["schema", "gearbox"]).exit_code == 2
