"""roughfilm stribeck of a set of windows."""

import csv
import json

import h5py
import numpy as np
import pytest
from places import SCENES
from typer.testing import CliRunner
from window_sets import write_set

from roughfilm.cli.main import app
from roughfilm.rom.ladder.scene import load_scene

SCENE = SCENES / "rough_washer.toml"
SWEEP = ("--loads", "1MPa", "--speeds", "20rpm,300rpm", "--resolution", 16)


def cell(seed):
    changes = ("points=[16, 16]", "correlation_length=0.4 mm", "anisotropy=1", f"seed={seed}")
    return load_scene(SCENE, [f"roughness.surface.{change}" for change in changes]).roughness.read()


def run(*arguments):
    return CliRunner().invoke(app, ["stribeck", str(SCENE), *map(str, arguments)])


def asked(*arguments):
    done = run(*arguments, *SWEEP, *(["--jobs", 1] if "--windows" in arguments else []), "--json")
    assert done.exit_code == 0, done.stderr
    return json.loads(done.stdout)


@pytest.fixture(autouse=True)
def _without_pages(monkeypatch):
    """Figures take most of the time; one test looks at a page."""
    monkeypatch.setattr("roughfilm.pages.stribeck.write_page", lambda *_: None)


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    folder = tmp_path_factory.mktemp("stribeck")
    write_set(folder / "equal", [cell(504)] * 3)
    write_set(folder / "seeds", [cell(seed) for seed in (1, 2, 3)])
    return folder


@pytest.fixture(scope="module")
def swept(place):
    """The answer for three seeds, with the page."""
    return asked("--windows", place / "seeds", "--out", place / "out")


def test_equal_windows_give_the_plain_command_without_scatter(place):
    key = f"roughness.surface={place}/equal/cells/0001.h5"
    (plain,) = asked("--set", key, "--out", place / "plain")["curves"]
    (equal,) = asked("--windows", place / "equal", "--out", place / "equal out")["curves"]
    for one, two in zip(plain["points"], equal["points"], strict=True):
        for name in one.keys() - {"cpu_s", "uncertainty", "balance", "residual"}:
            assert two[name] == pytest.approx(one[name], rel=1e-5, abs=1e-12), name
        assert two["uncertainty"] == pytest.approx(one["uncertainty"], rel=1e-3, abs=1e-9)
        for name, scatter in two["scatter"].items():
            assert scatter <= 1e-5 * max(abs(two[name]), 1e-9), name
    for name in ("speed", "uncertainty"):
        assert equal["lift_off"][name] == pytest.approx(plain["lift_off"][name], rel=1e-5)
    assert equal["lift_off"]["scatter"] == pytest.approx(0, abs=1e-9)


def test_the_scatter_is_beside_the_numerical_uncertainty_in_all_files(place, swept):
    (curve,) = swept["curves"]
    for point in curve["points"]:
        assert point["scatter"]["friction_coefficient"] > 0
        low, high = point["window_interval"]["friction_coefficient"]
        assert low < point["friction_coefficient"] < high
    with (place / "out" / "stribeck.csv").open() as file:
        rows = list(csv.reader(file, skipinitialspace=True))
    column = rows[0].index("friction_coefficient_scatter (1)")
    assert [float(row[column]) for row in rows[1:]] == [
        point["scatter"]["friction_coefficient"] for point in curve["points"]
    ]
    with h5py.File(place / "out" / "stribeck.h5") as file:
        assert np.all(file["scatter/friction_coefficient"][:] < file["window_high/friction_coefficient"][:])
    assert swept["windows"]["count"] == 3
    page = (place / "out" / "report.html").read_text(encoding="utf-8")
    assert "over 3 windows" in page
    assert "(windows)" in page


def test_the_windows_share_the_load_of_one_wall(place, swept):
    alone = [
        asked("--set", f"roughness.surface={place}/seeds/cells/000{number}.h5", "--out", place / f"alone{number}")
        for number in (1, 2, 3)
    ]
    for number, point in enumerate(swept["curves"][0]["points"]):
        own = [one["curves"][0]["points"][number] for one in alone]
        mean = np.mean([one["friction_coefficient"] for one in own])
        assert abs(point["friction_coefficient"] - mean) <= point["scatter"]["friction_coefficient"]
        assert min(one["separation"] for one in own) < point["separation"] < max(one["separation"] for one in own)
    lifts = [one["curves"][0]["lift_off"]["speed"] for one in alone]
    assert swept["curves"][0]["lift_off"]["speed"] == pytest.approx(np.mean(lifts), rel=1e-6)


def test_a_second_run_solves_nothing_again(place, swept):
    again = asked("--windows", place / "seeds", "--out", place / "out")
    assert again["numerics"]["points_found"] == again["numerics"]["points"] == 2
    assert again["curves"] == swept["curves"]


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (("--jobs", 2), "--jobs: got 2 without a set of windows"),
        (("--windows", "seeds", "--table", "t.h5"), "--table: got t.h5 beside a set of windows"),
    ],
)
def test_wrong_options_are_refused_in_one_line(place, monkeypatch, options, message):
    monkeypatch.chdir(place)
    done = run("--out", "wrong", *options)
    assert done.exit_code == 2
    assert message in done.stderr


def test_a_bearing_without_a_surface_takes_no_windows(place):
    done = CliRunner().invoke(
        app,
        ["stribeck", str(SCENES / "washer.toml"), "--windows", str(place / "seeds"), "--out", str(place / "smooth")],
    )
    assert done.exit_code == 2
    assert "roughness" in done.stderr
