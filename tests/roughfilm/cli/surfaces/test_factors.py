"""roughfilm factors as people call it."""

import json
import os
import re
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
from typer.testing import CliRunner

from roughfilm.cli.main import app
from roughfilm.cli.surfaces import factors
from roughfilm.contact.mechanics.store import load_contact
from roughfilm.rom.bearing.mixed.asperity_table import AsperityTable
from roughfilm.rom.homogenization.table.store import load_table
from roughfilm.words.numbers import with_error

SURFACE = """
kind = "self_affine"
size = ["64 um", "64 um"]
points = [{points}, {points}]
seed = 20071
hurst = 0.8
roll_off = "16 um"
cut_off = "{cut}"
rms_height = "0.3 um"
"""


@pytest.fixture
def surface(tmp_path):
    path = tmp_path / "s.toml"
    path.write_text(SURFACE.format(points=32, cut="8 um"))
    return path


def run(*arguments):
    return CliRunner().invoke(app, ["factors", *map(str, arguments)], catch_exceptions=False)


def entries(*arguments):
    done = run(*arguments, "--json")
    assert done.exit_code == 0, done.stderr
    return json.loads(done.stdout)


def groove(path, *, turned=False):
    """Ridges across x, h = ĥ + a cos; the file holds heights, which are the other way up."""
    x = np.arange(64) / 64
    heights = np.tile(-0.5e-6 * np.cos(2 * np.pi * x)[:, None], (1, 8))
    np.save(path, heights.T if turned else heights)
    return path


def test_one_mean_gap_of_ridges_has_the_closed_form(tmp_path):
    file, a = groove(tmp_path / "g.npy"), 0.5
    found = entries(file, "--spacing", "1um,2um", "--gap", "1 um")["quantities"]
    exact = {"A11": (1 - a * a) ** 2.5 / (1 + a * a / 2), "A22": 1 + 1.5 * a * a, "A12": 0.0, "A21": 0.0, "B2": 0.0}
    exact["B1"] = (1 - a * a) / (1 + a * a / 2)
    for name, value in exact.items():
        assert abs(found[name]["value"] - value) <= found[name]["uncertainty"] + 1e-12, name
        assert found[name]["uncertainty"] < 0.01
        assert found[name]["unit"] == "1"
    assert found["mean_gap"] == {"value": pytest.approx(1e-6), "unit": "m"}


def test_the_harmonic_rule_is_exact_for_ridges(tmp_path):
    file, a = groove(tmp_path / "g.npy"), 0.5
    found = entries(file, "--spacing", "1um,2um", "--gap", "1um", "--rule", "harmonic")["quantities"]
    assert found["A11"]["value"] == pytest.approx((1 - a * a) ** 2.5 / (1 + a * a / 2), rel=1e-9)


def test_what_is_sealed_is_said(tmp_path):
    # Ridges that touch all along y: at a mean gap of a tenth of their height nothing passes in x.
    found = entries(groove(tmp_path / "g.npy"), "--spacing", "1um", "--gap", "0.2um")
    assert found["sealed_x"] is True
    assert found["sealed_y"] is False
    assert found["quantities"]["A11"]["value"] == found["quantities"]["B1"]["value"] == 0.0
    assert found["quantities"]["A22"]["value"] > 1
    turned = entries(groove(tmp_path / "t.npy", turned=True), "--spacing", "1um", "--gap", "0.2um")
    assert (turned["sealed_x"], turned["sealed_y"]) == (False, True)


def test_an_offset_opens_what_is_sealed(tmp_path):
    found = entries(groove(tmp_path / "g.npy"), "--spacing", "1um", "--gap", "0.2um", "--offset", "10nm")
    assert found["sealed_x"] is False
    assert found["quantities"]["A11"]["value"] > 0


