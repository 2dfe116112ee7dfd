"""roughfilm leakage of a set of windows."""

import itertools
import json
from dataclasses import replace

import numpy as np
import pytest
from small_scenes import SEAL, SURFACE
from typer.testing import CliRunner
from window_sets import surface_of_seed, write_set

from roughfilm.cli.main import app
from roughfilm.contact.surfaces.store import save_surface
from roughfilm.rom.studies.table import read_table

LOADS = ("--loads", "10kPa,60kPa")


def run(*arguments):
    return CliRunner().invoke(app, [str(argument) for argument in arguments])


def asked(*arguments):
    done = run(*arguments, *(["--jobs", 1] if "--windows" in arguments else []), "--json")
    assert done.exit_code == 0, done.stderr
    return json.loads(done.stdout)


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    folder = tmp_path_factory.mktemp("seal")
    (folder / "rough.toml").write_text(SURFACE, encoding="utf-8")
    (folder / "seal.toml").write_text(SEAL, encoding="utf-8")
    write_set(folder / "seeds", [surface_of_seed(seed) for seed in (1, 2, 3, 4)])
    return folder


@pytest.fixture(autouse=True)
def _without_pages(monkeypatch):
    """Figures take most of the time; one test looks at a page."""
    monkeypatch.setattr("roughfilm.pages.leakage.write_page", lambda *_: None)
    monkeypatch.setattr("roughfilm.pages.sets.leakage.write_page", lambda *_: None)


@pytest.fixture(scope="module")
def message(place):
    """The answer for four seeds, with the page."""
    return asked("leakage", place / "seal.toml", "--windows", place / "seeds", *LOADS, "--out", place / "out")


def test_equal_windows_give_the_plain_command_without_scatter(place):
    write_set(place / "equal", [surface_of_seed(20071)] * 3)
    asking = ("leakage", place / "seal.toml", *LOADS)
    plain = asked(*asking, "--out", place / "plain")
    equal = asked(*asking, "--windows", place / "equal", "--out", place / "equal out")
    for one, two in zip(plain["series"], equal["series"], strict=True):
        for name in one.keys() - {"cpu_s"}:
            assert two[name] == pytest.approx(one[name], rel=1e-9), name
        for name in ("mean_gap", "direct_x", "leakage_homogenized_y"):
            assert two[f"{name}_scatter"] <= 1e-8 * two[name]
    for name, entry in plain["quantities"].items():
        assert equal["quantities"][name]["value"] == pytest.approx(entry["value"], rel=1e-8), name
        if "uncertainty" in entry:
            assert equal["quantities"][name]["uncertainty"] == pytest.approx(entry["uncertainty"], rel=1e-7), name


def test_the_mean_is_that_of_the_windows_on_their_own(place, message):
    alone = [
        asked("leakage", place / "seal.toml", *LOADS, "--out", place / f"alone{number}", "--set", key)
        for number in range(1, 5)
        for key in [f"geometry.surface={place}/seeds/cells/{number:04d}.h5"]
    ]
    for number, row in enumerate(message["series"]):
        for name in ("area_fraction", "mean_gap", "direct_x", "direct_y", "direct_x_sealed"):
            mean = np.mean([one["series"][number][name] for one in alone])
            assert row[name] == pytest.approx(mean, rel=1e-8, abs=1e-40)
    leak, own = message["quantities"]["leakage_per_width"], [one["quantities"]["leakage_per_width"] for one in alone]
    assert leak["value"] == pytest.approx(np.mean([one["value"] for one in own]), rel=1e-8)
    assert leak["uncertainty"] == pytest.approx(np.mean([one["uncertainty"] for one in own]), rel=1e-6)
    assert leak["in_series"] < leak["value"]
    assert leak["scatter"] >= leak["value"] - leak["in_series"]
    assert leak["window_interval"][0] < min(one["value"] for one in own)
    assert leak["window_interval"][1] > max(one["value"] for one in own)
    loads = [one["quantities"]["sealing_load_direct_y"]["value"] for one in alone]
    assert message["quantities"]["sealing_load_direct_y"]["value"] == pytest.approx(np.mean(loads), rel=1e-12)


