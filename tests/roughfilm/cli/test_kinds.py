"""Commands take a scene of any kind: a dry contact from the ladder's table to the report of a sweep."""

import csv
import json
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from roughfilm import rom
from roughfilm.cli.main import app
from roughfilm.figures.view import views
from roughfilm.ladder import models
from roughfilm.rom.ladder.kind import kinds
from roughfilm.rom.ladder.store import load

SCENE = """
name = "small"
kind = "dry_contact"
[geometry.surface]
kind = "self_affine"
size = ["100 um", "100 um"]
points = [64, 64]
seed = 20071
hurst = 0.8
roll_off = "25 um"
cut_off = "12.5 um"
rms_slope = 0.1
[solid]
modulus = "210 GPa"
poisson = 0.3
hardness = "4 GPa"
[load]
pressure = "100 MPa"
"""


def run(*arguments):
    return CliRunner().invoke(app, [str(argument) for argument in arguments])


@pytest.fixture
def scene(tmp_path):
    path = tmp_path / "scene.toml"
    path.write_text(SCENE, encoding="utf-8")
    return path


def test_every_kind_has_a_view_that_names_its_quantities_and_models():
    assert set(views()) == set(kinds())
    assert {path.parent.name for path in Path(rom.__path__[0]).glob("*/models")} == set(kinds())
    for name, kind in kinds().items():
        view = views()[name]
        assert kind.name == name
        known = set(kind.reported) | {one.removesuffix("_per_width") for one in kind.reported}
        assert {*view.rows, *view.cards} <= known
        for compared in (kind.compared, *kind.compared_with.values()):
            assert {name.removesuffix("_per_width") for name in compared} <= {
                name.removesuffix("_per_width") for name in view.rows
            }
        assert set(view.styles) == {model.name for model in models() if model.kind == name}


def test_models_are_shown_by_kind_of_scene():
    shown = " ".join(run("models").stdout.split())
    assert "dry_contact: a rough surface pressed on a flat one greenwood_williamson" in shown
    assert "pocket: grooves or dimples under a sliding wall reynolds" in shown


def test_solve(scene, tmp_path):
    out = tmp_path / "r.h5"
    message = json.loads(run("solve", scene, "--model", "elastic_plastic", "--json", "--out", out).stdout)
    assert message["quantities"]["area_fraction"]["unit"] == "1"
    assert message["quantities"]["mean_gap"]["unit"] == "m"
    assert message["numerics"]["residual"] <= 1e-8
    assert message["provenance"]["heights"]["points"] == [64, 64]
    assert load(out).fields["gap"].values.shape == (64, 64)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["solve", "--model", "reynolds"], "--model: got 'reynolds'; it must be one of greenwood_williamson"),
        (["solve", "--model", "elastic", "--resolution", "65"], "--resolution: got 65; elastic takes 8 to 64 points"),
        (["solve", "--model", "bearing_area", "--set", "solid.hardness=1 Pa"], "load.pressure: got 1e+08 Pa"),
        (["generate", "--out", "x"], "scene.kind: got 'dry_contact', which no model solves in OpenFOAM"),
    ],
)
def test_refusals_are_one_line_and_code_2(scene, tmp_path, monkeypatch, arguments, words):
    monkeypatch.chdir(tmp_path)
    command, *options = arguments
    result = run(command, scene, *options)
    assert result.exit_code == 2
    assert words in result.stderr
    assert len(result.stderr.strip().splitlines()) == 1
    assert not (tmp_path / "x").exists()


class Page(HTMLParser):
    def __init__(self):
        super().__init__()
        self.outside, self.tags = [], []

    def handle_starttag(self, tag, attributes):
        self.tags.append(tag)
        self.outside += [v for name, v in attributes if name in {"src", "href"} and tag not in {"a", "use", "image"}]


