"""The page on averaged against followed roughness: what its numbers must say, and that it can be made."""

from pathlib import Path

import numpy as np
import pytest

from scripts.studies.scales import __main__ as scales
from scripts.studies.scales.data import Pair, WaveErrors, line, measured, over, pairs, slider, solve


@pytest.fixture(scope="module")
def across():
    return pairs(slider, "across", [2.0**-k for k in range(5, 9)], (0.0, 90.0, 180.0))


def test_the_film_is_that_of_the_source():
    x, _ = line(solve(slider(2.0**-3, 0.0), "homogenized"))
    film = solve(slider(2.0**-3, 0.0), "direct").fields["film_thickness"].values[:, 0]
    assert x[-1] == pytest.approx(0.1)
    assert film[0] == pytest.approx(5e-6)
    assert film.min() > 0.9 * 4e-6
    assert np.isclose(film[-1], 4e-6)


def test_opposite_phases_err_in_opposite_directions_and_cancel_to_second_order(across):
    sine, opposite = (np.array([pair.load for pair in across.pairs if pair.phase == phase]) for phase in (0.0, 180.0))
    left = np.abs(sine + opposite)
    assert np.log2(left[:-1] / left[1:]) == pytest.approx([2, 2, 2], abs=0.1)
    assert (np.sign(sine) == -np.sign(opposite)).all()


def test_errors_fall_in_proportion_to_the_waves_and_their_mean_over_phases_faster(across):
    assert across.rate("pressure") == pytest.approx(1, abs=0.05)
    assert across.rate("load") == pytest.approx(1, abs=0.05)
    opposite = WaveErrors(title="", pairs=tuple(pair for pair in across.pairs if pair.phase in (0.0, 180.0)))
    mean = opposite.mean("load")
    assert np.log2(mean[0] / mean[1]) == pytest.approx(2, abs=0.2)


def made(error):
    numbers = {"friction": 0.0, "cpu_direct": 2.0, "cpu_homogenized": 1.0, "uncertainty": 0.0}
    ratios = [2.0**-k for k in range(5, 9)]
    parts = [
        Pair(ratio=r, phase=0.0, pressure=error * r / ratios[-1], load=error * r / ratios[-1] / 3, **numbers)
        for r in ratios
    ]
    return WaveErrors(title="made", pairs=tuple(parts))


@pytest.mark.parametrize(("error", "verdict"), [(0.019, "true"), (0.025, "partly"), (0.04, "false")])
def test_the_claim_is_judged_by_its_numbers(error, verdict):
    claim = scales.judge(made(error))
    assert (claim.number, claim.verdict) == (13, verdict)


def test_the_claim_of_the_source_holds_here(across):
    assert scales.judge(across).verdict == "true"


def test_a_measured_surface_is_scaled_to_the_film(measured_file, tmp_path):
    source = measured_file("ground_striated.x3p")
    cell = measured(source.parent, tmp_path, points=32)
    scene = over(cell, 0.5, 0.0)
    assert scene.roughness.rms == pytest.approx(2e-6)
    assert scene.roughness.period == pytest.approx(10e-3)


def test_an_absent_surface_is_none(tmp_path):
    assert measured(None, tmp_path) is None
    assert measured(tmp_path, tmp_path) is None


def test_the_page_is_one_file(tmp_path, monkeypatch):
    for name, few in {"RATIOS": [2.0**-k for k in range(5, 9)], "IN_PLANE": [0.5, 0.25], "PHASES": (0.0,)}.items():
        monkeypatch.setattr(scales, name, few)
    scales.command(Path(tmp_path / "out"), as_json=True)
    page = (tmp_path / "out" / "scales.html").read_text(encoding="utf-8")
    assert page.count("<svg") == 2
    assert "ground_striated.x3p is not on this machine" in page
    assert (tmp_path / "out" / "scales.json").is_file()
