"""The uncertainty by the pixels against an exact solution and against finer pixels of the same surface."""

import numpy as np
import pytest

from roughfilm.contact.mechanics.discretisation import uncertainties
from roughfilm.contact.mechanics.exact.westergaard import Westergaard
from roughfilm.contact.mechanics.press import Press
from roughfilm.contact.synthetic.self_affine import self_affine


def errors_over_uncertainty(contact, truth):
    stated = uncertainties(contact)
    own = {**{name: getattr(contact, name) for name in stated if name != "pressure_max"}}
    own["pressure_max"] = float(contact.pressure.max())
    return {name: abs(own[name] - truth[name]) / stated[name] for name in truth if stated[name]}


def test_it_covers_the_error_of_a_wave_anywhere_on_the_grid():
    generator = np.random.default_rng(20260)
    found = {"area_fraction": [], "mean_gap": [], "approach": [], "pressure_max": []}
    for points in (16, 25, 40, 63, 100, 160):
        for ratio in (0.02, 0.1, 0.3, 0.6, 0.9):
            full = Westergaard(amplitude=0.01, wavelength=1.0, composite_modulus=1.0, load=1.0).full_contact_load
            exact = Westergaard(amplitude=0.01, wavelength=1.0, composite_modulus=1.0, load=ratio * full)
            wave = 0.01 * np.cos(2 * np.pi * (np.arange(points) + generator.random()) / points)
            contact = Press(np.outer(wave, np.ones(4)), (1 / points,) * 2, 1.0).at(exact.load)
            truth = {
                "area_fraction": exact.area_fraction,
                "mean_gap": exact.mean_gap,
                "approach": exact.approach,
                "pressure_max": float(exact.pressure(0.0)),
            }
            for name, ratio_of_errors in errors_over_uncertainty(contact, truth).items():
                found[name].append(ratio_of_errors)
    for name, ratios in found.items():
        assert np.mean(np.array(ratios) <= 1) >= 0.95, name
        assert max(ratios) <= 3, name
        assert np.median(ratios) >= 0.1, name


@pytest.mark.parametrize("hardness", [np.inf, 0.3, 0.05])
def test_it_covers_what_finer_pixels_change(hardness):
    """A synthetic surface is the same on every grid that resolves it; no factor is fitted to these surfaces."""
    ratios = []
    for seed, shortest in ((71, 3), (72, 4), (73, 6), (74, 9)):

        def pressed(points, seed=seed, shortest=shortest):
            surface = self_affine(
                size=(1e-3, 1e-3),
                points=(points, points),
                seed=seed,
                hurst=0.7,
                roll_off=1e-3 / 3,
                cut_off=shortest * 1e-3 / 64,
                rms_slope=0.1,
            )
            press = Press(surface.heights, surface.spacing, 1e11, hardness=hardness * 1e10)
            return press.at(min(0.02, 0.4 * hardness) * 1e10)

        finest, coarse = pressed(256), pressed(64)
        truth = {name: getattr(finest, name) for name in ("area_fraction", "plastic_fraction", "mean_gap", "approach")}
        ratios += errors_over_uncertainty(coarse, truth).values()
    assert np.mean(np.array(ratios) <= 1) >= 0.85
    assert max(ratios) <= 3
    assert np.median(ratios) >= 0.05


def test_it_covers_the_height_of_the_plane_of_smooth_plastic_contacts():
    """Their plane follows from the number of pixels above it, whose error does not vanish with the curvature."""
    ratios = []
    for seed in range(31, 38):

        def pressed(points, seed=seed):
            surface = self_affine(
                size=(1e-3, 1e-3),
                points=(points, points),
                seed=seed,
                hurst=0.7,
                roll_off=0.5e-3,
                cut_off=1e-3 / 3,
                rms_slope=0.1,
            )
            return Press(surface.heights, surface.spacing, 1e11, hardness=5e8).at(5e7)

        ratios.append(errors_over_uncertainty(pressed(48), {"mean_gap": pressed(192).mean_gap})["mean_gap"])
    assert np.mean(np.array(ratios) <= 1) >= 0.85
    assert np.median(ratios) >= 0.1


def test_a_flat_surface_has_no_error_by_its_pixels():
    assert not any(uncertainties(Press(np.zeros((8, 8)), (1e-6, 1e-6), 1e11).at(1e6)).values())


def test_plastic_pixels_that_may_appear_are_counted():
    wave = np.cos(2 * np.pi * np.arange(32) / 32)
    contact = Press(1e-6 * np.add.outer(wave, wave), (1e-6, 1e-6), 1e11, hardness=1e10).at(1e7)
    peak = float(contact.pressure.max())
    assert contact.plastic_fraction == 0
    nearly = Press(1e-6 * np.add.outer(wave, wave), (1e-6, 1e-6), 1e11, hardness=1.02 * peak).at(1e7)
    assert nearly.plastic_fraction == 0
    assert uncertainties(nearly)["plastic_fraction"] > 0
    assert uncertainties(nearly)["pressure_max"] > 0
