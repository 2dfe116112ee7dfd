"""``roughfilm contact``: what it prints, what it writes, how it goes on, and how it fails."""

import json
import os
import re
import signal
import subprocess
import sys
import time

import h5py
import numpy as np
import pytest
from empty_figures import ABSENT
from typer.testing import CliRunner

from roughfilm.cli.main import app
from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.contact.foundation.files import locked
from roughfilm.contact.mechanics.press import Press
from roughfilm.contact.mechanics.store import load_series
from roughfilm.contact.read import parse_spacing
from roughfilm.contact.surfaces.store import save_surface
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.figures.rendering import probe
from roughfilm.terminal.ranges import loads_of
from roughfilm.words.numbers import with_error

STEEL = ("--modulus", "210GPa", "--poisson", "0.3")
PLASTIC = (*STEEL, "--hardness", "4GPa")
NUMBERS = {"load", "area_fraction", "area_fraction_pixel", "plastic_fraction", "mean_gap", "approach"}
NUMBERS |= {"complementarity", "iterations", "pressure_max", "cpu_s"}


@pytest.fixture(autouse=True)
def _without_pictures(monkeypatch):
    """VTK takes most of the time; one test looks at its picture."""
    monkeypatch.setattr("roughfilm.figures.spatial.pressed_surface.draw_apart", lambda *_: ABSENT)


def run(*arguments):
    return CliRunner().invoke(app, ["contact", *map(str, arguments)])


def stated(*arguments):
    done = run(*arguments, "--json")
    assert done.exit_code == 0, done.output
    return json.loads(done.stdout)


@pytest.fixture
def rough(tmp_path):
    """A periodic surface of 32 x 24 points."""
    rng = np.random.default_rng(5320)
    spectrum = np.fft.rfft2(rng.normal(size=(32, 24)))
    spectrum[:, 6:] = 0
    spectrum[6:-6] = 0
    heights = np.fft.irfft2(spectrum, s=(32, 24))
    path = tmp_path / "s.h5"
    save_surface(Surface(heights=heights / heights.std() * 2e-7, spacing=(1e-6, 1e-6), periodic=True), path)
    return path


@pytest.fixture
def wave(tmp_path):
    """A cosine of amplitude D along a line of length L, as heights alone."""
    path = tmp_path / "wave.npy"
    np.save(path, 1e-7 * np.cos(2 * np.pi * np.arange(2048) / 2048))
    return path


def test_a_wave_opens_as_westergaard_said(wave):
    """h = D cos 2πx/L: sin²(πa/L) = P/p*, p* = πE*D/L, mean gap 2D (cos²ψ/2 + sin²ψ ln sin ψ), ψ = πa/L."""
    stiffness = 1 / ((1 - 0.3**2) / 210e9 + (1 - 0.2**2) / 70e9)
    full = np.pi * stiffness * 1e-7 / (2048 * 0.5e-6)
    answer = stated(
        wave, *STEEL, "--counter-modulus", "70GPa", "--counter-poisson", "0.2", "--spacing", "0.5um",
        "--loads", f"{0.1 * full!r}Pa,{0.3 * full!r}Pa",
    )  # fmt: skip
    for row, part in zip(answer["series"], (0.1, 0.3), strict=True):
        psi = np.arcsin(np.sqrt(part))
        assert row["load"] == pytest.approx(part * full, rel=1e-12)
        assert row["area_fraction"] == pytest.approx(2 * psi / np.pi, abs=1.5 / 2048)
        gap = 2e-7 * (np.cos(psi) ** 2 / 2 + np.sin(psi) ** 2 * np.log(np.sin(psi)))
        assert row["mean_gap"] == pytest.approx(gap, rel=1e-5)
        assert row["pressure_max"] == pytest.approx(2 * full * np.sin(psi), rel=1e-3)
        assert row["plastic_fraction"] == 0
    assert answer["quantities"]["composite_modulus"] == {"value": pytest.approx(stiffness, rel=1e-12), "unit": "Pa"}
    assert answer["provenance"]["settings"]["model"] == "elastic"


