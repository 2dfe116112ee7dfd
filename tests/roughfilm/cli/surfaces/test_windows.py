"""roughfilm windows answers in one line, keeps what it writes as a set of windows, and says what does not fit."""

import json

import numpy as np
import pytest
from dask_programs import DaskPrograms
from places import SCENES
from small_scenes import SEAL, SEEDS
from typer.testing import CliRunner

import roughfilm as rf
from roughfilm.cli.main import app
from roughfilm.contact.windows.store import read_windows
from roughfilm.rom.studies.table import read_table

FEW = ("--windows", 4, "--size", "80um", "--sizes", "40um", "--jobs", 1)


def run(*arguments):
    return CliRunner().invoke(app, ["windows", *map(str, arguments)])


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    """A directory with small scenes and the finished windows of a seal."""
    place = tmp_path_factory.mktemp("windows")
    for name, text in {"rough.toml": SEEDS, "seal.toml": SEAL}.items():
        (place / name).write_text(text)
    done = run(place / "rough.toml", "--scene", place / "seal.toml", *FEW, "--out", place / "out", "--json")
    assert done.exit_code == 0, done.output
    (place / "answer.json").write_text(done.stdout)
    return place


def test_the_answer_comes_last_and_names_mean_window_and_number(place):
    done = run(place / "rough.toml", "--scene", place / "seal.toml", *FEW, "--out", place / "out")
    assert done.exit_code == 0
    last = " ".join(done.stdout.split("rough.toml: ")[1].split())
    for words in ("leakage", "one window of 80 µm", "(95 %), mean known to", "for 5 %; written: "):
        assert words in last
    assert "8 of 8 windows were solved before and are used again" in " ".join(done.stderr.split())


def test_what_is_written_is_a_set_of_windows_with_a_table(place):
    answer, found = json.loads((place / "answer.json").read_text()), read_windows(place / "out")
    assert found.answers["quantities"] == answer["quantities"]
    assert (len(found.cells), found.independent, found.windows) == (4, 4, ())
    assert found.size == pytest.approx(8e-5)
    table = read_table(place / "out" / "table.h5")
    assert table["window"].tolist() == [1, 2, 3, 4, 1, 2, 3, 4]
    leakage = table["leakage_per_width"][:4]
    assert answer["quantities"]["leakage_per_width"]["scatter"]["values"] == leakage.tolist()
    assert answer["quantities"]["leakage_per_width"]["value"] == pytest.approx(leakage.mean())
    assert np.isfinite(table["leakage_per_width_uncertainty"]).all()
    scene = rf.load_scene(place / "seal.toml", set={"geometry.surface": str(place / "out" / "cells" / "0003.h5")})
    own = rf.solve(scene, model="direct_leakage").quantities["leakage_per_width"]
    assert own.value == leakage[2]


def test_a_change_is_said_and_nothing_old_is_kept(place, tmp_path):
    arguments = (place / "rough.toml", "--size", "80um", "--sizes", "none", "--jobs", 1, "--out", tmp_path)
    assert run(*arguments, "--windows", 3, "--scene", place / "seal.toml").exit_code == 0
    done = run(*arguments, "--windows", 2)
    assert done.exit_code == 0
    assert "changed: the scene since the last run" in " ".join(done.stderr.split())
    assert len(list((tmp_path / "rows").iterdir())) == 2
    assert [path.name for path in sorted((tmp_path / "cells").iterdir())] == ["0001.h5", "0002.h5"]


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (("--tolerance", "150%"), "error: --tolerance: got '150%'; it must be above 0 and below 100 %"),
        (("--gap", "1um", "--scene", SCENES / "seal.toml"), "error: --gap: got 1um with --scene"),
        (("--gap=-1um",), "error: --gap: got -1e-06; it must be 1e-22 to 1e+13 m, check the unit"),
        (("--resolution", "-3"), "error: --resolution: got -3; give a whole number from"),
        (("--sealing",), "error: --sealing: needs --scene with a seal"),
        (("--sealing", "--scene", SCENES / "dry_contact.toml"), "is of the kind 'dry_contact'; it needs a seal"),
        (("--scene", SCENES / "pocket.toml"), "kind: got 'pocket'; windows are put into scenes of the kinds"),
        (("--set", "smoothing=1"), "is described and periodic; leave out --prepare and --set"),
        (("--size", "wide"), "error: --size: "),
        (("--executor", "dask"), "error: --executor dask needs --scheduler ADDRESS"),
        (("--scene", SCENES / "rough_washer.toml"), "no window has an answer; the first: scene.load: is missing"),
    ],
)
def test_what_does_not_fit_is_said_in_one_line(place, tmp_path, options, message):
    done = run(place / "rough.toml", "--windows", 1, "--out", tmp_path / "out", "--jobs", 1, *options)
    assert done.exit_code == 2
    (line,) = [line for line in done.stderr.splitlines() if line.startswith("error")]
    assert message in line


@pytest.mark.slow
def test_workers_of_dask_give_the_rows_of_this_machine(place, tmp_path):
    programs = DaskPrograms(tmp_path / "programs")
    programs.scheduler()
    try:
        programs.workers(1)
        where = ("--executor", "dask", "--scheduler", programs.address)
        done = run(place / "rough.toml", "--scene", place / "seal.toml", *FEW, *where, "--out", tmp_path / "out")
    finally:
        programs.end()
    assert done.exit_code == 0, done.output
    here, there = (read_table(one / "table.h5")["leakage_per_width"] for one in (place / "out", tmp_path / "out"))
    assert np.array_equal(here, there)