def test_a_table_is_kept_and_gone_on_with(surface, tmp_path):
    out, page = tmp_path / "F.h5", tmp_path / "F.html"
    first = entries(surface, "--out", out, "--report", page)
    assert first["numerics"]["separations_found"] == 0
    assert first["quantities"]["interpolation_error"]["value"] <= 0.005
    table = load_table(out)
    assert len(table.points) == len(first["points"]) == first["numerics"]["separations"]
    assert all(point["A11"]["value"] <= 1 for point in first["points"])
    text = page.read_text()
    assert text.count("<svg") == 2
    assert "Where the flow goes" in text
    again = entries(surface, "--out", out)
    assert again["numerics"]["separations_found"] == again["numerics"]["separations"] == len(table.points)
    done = run(surface, "--out", out)
    assert "were solved before" in done.stderr


def test_a_looser_table_keeps_what_a_finer_one_found(surface, tmp_path):
    out = tmp_path / "F.h5"
    fine = entries(surface, "--out", out, "--tolerance", "0.002")["numerics"]["separations"]
    loose = entries(surface, "--out", out, "--tolerance", "0.05")["numerics"]
    assert loose["separations"] == loose["separations_found"] < fine
    assert len(load_table(out).points) == fine
    assert entries(surface, "--out", out, "--tolerance", "0.002")["numerics"]["separations_found"] == fine


def test_a_table_that_interpolation_cannot_hold_is_warned_of(tmp_path):
    random = np.random.default_rng(31)
    np.save(tmp_path / "levels.npy", 1e-6 * (random.normal(size=(24, 24)) > 0))
    found = entries(tmp_path / "levels.npy", "--spacing", "1um", "--tolerance", "0.0001")
    off = found["quantities"]["interpolation_error"]["value"]
    assert off <= 0.0001 or any("spikes and plateaus" in words for words in found["provenance"]["warnings"])


def pressed(surface, tmp_path, *more):
    steel = ["--modulus", "200GPa", "--poisson", "0.3", "--loads", "20MPa,200MPa,1GPa", "--out", tmp_path / "C.h5"]
    done = CliRunner().invoke(app, ["contact", *map(str, [surface, *steel, *more])], catch_exceptions=False)
    assert done.exit_code == 0, done.stderr
    return tmp_path / "C.h5"


def test_contacts_make_one_table_from_thick_films_to_the_greatest_load(surface, tmp_path):
    series, out, page = pressed(surface, tmp_path), tmp_path / "T.h5", tmp_path / "T.html"
    first = entries(series, "--out", out, "--tolerance", "0.05", "--report", page)
    loads = {point["load"] for point in first["points"]}
    assert {0.0, 2e7, 2e8, 1e9} <= loads
    table = AsperityTable(factors=load_table(out))
    assert table.largest_pressure == 1e9
    contact = load_contact(series, 2e8)
    alpha = contact.heights.max() - contact.heights.mean() - contact.approach
    assert table.contact_pressure(np.array([alpha])) == pytest.approx(2e8, rel=1e-9)
    assert "<h2>Contact pressure</h2>" in page.read_text()
    again = entries(series, "--out", out, "--tolerance", "0.05")["numerics"]
    assert again["separations_found"] == again["separations"] == len(table.factors.points)
    assert "MPa" in run(series, "--out", out, "--tolerance", "0.05").stdout