def test_json_is_one_object_with_every_number_of_every_load(rough):
    answer = stated(rough, *PLASTIC, "--loads", "50MPa..2GPa:4")
    assert set(answer) == {"series", "units", "quantities", "numerics", "outside", "provenance"}
    assert [row["load"] for row in answer["series"]] == pytest.approx([5e7, 170997594.7, 584803547.6, 2e9])
    assert all(set(row) == NUMBERS for row in answer["series"])
    assert set(answer["units"]) == NUMBERS
    assert answer["units"]["mean_gap"] == "m"
    areas = [row["area_fraction_pixel"] for row in answer["series"]]
    assert areas == sorted(areas)
    for row in answer["series"]:
        assert row["complementarity"] <= 1e-8
        assert row["area_fraction_pixel"] * 4e9 >= row["load"]
        assert row["pressure_max"] <= 4e9
    last = answer["series"][-1]
    gap = answer["quantities"]["mean_gap"]
    assert gap["value"] == last["mean_gap"]
    assert 0 < gap["uncertainty"] < 0.1 * gap["value"]
    index = answer["quantities"]["plasticity_index"]["value"]
    assert index == pytest.approx(last["plastic_fraction"] / last["area_fraction_pixel"])
    assert answer["numerics"]["residual"] == max(row["complementarity"] for row in answer["series"])
    assert answer["provenance"]["settings"]["hardness"] == 4e9


def test_the_file_holds_fields_that_balance_the_load(rough, tmp_path):
    answer = stated(rough, *PLASTIC, "--loads", "0.1..1GPa:3", "--out", tmp_path / "c.h5")
    with h5py.File(tmp_path / "c.h5") as file:
        assert file["series/area_fraction"][()] == pytest.approx([row["area_fraction"] for row in answer["series"]])
        for row in answer["series"]:
            group = file[f"loads/{row['load']!r}"]
            pressure, gap = group["pressure"][()], group["gap"][()]
            assert pressure.mean() == pytest.approx(row["load"], rel=1e-12)
            assert np.all((pressure == 0) | (gap == 0))
            assert np.count_nonzero(pressure == 4e9) == row["plastic_fraction"] * pressure.size


def test_loads_in_the_file_are_not_solved_again(rough, tmp_path, monkeypatch):
    out = tmp_path / "c.h5"
    first = stated(rough, *PLASTIC, "--loads", "100MPa,1GPa", "--out", out)["series"]
    solve, loads = Press.at, []

    def counted(self, load, **options):
        loads.append((load, options["start"].load))
        return solve(self, load, **options)

    monkeypatch.setattr(Press, "at", counted)
    done = run(rough, *PLASTIC, "--loads", "100,300,1000MPa", "--out", out, "--json", "--report", tmp_path / "c.html")
    second = json.loads(done.stdout)
    assert loads == [(3e8, 1e8)]
    assert "2 of 3 loads were solved before" in done.stderr
    assert second["numerics"]["loads_found"] == 2
    assert [second["series"][0], second["series"][2]] == first
    run(rough, *STEEL, "--hardness", "5GPa", "--loads", "200MPa..300MPa:2", "--model", "elastic_plastic", "--json")
    assert len(loads) == 1


@pytest.mark.parametrize("model", ["elastic_plastic", "persson"])
def test_another_series_is_never_written_over(rough, tmp_path, model):
    out = tmp_path / "c.h5"
    stated(rough, *PLASTIC, "--loads", "1GPa", "--out", out)
    before = out.read_bytes()
    done = run(rough, *STEEL, "--hardness", "3GPa", "--loads", "1GPa", "--out", out, "--model", model)
    assert done.exit_code == 2
    assert "holds another series, with hardness" in done.stderr
    assert out.read_bytes() == before
    assert sorted(os.listdir(tmp_path)) == ["c.h5", "s.h5"]


def test_two_series_into_one_file_are_kept_apart(rough, tmp_path):
    out = tmp_path / "c.h5"
    with locked(tmp_path / ".c.h5.lock", "held"):
        holder = subprocess.Popen(
            [sys.executable, "-m", "roughfilm.cli.main", "contact", rough, *PLASTIC, "--loads", "1GPa", "--out", out],
            stderr=subprocess.PIPE,
            text=True,
        )
        _, errors = holder.communicate(timeout=60)
    assert holder.returncode == 2
    assert errors.strip() == (
        f"error: --out {out}: another series goes into it (process {os.getpid()}); wait for it or choose another place"
    )
    assert not out.exists()


