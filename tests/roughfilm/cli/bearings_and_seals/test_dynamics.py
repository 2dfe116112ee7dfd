"""roughfilm dynamics as people call it."""

import json
import tomllib

import pytest
from places import SCENES
from typer.testing import CliRunner

from roughfilm.cli.main import app

SCENE = SCENES / "grooved_journal.toml"

ROUGH = """
[roughness]
kind = "surface"
[roughness.surface]
kind = "gaussian"
size = ["1 mm", "1 mm"]
points = [16, 16]
seed = 504
rms_height = "1 um"
correlation_length = "0.15 mm"
[asperities]
friction = 0.1
[asperities.solid]
modulus = "210 GPa"
poisson = 0.3
hardness = "5 GPa"
"""


def run(*arguments, scene=SCENE):
    words = ["dynamics", str(scene), "--resolution", "32", *map(str, arguments)]
    return CliRunner().invoke(app, words, catch_exceptions=False)


@pytest.fixture(scope="module")
def swept(tmp_path_factory):
    """The directory of a finished sweep, and what ``--json`` prints."""
    out = tmp_path_factory.mktemp("dynamics")
    done = run("--out", out, "--loads", "5kN,10kN", "--speeds", "0.02rpm,1000rpm,3000rpm", "--json")
    assert done.exit_code == 0, done.stderr
    return out, json.loads(done.stdout), done.stderr


def test_files_and_entries_hold_the_same_numbers(swept):
    out, entries, _ = swept
    assert {path.name for path in out.iterdir()} >= {
        *("dynamics.csv", "dynamics.h5", "dynamics.json", "report.html", "ross_1.toml", "ross_2.toml")
    }
    for number, curve in enumerate(entries["curves"]):
        (element,) = tomllib.loads((out / f"ross_{number + 1}.toml").read_text(encoding="utf-8")).values()
        points = curve["points"]
        assert element["speed"] == [point["rotation"] for point in points]
        for row, point in zip(element["kxy"], points, strict=True):
            synchronous = row[element["frequency"].index(point["rotation"])]
            assert synchronous == pytest.approx(point["stiffness_xy"], rel=1e-12)
        for point in points:
            scale = 50e-6 / point["load"]
            assert point["dimensionless_stiffness_xx"] == pytest.approx(scale * point["stiffness_xx"])
            damping = scale * point["rotation"] * point["damping_yy"]
            assert point["dimensionless_damping_yy"] == pytest.approx(damping)
            assert point["uncertainty"]["stiffness_xx"] > 0
    assert [curve["points"][0]["load"] for curve in entries["curves"]] == pytest.approx([5e3, 10e3])


def test_a_speed_without_a_film_is_left_out_with_a_warning(swept):
    _, entries, _ = swept
    assert all(len(curve["points"]) == 2 for curve in entries["curves"])
    warnings = entries["provenance"]["warnings"]
    assert len(warnings) == 2
    assert "left out at 0.02 rpm: load" in warnings[0]


def test_finished_points_are_used_again(swept):
    out, entries, _ = swept
    again = run("--out", out, "--loads", "5kN,10kN", "--speeds", "1000rpm,3000rpm", "--json")
    found = json.loads(again.stdout)
    assert found["numerics"]["points_found"] == 4
    assert [curve["points"] for curve in found["curves"]] == [curve["points"] for curve in entries["curves"]]


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--set", "load.force=0 N"], "load.force"),
        (["--speeds", "0rpm"], "speeds: got 0.0"),
        (["--frequency-ratio", "-1"], "--frequency-ratio: got -1.0"),
        (["--loads", "1MN", "--speeds", "1rpm"], "load: got 1e+06 N"),
    ],
)
def test_bad_input_is_refused_in_one_line(words, message, tmp_path):
    done = run("--out", tmp_path / "out", *words)
    assert done.exit_code == 2
    assert message in " ".join(done.stderr.split())
    assert "Traceback" not in done.stderr


@pytest.fixture(scope="module")
def warm(tmp_path_factory):
    """The grooved journal with an oil that has a temperature."""
    text = SCENE.read_text(encoding="utf-8")
    begin, end = text.index("[lubricant]"), text.index("[", text.index("[lubricant]") + 1)
    scene = tmp_path_factory.mktemp("warm") / "warm.toml"
    scene.write_text(f'{text[:begin]}[lubricant]\noil = "ISO VG 32"\ntemperature = "45 degC"\n{text[end:]}')
    return scene


def test_the_temperature_of_the_film_has_a_column_a_figure_and_stands_in_the_answer(warm, tmp_path):
    done = run("--speeds", "3000rpm", "--loads", "5kN", "--out", tmp_path / "out", scene=warm)
    assert done.exit_code == 0, done.stderr
    assert "film, °C" in done.stdout
    assert "film at " in " ".join((done.stdout + done.stderr).split())
    entries = json.loads((tmp_path / "out" / "dynamics.json").read_text(encoding="utf-8"))
    (point,) = entries["curves"][0]["points"]
    assert point["outlet_temperature"] > point["temperature"] > 46
    assert point["uncertainty"]["temperature"] > 0
    assert entries["units"]["temperature"] == "degC"
    page = (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    assert "Temperature against speed" in page
    assert "at the one temperature at which its heat is balanced" in page


def test_temperatures_are_left_out_at_request_and_where_they_cannot_be_computed_with_a_warning(warm, tmp_path):
    options = ("--speeds", "3000rpm", "--loads", "5kN")
    cold = run("--isothermal", *options, "--out", tmp_path / "cold", scene=warm)
    assert cold.exit_code == 0, cold.stderr
    assert "film, °C" not in cold.stdout
    law = ("temperature=40degC", "thermoviscosity.law=exponential", "thermoviscosity.temperature_coefficient=0.03/K")
    words = [word for entry in law for word in ("--set", f"lubricant.{entry}")]
    lacking = run(*words, *options, "--out", tmp_path / "lacking")
    assert lacking.exit_code == 0, lacking.stderr
    assert "lubricant.density: missing" in " ".join((lacking.stdout + lacking.stderr).split())


def test_a_shape_whose_wall_is_given_is_refused(tmp_path):
    done = run("--out", tmp_path / "out", scene=SCENES / "pad.toml")
    assert done.exit_code == 2
    assert "geometry.shape: got 'linear'" in " ".join(done.stderr.split())


def test_the_load_on_asperities_has_a_column_and_stands_in_the_answer(tmp_path):
    """A surface with few points and gaps, so that its table is made fast."""
    rough = tmp_path / "rough.toml"
    rough.write_text(SCENE.read_text(encoding="utf-8") + ROUGH, encoding="utf-8")
    done = run("--out", tmp_path / "rough", "--speeds", "10rpm", scene=rough)
    assert done.exit_code == 0, done.stderr
    assert "contact, %" in done.stdout
    assert "of which asperities carry" in " ".join((done.stdout + done.stderr).split())
    page = (tmp_path / "rough" / "report.html").read_text(encoding="utf-8")
    assert "asperities that touch and deform" in page
    assert "carried by contact" in page
