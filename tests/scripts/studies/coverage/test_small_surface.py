"""The complete map behind a small measured one: between its points and beyond its edges."""

import numpy as np
import pytest

from scripts.studies.coverage.scenes.small_surface import drawn_surface
from scripts.studies.coverage.truths.small_surface import complete


def test_pixels_a_third_as_wide_have_the_points_of_the_map_in_their_middle():
    period = drawn_surface(np.random.default_rng(2), 24, 5)
    fine = complete(period, (14, 24), 3, whole=True)
    assert fine.shape == (42, 72)
    assert fine[1::3, 1::3] == pytest.approx(period[:14], abs=1e-12)


def test_a_part_is_continued_by_its_mirror_images():
    period = drawn_surface(np.random.default_rng(2), 24, 5)
    part = complete(period, (14, 10), 2, whole=True)
    whole = complete(period, (14, 10), 2, whole=False)
    assert whole.shape == (56, 40)
    assert np.array_equal(whole[:28, :20], part)
    assert np.array_equal(whole[28:, :20], part[::-1])
    assert np.array_equal(whole[:, 20:], whole[:, 19::-1])


def test_half_a_wave_from_crest_to_trough_is_continued_to_the_whole_wave():
    x = np.arange(32) + 0.5
    wave = np.repeat(np.cos(2 * np.pi * x / 32)[:, None], 4, axis=1)
    fine_x = (np.arange(64) + 0.5) / 2
    assert complete(wave, (16, 2), 2, whole=False)[:, 0] == pytest.approx(np.cos(2 * np.pi * fine_x / 32), abs=1e-12)
