"""``roughfilm combine``: numbers as JSON, a file that other commands read, and faults in one line."""

import json

import numpy as np
import pytest
from typer.testing import CliRunner

from roughfilm.cli.main import app
from roughfilm.contact.surfaces.files import read_surface
from roughfilm.contact.surfaces.store import save_surface
from roughfilm.contact.surfaces.surface import Surface


@pytest.fixture
def run():
    def call(*arguments):
        return CliRunner().invoke(app, ["combine", *map(str, arguments)])

    return call


@pytest.fixture
def pair(tmp_path):
    """Two windows of one surface, 5 and 3 pixels apart, the second with a pit."""
    rng = np.random.default_rng(991)
    waves = np.fft.rfft2(rng.normal(size=(96, 96)))
    q = np.hypot(np.fft.fftfreq(96)[:, None], np.fft.rfftfreq(96))
    heights = np.fft.irfft2(waves * (q < 0.15), s=(96, 96))
    heights = 1e-6 * heights / heights.std()
    after = heights[5:85, 3:83].copy()
    after[30:40, 30:42] -= 3e-6
    paths = tmp_path / "before.h5", tmp_path / "after.h5"
    for path, part in zip(paths, (heights[:80, :80], after), strict=True):
        save_surface(Surface(heights=part, spacing=(1e-6, 1e-6)), path)
    return paths


def test_wear_is_stated_as_json_and_stored(run, pair, tmp_path):
    done = run(*pair, "--json", "--out", tmp_path / "wear.h5")
    assert done.exit_code == 0, done.output
    message = json.loads(done.stdout)
    quantities = message["quantities"]
    assert quantities["shift_x"]["value"] == pytest.approx(5e-6, abs=1e-8)
    assert quantities["shift_y"]["value"] == pytest.approx(3e-6, abs=1e-8)
    assert quantities["largest_depth"]["value"] == pytest.approx(3e-6, rel=0.05)
    gone = quantities["worn_volume_per_area"]
    stored = read_surface(tmp_path / "wear.h5")
    assert gone["value"] == pytest.approx(120 * 3e-6 / stored.heights.size, rel=1e-3)
    assert stored.heights.mean() == pytest.approx(gone["value"], rel=1e-9)
    assert message["provenance"]["record"]["operation"] == "difference"


def test_walls_are_summed_for_other_commands(run, pair, tmp_path):
    done = run(*pair, "--operation", "sum", "--shift", "2um,1um", "--mirror", "none", "--out", tmp_path / "walls.h5")
    assert done.exit_code == 0, done.output
    assert "composite Sq" in done.stdout.splitlines()[-1] or "walls.h5" in done.stdout
    assert read_surface(tmp_path / "walls.h5").shape == (78, 79)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--shift", "5um"], "--shift: got '5um'; write two lengths, such as '5um,-2um', or 'registered'"),
        (["--shift", "5,3"], "--shift: got '5', a number without a unit"),
        (["--shift", "1mm,0um"], "registration: the surfaces overlap by 0 pixels along x"),
        (["--set", "s_filter=1mm"], "s_filter: got a nesting index of 0.001 m, longer than the shorter side"),
    ],
)
def test_faults_are_one_line(run, pair, options, message):
    done = run(*pair, *options)
    assert done.exit_code == 2
    assert message in " ".join(done.stderr.split())
    assert "Traceback" not in done.stderr


def test_equal_files_differ_by_zero_in_readable_numbers(run, pair):
    done = run(pair[0], pair[0])
    assert done.exit_code == 0, done.output
    assert "worn volume per area 0 m" in " ".join(done.stdout.split())
    assert "0.0000" not in done.stdout
