"""Height parameters are moments of the heights about their mean, and nothing else about the surface matters."""

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.parameters import exact
from roughfilm.contact.parameters.heights import height_statistics

NAMES = ("average", "rms", "peak", "valley", "skewness", "kurtosis")


def test_a_sampled_sinusoid_has_its_closed_form():
    phase = 2 * np.pi * (np.arange(4096) + 0.5) / 4096
    found, expected = height_statistics(3e-6 * np.sin(phase) + 1e-5), exact.sinusoid_statistics(3e-6)
    for name in NAMES:
        assert getattr(found, name) == pytest.approx(getattr(expected, name), rel=1e-6, abs=1e-12), name
    assert found.mean == pytest.approx(1e-5)
    assert found.total == pytest.approx(6e-6, rel=1e-6)


def test_gaussian_heights_have_theirs(gaussian_heights):
    found = height_statistics(gaussian_heights(100_001, 2e-7))
    assert found.average == pytest.approx(exact.gaussian_average(2e-7), rel=1e-4)
    assert found.rms == pytest.approx(2e-7, rel=1e-4)
    assert found.skewness == pytest.approx(0, abs=1e-12)
    assert found.kurtosis == pytest.approx(3, rel=2e-3)


def test_pits_lean_down():
    """A part p of the points a depth d below the rest: Sq² = p(1−p) d², Ssk = (2p−1)/√(p(1−p)), Sku = Ssk² + 1."""
    heights = np.zeros(1000)
    heights[:50] = -4e-6
    p, d = 0.05, 4e-6
    found = height_statistics(heights)
    assert found.average == pytest.approx(2 * p * (1 - p) * d)
    assert found.rms == pytest.approx(np.sqrt(p * (1 - p)) * d)
    assert found.peak == pytest.approx(p * d)
    assert found.valley == pytest.approx((1 - p) * d)
    assert found.skewness == pytest.approx((2 * p - 1) / np.sqrt(p * (1 - p)))
    assert found.kurtosis == pytest.approx((2 * p - 1) ** 2 / (p * (1 - p)) + 1)


def test_roughness_of_a_nanometre_survives_a_metre_of_height():
    heights = 1e-9 * np.sin(2 * np.pi * np.arange(360) / 360)
    near, far = height_statistics(heights), height_statistics(heights + 1.0)
    assert far.rms == pytest.approx(near.rms, rel=1e-6)
    assert far.kurtosis == pytest.approx(near.kurtosis, rel=1e-6)


@pytest.mark.parametrize(
    "heights",
    [np.zeros(10), np.full((7, 9), 0.1), np.full(1000, 1 / 3) * (1 + 1e-16), 1e5 + 1e-12 * np.arange(9), [2e-6]],
)
def test_constant_heights_are_refused(heights):
    with pytest.raises(InputError, match="all the same"):
        height_statistics(heights)


@pytest.mark.parametrize("heights", [[0, np.nan], [0, np.inf], [0, -np.inf], [0, 1e7], [np.nan, np.nan]])
def test_heights_that_cannot_be_are_refused(heights):
    with pytest.raises(InputError, match="leave out what was not measured"):
        height_statistics(heights)


def test_no_heights_are_refused():
    with pytest.raises(InputError, match="got 0 of"):
        height_statistics([])
