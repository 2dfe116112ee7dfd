"""Random surfaces in files, and the same surfaces at more points."""

from pathlib import Path

import numpy as np
import pytest

from roughfilm.contact.surfaces.store import load_surface
from scripts.studies.coverage.drawing import drawn
from scripts.studies.coverage.surfaces import drawn_surface, in_file, padded, refined, rms_slope


def test_a_finer_surface_goes_through_the_same_points_without_new_waves():
    heights = drawn_surface(np.random.default_rng(1), 48, 8)
    fine = padded(heights, 2)
    assert fine[::2, ::2] == pytest.approx(heights, abs=1e-12)
    waves = np.abs(np.fft.fft2(fine))
    number = np.abs(np.fft.fftfreq(96) * 96)
    assert waves[np.maximum.outer(number, number) > 6].max() < 1e-9 * waves.max()
    assert rms_slope(fine) == pytest.approx(rms_slope(heights), rel=1e-12)


def test_padding_keeps_the_shape_of_a_profile():
    x, fine_x = (2 * np.pi * np.arange(n) / n for n in (16, 64))
    profile = np.repeat(np.cos(3 * x + 0.4)[:, None], 4, axis=1)
    assert padded(profile, 4) == pytest.approx(np.repeat(np.cos(3 * fine_x + 0.4)[:, None], 16, axis=1), abs=1e-12)


def test_the_slope_of_a_wave_is_that_of_its_derivative():
    """√2 π for a wave of amplitude 1 and length 1: rms of 2π sin."""
    x = np.arange(32) / 32
    assert rms_slope(np.repeat(np.cos(2 * np.pi * x)[:, None], 32, axis=1)) == pytest.approx(2**0.5 * np.pi)


@pytest.mark.parametrize("seed", range(6))
def test_heights_have_unit_rms_and_no_mean(seed):
    heights = drawn_surface(np.random.default_rng(seed), 48, 8)
    assert heights.std() == pytest.approx(1)
    assert heights.mean() == pytest.approx(0, abs=1e-12)


def test_a_file_holds_the_heights_as_periodic():
    heights = drawn_surface(np.random.default_rng(3), 16, 5)
    path = in_file(heights, (1e-6, 2e-6))["surface"]
    assert in_file(heights, (1e-6, 2e-6))["surface"] == path
    found = load_surface(Path(path))
    assert found.periodic
    assert found.spacing == (1e-6, 2e-6)
    assert np.array_equal(found.heights, heights)


def test_the_refined_scene_differs_only_in_its_points():
    scene = next(one for one in (drawn("rough_gap", seed) for seed in range(20000, 20040)) if one.geometry.upper)
    fine = refined(scene, 2)
    assert fine.surface().shape == tuple(2 * count for count in scene.surface().shape)
    assert fine.surface().size == pytest.approx(scene.surface().size)
    assert fine.rms_height == pytest.approx(scene.rms_height, rel=1e-9)
    assert fine.rms_slope == pytest.approx(scene.rms_slope, rel=1e-9)
    assert fine.geometry.upper.read().shape == fine.surface().shape
    assert fine.lubricant == scene.lubricant
