"""roughfilm leakage: from the first touch to where it is sealed, kept load by load."""

import csv
import itertools
import json
import math
import re

import numpy as np
import pytest
from empty_figures import ABSENT
from small_scenes import CONTACT, SEAL, SURFACE
from typer.testing import CliRunner

from roughfilm.cli.main import app
from roughfilm.rom.seal.leakage import curve as leakage_run
from roughfilm.rom.seal.leakage.series import load_series
from roughfilm.rom.studies.table import read_table
from roughfilm.words.numbers import with_error

NAMES = ("direct_x", "direct_y", "homogenized_x", "homogenized_y")


def run(*arguments):
    return CliRunner().invoke(app, [str(argument) for argument in arguments])


def asked(*arguments):
    done = run(*arguments, "--json")
    assert done.exit_code == 0, done.stderr
    return json.loads(done.stdout)


@pytest.fixture(scope="module", autouse=True)
def _empty():
    """The figures of the series are drawn."""


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    folder = tmp_path_factory.mktemp("seal")
    (folder / "rough.toml").write_text(SURFACE, encoding="utf-8")
    (folder / "seal.toml").write_text(SEAL, encoding="utf-8")
    return folder


@pytest.fixture(autouse=True)
def _without_pages(monkeypatch):
    """Figures take most of the time; one test looks at a page."""
    monkeypatch.setattr("roughfilm.pages.leakage.write_page", lambda *_: None)


@pytest.fixture(scope="module")
def stated(place):
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("roughfilm.figures.spatial.pressed_surface.draw_apart", lambda *_: ABSENT)
        return asked("leakage", place / "seal.toml", "--out", place / "out")


def test_loads_reach_from_the_first_touch_to_beyond_where_it_seals(stated):
    series = stated["series"]
    assert 25 <= len(series) <= 28
    loads, areas = ([row[name] for row in series] for name in ("load", "area_fraction"))
    assert loads == sorted(loads)
    assert areas[0] < 0.02
    assert all(series[-1][f"{name}_sealed"] == 1 for name in NAMES)
    assert not any(series[0][f"{name}_sealed"] for name in NAMES)


def test_leakage_falls_and_is_nothing_where_sealed(stated):
    for name in NAMES:
        column = [row[name] for row in stated["series"]]
        assert all(a > b or a == b == 0 for a, b in itertools.pairwise(column))
        assert [value == 0 for value in column] == [row[f"{name}_sealed"] == 1 for row in stated["series"]]
    for row in stated["series"]:
        assert row["direct_x"] >= row["homogenized_x"] * (1 - 1e-6)
        assert row["direct_y"] >= row["homogenized_y"] * (1 - 1e-6)


def test_thresholds_part_the_series(stated):
    for name in NAMES:
        side = stated["thresholds"][name]
        assert stated["quantities"][f"seals_{name}"]["value"] == 1
        assert side["open"]["load"] < stated["quantities"][f"sealing_load_{name}"]["value"] < side["sealed"]["load"]
        assert side["sealed"]["load"] <= 1.0101 * side["open"]["load"]
        for row in stated["series"]:
            if row["load"] <= side["open"]["load"]:
                assert row[f"{name}_sealed"] == 0
            if row["load"] >= side["sealed"]["load"]:
                assert row[f"{name}_sealed"] == 1


def test_tables_and_page_hold_the_series(stated, place):
    table = read_table(place / "out" / "table.h5")
    assert table["load"].tolist() == [row["load"] for row in stated["series"]]
    leak = table["leakage_direct_y"]
    assert leak == pytest.approx(1e3 * table["direct_y"] * 1e6 / (12e-3 * 1e-3), rel=1e-12)
    with (place / "out" / "table.csv").open(encoding="utf-8") as file:
        lines = list(csv.reader(file))
    assert len(lines) == 1 + len(stated["series"])
    assert "leakage_direct_x (kg/(m*s))" in lines[0]
    page = (place / "out" / "report.html").read_text(encoding="utf-8")
    assert page.count("<svg") >= 4
    assert "No picture: left out in a test" in page
    assert "http://www.w3.org" in page


