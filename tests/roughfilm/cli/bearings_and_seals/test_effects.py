"""roughfilm effects as people call it."""

import json
import re
from pathlib import Path
from typing import Any

import pytest
from click.testing import Result
from places import SCENES
from typer.testing import CliRunner

from roughfilm.cli.main import app
from roughfilm.rom.bearing.effects.ablation import EFFECTS
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import load_scene, read_scene
from roughfilm.words.numbers import with_error

COARSE = ("--set", "roughness.surface.points=[32, 32]", "--set", "roughness.surface.correlation_length=60um")


def run(scene: str, *arguments: object) -> Result:
    return CliRunner().invoke(app, ["effects", str(SCENES / scene), *map(str, arguments)], catch_exceptions=False)


@pytest.fixture(scope="module")
def pad(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, dict[str, Any]]:
    """The directory of the example, coarse, and what ``--json`` entries."""
    out = tmp_path_factory.mktemp("effects")
    done = run("pad.toml", *COARSE, "--resolution", 32, "--out", out, "--json")
    assert done.exit_code == 0, done.stderr
    return out, json.loads(done.stdout)


def test_the_example_has_every_isothermal_effect_and_the_steps_lead_to_all(pad: tuple[Path, dict[str, Any]]) -> None:
    entries = pad[1]
    assert entries["left_out"] == ["shear thinning", "heating"]
    for view, names in (("at_film", ("load", "friction", "side_leakage")), ("under_load", ("film", "friction"))):
        found = entries[view]
        assert [one["name"] for one in found["contributions"]] == [effect.name for effect in EFFECTS][:-2]
        for name in names:
            steps = sum(one["on"][name]["value"] for one in found["contributions"])
            assert found["plain"][name]["value"] + steps == pytest.approx(found["full"][name]["value"], rel=1e-9)
            for one in found["contributions"]:
                without = one["off"][name]["value"] + one["alone"][name]["value"]
                assert without == pytest.approx(found["full"][name]["value"], rel=1e-9)
    assert entries["quantities"]["load"] == entries["at_film"]["full"]["load"]


def test_under_the_load_everything_carries_it(pad: tuple[Path, dict[str, Any]]) -> None:
    found = pad[1]["under_load"]
    carried = 2e6 * 20e-3 * 20e-3
    for one in found["contributions"]:
        assert one["after"]["load"]["value"] == pytest.approx(carried, rel=1e-5)
        assert one["off"]["load"]["value"] == pytest.approx(carried, rel=1e-5)
    assert pad[1]["numerics"]["balance"] < 1e-6


def test_inertia_stands_beside_the_effects_and_not_within(pad: tuple[Path, dict[str, Any]]) -> None:
    entries = pad[1]
    added = entries["inertia"]["amounts"]["load"]
    assert 0 < abs(added["value"]) + added["uncertainty"] < 0.01 * entries["quantities"]["load"]["value"]
    assert entries["inertia"]["pocket"]["model"] in ("inertial_reynolds", "film", "film_slope"), "by advice"
    assert entries["inertia"]["pocket"]["within"] <= 0.05
    assert entries["inertia_under_load"]["thicker"]["unit"] == "m"
    assert [one["effect"] for one in entries["treatments"]][-1] == "inertia"


def test_the_page_is_whole(pad: tuple[Path, dict[str, Any]]) -> None:
    out, entries = pad
    page = (out / "report.html").read_text(encoding="utf-8")
    assert page.count("<svg") == 3
    for one in entries["treatments"]:
        assert one["why"].split(",")[0] in page
    for words in (
        "Each added to all the others",
        "inertia, not counted",
        "Under 2 MPa",
        entries["inertia"]["pocket"]["model"],
    ):
        assert words in page
    assert {path.name for path in out.iterdir()} == {
        "report.html",
        "effects.json",
        "effects.svg",
        "effects_at_film.svg",
        "effects_under_load.svg",
    }
    assert json.loads((out / "effects.json").read_text(encoding="utf-8"))["at_film"] == entries["at_film"]


def test_the_page_begins_with_load_film_and_friction(
    pad: tuple[Path, dict[str, Any]],
) -> None:
    out, entries = pad
    page = (out / "report.html").read_text(encoding="utf-8")
    first = page[page.index("<h1>") : page.index("Model of each effect")]
    load, film = (
        with_error(*(factor * entries[view]["full"][name][number] for number in ("value", "uncertainty")))
        for view, name, factor in (("at_film", "load", 1.0), ("under_load", "film", 1e6))
    )
    assert first.index(f"<b>{load} N</b>") < first.index(f"<b>{film} µm</b>") < first.index("friction at the film")
    heads = re.findall(r"<th>([^<]+)<br>([^<]*)</th>", first)
    assert heads == [("load", "N"), ("film thickness", "µm"), ("friction", "N")]
    rows = re.findall(r"<tr[^>]*><td>(.*?)</td>", first)
    names = [f"+ {one['name']}" for one in entries["at_film"]["contributions"]]
    assert rows == ["plain film", *names, "all effects", "inertia, not counted"]


