"""Resampling keeps what its order promises: lines, means, band-limited waves."""

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.preparation.grid import next_power_of_two, resample
from roughfilm.contact.surfaces.surface import Surface


def test_powers_of_two_are_never_fewer():
    assert [next_power_of_two(n) for n in (2, 3, 480, 512, 513, 736)] == [2, 4, 512, 512, 1024, 1024]


@pytest.mark.parametrize("points", [(96, 50), (40, 25), (23, 19), (41, 60)])
def test_the_rectangle_stays_and_a_plane_stays_a_plane_away_from_its_border(points):
    x, y = (np.arange(n) + 0.5 for n in (40, 25))
    given = Surface(heights=3 * x[:, None] - 2 * y[None, :], spacing=(1.0, 1.0))
    found = resample(given, points)
    assert found.shape == points
    assert np.allclose(found.size, (40, 25))
    new_x, new_y = ((np.arange(n) + 0.5) * step for n, step in zip(points, found.spacing, strict=True))
    inner = np.ix_((new_x > 2) & (new_x < 38), (new_y > 2) & (new_y < 23))
    assert np.allclose(found.heights[inner], (3 * new_x[:, None] - 2 * new_y[None, :])[inner], atol=1e-12)


def test_coarser_pixels_hold_the_mean_of_what_they_cover():
    """So a noise of two pixels' wavelength vanishes instead of turning into a long wave."""
    noise = np.where(np.arange(240) % 2, 1.0, -1.0)[:, None] * np.ones((1, 4))
    found = resample(Surface(heights=noise, spacing=(1.0, 1.0)), (60, 4))
    assert np.abs(found.heights[1:-1]).max() < 1e-12


@pytest.mark.parametrize("factor", [1.7, 0.45])
def test_linear_interpolation_is_of_second_order(factor):
    errors = []
    for n in (50, 100, 200, 400):
        x = (np.arange(n) + 0.5) / n
        count = round(factor * n)
        found = resample(Surface(heights=np.sin(9 * x)[:, None] * np.ones((1, 2)), spacing=(1 / n, 1.0)), (count, 2))
        new = (np.arange(count) + 0.5) / count
        inner = (new > 0.1) & (new < 0.9)
        errors.append(np.abs(found.heights[:, 0] - np.sin(9 * new))[inner].max())
    order = np.polyfit(np.log([50, 100, 200, 400]), np.log(errors), 1)[0]
    assert order == pytest.approx(-2, abs=0.2)


@pytest.mark.parametrize(("old", "new"), [((16, 15), (33, 40)), ((33, 40), (16, 15)), ((16, 16), (64, 32))])
def test_band_limited_waves_are_exact_on_even_and_odd_grids(old, new):
    def waves(shape):
        x, y = np.meshgrid(*(2 * np.pi * np.arange(n) / n for n in shape), indexing="ij")
        return 1 + np.cos(3 * x + 0.4) + np.sin(5 * y - x) - 0.3 * np.cos(7 * x)

    given = Surface(heights=waves(old), spacing=(1.0, 1.0), periodic=True)
    assert np.allclose(resample(given, new, "band-limited").heights, waves(new), atol=1e-12)


@pytest.mark.parametrize(("method", "invalid"), [("band-limited", False), ("linear", True)])
def test_what_cannot_be_resampled_is_refused(method, invalid):
    mask = np.zeros((5, 5), bool)
    mask[2, 2] = invalid
    given = Surface(heights=np.arange(25.0).reshape(5, 5), spacing=(1.0, 1.0), invalid=mask)
    with pytest.raises(InputError, match=r"^grid: "):
        resample(given, (8, 8), method)