def test_the_page_begins_with_the_leakage_at_the_load_of_the_scene(stated, place):
    quantities, page = stated["quantities"], (place / "out" / "report.html").read_text(encoding="utf-8")
    assert quantities["load"]["value"] == 10e3
    (row,) = [row for row in stated["series"] if row["load"] == 10e3]
    leak, bar = (3.6e6 * quantities["leakage_per_width"][name] for name in ("value", "uncertainty"))
    assert 3.6e6 * row["leakage_homogenized_y"] < leak < 3.6e6 * row["leakage_direct_y"]
    unit = re.search(r"<b>[\d.]+ ± [\d.]+ (.*)</b><span>leakage per width at 0.01 MPa along y", page)[1]
    size = {"g/(h·m)": 1.0, "mg/(h·m)": 1e3}[unit]
    assert f"<b>{with_error(size * leak, size * bar)} {unit}</b>" in page
    assert set(re.findall(r"[pnµmk]?g/\(h·m\)", page)) == {unit}
    assert quantities["area_fraction"]["value"] == row["area_fraction"]


def test_the_answer_of_the_page_is_that_of_the_model(stated, place):
    whole = asked("solve", place / "seal.toml", "--model", "direct_leakage", "--resolution", 32)["quantities"]
    for name in ("leakage_per_width", "area_fraction", "mean_gap"):
        for number in ("value", "uncertainty"):
            assert stated["quantities"][name][number] == pytest.approx(whole[name][number], rel=1e-4)


def test_the_same_command_solves_nothing_again(stated, place):
    again = asked("leakage", place / "seal.toml", "--out", place / "out")
    assert again["numerics"]["loads_found"] == len(stated["series"])
    assert again["series"] == stated["series"]


def test_another_liquid_takes_the_same_contacts_and_another_solid_does_not(stated, place):
    thick = asked("leakage", place / "seal.toml", "--out", place / "out", "--set", "liquid.viscosity=2 mPa*s")
    assert thick["numerics"]["loads_found"] == len(stated["series"])
    assert thick["series"][0]["leakage_direct_x"] == pytest.approx(stated["series"][0]["leakage_direct_x"] / 2)
    refused = run("leakage", place / "seal.toml", "--out", place / "out", "--set", "solid.modulus=11 MPa")
    assert refused.exit_code == 2
    assert "holds another series" in refused.stderr


def test_what_was_finished_is_kept_when_it_ends_half_way(place, monkeypatch):
    flow, done = leakage_run.direct_leakage, []

    def fails(gap, spacing):
        if len(done) == 3:
            raise KeyboardInterrupt
        done.append(1)
        return flow(gap, spacing)

    arguments = ("leakage", place / "seal.toml", "--out", place / "half", "--loads", "1kPa..50kPa:6", "--threads", 1)
    monkeypatch.setattr(leakage_run, "direct_leakage", fails)
    stopped = run(*arguments)
    assert stopped.exit_code != 0
    assert "the same command goes on" in stopped.stderr
    monkeypatch.setattr(leakage_run, "direct_leakage", flow)
    kept = load_series(place / "half" / "leakage.h5")
    assert len(kept.rows) == 3
    assert set(kept.thresholds) == set(NAMES)
    whole = asked(*arguments)
    assert whole["numerics"]["loads_found"] == 3
    assert len(whole["series"]) == 6


def test_loads_may_come_in_any_order_but_not_below_zero(place):
    stated = asked("leakage", place / "seal.toml", "--out", place / "few", "--loads", "20kPa,5kPa")
    assert [row["load"] for row in stated["series"]] == [5e3, 2e4]
    refused = run("leakage", place / "seal.toml", "--out", place / "few", "--loads=-5kPa")
    assert refused.exit_code == 2
    assert "a load must be above 0" in refused.stderr


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--set", "solid.hardness=30 kPa", "--loads", "1kPa..50kPa:3"], "above the hardness"),
        (["--set", "kind=dry_contact"], "liquid"),
        (["--threads", "0"], "it must be 1 to 256"),
        (["--set", "load.pressure=0 Pa"], "load.pressure"),
    ],
)
def test_what_makes_no_sense_is_refused_in_a_line(place, arguments, words):
    done = run("leakage", place / "seal.toml", "--out", place / "bad", *arguments)
    assert done.exit_code == 2
    assert words in done.stderr
    assert "Traceback" not in done.stderr