def test_what_a_scene_lacks_is_left_out_and_said(tmp_path: Path) -> None:
    done = run("parabolic_slider.toml", "--resolution", 128, "--out", tmp_path)
    assert done.exit_code == 0, done.stderr
    entries = json.loads((tmp_path / "effects.json").read_text(encoding="utf-8"))
    assert entries["left_out"] == ["side flow", "texture", "roughness", "asperities", "shear thinning", "heating"]
    assert entries["under_load"] is None
    assert entries["inertia"] is None
    said = " ".join(done.stdout.split())
    assert "left out, because the scene does not have them: side flow, texture, roughness, asperities, shear" in said
    assert "the scene has no lubricant.density" in said


def test_a_wide_pad_has_rows_of_inertia_in_full_and_of_slope(tmp_path: Path) -> None:
    done = run("wide_pad.toml", "--resolution", 128, "--out", tmp_path)
    assert done.exit_code == 0, done.stderr
    assert "load, slope, not counted above: −" in done.stdout
    assert "inertia by film: Reynolds number" in done.stdout
    inertia = json.loads((tmp_path / "effects.json").read_text(encoding="utf-8"))["inertia"]
    assert inertia["model"] == "film"
    assert inertia["slope"]["load"]["value"] < 0
    page = (tmp_path / "report.html").read_text(encoding="utf-8")
    rows = re.findall(r"<tr[^>]*><td>(.*?)</td>", page[: page.index("Model of each effect")])
    assert rows[-3:] == ["all effects", "inertia, not counted", "slope, not counted"]
    assert "Inertia and slope, computed separately" in page


def test_a_load_of_the_command_takes_the_place_of_the_scenes(tmp_path: Path) -> None:
    done = run("rough_pad.toml", "--resolution", 32, "--load", "0.2MPa", "--out", tmp_path, "--json")
    assert done.exit_code == 0, done.stderr
    entries = json.loads(done.stdout)
    assert entries["provenance"]["scene"]["load"]["pressure"].split()[0] == "200000.0"
    assert set(entries["under_load"]["unsolved"]) == {"the plain film", "with side flow", "without cavitation"}
    (roughness,) = [one for one in entries["under_load"]["contributions"] if one["name"] == "roughness"]
    assert roughness["on"]["film"]["value"] > 0
    page = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert "No numbers the plain film" not in page
    assert "Without numbers: the plain film" in page


@pytest.mark.parametrize(
    ("scene", "arguments", "words"),
    [
        ("pocket.toml", (), "effects are those of a bearing"),
        ("rough_pad.toml", ("--load", "2mm"), "load.pressure"),
        ("rough_pad.toml", ("--load", "-2MPa"), "must be above"),
        ("rough_pad.toml", ("--resolution", "4"), "it must be 16 to 1024 cells"),
        ("textured_slider.toml", ("--load", "1GPa", "--resolution", "128"), "carry at most"),
    ],
)
def test_what_makes_no_sense_costs_one_line(scene: str, arguments: tuple[str, ...], words: str, tmp_path: Path) -> None:
    done = run(scene, *arguments, "--out", tmp_path / "out")
    assert done.exit_code == 2
    assert words in done.stderr
    assert len(done.stderr.strip().splitlines()) == 1
    assert not (tmp_path / "out" / "report.html").exists()


def test_a_model_seeks_the_film_that_carries_the_load_of_the_scene() -> None:
    from roughfilm.rom.bearing.models.reynolds_cavitating import MODEL

    scene = load_scene(SCENES / "parabolic_slider.toml", ["load.pressure=1 MPa"])
    assert read_scene(scene.model_dump(mode="json", exclude_none=True)) == scene
    found = MODEL.solve(scene, Request(resolution=128))
    assert found.quantities["load_per_width"].value == pytest.approx(1e6 * 76.2e-3, rel=1e-6)
    assert found.warnings == ()


def test_a_journal_without_a_film_is_analysed_at_the_film_under_its_load(tmp_path: Path) -> None:
    done = run("journal_under_load.toml", "--resolution", 32, "--out", tmp_path)
    assert done.exit_code == 0, done.stderr
    assert "at the film under the load" in done.stdout
    assert "at the film of the scene" not in done.stdout
    assert "At the film under the load, " in (tmp_path / "report.html").read_text()
    entries = json.loads((tmp_path / "effects.json").read_text())
    assert [one["name"] for one in entries["under_load"]["contributions"]] == ["side flow", "cavitation"]
    assert all(one["on"]["film"]["value"] < 0 for one in entries["under_load"]["contributions"])
    for view in ("at_film", "under_load"):
        assert entries[view]["full"]["load"]["value"] == pytest.approx(5e3, rel=1e-3)