def test_a_row_of_heights_has_its_points_along_y(tmp_path):
    heights = np.random.default_rng(5323).normal(scale=1e-7, size=64)
    np.save(tmp_path / "row.npy", heights[None, :])
    np.save(tmp_path / "line.npy", heights)
    row = stated(tmp_path / "row.npy", *STEEL, "--loads", "100MPa", "--spacing", "1um,2um")
    line = stated(tmp_path / "line.npy", *STEEL, "--loads", "100MPa", "--spacing", "2um")
    assert row["series"][0]["mean_gap"] == line["series"][0]["mean_gap"]


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (("--loads", "1MPa..1.0000000000000004MPa:6"), "too close for 6"),
        (("--loads", "1MPa..1GPa:" + "9" * 5000), "how many loads, 2 to 1000"),
        (("--loads", "1e-300Pa"), "check the unit"),
        (("--loads", "1MPa", "--hardness", ""), "--hardness"),
        (("--loads", "1.0000001GPa", "--hardness", "1GPa"), "up to 1000.0001 MPa"),
    ],
)
def test_what_makes_no_sense_is_one_line(rough, options, words):
    done = run(rough, *STEEL, *options)
    assert done.exit_code == 2
    assert words in done.stderr
    assert len(done.stderr.strip().splitlines()) == 1


def test_a_surface_that_is_a_pipe_or_not_there_is_one_line(tmp_path):
    os.mkfifo(tmp_path / "pipe.npy")
    for name, words in (("pipe.npy", "pipe.npy"), ("none.toml", "no such file"), ("a" * 300 + ".npy", "too long")):
        done = run(tmp_path / name, *STEEL, "--loads", "1MPa", "--spacing", "1um")
        assert done.exit_code == 2
        assert words in done.stderr
        assert "standard output" not in done.stderr


def test_a_load_that_fails_keeps_those_before(rough, tmp_path, monkeypatch):
    solve = Press.at

    def fails(self, load, **options):
        if load > 5e8:
            raise ConvergenceError("contact: stalled")
        return solve(self, load, **options)

    monkeypatch.setattr(Press, "at", fails)
    done = run(rough, *PLASTIC, "--loads", "100MPa,400MPa,1GPa", "--out", tmp_path / "c.h5")
    assert done.exit_code == 3
    assert done.stderr.strip() == "error: at 1000 MPa: contact: stalled"
    with h5py.File(tmp_path / "c.h5") as file:
        assert list(file["series/load"]) == [1e8, 4e8]


def test_killed_at_any_moment_it_goes_on(tmp_path):
    heights = np.random.default_rng(5322).normal(scale=1e-7, size=(128, 128))
    np.save(tmp_path / "s.npy", heights)
    out = tmp_path / "c.h5"
    arguments = ["contact", str(tmp_path / "s.npy"), "--spacing", "1um", *PLASTIC, "--loads", "10MPa..3GPa:400"]
    command = [sys.executable, "-m", "roughfilm.cli.main", *arguments, "--out", str(out), "--json"]
    with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as started:
        deadline = time.monotonic() + 60
        while not out.exists() and time.monotonic() < deadline and started.poll() is None:
            time.sleep(0.02)
        time.sleep(0.1)
        started.send_signal(signal.SIGKILL)
    _, kept = load_series(out)
    with h5py.File(out) as file:
        assert file["series/load"][()].tolist() == list(kept)
    assert 1 <= len(kept) < 400
    answer = stated(tmp_path / "s.npy", "--spacing", "1um", *PLASTIC, "--loads", f"{kept[-1]!r}Pa", "--out", out)
    assert answer["numerics"]["loads_found"] == 1
    assert sorted(os.listdir(tmp_path)) == ["c.h5", "s.npy"]


def test_people_get_a_table_and_a_page(rough, tmp_path):
    done = run(rough, *STEEL, "--hardness", "40GPa", "--loads", "100MPa,4GPa", "--report", tmp_path / "page.html")
    assert done.exit_code == 0
    assert re.search(r"^\s+100\s", done.stdout, re.MULTILINE)
    assert f"written: {tmp_path / 'page.html'}" in done.stdout
    page = (tmp_path / "page.html").read_text()
    assert page.count("<svg") == 5
    for title in ("Area", "Mean gap", "Pressure and gap at 4000 MPa", "Section at 4000 MPa", "Pressures", "Results"):
        assert f"<h2>{title}</h2>" in page
    assert not re.search(r'(src|href)="http', page)


