"""``roughfilm export``: what it writes, what it says, and how it fails."""

import json

import meshio
import numpy as np
import pytest
from forging import forge
from places import SCENES
from typer.testing import CliRunner

from roughfilm.cli.main import app
from roughfilm.contact.surfaces.store import save_surface
from roughfilm.contact.surfaces.surface import Surface


@pytest.fixture
def run():
    def call(*arguments):
        return CliRunner().invoke(app, ["export", *map(str, arguments)])

    return call


def test_a_gap_is_written_and_json_states_its_volume(run, tmp_path):
    out = tmp_path / "gap.vtu"
    done = run(SCENES / "rough_gap.toml", "--out", out, "--json", "--resolution", 32, "--set", "geometry.mean_gap=8um")
    assert done.exit_code == 0
    assert not done.stderr
    stated = json.loads(done.stdout)
    found = meshio.read(out)
    length, width = np.ptp(found.points[:, 0]), np.ptp(found.points[:, 1])
    assert length == pytest.approx(50e-6)
    assert stated["quantities"] == {"volume": {"value": pytest.approx(length * width * 8e-6), "unit": "m^3"}}
    assert stated["numerics"]["cells"] == len(found.cells_dict["hexahedron"])
    assert stated["provenance"]["what"] == "gap"
    assert stated["provenance"]["data"] == ["gap (m)"]


def test_a_wall_and_a_closed_gap_go_to_stl(run, tmp_path):
    done = run(SCENES / "rough_gap.toml", "--out", tmp_path / "wall.stl", "--what", "upper")
    assert done.exit_code == 0
    assert np.ptp(meshio.read(tmp_path / "wall.stl").points[:, 2]) == 0
    assert "left out: gap (m)" in done.stderr
    assert run(SCENES / "rough_gap.toml", "--out", tmp_path / "gap.stl", "--layers", 2).exit_code == 0


def test_a_surface_is_written(run, tmp_path):
    heights = 1e-6 * np.random.default_rng(77).normal(size=(9, 7))
    save_surface(Surface(heights=heights, spacing=(2e-6, 3e-6)), tmp_path / "s.h5")
    assert run(tmp_path / "s.h5", "--out", tmp_path / "s.msh").exit_code == 0
    found = meshio.read(tmp_path / "s.msh")
    assert found.points[:, 2] == pytest.approx(heights.ravel(), rel=1e-14)
    done = run(tmp_path / "s.h5", "--out", tmp_path / "t.msh", "--what", "gap")
    assert done.exit_code == 2
    assert "not a scene of a rough gap" in done.stderr


def test_a_result_is_written(run, tmp_path):
    solve = ["solve", str(SCENES / "pocket.toml"), "--model", "film", "--resolution", "24", "--out"]
    assert CliRunner().invoke(app, [*solve, str(tmp_path / "film.h5")]).exit_code == 0
    done = run(tmp_path / "film.h5", "--out", tmp_path / "film.vtu", "--json")
    stated = json.loads(done.stdout)
    assert {"cell_pressure (Pa)", "cell_velocity (m/s)"} == set(meshio.read(tmp_path / "film.vtu").cell_data)
    assert "position (m)" in stated["provenance"]["left_out"]
    assert stated["provenance"]["model"] == "film"


@pytest.mark.parametrize(
    ("model", "field"), [("film", "vertices"), ("reynolds_cavitating", "x"), ("reynolds_cavitating", "y")]
)
@pytest.mark.parametrize("shape", [(), (3,), (25, 5, 1), (25, 5, 4), (1, 5, 2), (2, 2, 2, 2, 2)])
def test_positions_of_another_shape_are_refused_in_one_line(run, tmp_path, model, field, shape):
    scene, resolution = ("pocket", "24") if model == "film" else ("textured_slider", "32")
    solve = ["solve", str(SCENES / f"{scene}.toml"), "--model", model, "--resolution", resolution, "--out"]
    assert CliRunner().invoke(app, [*solve, str(tmp_path / "r.h5")]).exit_code == 0

    def change(file):
        del file[f"fields/{field}"]
        file[f"fields/{field}"] = np.ones(shape)
        file[f"fields/{field}"].attrs["unit"] = "m"

    forge(tmp_path / "r.h5", change)
    done = run(tmp_path / "r.h5", "--out", tmp_path / "r.vtu")
    assert done.exit_code == 2, done.exception
    assert done.stderr.count("error:") == 1
    assert not (tmp_path / "r.vtu").exists()


@pytest.mark.parametrize(
    ("arguments", "stated"),
    [
        (("rough_gap.toml", "--out", "x.obj"), "write .vtu, .stl or .msh"),
        (("pocket.toml", "--out", "x.vtu"), "solve it with --out and export the result"),
        (("rough_gap.toml", "--out", "x.vtu", "--resolution", "1"), "take 2 to 256"),
        (("rough_gap.toml", "--out", "x.vtu", "--layers", "0"), "take 1 or more"),
        (("rough_gap.toml", "--out", "x.vtu", "--resolution", "257"), "take 2 to 256"),
        (("rough_gap.toml", "--out", "x.vtu", "--layers", "100000"), "at most"),
        (("rough_gap.toml", "--out", "x.vtu", "--what", "lower", "--layers", "3"), "a wall has none"),
        (("missing.h5", "--out", "x.vtu"), "no such file"),
        (("missing.npy", "--out", "x.vtu"), "no such file"),
    ],
)
def test_bad_input_is_one_line(run, arguments, stated, tmp_path):
    done = run(SCENES / arguments[0], *(tmp_path / a if a.startswith("x.") else a for a in arguments[1:]))
    assert done.exit_code == 2
    assert stated in done.stderr.replace("\n", " ")
    assert done.stderr.count("error:") == 1
    assert not list(tmp_path.iterdir())
