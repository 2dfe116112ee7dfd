"""An output replaces no input and no other kind of file, and no two commands write the same page."""

import os

import numpy as np
import pytest
from places import SCENES, STUDIES
from small_scenes import SEAL, SURFACE
from typer.testing import CliRunner

from roughfilm.cli.main import app
from roughfilm.contact.foundation.files import locked
from roughfilm.rom.ladder.store import load

LETTER = "Dear editor,\n"


def run(*arguments):
    return CliRunner().invoke(app, [*map(str, arguments)])


@pytest.fixture
def place(tmp_path, monkeypatch):
    """A directory with a scene, links to it, surfaces and a letter."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "p.toml").write_bytes((SCENES / "pocket.toml").read_bytes())
    (tmp_path / "deep").mkdir()
    (tmp_path / "symbolic.h5").symlink_to("p.toml")
    (tmp_path / "hard.h5").hardlink_to("p.toml")
    (tmp_path / "rough.toml").write_text(SURFACE)
    (tmp_path / "letter").write_text(LETTER)
    np.save(tmp_path / "z.npy", np.random.default_rng(834).normal(scale=1e-7, size=(16, 16)))
    return tmp_path


@pytest.mark.parametrize("out", ["p.toml", "deep/../p.toml", "symbolic.h5", "hard.h5"])
@pytest.mark.parametrize("more", [(), ("--overwrite",)], ids=["", "overwrite"])
def test_a_scene_is_never_replaced_by_its_result(place, out, more):
    before = (place / "p.toml").read_bytes()
    done = run("solve", "p.toml", "--model", "reynolds", "--out", out, *more)
    assert done.exit_code == 2
    assert "is an input, which no output replaces" in done.stderr
    assert (place / "p.toml").read_bytes() == before
    assert (place / "hard.h5").samefile("p.toml")


def test_an_input_that_the_scene_names_is_not_replaced(place):
    (place / "seal.toml").write_text(SEAL)
    before = (place / "rough.toml").read_bytes()
    done = run("solve", "seal.toml", "--model", "direct", "--out", "rough.toml", "--overwrite")
    assert done.exit_code == 2
    assert "rough.toml: " in done.stderr
    assert (place / "rough.toml").read_bytes() == before


WRITERS = {
    "solve": ["solve", "p.toml", "--model", "reynolds", "--out", "letter"],
    "surface": ["surface", "rough.toml", "--out", "letter"],
    "surface, page": ["surface", "rough.toml", "--report", "letter"],
    "combine": ["combine", "rough.toml", "rough.toml", "--out", "letter"],
    "combine, page": ["combine", "rough.toml", "rough.toml", "--report", "letter"],
    "export": ["export", "rough.toml", "--out", "letter.stl"],
    "contact": ["contact", "rough.toml", "--modulus", "1GPa", "--poisson", "0.3", "--loads", "1MPa", "--out", "letter"],
    "contact, page": [
        *["contact", "rough.toml", "--modulus", "1GPa", "--poisson", "0.3", "--loads", "1MPa", "--report", "letter"]
    ],
    "factors": ["factors", "rough.toml", "--out", "letter"],
    "factors, page": ["factors", "rough.toml", "--gap", "1um", "--report", "letter"],
}


@pytest.mark.parametrize("words", WRITERS.values(), ids=WRITERS)
def test_a_file_of_another_kind_is_kept(place, words):
    (place / "letter").rename(place / words[-1])
    done = run(*words)
    assert done.exit_code == 2
    assert f"{words[-1]}: exists and is not a" in done.stderr
    assert "name another place or remove it" in done.stderr
    assert ("or give --overwrite" in done.stderr) == (words[0] in {"solve", "surface", "combine", "export"})
    assert (place / words[-1]).read_text() == LETTER


@pytest.mark.parametrize(
    ("words", "name"),
    [
        (["compare", "p.toml"], "report.html"),
        (["compare", "p.toml"], "results/reynolds.h5"),
        (["batch", STUDIES / "pocket.toml"], "table.csv"),
        (["batch", STUDIES / "pocket.toml"], "table.h5"),
        (["dynamics", SCENES / "grooved_journal.toml"], "dynamics.h5"),
        (["effects", SCENES / "pad.toml"], "report.html"),
        (["leakage", SCENES / "seal.toml"], "table.csv"),
        (["stribeck", SCENES / "rough_washer.toml"], "stribeck.h5"),
        (["windows", "rough.toml"], "table.csv"),
        (["windows", "rough.toml"], "windows.json"),
        (["charts"], "charts.png"),
        (["stability", "cell"], "report.html"),
        (["validate"], "validation.json"),
    ],
)
def test_a_directory_with_a_file_of_another_kind_is_refused_before_the_work(place, words, name):
    letter = place / "out" / name
    letter.parent.mkdir(parents=True)
    letter.write_text(LETTER)
    done = run(*words, "--out", "out")
    assert done.exit_code == 2
    assert f"{name}: exists and is not a" in done.stderr
    assert letter.read_text() == LETTER
    assert [path for path in (place / "out").rglob("*") if path.is_file()] == [letter]


def test_a_person_may_replace_another_kind_of_file(place):
    assert run("solve", "p.toml", "--model", "reynolds", "--out", "letter", "--overwrite").exit_code == 0
    assert load(place / "letter").model == "reynolds"


@pytest.mark.parametrize(
    ("words", "page"),
    [
        (["compare", "p.toml", "--out", "out"], "report.html"),
        (["effects", SCENES / "pad.toml", "--out", "out"], "report.html"),
        (["leakage", SCENES / "seal.toml", "--out", "out"], "leakage.h5"),
        (["stribeck", SCENES / "rough_washer.toml", "--out", "out"], "stribeck.h5"),
        (["windows", "rough.toml", "--out", "out"], "windows.json"),
    ],
    ids=["compare", "effects", "leakage", "stribeck", "windows"],
)
def test_the_second_command_into_one_place_is_refused(place, words, page):
    with locked(place / "out" / f".{page}.lock", "held"):
        done = run(*words)
    assert done.exit_code == 2
    assert f"goes into it (process {os.getpid()})" in done.stderr
    assert list((place / "out").iterdir()) == []
