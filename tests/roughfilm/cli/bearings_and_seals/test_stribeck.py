"""roughfilm stribeck as people call it."""

import csv
import json

import h5py
import numpy as np
import pytest
from places import SCENES
from typer.testing import CliRunner

from roughfilm.cli.main import app
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.mechanics.store import load_contact
from roughfilm.rom.bearing.mixed import curves as stribeck_sweep
from roughfilm.rom.bearing.mixed.store import NUMBERS
from roughfilm.rom.homogenization.table.store import load_table
from roughfilm.rom.ladder.scene import load_scene
from roughfilm.terminal.ranges import loads_of, speeds_of
from roughfilm.words.numbers import with_error

SCENE = SCENES / "rough_washer.toml"
COARSE = ("--set", "roughness.surface.points=[32, 32]", "--set", "roughness.surface.correlation_length=0.2 mm")
COARSE = (*COARSE, "--set", "roughness.surface.anisotropy=1", "--resolution", "16")
SWEEP = ("--loads", "1MPa,2MPa", "--speeds", "0,20rpm,80rpm,500rpm")


def run(*arguments):
    return CliRunner().invoke(app, ["stribeck", str(SCENE), *COARSE, *map(str, arguments)], catch_exceptions=False)


@pytest.fixture(scope="module")
def swept(tmp_path_factory):
    """The directory of a finished sweep, and what ``--json`` entries."""
    out = tmp_path_factory.mktemp("stribeck")
    done = run("--out", out, *SWEEP, "--json")
    assert done.exit_code == 0, done.stderr
    return out, json.loads(done.stdout)


def test_film_and_asperities_carry_the_load_between_them(swept):
    _, entries = swept
    for curve in entries["curves"]:
        points = curve["points"]
        area = points[0]["load"] / points[0]["pressure"]
        for point in points:
            assert point["film_load"] + point["contact_load"] == pytest.approx(curve["pressure"] * area, rel=1e-5)
            assert point["contact_share"] == pytest.approx(point["contact_load"] / point["load"])
        assert (np.diff([point["separation"] for point in points]) > 0).all()
        assert (np.diff([point["contact_share"] for point in points]) <= 0).all()


def test_at_rest_only_what_touches_rubs_and_the_inner_pressure_carries_the_rest(swept):
    """At rest nothing shears, and without pressure at the inner edge the asperities would carry all."""
    _, entries = swept
    for curve in entries["curves"]:
        rest = curve["points"][0]
        assert rest["speed"] == 0
        assert rest["friction_coefficient"] == pytest.approx(0.1 * rest["contact_share"], abs=2e-3)
        assert 0 < rest["film_load"] < 0.1e6 * rest["load"] / rest["pressure"]


def test_walls_part_between_the_points_that_touch_and_those_that_do_not(swept):
    _, entries = swept
    lifts = []
    for curve in entries["curves"]:
        lift = curve["lift_off"]["speed"]
        assert max(point["speed"] for point in curve["points"] if point["contact_load"] > 0) < lift
        assert min(point["speed"] for point in curve["points"] if point["contact_load"] == 0) > lift
        lifts.append(lift)
    assert lifts[1] > lifts[0]


def test_spots_in_contact_have_a_flash_temperature_with_a_range(swept, tmp_path):
    heat = {"conductivity": "46 W/(m*K)", "density": "7850 kg/m^3", "heat_capacity": "460 J/(kg*K)"}
    entries = [f"asperities.solid_heat.{key}={value}" for key, value in heat.items()]
    entries += ["lubricant.temperature=40 degC", "lubricant.thermoviscosity.law=exponential"]
    entries += ["lubricant.thermoviscosity.temperature_coefficient=0.03/K"]
    words = [word for entry in entries for word in ("--set", entry)]
    table, options = swept[0] / "table.h5", ("--loads", "1MPa", "--speeds", "0,20rpm")
    done = run("--out", tmp_path / "out", "--table", table, *options, *words)
    assert done.exit_code == 0, done.stderr
    assert "spots hotter by, K" in " ".join(done.stdout.split())
    printed = " ".join((done.stdout + done.stderr).split())
    assert "flash_temperature: a spot has" in printed
    assert "missing, so that all films have the temperature of the supplied lubricant" in printed
    entries = json.loads((tmp_path / "out" / "stribeck.json").read_text(encoding="utf-8"))
    rest, slow = entries["curves"][0]["points"]
    assert rest["flash_temperature"] == 0
    assert 0 < slow["flash_temperature_low"] <= slow["flash_temperature"] < slow["flash_temperature_high"]
    assert entries["units"]["flash_temperature"] == "K"
    greatest = entries["quantities"]["greatest flash temperature at 1 MPa"]
    assert (greatest["value"], greatest["high"]) == (slow["flash_temperature"], slow["flash_temperature_high"])
    assert "spots<br>in contact<br>hotter by" in (tmp_path / "out" / "report.html").read_text(encoding="utf-8")


