"""What the manual takes from the code: every key, command and name, formulas that browsers draw, links that lead on."""

import hashlib
from pathlib import Path

import pytest
from latex2mathml.converter import convert

import roughfilm
from roughfilm.cli.main import COMMANDS
from roughfilm.contact.parameters.definitions import AREAL, PROFILE
from roughfilm.scenes.json_schema import schema_of
from scripts.manual import commands, interface, kept_examples, parameters, scene_keys
from scripts.manual.links import broken


def _keys(schema: object) -> set[str]:
    """The names of all properties of a JSON Schema."""
    if isinstance(schema, list):
        return set().union(*map(_keys, schema))
    if not isinstance(schema, dict):
        return set()
    return {*schema.get("properties", {})}.union(*map(_keys, schema.values()))


@pytest.mark.parametrize("kind", ["bearing", "dry_contact", "pocket", "rough_gap", "seal"])
def test_every_key_has_a_meaning_and_an_example(kind: str) -> None:
    keys = [key for _, _, keys in scene_keys.tables(kind) for key in keys]
    assert {key.name for key in keys} == _keys(schema_of(kind))
    assert [key.name for key in keys if not key.example or not key.range] == []
    tables = {"geometry", "lubricant", "roughness", "kind", "shape", "law"}
    assert [key.name for key in keys if not key.meaning and key.name not in tables] == []


def test_units_and_ranges_of_a_quantity_follow_from_the_schema() -> None:
    ((_, _, keys),) = [one for one in scene_keys.tables("bearing") if one[0] == "[motion]"]
    speed = next(key for key in keys if key.name == "speed")
    assert (speed.unit, speed.default, speed.range[:8]) == ("m/s", "required", "any sign")
    viscosity = next(key for _, _, keys in scene_keys.tables("pocket") for key in keys if key.name == "viscosity")
    assert (viscosity.unit, viscosity.default, viscosity.range[:7]) == ("Pa*s", "required", "above 0")


def test_the_page_of_commands_has_every_command_and_option() -> None:
    page = commands.page()
    assert [name for name in COMMANDS if f"\n### {name}\n" not in page] == []
    solve = page.partition("### solve")[2].partition("\n### ")[0]
    assert all(f"`{option}" in solve for option in ("SCENE", "--model", "--within", "--out", "--set", "--json"))


def test_the_page_of_the_interface_has_every_name() -> None:
    page = interface.page()
    assert [name for name in roughfilm.__all__ if f"roughfilm.{name}\n" not in page] == ["__version__"]


def test_the_page_of_parameters_has_a_formula_for_each() -> None:
    page = parameters.page()
    for one in (*AREAL.values(), *PROFILE.values()):
        row = next(line for line in page.splitlines() if line.startswith(f"| {one.name} |"))
        assert row.count(" | ") == 5, row
        formula = convert(row.split("$")[1])
        assert formula.startswith("<math")
        assert "\\" not in formula
    assert "not comparable between laboratories" in page


def test_a_link_that_leads_nowhere_is_named(tmp_path: Path) -> None:
    (tmp_path / "other.html").write_text('<p id="here">')
    (tmp_path / "page.html").write_text(
        '<a href="other.html#here"></a><a href="other.html#there"></a><a href="absent.html"></a>'
        '<a href="https://example.org"></a><img src="https://example.org/picture.png">'
    )
    assert [*broken(tmp_path)] == [
        "page.html: absent.html",
        "page.html: loads https://example.org/picture.png",
        "page.html: other.html#there",
    ]


def test_a_kept_example_serves_until_its_program_changes(tmp_path: Path) -> None:
    examples, built, kept = tmp_path / "examples", tmp_path / "built", tmp_path / "kept"
    for folder in (examples / "gaps", built / "gaps" / "images"):
        folder.mkdir(parents=True)
    program = examples / "gaps" / "long_flow.py"
    program.write_text("print(1)\n")
    assert [*kept_examples.outdated(examples, kept)] == ["gaps/long_flow.py"]
    (built / "gaps" / "long_flow.rst").write_text("1")
    (built / "gaps" / "long_flow.py.md5").write_text(hashlib.md5(b"print(1)\n").hexdigest())
    (built / "gaps" / "images" / "sphx_glr_long_flow_001.png").write_bytes(b"")
    (built / "gaps" / "short.rst").write_text("2")
    kept_examples.keep(built, kept)
    assert [*kept_examples.outdated(examples, kept)] == []
    kept_examples.restore(kept, tmp_path / "again", examples)
    assert sorted(path.name for path in (tmp_path / "again").rglob("*.*")) == [
        "long_flow.py",
        "long_flow.py.md5",
        "long_flow.rst",
        "long_flow.zip",
        "sphx_glr_long_flow_001.png",
    ]
    program.write_text("print(2)\n")
    assert [*kept_examples.outdated(examples, kept)] == ["gaps/long_flow.py"]
