"""Fewer points hold the same waves, less those that they cannot."""

import numpy as np
import pytest

from roughfilm.rom.parts.restriction import restricted

SHAPES = [((64, 48), (32, 24)), ((64, 48), (33, 25)), ((63, 49), (32, 17)), ((65, 64), (64, 3)), ((64, 64), (64, 2))]


def waves(shape, numbers):
    x, y = (np.arange(n) / n for n in shape)
    phase = 2 * np.pi * (numbers[0] * x[:, None] + numbers[1] * y[None, :])
    return np.cos(phase + 0.7)


@pytest.mark.parametrize(("fine", "coarse"), SHAPES)
def test_a_long_wave_is_sampled_and_a_short_one_is_gone(fine, coarse):
    kept = 0.3 + waves(fine, (1, 0)) + 2 * waves(fine, (-3, 0))
    lost = waves(fine, (0, fine[1] // 2)) + waves(fine, (5, (coarse[1] + 1) // 2))
    expected = 0.3 + waves(coarse, (1, 0)) + 2 * waves(coarse, (-3, 0))
    assert restricted(kept + lost, coarse) == pytest.approx(expected, abs=1e-12)


def test_oblique_waves_keep_their_direction():
    assert restricted(waves((60, 60), (4, -7)), (24, 20)) == pytest.approx(waves((24, 20), (4, -7)), abs=1e-12)


def test_the_same_grid_gives_the_same_bits():
    heights = np.random.default_rng(20071).standard_normal((12, 9))
    assert restricted(heights, (12, 9)) is heights