def test_the_page_begins_with_area_and_gap_at_the_asked_loads(rough, tmp_path):
    answer = stated(rough, *PLASTIC, "--loads", "100MPa,1GPa", "--report", tmp_path / "page.html")
    page = (tmp_path / "page.html").read_text()
    first = page[page.index("<h1>") : page.index("<h2>")]
    last = answer["quantities"]
    area, gap = (
        with_error(*(factor * last[name][number] for number in ("value", "uncertainty")))
        for name, factor in (("area_fraction", 100), ("mean_gap", 1e6))
    )
    assert f"<b>{area} %</b>" in first
    assert f"mean gap {gap} µm" in first
    assert [first.count(f"in contact at {load} MPa") for load in (100, 1000)] == [1, 1]
    assert not re.search(r"\d [kG]Pa", first.replace("modulus E* 230.8 GPa", "").replace("hardness 4 GPa", ""))


def test_the_surface_is_pictured_under_its_loads(rough, monkeypatch, tmp_path):
    monkeypatch.undo()
    page = tmp_path / "page.html"
    assert run(rough, *STEEL, "--loads", "100MPa,4GPa", "--report", page).exit_code == 0
    assert ("data:image/png" in page.read_text()) == probe().available


def test_the_page_of_a_line_has_a_profile_and_no_map(wave, tmp_path):
    assert run(wave, *STEEL, "--spacing", "1um", "--loads", "10MPa", "--report", tmp_path / "p.html").exit_code == 0
    page = (tmp_path / "p.html").read_text()
    assert "<h2>Profile at 10 MPa</h2>" in page
    assert page.count("<svg") == 2


@pytest.mark.parametrize("model", ["persson", "greenwood_williamson", "bearing_area"])
def test_statistical_rungs_state_what_they_can(rough, tmp_path, model):
    out = tmp_path / "c.h5"
    answer = stated(
        *(rough, *PLASTIC, "--loads", "40MPa,400MPa", "--model", model), "--out", out, "--report", tmp_path / "p.html"
    )
    row = answer["series"][0]
    assert row["complementarity"] is row["approach"] is row["iterations"] is None
    assert (row["mean_gap"] is None) == (model == "persson")
    with h5py.File(out) as file:
        assert list(file["series/load"]) == [4e7, 4e8]
    if model == "bearing_area":
        assert row["area_fraction"] == pytest.approx(0.01, rel=1e-12)
        assert row["plastic_fraction"] == pytest.approx(0.01, rel=1e-12)


def test_the_older_algorithm_finds_the_same_contact(rough):
    rows = [
        stated(rough, *PLASTIC, "--loads", "345MPa", "--model", m)["series"][0]
        for m in ("stanley_kato", "elastic_plastic")
    ]
    for name in ("area_fraction", "plastic_fraction", "mean_gap", "approach"):
        assert rows[0][name] == pytest.approx(rows[1][name], rel=1e-6), name
    assert rows[0]["iterations"] > rows[1]["iterations"]


def test_invalid_points_and_steps_at_the_edges_are_told(tmp_path):
    heights = np.random.default_rng(5323).normal(scale=1e-8, size=(40, 40)) + 1e-8 * np.arange(40)[:, None]
    np.save(tmp_path / "tilted.npy", heights)
    arguments = (tmp_path / "tilted.npy", *STEEL, "--spacing", "1um", "--loads", "100MPa", "--json")
    done = run(*arguments)
    assert done.exit_code == 0
    assert "is not periodic (mismatch" in done.stderr
    assert "roughfilm surface" in done.stderr
    assert json.loads(done.stdout)["provenance"]["warnings"]
    assert run(*arguments, "--boundary", "free").stderr == ""
    heights[3, 4] = np.nan
    np.save(tmp_path / "tilted.npy", heights)
    done = run(*arguments)
    assert done.exit_code == 2
    assert "has 1 invalid points; fill them: roughfilm surface" in done.stderr


def test_a_measured_file_is_pressed_with_a_warning(tmp_path):
    rows = np.random.default_rng(5324).normal(size=(16, 16))
    text = "# spacing: 1 um, 1 um; heights: nm\n" + "\n".join(",".join(map(str, row)) for row in rows)
    (tmp_path / "s.csv").write_text(text)
    done = run(tmp_path / "s.csv", *STEEL, "--loads", "100MPa")
    assert done.exit_code == 0
    assert "is taken as it was measured" in done.stderr


