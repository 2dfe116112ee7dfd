"""Commands on rough gaps: solved, generated, compared and swept as any other kind of scene."""

import csv
import json
from dataclasses import replace

import numpy as np
import pytest
from places import SCENES
from typer.testing import CliRunner

from roughfilm.cli.first_steps import compare
from roughfilm.cli.main import app
from roughfilm.figures import gap_view
from roughfilm.ladder import models
from roughfilm.rom.ladder.model import Resolutions
from roughfilm.rom.ladder.store import load

SCENE, STUDY = SCENES / "rough_gap.toml", SCENES.parent / "studies" / "rough_gap.toml"


def run(*arguments):
    return CliRunner().invoke(app, [str(argument) for argument in arguments])


def test_solve_states_coefficients_over_those_of_a_smooth_gap():
    done = run("solve", SCENE, "--model", "homogenized", "--json")
    assert done.exit_code == 0, done.output
    stated = json.loads(done.stdout)["quantities"]
    a = 0.3
    assert stated["A11"]["value"] == pytest.approx((1 - a**2) ** 2.5 / (1 + a**2 / 2), rel=2e-4)
    assert stated["A22"]["value"] == pytest.approx(1 + 1.5 * a**2, rel=1e-9)
    assert stated["A11"]["unit"] == "1"


def test_overrides_replace_what_they_make_meaningless(tmp_path):
    np.save(tmp_path / "flat.npy", np.zeros((16, 16)))
    done = run(
        *("solve", SCENE, "--model", "homogenized", "--json"),
        *("--set", f"geometry.surface={tmp_path / 'flat.npy'}", "--set", "geometry.spacing=1um"),
    )
    assert done.exit_code == 0, done.output
    assert json.loads(done.stdout)["quantities"]["A11"]["value"] == pytest.approx(1.0)


def test_overrides_that_take_each_others_place_are_refused():
    done = run(
        *("solve", SCENE, "--model", "homogenized"),
        *("--set", "flow.pressure_gradient=1MPa/m", "--set", "flow.reynolds_number=3"),
    )
    assert done.exit_code == 2
    assert "takes the place of flow.pressure_gradient" in " ".join(done.stderr.split())


@pytest.mark.parametrize(
    ("override", "words"),
    [
        ("geometry.mean_gap=1um", "the walls cross"),
        ("mesh.layers=1", "it must be 4 to 1000"),
        ("geometry.amplitude=3", "a number without a unit"),
        ("geometry.surface=nowhere.h5", "no such file"),
    ],
)
def test_bad_input_is_one_line_and_code_2(override, words):
    done = run("solve", SCENE, "--model", "homogenized", "--set", override)
    assert done.exit_code == 2
    assert words in done.stderr
    assert done.stderr.count("\n") == 1


def test_a_mesh_that_does_not_fit_is_refused_with_its_estimate_before_it_is_made(tmp_path):
    surface = "{kind='sinusoid', size=['1 mm', '1 mm'], points=[1024, 1024], amplitude='3 um', wavelength_x='50 um'}"
    text = SCENE.read_text(encoding="utf-8")
    kept = [line for line in text.splitlines() if not line.startswith(("surface", "amplitude", "wavelength"))]
    path = tmp_path / "large.toml"
    path.write_text("\n".join(kept).replace("[geometry]", f"[geometry]\nsurface = {surface.replace(chr(39), chr(34))}"))
    done = run("generate", path, "--out", tmp_path / "case", "--resolution", "1024", "--set", "mesh.layers=1000")
    assert done.exit_code == 2
    assert "GiB of memory" in done.stderr
    assert not (tmp_path / "case" / "stokes").exists()


def test_a_study_of_gaps_is_swept_and_reported(tmp_path):
    planned = run("batch", STUDY, "--out", tmp_path / "planned", "--dry-run", "--json")
    assert json.loads(planned.stdout)["cases"] == 27
    fewer = STUDY.read_text(encoding="utf-8").replace('["1 um", "3 um", "5 um"]', '["1 um", "3 um"]')
    fewer = fewer.replace('["25 um", "50 um", "200 um"]', '["50 um", "200 um"]').replace(
        "[0.1, 1.0, 10.0]", "[1.0, 2.0]"
    )
    (tmp_path / "fewer.toml").write_text(fewer, encoding="utf-8")
    done = run("batch", tmp_path / "fewer.toml", "--out", tmp_path / "sweep", "--jobs", "1")
    assert done.exit_code == 0, done.output
    with (tmp_path / "sweep" / "table.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 24
    assert {row["outcome"] for row in rows} == {"solved"}
    steep = [row for row in rows if row["setting"] == "slope_corrected"]
    thin = [row for row in rows if row["setting"] == "homogenized"]
    for one, other in zip(steep, thin, strict=True):
        assert float(one["A11"]) < float(other["A11"])
    assert run("report", tmp_path / "sweep").exit_code == 0


@pytest.mark.usefixtures("drawn")
@pytest.mark.openfoam
def test_a_comparison_shows_every_rung_and_the_film_in_space(tmp_path, monkeypatch):
    at_16 = Resolutions(least=16, most=16, default=16, series=(16,))
    coarse = tuple(replace(model, resolutions=at_16) if model.outside else model for model in models("rough_gap"))
    monkeypatch.setattr(compare, "models", lambda _: coarse)
    compare.command(SCENE, out=tmp_path, set_=["mesh.layers=8"])
    page = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert ";scene=turns;" in page or "no picture: " in page
    for name in ("smooth_gap", "homogenized", "slope_corrected", "stokes", "navier_stokes"):
        assert f">{name}" in page
    for heading in ("Flow and friction factors", "Across the gap", "Streamlines"):
        assert heading in page
    film = gap_view.film_of(load(tmp_path / "results" / "stokes.h5"))
    x0, x1, y0, y1, z0, z1 = film.bounds
    volume = film.compute_cell_sizes()["Volume"]
    assert volume.sum() / ((x1 - x0) * (y1 - y0)) == pytest.approx(10.0, rel=1e-6)
    assert z1 - z0 == pytest.approx(13.0)
    assert (film["velocity"][:, 0] * volume).sum() > 0