def test_files_hold_what_was_printed(swept):
    out, entries = swept
    points = [point for curve in entries["curves"] for point in curve["points"]]
    assert json.loads((out / "stribeck.json").read_text())["curves"] == entries["curves"]
    with (out / "stribeck.csv").open() as file:
        rows = list(csv.reader(file, skipinitialspace=True))
    assert rows[0][:2] == ["pressure (Pa)", "speed (m/s)"]
    assert [float(row[1]) for row in rows[1:]] == [point["speed"] for point in points]
    with h5py.File(out / "stribeck.h5") as file:
        for name in NUMBERS:
            np.testing.assert_array_equal(file[f"points/{name}"][()], [point[name] for point in points])
            assert file[f"points/{name}"].attrs["unit"] == entries["units"][name]
        assert file["lift_off/speed"].shape == (2,)
    page = (out / "report.html").read_text()
    assert page.count("<svg") == 3
    assert "rough washer: Stribeck curves" in page


def test_finished_points_are_found_again_and_others_added(swept):
    out, entries = swept
    again = run("--out", out, "--loads", "2MPa", "--speeds", "20rpm,40rpm,80rpm", "--json")
    found = json.loads(again.stdout)
    assert found["numerics"]["points_found"] == 2
    assert found["numerics"]["table_points_found"] == found["numerics"]["table_points"]
    before = {point["speed"]: point for point in entries["curves"][1]["points"]}
    for point in found["curves"][0]["points"]:
        assert before.get(point["speed"], point) == point


def test_a_sweep_that_is_stopped_goes_on(swept, tmp_path, monkeypatch):
    out, _ = swept
    (tmp_path / "table.h5").write_bytes((out / "table.h5").read_bytes())
    sweep, stopped = stribeck_sweep.stribeck, 3

    def interrupted(*arguments, keep, **options):
        count = 0

        def kept(point):
            nonlocal count
            keep(point)
            count += 1
            if count == stopped:
                raise KeyboardInterrupt

        return sweep(*arguments, keep=kept, **options)

    monkeypatch.setattr(stribeck_sweep, "stribeck", interrupted)
    assert run("--out", tmp_path, *SWEEP).exit_code != 0
    monkeypatch.undo()
    entries = json.loads(run("--out", tmp_path, *SWEEP, "--json").stdout)
    assert entries["numerics"]["points_found"] == stopped


def test_a_table_that_does_not_reach_is_extended_and_that_is_stated(swept, tmp_path):
    """A table of light loads alone: the land carries less by it than is asked."""
    whole = load_table(swept[0] / "table.h5")
    series = tmp_path / "C.h5"
    surface = tmp_path / "surface.npy"
    scene = scene_of_tests()
    np.save(surface, scene.roughness.scaled_heights())
    spacing = scene.roughness.scaled_spacing()[0]
    steel = ("--modulus", "210GPa", "--poisson", "0.3", "--hardness", "5GPa", "--spacing", f"{spacing} m")
    asked = ("contact", str(surface), *steel, "--loads", "0.2MPa,0.5MPa", "--out", str(series))
    pressed = CliRunner().invoke(app, asked)
    assert pressed.exit_code == 0, pressed.stderr
    assert load_contact(series, 0.5e6).load == 0.5e6
    short = tmp_path / "T.h5"
    made = CliRunner().invoke(app, ["factors", str(series), "--out", str(short)])
    assert made.exit_code == 0, made.stderr
    reach = max(point.load for point in load_table(short).points)
    assert reach == 0.5e6 < max(point.load for point in whole.points)
    done = run("--out", tmp_path / "out", "--table", short, "--loads", "2MPa", "--speeds", "0", "--json")
    assert done.exit_code == 0, done.stderr
    entries = json.loads(done.stdout)
    warned = [
        words for words in entries["provenance"]["warnings"] if "T.h5 has contact pressures of up to 0.5" in words
    ]
    assert len(warned) == 1
    assert "extended to" in warned[0]
    assert entries["curves"][0]["points"][0]["contact_load"] > 0


def scene_of_tests():
    return load_scene(SCENE, [entry for flag, entry in zip(COARSE[::2], COARSE[1::2], strict=True) if flag == "--set"])


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--loads", "4.99GPa"), "the surface carries at most"),
        (("--speeds", "5 kg"), "write a speed"),
        (("--speeds", "-1rpm"), "must be 0 or 1e-19 to"),
        (("--resolution", "3"), "give a whole number from 16 to 1024"),
        (("--set", "asperities.friction=-1"), "asperities.friction"),
        (("--set", "roughness.surface.seed=2"), "holds another table of flow factors, of another surface"),
    ],
)
def test_faults_take_one_line(swept, arguments, words):
    done = run("--out", swept[0], *SWEEP, *arguments)
    assert done.exit_code == 2
    assert words in done.stderr
    assert len(done.stderr.strip().splitlines()) == 1


