"""The page of a sweep: errors by case, what orders them, and refusals in one line."""

import json
import re
from dataclasses import replace

import numpy as np
import pytest
from typer.testing import CliRunner

from roughfilm.cli.main import app
from roughfilm.rom.ladder.store import load, save
from roughfilm.rom.studies.sweep import loaded, read_sweep, relative_error
from roughfilm.rom.studies.table import read_table

STUDY = """
name = "small"
kind = "pocket"
[geometry]
length = "1 mm"
film = "30 um"
width = ["0.2 length", "0.5 length"]
depth = ["0.25 film", "0.75 film"]
[lubricant]
viscosity = "0.01 Pa*s"
density = "1000 kg/m^3"
[motion]
reynolds_number = [20, 160]
[[variants]]
geometry.profile = "cylindrical"
[[variants]]
geometry.profile = "splined"
geometry.shift = "0.2 width"
[study]
models = ["reynolds", "inertial_reynolds", "film", "film_slope"]
resolution = { film = 100, film_slope = 100 }
"""


@pytest.fixture(scope="module")
def finished(tmp_path_factory):
    place = tmp_path_factory.mktemp("sweep")
    (place / "study.toml").write_text(STUDY)
    run = CliRunner().invoke(app, ["batch", str(place / "study.toml"), "--out", str(place / "done")])
    assert run.exit_code == 0, run.output
    return place / "done"


@pytest.fixture(scope="module")
def reported(finished):
    """The entries and the page of the report."""
    run = CliRunner().invoke(app, ["report", str(finished), "--json"])
    assert run.exit_code == 0, run.output
    return json.loads(run.stdout), (finished / "report.html").read_text(encoding="utf-8")


def test_a_sweep_is_read_side_by_side(finished):
    sweep = read_sweep(read_table(finished / "table.h5"), "pocket")
    assert len(sweep.names) == 16
    assert set(sweep.found) == {"reynolds", "inertial_reynolds", "film-100", "film_slope-100"}
    assert np.unique(sweep.given["width_plus"]) == pytest.approx([0.2, 0.5])
    features = sweep.features()
    splined = sweep.given["profile"] == "splined"
    expected = sweep.given["depth_plus"] * 0.03 / sweep.given["width_plus"]
    assert features["slope"][~splined] == pytest.approx(2 * expected[~splined])
    assert features["slope"][splined] == pytest.approx(expected[splined] / 0.3)


def test_the_report_orders_the_errors_of_every_model(finished, reported):
    entries, page = reported
    assert entries["reference"] == "film_slope-100"
    assert entries["cases"] == 16
    rows = {row["setting"]: row for row in entries["settings"]}
    sweep = read_sweep(read_table(finished / "table.h5"), "pocket")
    error = relative_error(sweep, "film-100", "film_slope-100", "load_plus")[loaded(sweep, "film_slope-100")]
    assert rows["film-100"]["error"]["load_plus"]["worst"] == pytest.approx(error.max())
    law = rows["inertial_reynolds"]["ordered_by"]["friction_plus"]
    assert 0.5 < law["rank"] <= 1
    assert "16 cases by 4 settings" in page
    assert not re.findall(r"(?:src|href)=\"http", page)


def test_a_reference_that_leaves_effects_out_ranks_only_what_it_can_state_apart(reported):
    """film_slope is itself off by some per cent by the laws; film differs from it by less in most cases."""
    entries, page = reported
    bar = entries["reference_uncertainty"]["load_plus"]
    assert bar["known"] == bar["cases"]
    rows = {row["setting"]: row["error"]["load_plus"] for row in entries["settings"]}
    least, largest = rows["film-100"]["intervals"]["median"]
    assert least <= rows["film-100"]["median"] <= largest
    assert largest - rows["film-100"]["median"] == pytest.approx(bar["median"], rel=1)
    orders = {(*one["settings"], one["quantity"]): one for one in entries["ranking"]}
    assert orders["reynolds", "film-100", "load_plus"]["order"] == "film-100 is nearer"
    assert "Which models can be distinguished" in page


def test_a_directory_without_a_table_is_one_line(tmp_path):
    run = CliRunner().invoke(app, ["report", str(tmp_path)])
    assert run.exit_code == 2
    assert "holds no batch; name the directory of a batch" in " ".join(run.stderr.split())
    assert len(run.stderr.strip().splitlines()) == 1


def test_an_edited_case_is_not_the_best_one_and_is_named(tmp_path):
    text = STUDY.replace('["0.2 length", "0.5 length"]', '"0.3 length"').replace("[20, 160]", "[20, 60]")
    (tmp_path / "study.toml").write_text(text.partition("[study]")[0] + '[study]\nmodels = ["reynolds"]\n')
    out = tmp_path / "done"
    run = CliRunner().invoke(app, ["batch", str(tmp_path / "study.toml"), "--out", str(out)])
    assert run.exit_code == 0, run.output
    before = json.loads(CliRunner().invoke(app, ["report", str(out), "--json"]).stdout)
    assert before["edited"] == []
    best = before["answers"][0]["best"]
    path = next(one for one in out.rglob("*.h5") if one.parent.name == best["case"])
    words = "the case was edited: constant/transportProperties: nu 1 → 1234"
    save(replace(load(path), warnings=(words,)), path, overwrite=True)
    (out / "table.h5").unlink()
    run = CliRunner().invoke(app, ["report", str(out), "--overwrite"])
    assert run.exit_code == 0, run.output
    assert f"Case {best['number']} by reynolds: the case was edited" in " ".join(run.output.split())
    after = json.loads((out / "report.json").read_text())
    (line,) = after["edited"]
    assert line.startswith(f"Case {best['number']} by reynolds: {words}")
    assert after["answers"][0]["best"]["case"] != best["case"]
    assert words in (out / "report.html").read_text()