def test_contacts_that_make_no_table_are_refused_in_one_line(surface, tmp_path):
    series = pressed(surface, tmp_path)
    assert "leave --gap out" in run(series, "--gap", "1um").stderr
    series.unlink()
    assert "at 0 loads, by the model persson" in run(pressed(surface, tmp_path, "--model", "persson")).stderr
    series.unlink()
    assert "--boundary periodic" in run(pressed(surface, tmp_path, "--boundary", "free")).stderr
    data = bytearray(series.read_bytes())
    data[len(data) // 2] ^= 1
    series.write_bytes(data)
    done = run(series)
    assert done.exit_code == 2
    assert "was damaged" in done.stderr


def test_the_page_of_one_gap(surface, tmp_path):
    page = tmp_path / "G.html"
    found = entries(surface, "--gap", "0.5um", "--report", page)["quantities"]
    text = page.read_text()
    assert text.count("<svg") == 1
    first = text[text.index("<h1>") : text.index("<h2>")]
    assert "At a mean gap of 0.5 µm, a pressure gradient drives" in first
    for name in ("A11", "A22", "B1"):
        value = with_error(found[name]["value"], found[name]["uncertainty"])
        assert re.search(rf"<b>{value}</b><span>[^<]*<br>\(factor {name}\)", first)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["none.h5", "--gap", "1um"], "no such file"),
        (["SURFACE", "--gap", "1 s"], "--gap 1 s"),
        (["SURFACE", "--gap", "-1um"], "give a length of 1e-15 to 1e+06 m"),
        (["SURFACE", "--gap", "0um"], "give a length of 1e-15 to 1e+06 m"),
        (["SURFACE", "--gap", "1e200m"], "a length must be"),
        (["SURFACE", "--gap", "1um", "--tolerance", "0.1"], "--tolerance"),
        (["SURFACE", "--gap", "1um", "--out", "F.h5"], "leave it or --gap out"),
        (["SURFACE", "--offset", "10nm"], "give --gap"),
        (["SURFACE", "--tolerance", "0"], "--tolerance"),
        (["SURFACE", "--spacing", "1um"], "says its spacing itself; leave it out"),
        (["SURFACE", "--report", "SURFACE"], "SURFACE"),
        (["PROFILE", "--spacing", "1um", "--gap", "1um"], "is a profile"),
        (["ARRAY", "--gap", "1um"], "--spacing: array.npy holds none"),
        (["FLAT", "--spacing", "1um"], "all the same"),
        (["HOLES", "--spacing", "1um", "--gap", "1um"], "invalid"),
    ],
)
def test_bad_input_is_one_line(surface, tmp_path, monkeypatch, arguments, words):
    monkeypatch.chdir(tmp_path)
    np.save("profile.npy", np.arange(9.0)[:, None] * 1e-7)
    np.save("array.npy", np.random.default_rng(3).normal(size=(8, 8)) * 1e-7)
    np.save("flat.npy", np.ones((8, 8)))
    np.save("holes.npy", np.where(np.eye(8) > 0, np.nan, 1e-7))
    files = {
        "SURFACE": surface,
        "PROFILE": "profile.npy",
        "ARRAY": "array.npy",
        "FLAT": "flat.npy",
        "HOLES": "holes.npy",
    }
    done = run(*[files.get(argument, argument) for argument in arguments])
    assert done.exit_code == 2
    lines = [line for line in done.stderr.splitlines() if not line.startswith("warning")]
    assert len(lines) == 1
    assert words.replace("SURFACE", "s.toml") in lines[0]


def test_an_interrupted_table_keeps_its_points_and_goes_on(surface, tmp_path, monkeypatch):
    out, new = tmp_path / "F.h5", []
    tabulate = factors.tabulate

    def interrupted(*arguments, keep, **options):
        def stop_after_two(point):
            if len(new) == 2:
                raise KeyboardInterrupt
            new.append(point)
            keep(point)

        return tabulate(*arguments, keep=stop_after_two, **options)

    monkeypatch.setattr(factors, "tabulate", interrupted)
    stopped = run(surface, "--out", out)
    assert stopped.exit_code == 128 + signal.SIGINT
    assert "stopped: 2 points; the same command goes on" in stopped.stderr
    assert {point.mean_gap for point in load_table(out).points} == {point.mean_gap for point in new}
    monkeypatch.undo()
    assert entries(surface, "--out", out)["numerics"]["separations_found"] == 2
    assert sorted(os.listdir(tmp_path)) == ["F.h5", "s.toml"]


def test_a_terminated_table_leaves_a_whole_file(tmp_path):
    path, out = tmp_path / "s.toml", tmp_path / "F.h5"
    path.write_text(SURFACE.format(points=64, cut="4 um"))
    command = [sys.executable, "-m", "roughfilm.cli.main", "factors", path, "--out", out, "--tolerance", "0.0002"]
    with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as running:
        while running.poll() is None and not out.exists():
            time.sleep(0.05)
        running.terminate()
    assert running.returncode in (0, 128 + signal.SIGTERM, -signal.SIGTERM)
    assert len(load_table(out).points) > 1
    assert sorted(os.listdir(tmp_path)) == ["F.h5", "s.toml"]
