"""Outliers are cut where the bearing curve first holds points enough, and nothing else is touched."""

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.preparation.outliers import cut_outliers
from roughfilm.contact.surfaces.surface import Surface


def body_with_spikes():
    """A body of heights from 0 to 1 µm, one spike of 9 µm, and three pits of 1 µm below zero."""
    heights = np.linspace(0.002e-6, 0.998e-6, 10_000).reshape(100, 100)
    heights[7, 7] = 9e-6
    heights[[8, 9, 10], [70, 71, 72]] = -1e-6
    return Surface(heights=heights, spacing=(1e-6, 1e-6))


def test_spikes_and_pits_come_down_to_the_body():
    given = body_with_spikes()
    clipped, cut = cut_outliers(given, bins=1000, points=10)
    bin_width = 10e-6 / 1000
    assert (cut.above, cut.below) == (1, 3)
    assert 0.998e-6 <= cut.highest <= 0.998e-6 + bin_width
    assert 0.002e-6 - bin_width <= cut.lowest <= 0.002e-6
    assert clipped.heights.max() == cut.highest
    assert clipped.heights.min() == cut.lowest
    inside = (given.heights <= cut.highest) & (given.heights >= cut.lowest)
    assert inside.sum() == 10_000 - 4
    assert np.array_equal(clipped.heights[inside], given.heights[inside])


def test_no_points_wanted_cuts_nothing():
    given = body_with_spikes()
    clipped, cut = cut_outliers(given, points=0)
    assert np.array_equal(clipped.heights, given.heights)
    assert (cut.above, cut.below) == (0, 0)


def test_invalid_points_neither_count_nor_change():
    given = body_with_spikes()
    invalid = np.zeros(given.shape, bool)
    invalid[7, 7] = True
    clipped, cut = cut_outliers(given.with_heights(given.heights, invalid=invalid))
    assert cut.above == 0
    assert clipped.heights[7, 7] == 0


def test_bins_finer_than_the_digits_of_the_heights_are_refused():
    heights = 1.0 + 1e-15 * np.arange(100.0).reshape(10, 10)
    with pytest.raises(
        InputError, match=r"^outliers: 1000000 bins are finer than the digits of the heights; take fewer"
    ):
        cut_outliers(Surface(heights=heights, spacing=(1e-6, 1e-6)), bins=1_000_000)


def test_more_points_than_any_bin_holds_is_refused():
    with pytest.raises(InputError, match=r"^outliers: no bin of 1000 holds 200 points"):
        cut_outliers(body_with_spikes().with_heights(np.random.default_rng(815).random((100, 100))), points=200)
