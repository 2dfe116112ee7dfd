"""Finite elements of a gap between ridges, against the mesh-free solution and the theory of thin films."""

import numpy as np
import pytest

from roughfilm.ladder import find
from roughfilm.rom.ladder.scene import load_scene, read_scene
from roughfilm.rom.rough_gap.flow.exact import ridge_flow
from scripts.studies.coverage.truth import truth_of
from scripts.studies.coverage.truths.rough_gap import ridge_factors, thin_film_factors

X = 2 * np.pi * np.arange(64) / 64


@pytest.mark.parametrize(
    ("lower", "upper", "period"),
    [
        (-0.3 * np.cos(X), np.ones(64), 5.0),
        (-0.5 * np.cos(X) + 0.1 * np.sin(2 * X), np.ones(64), 3.0),
        (0.2 * np.sin(X), 1 + 0.3 * np.cos(X), 4.0),
    ],
)
def test_finite_elements_and_growing_bases_agree(lower, upper, period):
    exact = ridge_flow(lower, upper, period, tolerance=1e-6)
    found = ridge_factors(lower, upper, period, 8)
    assert found["A11"] == pytest.approx(exact.across, rel=2e-4)
    assert found["A22"] == pytest.approx(exact.along, rel=2e-4)
    if np.ptp(upper) == 0:
        assert found["B1"] == pytest.approx(exact.drag, rel=2e-4)
        assert found["friction"] == pytest.approx(exact.friction, rel=2e-4)


def test_long_ridges_are_a_thin_film():
    lower, upper = -0.3 * np.cos(X), np.ones(64)
    thin = thin_film_factors(lower, upper)
    assert thin["A11"] == pytest.approx((1 - 0.3**2) ** 2.5 / (1 + 0.3**2 / 2), rel=1e-9)
    found = ridge_factors(lower, upper, 100.0, 5)
    for name, value in thin.items():
        assert found[name] == pytest.approx(value, rel=1e-3)


def test_the_error_falls_with_the_fourth_power_of_the_cells():
    exact = ridge_flow(-0.3 * np.cos(X), np.ones(64), 5.0, tolerance=1e-7).across
    coarse, fine = (abs(ridge_factors(-0.3 * np.cos(X), np.ones(64), 5.0, rows)["A11"] - exact) for rows in (4, 8))
    assert coarse > 10 * fine


def test_the_slope_correction_covers_the_truth_of_ridges():
    kept = []
    for amplitude, wavelength in ((1, 60), (3, 50), (5, 100), (6, 25)):
        geometry = {"surface": "sinusoid", "amplitude": f"{amplitude} um", "wavelength": f"{wavelength} um"}
        scene = read_scene(
            {
                "name": "ridges",
                "kind": "rough_gap",
                "geometry": geometry | {"mean_gap": "10 um"},
                "lubricant": {"viscosity": "10 mPa*s", "density": "870 kg/m^3"},
                "flow": {"reynolds_number": 1e-3},
            }
        )
        truth, found = truth_of(scene), find("rough_gap", "slope_corrected").solve(scene)
        kept += [
            abs(found[name].value - value) <= found[name].uncertainty + truth.uncertainty[name]
            for name, value in truth.values.items()
        ]
    assert np.mean(kept) >= 0.85


def test_gaps_between_surfaces_have_the_limits_of_their_models_alone():
    found = truth_of(load_scene("scripts/examples/scenes/random_gap.toml"))
    assert found.values == {}
    assert {name for name, limits in found.own.items() if limits} >= {"smooth_gap", "homogenized"}