BAD = [
    (("--loads", "1MPa..1GPa"), "a range ends with how many loads"),
    (("--loads", "1GPa..1MPa:3"), "the first of a range must be below the last"),
    (("--loads", "5"), "a number without a unit"),
    (("--loads", "5 um"), "wrong dimension"),
    (("--loads", "1MPa,,2MPa"), "a load is missing"),
    (("--loads", "0Pa"), "a load must be above 0"),
    (("--loads", "1MPa,5GPa"), "1 of 2, up to 5000 MPa, are above the hardness of 4000 MPa"),
    (("--modulus", "210"), "--modulus 210.* a number without a unit"),
    (("--modulus", "-210GPa"), "--modulus: got -2.1e\\+11 Pa"),
    (("--poisson", "0.7"), "--poisson: got 0.7"),
    (("--counter-modulus", "70GPa"), "--counter-poisson: is missing"),
    (("--counter-modulus", "0Pa", "--counter-poisson", "0.3"), "--counter-modulus: got 0 Pa"),
    (("--spacing", "1um"), "says its spacing itself"),
    (("--spacing", "1kg"), "wrong dimension"),
    (("--tolerance", "0"), "tolerance of 0"),
    (("--tolerance", "nan"), "tolerance of nan"),
    (("--threads", "0"), "0 threads"),
    (("--threads", "100000"), "it must be 1 to 256"),
    (("--boundary", "free", "--model", "persson"), "persson has no edges"),
    (("--report", "/proc/nowhere/page.html"), "cannot be written"),
]


@pytest.mark.parametrize(("options", "message"), BAD)
def test_a_bad_request_is_one_line_before_anything_is_solved(rough, tmp_path, monkeypatch, options, message):
    monkeypatch.setattr(Press, "_search", lambda *_: pytest.fail("it was solved"))
    out = tmp_path / "c.h5"
    done = run(rough, *PLASTIC, "--loads", "1MPa", "--out", out, "--json", *options)
    assert done.exit_code == 2
    assert done.stdout == ""
    assert len(done.stderr.strip().splitlines()) == 1
    assert re.search(message, done.stderr)
    assert not out.exists()


def test_models_that_need_a_hardness_say_so(rough):
    for model in ("elastic_plastic", "bearing_area"):
        done = run(rough, *STEEL, "--loads", "1MPa", "--model", model)
        assert done.exit_code == 2
        assert f"--hardness: {model} needs one" in done.stderr


def test_no_output_replaces_an_input(rough, tmp_path):
    before = rough.read_bytes()
    for options in (("--out", rough), ("--report", rough), ("--out", tmp_path / "a", "--report", tmp_path / "a")):
        done = run(rough, *STEEL, "--loads", "1MPa", *options)
        assert done.exit_code == 2
        assert "is the same file as" in done.stderr
    assert rough.read_bytes() == before
    assert os.listdir(tmp_path) == ["s.h5"]


def test_an_array_without_spacing_is_refused(wave):
    done = run(wave, *STEEL, "--loads", "1MPa")
    assert done.exit_code == 2
    assert f"--spacing: {wave} holds none" in done.stderr


def test_ranges_of_loads():
    assert loads_of("1MPa..1GPa:4") == (1e6, pytest.approx(1e7), pytest.approx(1e8), 1e9)
    assert loads_of("1..100 MPa:3") == (1e6, pytest.approx(1e7), 1e8)
    assert loads_of("1e1..1e3 kPa:2") == (1e4, 1e6)
    assert loads_of("5MPa, 200 kPa,5MPa") == (2e5, 5e6)
    assert loads_of("7bar") == (7e5,)
    assert parse_spacing("1um") == (1e-6, 1e-6)
    assert parse_spacing("1um, 2 nm") == (1e-6, 2e-9)
    with pytest.raises(InputError, match="one length above 0 or two"):
        parse_spacing("1um,2um,3um")


def test_a_peak_pressure_beyond_linear_elasticity_is_said_for_each_load(tmp_path):
    """At W = π E* Δ/λ a wave is flat, with the peak 2 W (Westergaard 1939): above 0.3 E* for Δ/λ = 0.05."""
    wave = np.cos(2 * np.pi * np.arange(64) / 64)
    np.save(tmp_path / "wave.npy", 0.05 * 64e-6 * np.outer(wave, np.ones(8)))
    flat = np.pi * 0.05 * 1e9
    given = (tmp_path / "wave.npy", "--spacing", "1um", "--modulus", "1GPa", "--poisson", "0")
    answer = stated(given[0], *given[1:], "--loads", f"{0.1 * flat}Pa,{1.0001 * flat}Pa")
    assert [row["pressure_max"] > 0.3e9 for row in answer["series"]] == [False, True]
    assert answer["outside"] == [
        "peak pressure 314.2 MPa exceeds 0.3 E* = 300 MPa, beyond which linear elasticity does not hold"
    ]
    assert "at 1 of 2 points: 157.1 MPa" in answer["provenance"]["warnings"][0]
