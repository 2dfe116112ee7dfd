"""The command ``fit``: its file, which every command takes as a surface, its page, its JSON and its errors."""

import json

import numpy as np
import pytest
from typer.testing import CliRunner

import roughfilm as rf
from roughfilm.cli.main import app
from roughfilm.contact.synthetic.description import read_description

FIELD = """
kind = "gaussian"
size = ["64 um", "64 um"]
points = [32, 32]
seed = 1
rms_height = "0.5 um"
correlation_length = "8 um"
amplitudes = "random"
"""


def run(*arguments):
    return CliRunner().invoke(app, list(map(str, arguments)))


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    """A directory with a description fitted to the seeds of another one, and the JSON that was printed."""
    place = tmp_path_factory.mktemp("fit")
    (place / "field.toml").write_text(FIELD, encoding="utf-8")
    words = ("--windows", 16, "--seeds", 40, "--out", place / "fitted.toml", "--report", place / "page.html", "--json")
    done = run("fit", place / "field.toml", *words)
    assert done.exit_code == 0, done.output
    return place, json.loads(done.stdout)


def test_the_json_counts_the_held_out_windows(place):
    _, entries = place
    for one in entries["held"].values():
        assert one["count"] == 16
        assert one["inside"] + one["below"] + one["above"] == 16
        assert len(one["windows"]) == 16
        assert len(one["seeds"]) == 40
    assert entries["provenance"]["warnings"] == []
    assert entries["description"]["kind"] == "random_field"


def test_windows_of_another_size_than_that_of_the_fit_are_warned_of(place):
    path = place[0] / "fitted.toml"
    assert not any("at any size" in one for one in rf.windows(path, count=3, sizes=[]).warnings)
    larger = rf.windows(path, count=3, size=128e-6, sizes=[])
    assert any("scatters at any size as the windows to which it was fitted" in one for one in larger.warnings)


def test_the_file_is_a_surface_for_other_commands(place):
    path = place[0] / "fitted.toml"
    assert path.read_text(encoding="utf-8").startswith(
        "# A random field fitted by roughfilm fit.\n# Surface: field.toml"
    )
    description = read_description(path)
    assert description.seed == 0
    surface = rf.read_surface(path)
    assert surface.shape == (32, 32)
    assert surface.heights.std() == pytest.approx(description.population.rms_height, rel=0.6)
    done = run("contact", path, "--modulus", "210GPa", "--poisson", 0.3, "--loads", "1GPa", "--json")
    assert done.exit_code == 0, done.output
    assert 0 < json.loads(done.stdout)["series"][0]["area_fraction"] < 1


def test_the_page_answers_first(place):
    text = (place[0] / "page.html").read_text(encoding="utf-8")
    assert "held-out windows in contact pressure," in text
    assert text.index("How sure:") < text.index("Power spectrum") < text.index("Scatter")


def test_the_interface_refuses_what_is_no_surface(place):
    with pytest.raises(rf.InputError, match="give a Surface"):
        rf.fit_description([[0.0]])
    with pytest.raises(rf.InputError, match="read_surface"):
        rf.fit_description("measured.x3p")
    with pytest.raises(rf.InputError, match="needs no preparation"):
        rf.fit_description(place[0] / "field.toml", recipe={"form": "tilt"})


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["absent.x3p"], "absent.x3p"),
        (["field.toml", "--windows", 3], "windows: got 3"),
        (["field.toml", "--seeds", 3], "seeds: got 3"),
        (["field.toml", "--size", "3 bananas"], "--size"),
        (["field.toml", "--area", "200%"], "area"),
        (["field.toml", "--set", "form=tilt"], "leave out --prepare and --set"),
        (["field.toml", "--out", "field.toml"], "field.toml"),
    ],
)
def test_bad_input_is_refused_in_one_line(place, monkeypatch, words, message):
    monkeypatch.chdir(place[0])
    done = run("fit", *words)
    assert done.exit_code == 2
    assert message in done.stderr
    assert "Traceback" not in done.stderr


@pytest.mark.parametrize("anisotropy", ["0", "-1", "nan"])
def test_an_anisotropy_out_of_range_is_refused(tmp_path, anisotropy):
    np.save(tmp_path / "line.npy", 1e-6 * np.random.default_rng(1).standard_normal(500))
    done = run("fit", tmp_path / "line.npy", "--set", "read.spacing=1um", f"--anisotropy={anisotropy}")
    assert done.exit_code == 2
    assert "anisotropy: got" in done.output