def test_scenes_of_other_kinds_are_refused(place):
    (place / "dry.toml").write_text(CONTACT, encoding="utf-8")
    done = run("leakage", place / "dry.toml", "--out", place / "bad")
    assert done.exit_code == 2
    assert "takes scenes of kind 'seal'" in done.stderr


def test_a_flat_surface_is_sealed_under_the_loads_that_are_asked(place, monkeypatch):
    monkeypatch.undo()
    monkeypatch.setattr("roughfilm.figures.spatial.pressed_surface.draw_apart", lambda *_: ABSENT)
    np.save(place / "flat.npy", np.zeros((16, 16)))
    flat = ["--set", f"geometry.surface={place / 'flat.npy'}", "--set", "geometry.spacing=1 um"]
    refused = run("leakage", place / "seal.toml", "--out", place / "flat", *flat)
    assert refused.exit_code == 2
    assert "is flat" in refused.stderr
    stated = asked("leakage", place / "seal.toml", "--out", place / "flat", *flat, "--loads", "1kPa,1MPa")
    assert all(row[name] == 0 and row[f"{name}_sealed"] == 1 for row in stated["series"] for name in NAMES)
    assert all(row["valley_depth"] is None for row in stated["series"])
    assert "Nothing leaks at any of these loads" in (place / "flat" / "report.html").read_text(encoding="utf-8")


def test_grooves_that_never_close_are_stated_with_the_largest_load(place):
    """Full contact of ridges needs P = πE*D/λ: more than E* of deep ones."""
    ridges = 8e-6 * np.repeat(np.cos(2 * np.pi * np.arange(32) / 32)[:, None], 8, axis=1)
    np.save(place / "deep.npy", ridges)
    assert math.pi * 8e-6 / (32 * 0.5e-6) > 1
    deep = ["--set", f"geometry.surface={place / 'deep.npy'}", "--set", "geometry.spacing=0.5 um"]
    stated = asked("leakage", place / "seal.toml", "--out", place / "deep", *deep)
    assert stated["quantities"]["seals_direct_y"]["value"] == 0
    assert stated["quantities"]["seals_direct_x"]["value"] == 1
    warnings = " ".join(stated["provenance"]["warnings"])
    assert "single period between reservoirs, y: stays open up to 13.33 MPa" in warnings
    assert "single period between reservoirs, x: is sealed under any load" in warnings
    assert stated["series"][-1]["load"] <= 1e7 / 0.75 * (1 + 1e-9)


def test_joints_that_seal_are_warned_of(place):
    x = np.arange(64) / 64
    heights = 1e-7 * (np.cos(2 * np.pi * 4 * x)[:, None] + np.cos(2 * np.pi * 4 * x)[None, :])
    heights[-2:] += 6e-7
    np.save(place / "joint.npy", heights)
    bad = ["--set", f"geometry.surface={place / 'joint.npy'}", "--set", "geometry.spacing=0.5 um"]
    stated = asked("leakage", place / "seal.toml", "--out", place / "joint", *bad)
    warnings = " ".join(stated["provenance"]["warnings"])
    assert "seals first at the edge in x" in warnings


def test_a_second_series_elsewhere_takes_the_flows_of_the_first(place, tmp_path, monkeypatch):
    """The cache keeps the sealing loads and the rows, for another liquid too; contacts are solved again."""
    loads = ("--loads", "1kPa,3kPa,10kPa")
    first = asked("leakage", place / "seal.toml", "--out", tmp_path / "one", *loads)

    def refused(*_):
        raise AssertionError("a flow is solved again")

    monkeypatch.setattr(leakage_run, "direct_leakage", refused)
    monkeypatch.setattr(leakage_run, "homogenized_leakage", refused)
    monkeypatch.setattr(leakage_run, "thresholds", refused)
    thicker = ("--set", "liquid.viscosity=2 mPa*s")
    second = asked("leakage", place / "seal.toml", "--out", tmp_path / "two", *loads, *thicker)
    assert second["thresholds"] == first["thresholds"]
    for one, other in zip(first["series"], second["series"], strict=True):
        assert one["direct_x"] == other["direct_x"]
        assert one["mean_gap"] == other["mean_gap"]
        assert other["leakage_direct_x"] == pytest.approx(one["leakage_direct_x"] / 2)
    assert (tmp_path / "two" / "contacts.h5").stat().st_size == (tmp_path / "one" / "contacts.h5").stat().st_size
