"""Truths by finer grids, against exact solutions."""

import signal

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import ConvergenceError
from roughfilm.ladder import find
from roughfilm.rom.ladder.scene import read_scene
from scripts.studies.coverage import finer
from scripts.studies.coverage.answering import answers, judged_resolution
from scripts.studies.coverage.finer import finer_runs, finer_truth, on_finer_surface
from scripts.studies.coverage.surfaces import SIDE, in_file

WEDGE = {
    "name": "wedge",
    "kind": "bearing",
    "geometry": {"shape": "linear", "length": "10 mm", "film": "10 um", "rise": "10 um"},
    "lubricant": {"viscosity": "0.01 Pa*s", "cavitation_pressure": "-1 MPa"},
    "motion": {"speed": "1 m/s"},
}
"""An infinitely wide wedge of h₁/h₂ = 2, whose film does not rupture."""


def wedge_load() -> float:
    """Load per width of the wedge, N/m: 6ηuL²/h₂² (ln k - 2 (k - 1)/(k + 1))/(k - 1)², k = h₁/h₂."""
    k = 2.0
    return 6 * 0.01 * 1.0 * (10e-3 / 10e-6) ** 2 * (np.log(k) - 2 * (k - 1) / (k + 1)) / (k - 1) ** 2


def test_the_truth_of_a_wedge_is_the_closed_form():
    found = finer_truth(read_scene(WEDGE))
    value, bar = found.own["reynolds"]["load_per_width"]
    assert value == pytest.approx(wedge_load(), rel=1e-6)
    assert abs(value - wedge_load()) <= bar
    assert found.values["load_per_width"] == found.own["reynolds_cavitating"]["load_per_width"][0]
    assert found.own.keys() == answers(read_scene(WEDGE)).keys()
    judged, *finest = found.finer["reynolds"].values()
    assert abs(finest[-1]["load_per_width"] - value) < abs(judged["load_per_width"] - value)


def test_finer_solutions_stop_at_smaller_residuals(monkeypatch):
    """Flows agree to 1e-12 on all grids of some films; errors of the iteration would then look like those of grids."""
    tolerances = {}

    def collect(_scene, model, solve):
        runs = [solve(model, factor) for factor in (1, 2, 4)]
        tolerances[model.name] = [run.numerics.tolerance for run in runs[:2]]
        return runs

    monkeypatch.setattr(finer, "finer_runs", collect)
    finer_truth(read_scene(WEDGE))
    for name, (judged, fine) in tolerances.items():
        assert judged == find("bearing", name).tolerance
        assert fine <= judged / 100


def test_a_model_that_fails_on_finer_grids_has_no_truth(monkeypatch):
    scene = read_scene(WEDGE)

    def fail(_model, _factor):
        raise ConvergenceError("no")

    assert finer_runs(scene, find("bearing", "reynolds"), fail) == []
    monkeypatch.setattr(finer, "MAX_NEEDED_S", 0.0)
    with pytest.raises(ConvergenceError, match="finer grids"):
        finer_truth(scene)


def test_a_solution_that_takes_too_long_is_given_up():
    def work_on():
        with finer.limited(0.05):
            while True:
                pass

    with pytest.raises(ConvergenceError, match=r"more than 0\.05 s"):
        work_on()
    with finer.limited(10):
        pass
    assert signal.getitimer(signal.ITIMER_VIRTUAL)[0] == 0


def test_a_scene_is_judged_at_one_resolution():
    model, wide = find("bearing", "reynolds_cavitating"), read_scene(WEDGE)
    assert judged_resolution(model, wide) == model.resolution_of(wide)
    narrow = read_scene({**WEDGE, "geometry": {**WEDGE["geometry"], "width": "10 mm"}})
    judged = judged_resolution(model, narrow)
    assert judged in (32, 64, 256)
    assert judged == answers(narrow)["reynolds_cavitating"].resolution


def test_the_truth_of_a_wavy_gap_is_the_closed_form():
    """Across ridges A = 1/<h⁻³>, along them A = <h³>, over the cube of the mean gap."""
    x = 2 * np.pi * np.arange(32) / 32
    wave = np.repeat(0.3e-5 * np.cos(x)[:, None], 4, axis=1)
    scene = read_scene(
        {
            "name": "ridges",
            "kind": "rough_gap",
            "geometry": {**in_file(wave, (SIDE / 32, SIDE / 32)), "mean_gap": "10 um"},
            "lubricant": {"viscosity": "0.01 Pa*s", "density": "870 kg/m^3"},
            "flow": {"reynolds_number": 1e-3},
        }
    )
    found = on_finer_surface(scene).own["homogenized"]
    a = 0.3
    exact = {"A11": (1 - a**2) ** 2.5 / (1 + a**2 / 2), "A22": 1 + 1.5 * a**2}
    for name, value in exact.items():
        assert found[name][0] == pytest.approx(value, abs=max(found[name][1], 1e-9))
        assert found[name][1] < 1e-3
