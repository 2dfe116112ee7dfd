"""roughfilm march: the answer, its files, and a stopped march that goes on."""

import json

import h5py
import numpy as np
import pytest
from places import SCENES
from typer.testing import CliRunner

from roughfilm.cli.main import app

FEW = ["--end", "3ms", "--cells", "12,8", "--fields", "3", "--json"]


def run(*words):
    return CliRunner().invoke(app, [str(word) for word in words])


@pytest.fixture(scope="module", autouse=True)
def _empty():
    """The figures of a march are drawn, which no other test does."""


@pytest.fixture(scope="module")
def marched(tmp_path_factory):
    out = tmp_path_factory.mktemp("march") / "out"
    done = run("march", SCENES / "unbalanced_rotor.toml", "--out", out, *FEW)
    assert done.exit_code == 0, done.output
    return out, json.loads(done.stdout)


def test_the_answer_has_quantities_with_uncertainties(marched):
    _, entries = marched
    film = entries["quantities"]["film_min"]
    assert 0 < film["value"] < 40e-6
    assert film["uncertainty"] > 0
    assert entries["numerics"]["flow_imbalance"] < 1e-9


def test_the_files_hold_every_step(marched):
    out, entries = marched
    steps = entries["numerics"]["steps"]
    with h5py.File(out / "series.h5") as file:
        assert file["series/film_min"].shape == (steps,)
        assert file["series/film_min"].attrs["unit"] == "m"
        assert file["fields/pressure"].shape[0] == 3
        assert file["fields/pressure"].shape[1:] == (file["grid/x"].size, file["grid/y"].size)
    rows = np.loadtxt(out / "series.csv", delimiter=",", skiprows=1)
    assert rows.shape == (steps, len(entries["units"]))
    assert "Orbit" in (out / "report.html").read_text()


def test_the_same_command_takes_the_steps_from_the_file(marched):
    out, entries = marched
    again = json.loads(run("march", SCENES / "unbalanced_rotor.toml", "--out", out, *FEW).stdout)
    assert again["numerics"]["steps_found"] == again["numerics"]["steps"] == entries["numerics"]["steps"]
    assert again["quantities"] == entries["quantities"]


@pytest.mark.parametrize(
    ("words", "place"),
    [
        (["--end", "3"], "--end: got"),
        (["--cells", "3"], "--cells: got"),
        (["--error", "3"], "--error: got"),
        (["--steps", "0"], "--steps: got"),
        (["--set", "motion.over_time.file=nowhere.csv"], "no such file"),
        (["--set", "body.start.eccentricity=[0.9, 0.9]"], "into the bore"),
    ],
)
def test_bad_input_is_one_line(tmp_path, words, place):
    done = run("march", SCENES / "unbalanced_rotor.toml", "--out", tmp_path / "out", *words)
    assert done.exit_code == 2
    assert place in done.stderr
    assert "Traceback" not in done.stderr
    assert len(done.stderr.strip().splitlines()) == 1