def test_compare(scene, tmp_path):
    result = run("compare", scene, "--out", tmp_path / "study", "--json")
    assert result.exit_code == 0, result.stderr
    message = json.loads(result.stdout)
    assert message["model"] == "elastic_plastic"
    assert {part["model"] for part in message["models"]} == set(views()["dry_contact"].styles)
    effects = {(d["other"], d["model"], d["effect"], d["quantity"]) for d in message["differences"] if d["effect"]}
    assert ("elastic", "elastic_plastic", "plasticity", "area_fraction") in effects
    assert ("bearing_area", "elastic_plastic", "deformation", "mean_gap") in effects
    gaps = {d["model"] for d in message["differences"] if d["quantity"] == "mean_gap" and not d["effect"]}
    assert gaps == {"greenwood_williamson", "bearing_area", "elastic"}
    assert message["cheapest_within_10_percent"] != "persson"
    assert {point["resolution"] for point in message["chart"]["points"]} == {8, 16, 32, 64}
    page = Page()
    page.feed((tmp_path / "study" / "report.html").read_text(encoding="utf-8"))
    assert page.outside == []
    assert page.tags.count("svg") == 3
    again = {path: path.stat().st_mtime_ns for path in (tmp_path / "study" / "results").glob("*.h5")}
    assert run("compare", scene, "--out", tmp_path / "study").exit_code == 0
    assert {path: path.stat().st_mtime_ns for path in again} == again


def test_an_elastic_body_leaves_the_bearing_area_out(scene, tmp_path):
    scene.write_text(SCENE.replace('hardness = "4 GPa"', ""), encoding="utf-8")
    message = json.loads(run("compare", scene, "--out", tmp_path / "study", "--json").stdout)
    assert set(message["absent"]) == {"bearing_area"}
    assert message["cheapest_within_10_percent"] in ("elastic", "elastic_plastic", "persson", "greenwood_williamson")
    assert "no hardness: elastic" in (tmp_path / "study" / "report.html").read_text(encoding="utf-8")


def test_heights_that_changed_are_pressed_again(scene, tmp_path):
    def compared(heights):
        np.save(tmp_path / "s.npy", heights)
        text = SCENE[: SCENE.index("[geometry")] + '[geometry]\nsurface = "s.npy"\nspacing = "1 um"\n'
        scene.write_text(text + SCENE[SCENE.index("[solid]") :], encoding="utf-8")
        message = json.loads(run("compare", scene, "--out", tmp_path / "study", "--json").stdout)
        return message["quantities"]["area_fraction"]["value"]

    noise = np.random.default_rng(20071).standard_normal((32, 32))
    assert compared(1e-8 * noise) > 1.5 * compared(4e-8 * noise)


def test_batch_and_report(scene, tmp_path):
    text = SCENE.replace('"100 MPa"', '["30 MPa", "100 MPa", "300 MPa"]').replace("= 0.1", "= [0.03, 0.1, 0.3]")
    scene.write_text(text, encoding="utf-8")
    result = run("batch", scene, "--out", tmp_path / "done", "--jobs", 1)
    assert result.exit_code == 0, result.output
    with (tmp_path / "done" / "table.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 9 * 5
    assert {"rms_slope", "pressure (Pa)", "pressure_ratio", "hardness_ratio", "nayak", "mean_gap (m)"} <= set(rows[0])
    assert all(row["outcome"] == "solved" for row in rows)
    result = run("report", tmp_path / "done", "--json")
    assert result.exit_code == 0, result.output
    report = json.loads(result.stdout)
    assert report["reference"] == "elastic_plastic"
    elastic = next(row for row in report["settings"] if row["setting"] == "elastic")
    assert elastic["error"]["area_fraction"]["worst"] > elastic["error"]["area_fraction"]["median"] > 0
    page = (tmp_path / "done" / "report.html").read_text(encoding="utf-8")
    assert "contact area error" in page
    assert "friction" not in page.replace(kinds()["dry_contact"].excluded, "")
