"""The mean over windows: numerical uncertainty and scatter apart."""

import math

import numpy as np
import pytest

from roughfilm.contact.windows.average import window_average


def test_equal_windows_have_no_scatter_and_keep_their_numerical_uncertainty():
    found = window_average([0.3] * 4, [0.01] * 4)
    assert found.value == pytest.approx(0.3, rel=1e-15)
    assert found.uncertainty == pytest.approx(0.01, rel=1e-15)
    assert found.scatter == pytest.approx(0.0, abs=1e-15)
    assert found.interval == pytest.approx((0.3, 0.3), rel=1e-12)


def test_numerical_uncertainties_are_averaged_and_unknown_if_one_is():
    values = [1.0, 1.2, 0.9]
    assert window_average(values, [0.1, 0.2, 0.6]).uncertainty == pytest.approx(0.3)
    assert window_average(values, [0.1, None, 0.6]).uncertainty is None
    assert window_average(values, [0.1, math.inf, 0.6]).uncertainty is None
    assert window_average(values).uncertainty is None


def test_two_windows_have_no_scatter_that_is_known():
    found = window_average([1.0, 2.0])
    assert found.value == 1.5
    assert found.scatter is None
    assert found.entries("m")["window_interval"] is None
    assert math.isnan(found.columns("gap")["gap_scatter"])


def test_a_limit_below_the_mean_widens_the_interval_of_the_mean_downwards_only():
    found = window_average([1.0, 1.2, 0.9, 1.1])
    low, high = found.mean_interval
    assert found.above(found.value / 2).mean_interval == pytest.approx((low / 2, high))
    assert found.above(2 * found.value) is found


def test_scaled_averages_scale_all_lengths():
    found = window_average([1.0, 1.2, 0.9, 1.1], [0.1] * 4)
    twice = found.scaled(2.0)
    assert twice.columns("x") == pytest.approx({name: 2 * value for name, value in found.columns("x").items()})
    assert twice.uncertainty == pytest.approx(0.2)


def test_the_scatter_of_few_windows_covers_the_mean_of_very_many():
    values = np.random.default_rng(4).lognormal(sigma=0.7, size=(400, 8))
    covered = [found.mean_interval[0] < np.exp(0.245) < found.mean_interval[1] for found in map(window_average, values)]
    assert 0.9 < np.mean(covered) < 0.99
