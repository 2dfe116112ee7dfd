"""No height is clipped unless asked for, and then at most the given fraction at each end."""

import numpy as np
import pytest

from roughfilm.contact.preparation.outliers import cut_outliers
from roughfilm.contact.preparation.prepare import prepare
from roughfilm.contact.preparation.recipe import read_recipe
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.interface.surfaces import press

BAND = 6
"""Points per shortest wave of the small maps."""


def random_map(points, seed=5):
    """A periodic map whose shortest wave spans six points, with an rms height of 0.1 µm."""
    waves = np.hypot(*np.meshgrid(np.fft.fftfreq(points), np.fft.rfftfreq(points), indexing="ij"))
    amplitudes = np.where((waves > 0) & (waves <= 1 / BAND), 1.0, 0.0)
    noise = np.random.default_rng(seed).standard_normal((points, points))
    heights = np.fft.irfft2(np.fft.rfft2(noise) * amplitudes, s=(points, points))
    return Surface(heights=1e-7 * heights / heights.std(), spacing=(1e-6, 1e-6))


@pytest.mark.parametrize("points", [16, 17, 24, 31, 32, 48, 50, 64, 96, 150, 256])
def test_the_area_and_the_gap_of_a_small_map_are_those_of_its_heights(points):
    """The map is periodic, so that a recipe that changes nothing must leave its contact as it is."""
    given = random_map(points)
    recipe = {"form": "none", "edges": {"direction": "none"}, "smoothing": 1}
    prepared = prepare(given, read_recipe(recipe))
    expected, found = (press(one.heights, spacing=1e-6, modulus=1e9, load=5e6 / 3) for one in (given, prepared.surface))
    assert found.area_fraction == pytest.approx(expected.area_fraction, rel=0.02)
    assert found.mean_gap == pytest.approx(expected.mean_gap, rel=0.02)
    assert not prepared.warnings


@pytest.mark.parametrize("points", [16, 21, 32, 45])
def test_a_small_map_is_prepared_by_the_usual_recipe(points):
    prepared = prepare(random_map(points), read_recipe({}))
    assert prepared.surface.periodic
    assert prepared.record["outliers"]["above"] == prepared.record["outliers"]["below"] == 0


def test_a_quantile_clips_that_fraction_at_each_end():
    heights = np.random.default_rng(3).permutation(10_000).reshape(100, 100) * 1e-9
    clipped, cut = cut_outliers(Surface(heights=heights, spacing=(1e-6, 1e-6)), 0.01)
    assert (cut.above, cut.below) == (100, 100)
    assert (clipped.heights.max(), clipped.heights.min()) == pytest.approx((9899e-9, 100e-9), rel=1e-12)
    inside = (heights >= cut.lowest) & (heights <= cut.highest)
    assert np.array_equal(clipped.heights[inside], heights[inside])


def test_many_equal_heights_are_not_clipped():
    heights = np.where(np.arange(100)[:, None] < 50, 0.0, 1e-6) * np.ones(100)
    _, cut = cut_outliers(Surface(heights=heights, spacing=(1e-6, 1e-6)), 0.1)
    assert (cut.above, cut.below) == (0, 0)


def test_invalid_points_neither_count_nor_change():
    heights = np.random.default_rng(4).normal(size=(60, 60))
    heights[7, 7] = 50.0
    invalid = np.zeros((60, 60), bool)
    invalid[7, 7] = True
    clipped, cut = cut_outliers(Surface(heights=1e-6 * heights, spacing=(1e-6, 1e-6), invalid=invalid), 1e-3)
    assert cut.above == 3
    assert clipped.heights[7, 7] == 0


def test_much_clipping_warns_that_summits_carry_load():
    warnings = prepare(random_map(64), read_recipe({"outliers": {"quantile": 0.02}})).warnings
    assert any("% of the points were clipped, which removes summits that carry load" in one for one in warnings)
