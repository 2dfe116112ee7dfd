"""roughfilm advise and solve --within: what they print, and what they refuse."""

import json

import numpy as np
import pytest
from places import SCENES
from typer.testing import CliRunner

from roughfilm.cli.main import app
from roughfilm.rom.advice.window import window_note
from roughfilm.rom.ladder.scene import load_scene
from roughfilm.rom.ladder.store import load
from roughfilm.terminal.console import BAD_INPUT, NOT_CONVERGED


@pytest.fixture
def run():
    return lambda *arguments: CliRunner().invoke(app, [str(argument) for argument in arguments])


@pytest.fixture
def groove(pocket_file):
    return [pocket_file, "--set", "motion.reynolds_number=5", "--set", "geometry.width=0.4mm"]


def test_advice_as_json(run, groove):
    found = run("advise", *groove, "--want", "load", "--within", "10%", "--json")
    assert found.exit_code == 0
    stated = json.loads(found.stdout)
    assert stated["model"] in ("inertial_reynolds", "film", "film_slope")
    assert 0 < stated["expected_error"] <= 0.10
    assert 0 < stated["expected_cpu_s"] < 1
    assert stated["enough"]
    assert any(reason.startswith("stokes: not enough: error ") for reason in stated["reasons"])
    chosen = next(one for one in stated["considered"] if one["verdict"] == "chosen")
    assert chosen["a_priori"]["error"] > 0
    assert chosen["a_posteriori"]["reasons"], "the two sources are kept apart"
    assert stated["numbers"]["reynolds_number"] == 5


def test_advice_for_people(run, groove):
    found = run("advise", *groove, "--within", "10%")
    assert found.exit_code == 0
    assert "load within 10 % by" in found.stdout
    assert "reynolds: not enough: error above 100 % (expected by the laws); leaves out inertia" in found.stdout
    assert "h/L = 0.03" in found.stdout


def test_the_scatter_between_windows_is_said(run):
    scene = SCENES / "dry_contact.toml"
    text = run("advise", scene).stdout.replace("\n", " ")
    assert "the surface is one window: Sq of another one of its size differs by up to about" in text
    assert json.loads(run("advise", scene, "--json").stdout)["window"].endswith("run roughfilm windows")


@pytest.mark.parametrize(("kind", "noted"), [("seal", True), ("pad", True), ("journal", False), ("pocket", False)])
def test_the_scatter_between_windows_is_noted_where_a_scene_has_a_surface(kind, noted):
    """These windows scatter by more than 1 %; 90 % is more than any window shows."""
    scene = load_scene(SCENES / f"{kind}.toml")
    assert window_note(scene, 0.01).startswith("the surface is one window") == noted
    assert window_note(scene, 0.9) == ""


def test_solve_takes_what_is_advised_and_keeps_why(run, groove, tmp_path):
    file = tmp_path / "result.h5"
    advised = json.loads(run("advise", *groove, "--within", "10%", "--json").stdout)
    found = run("solve", *groove, "--within", "10%", "--json", "--out", file)
    assert found.exit_code == 0
    stated = json.loads(found.stdout)
    assert stated["model"] == advised["model"]
    assert stated["numerics"]["resolution"] == advised["resolution"]
    assert load(file).provenance["advice"]["within"] == 0.1


@pytest.mark.parametrize(
    ("scene", "wants"),
    [("dry_contact", ("contact area", "mean gap")), ("seal", ("leakage", "contact area"))],
)
def test_a_flat_surface_has_no_numbers_and_is_judged_all_the_same(run, tmp_path, scene, wants):
    np.save(tmp_path / "flat.npy", np.zeros((16, 16)))
    flat = ["--set", f"geometry.surface={tmp_path / 'flat.npy'}", "--set", "geometry.spacing=1um"]
    for want in wants:
        found = run("advise", f"{SCENES}/{scene}.toml", *flat, "--within", "5%", "--want", want, "--json")
        assert found.exit_code == 0, found.stderr
        stated = json.loads(found.stdout)
        assert stated["numbers"] == {}
        assert stated["expected_error"] <= 0.05
    assert "numbers of the scene" not in run("advise", f"{SCENES}/{scene}.toml", *flat, "--within", "5%").stdout


def test_a_lubricant_that_boils_above_ambient_is_judged(run):
    pressures = {"lubricant.cavitation_pressure": "10kPa", "boundary.inlet.pressure": "1MPa"}
    sets = [text for key, value in pressures.items() for text in ("--set", f"{key}={value}")]
    boiling = [f"{SCENES}/parabolic_slider.toml", *sets, "--set", "boundary.outlet.pressure=1MPa"]
    stated = json.loads(run("advise", *boiling, "--within", "5%", "--json").stdout)
    assert stated["numbers"]["cavitation_number"] < 0
    assert stated["model"] == "reynolds_cavitating"


def test_it_says_when_none_will_do(run):
    asked = [f"{SCENES}/parabolic_slider.toml", "--within", "1e-13"]
    found = run("advise", *asked, "--json")
    assert found.exit_code == NOT_CONVERGED
    stated = json.loads(found.stdout)
    assert (stated["enough"], stated["model"]) == (False, None)
    assert stated["nearest"]
    found = run("solve", *asked)
    assert found.exit_code == NOT_CONVERGED
    assert "no model here is known to give the load within" in found.stderr.replace("\n", " ")


@pytest.mark.parametrize(
    ("options", "stated"),
    [
        (["--within", "much"], "--within: got 'much'"),
        (["--within", "-5%"], "--within: got '-5%'"),
        (["--within", "5%", "--model", "film"], "--model: --within is for the choice of a model"),
        (["--within", "5%", "--resolution", "50"], "--resolution: needs --model"),
        (["--want", "lift"], "--want: got 'lift'"),
        (["--processes", "2"], "--processes: needs --model"),
        (["--want", "load", "--model", "film"], "--model: --want is for the choice of a model"),
        (["--resolution", "50"], "--resolution: needs --model"),
    ],
)
def test_what_cannot_be_asked_is_refused(run, pocket_file, options, stated):
    found = run("solve", pocket_file, *options)
    assert found.exit_code == BAD_INPUT
    assert stated in found.stderr.replace("\n", " ")
    assert found.stderr.count("error:") == 1
