"""Filled heights are harmonic, stay in the range of their surroundings, and leave valid ones alone."""

import numpy as np
import pytest

from roughfilm.contact.preparation.filling import fill_invalid
from roughfilm.contact.surfaces.surface import Surface

SPACING = (1.5e-6, 0.4e-6)
X, Y = np.meshgrid(np.arange(60) * SPACING[0], np.arange(45) * SPACING[1], indexing="ij")


@pytest.mark.parametrize(
    "harmonic", [X**2 - Y**2, X * Y, 1.0 + 0 * X, 3 * X - 2 * Y], ids=["saddle", "twist", "level", "tilt"]
)
def test_a_harmonic_polynomial_is_restored(harmonic):
    """Second differences of second-order polynomials are exact, whatever the spacing."""
    invalid = np.zeros(X.shape, bool)
    invalid[20:40, 10:30] = True
    invalid[5, 5] = invalid[50:52, 40:43] = True
    filled, residual = fill_invalid(Surface(heights=np.where(invalid, 9.0, harmonic), spacing=SPACING, invalid=invalid))
    assert residual <= 1e-9
    assert not filled.invalid.any()
    assert np.abs(filled.heights - harmonic).max() < 1e-7 * np.ptp(harmonic + X)
    assert np.array_equal(filled.heights[~invalid], harmonic[~invalid])


def test_filled_heights_stay_between_the_valid_ones():
    rng = np.random.default_rng(814)
    invalid = rng.random(X.shape) < 0.7
    heights = rng.normal(size=X.shape)
    filled, _ = fill_invalid(Surface(heights=heights, spacing=SPACING, invalid=invalid))
    assert filled.heights.min() >= heights[~invalid].min() - 1e-8
    assert filled.heights.max() <= heights[~invalid].max() + 1e-8


def test_one_valid_point_states_all_heights():
    invalid = np.ones(X.shape, bool)
    invalid[3, 4] = False
    filled, _ = fill_invalid(Surface(heights=np.full(X.shape, 2e-6), spacing=SPACING, invalid=invalid))
    assert np.allclose(filled.heights, 2e-6, rtol=1e-9)


def test_without_invalid_points_nothing_happens():
    given = Surface(heights=X, spacing=SPACING)
    filled, residual = fill_invalid(given)
    assert filled is given
    assert residual == 0


@pytest.mark.parametrize("shape", [(150, 150), (149, 211)])
def test_a_wide_hole_is_filled_in_few_iterations(shape, monkeypatch):
    """Nine tenths missing on one side, from a corner of a harmonic polynomial."""
    monkeypatch.setattr("roughfilm.contact.preparation.filling.MAX_ITERATIONS", 60)
    x, y = np.meshgrid(*(np.arange(n) * 1e-6 for n in shape), indexing="ij")
    heights = x**2 - y**2 + 3 * x * y
    invalid = np.zeros(shape, bool)
    invalid[4:-4, 4:-4] = True
    filled, residual = fill_invalid(
        Surface(heights=np.where(invalid, 0, heights), spacing=(1e-6, 1e-6), invalid=invalid)
    )
    assert residual <= 1e-9
    assert np.abs(filled.heights - heights).max() < 1e-6 * np.ptp(heights)