def test_tables_and_page_have_the_scatter_beside_the_numerical_uncertainty(place, message):
    table = read_table(place / "out" / "table.h5")
    for name in ("direct_y", "leakage_direct_y", "mean_gap"):
        assert {name, f"{name}_scatter", f"{name}_window_low", f"{name}_window_high"} <= table.keys()
    assert table["direct_y_scatter"].tolist() == [row["direct_y_scatter"] for row in message["series"]]
    assert message["windows"]["count"] == 4
    page = (place / "out" / "report.html").read_text(encoding="utf-8")
    assert page.count("<svg") == 3
    assert "(numerical)" in page
    assert page.count("by the choice of windows") == 3


def test_a_second_run_takes_all_rows_from_the_files(place, message):
    again = asked("leakage", place / "seal.toml", "--windows", place / "seeds", *LOADS, "--out", place / "out")
    assert again["numerics"]["loads_found"] == again["numerics"]["rows"] == 8
    assert again["series"] == message["series"]


def test_default_loads_reach_to_where_the_last_window_seals(place):
    cells = [surface_of_seed(seed, 16) for seed in (1, 2, 3)]
    write_set(place / "coarse", cells)
    series = asked("leakage", place / "seal.toml", "--windows", place / "coarse", "--out", place / "all")["series"]
    sealed = [row["direct_x_sealed"] for row in series]
    assert sealed[0] == 0
    assert sealed[-1] == 1
    assert all(one <= two for one, two in itertools.pairwise(sealed))


def test_a_window_that_is_always_sealed_counts_in_the_fraction_of_sealed_windows(place):
    open_cells = [surface_of_seed(seed, 16) for seed in (2, 3, 4)]
    walled = open_cells[0].heights.copy()
    walled[:, 0] = walled[0, :] = walled.max() + 1e-7  # ridges along both axes touch first
    cells = [*open_cells, replace(open_cells[0], heights=walled)]
    write_set(place / "walled", cells)
    asking = ("leakage", place / "seal.toml", "--windows", place / "walled", "--loads", "10kPa")
    quantities = asked(*asking, "--out", place / "few")["quantities"]
    assert quantities["sealed"]["value"] == 0.25
    assert 0 <= quantities["leakage_per_width"]["in_series"] < 0.02 * quantities["leakage_per_width"]["value"]
    assert quantities["leakage_per_width"]["window_interval"][0] == 0


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (("--jobs", 2), "--jobs: got 2 without a set of windows"),
        (("--windows", "."), "holds no windows.json"),
        (("--windows", "seeds", "--jobs", 0), "--jobs: got 0"),
    ],
)
def test_wrong_options_are_refused_in_one_line(place, monkeypatch, options, message):
    monkeypatch.chdir(place)
    done = run("leakage", "seal.toml", "--out", "wrong", *options)
    assert done.exit_code == 2
    assert message in done.stderr


@pytest.mark.parametrize(("steeper", "outside"), [(1, False), (20, False), (40, True)])
def test_contacts_beyond_linear_elasticity_are_said_as_of_one_surface(place, steeper, outside):
    """The mean pressure of the contacts is outside the range; a few tips are a warning."""
    rough = [surface_of_seed(seed) for seed in (1, 2)]
    surfaces = [one.with_heights(steeper * one.heights) for one in rough]
    write_set(place / f"steep {steeper}", surfaces)
    save_surface(surfaces[1], place / f"steep {steeper}.h5")
    asking = ("leakage", place / "seal.toml", "--loads", "10kPa", "--out")
    of_set = asked(*asking, place / f"set {steeper}", "--windows", place / f"steep {steeper}")
    of_one = asked(*asking, place / f"one {steeper}", "--set", f"geometry.surface={place / f'steep {steeper}.h5'}")
    for found in (of_set, of_one):
        said = [one for one in found["provenance"]["warnings"] if "0.3 E*" in one]
        assert len(said) == (steeper > 1)
        assert all(("mean pressure of the contacts" in one) == outside for one in said)
        assert bool(found["outside"]) == outside
    assert of_set["series"][0]["pressure_max"] >= of_one["series"][0]["pressure_max"]