def test_curves_of_another_scene_are_not_mixed_with_these(swept):
    done = run("--out", swept[0], *SWEEP, "--set", "lubricant.viscosity=0.2 Pa*s")
    assert done.exit_code == 2
    assert "holds another table of Stribeck curves, with lubricant.viscosity 0.14 Pa*s, not 0.2 Pa*s" in done.stderr


def test_another_kind_of_scene_is_refused(tmp_path):
    done = CliRunner().invoke(app, ["stribeck", str(SCENE.parent / "pocket.toml"), "--out", str(tmp_path)])
    assert done.exit_code == 2
    assert "takes scenes of kind 'bearing'" in done.stderr


def test_the_page_begins_with_the_friction_at_the_speed_of_the_scene(swept, tmp_path, monkeypatch):
    monkeypatch.setattr("roughfilm.cli.bearings_and_seals.stribeck.ROTATIONAL_SPEEDS", "20rpm,500rpm")
    table = ("--table", swept[0] / "table.h5", "--set", "motion.speed=1 m/s")
    done = run("--out", tmp_path, "--loads", "1MPa", *table, "--json")
    assert done.exit_code == 0, done.stderr
    (curve,) = json.loads(done.stdout)["curves"]
    assert len(curve["points"]) == 3
    (own,) = [point for point in curve["points"] if point["speed"] == 1.0]
    bar = own["uncertainty"]["friction_coefficient"]
    assert bar > 0
    first = (tmp_path / "report.html").read_text().partition("<h2>")[0]
    turns = f"{60 / (2 * np.pi * 0.165):.4g} rpm"
    assert f"friction coefficient at the speed of the scene, {turns}, is" in first
    assert f"<b>{with_error(own['friction_coefficient'], bar)}</b>" in first
    assert "lift-off at" in first


def test_ranges_of_speeds():
    turn = 2 * np.pi / 60
    assert speeds_of("0,30rpm, 2 m/s", 0.1) == (0.0, pytest.approx(30 * turn * 0.1), 2.0)
    assert speeds_of("1..100rpm:3", 1.0) == pytest.approx((turn, 10 * turn, 100 * turn))
    assert speeds_of("0..2m/s:3", None) == (0.0, 1.0, 2.0)
    assert speeds_of("0.5 Hz, 60 1/min", 0.1) == pytest.approx((30 * turn * 0.1, 60 * turn * 0.1))
    assert loads_of("2kN, 1MPa", area=0.001) == pytest.approx((1e6, 2e6))
    with pytest.raises(InputError, match="force"):
        loads_of("2kN")
    assert speeds_of("0", None) == (0.0,)
    with pytest.raises(InputError, match="nothing turns here"):
        speeds_of("30rpm", None)
    with pytest.raises(InputError, match="first of a range must be below"):
        speeds_of("5..1rpm:3", 0.1)


def test_a_smooth_bearing_is_swept_under_its_own_load(tmp_path):
    """Without asperities the film carries all; the default load is that of the scene."""
    scene = tmp_path / "journal.toml"
    scene.write_text((SCENES / "journal.toml").read_text() + '\n[load]\nforce = "2.5 kN"\n')
    arguments = [
        "stribeck",
        str(scene),
        "--speeds",
        "50rpm,500rpm",
        "--resolution",
        "16",
        "--out",
        str(tmp_path / "out"),
    ]
    done = CliRunner().invoke(app, [*arguments, "--json"], catch_exceptions=False)
    assert done.exit_code == 0, done.stderr
    (curve,) = json.loads(done.stdout)["curves"]
    assert curve["pressure"] == pytest.approx(2.5e3 / (50e-3 * 50e-3))
    assert all(point["contact_share"] == 0 for point in curve["points"])
    page = (tmp_path / "out" / "report.html").read_text()
    assert "no asperities" in page
    assert "lift off" not in page
    assert page.count("<svg") == 2


def test_a_second_sweep_elsewhere_takes_the_table_of_the_first(tmp_path, monkeypatch):
    one = run("--out", tmp_path / "one", *SWEEP, "--json")
    monkeypatch.setattr("roughfilm.rom.bearing.mixed.kept.tabulate_pressed", lambda *_, **__: pytest.fail("made again"))
    other = run("--out", tmp_path / "two", *SWEEP, "--json")
    first, second = (json.loads(done.stdout) for done in (one, other))
    assert second["quantities"] == first["quantities"]
    assert first["numerics"]["table_points_found"] == 0
    assert second["numerics"]["table_points_found"] == second["numerics"]["table_points"]
