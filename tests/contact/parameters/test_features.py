"""Peaks and pits of egg boxes, paraboloids and Gaussian surfaces have their number, height and curvature."""

import dataclasses

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.parameters import exact
from roughfilm.contact.parameters.features import significant_peaks, significant_pits
from roughfilm.contact.surfaces.surface import Surface


def egg_box(n=48, *, waves=(4, 3), size=(96e-6, 120e-6), height=1e-6, periodic=True):
    """The product of two cosines: 2 waves[0] waves[1] peaks and as many pits, on points of the grid."""
    x, y = (np.cos(2 * np.pi * count * np.arange(n) / n) for count in waves)
    return Surface(heights=height * np.outer(x, y), spacing=(size[0] / n, size[1] / n), periodic=periodic)


def curvature_of(surface, waves=(4, 3), height=1e-6):
    """The mean curvature at the peaks of the egg box, H (qx² + qy²)/2."""
    return (
        height * sum((2 * np.pi * count / length) ** 2 for count, length in zip(waves, surface.size, strict=True)) / 2
    )


def test_an_egg_box_has_its_peaks_and_pits():
    surface = egg_box()
    for found in (significant_peaks(surface), significant_pits(surface)):
        assert found.density == pytest.approx(24 / (96e-6 * 120e-6), rel=1e-12)
        np.testing.assert_allclose(found.heights, np.full(24, 1e-6), rtol=1e-12)
        assert found.five_point_height == pytest.approx(1e-6, rel=1e-12)
        assert found.mean_curvature == pytest.approx(curvature_of(surface), rel=0.03)


def test_curvature_converges_with_second_order_where_peaks_are_points_of_the_grid():
    counts = np.array([24, 48, 96, 192])
    errors = [
        abs(significant_peaks(surface).mean_curvature / curvature_of(surface) - 1)
        for surface in (egg_box(n) for n in counts)
    ]
    assert np.polyfit(np.log(counts), np.log(errors), 1)[0] == pytest.approx(-2, abs=0.05)


def test_shifted_by_part_of_a_pixel_height_and_curvature_change_by_second_order():
    """The peaks of an egg box are symmetric."""
    errors = []
    for n in (48, 96, 192):
        x, y = (np.cos(2 * np.pi * (count * np.arange(n) + 0.31) / n) for count in (4, 3))
        shifted = dataclasses.replace(egg_box(n), heights=1e-6 * np.outer(x, y))
        found = significant_peaks(shifted)
        assert found.density == significant_peaks(egg_box(n)).density
        errors.append([1 - found.five_point_height / 1e-6, abs(found.mean_curvature / curvature_of(shifted) - 1)])
    order = np.log2(np.divide(errors[:-1], errors[1:]))
    assert order == pytest.approx(np.full((2, 2), 2.0), abs=0.3)


@pytest.mark.parametrize("tops", [(3.0, 7.0, 5.0, 2.0, 6.0, 4.0, 1.0)])
def test_paraboloids_have_their_heights_and_curvatures(tops):
    """Caps z = H − (x²/Rx + y²/Ry)/2 on a plane; their second differences are exact."""
    radii = (40e-6, 25e-6)
    heights = np.zeros((160, 120))
    places = [(20, 20), (60, 20), (100, 25), (140, 20), (20, 80), (60, 85), (110, 80)]
    x, y = np.arange(160) * 1e-6, np.arange(120) * 1e-6
    for (px, py), top in zip(places, tops, strict=True):
        cap = 1e-6 * top - np.add.outer((x - px * 1e-6) ** 2 / radii[0], (y - py * 1e-6) ** 2 / radii[1]) / 2
        heights = np.maximum(heights, cap)
    surface = Surface(heights=heights, spacing=(1e-6, 1e-6), periodic=True)
    found = significant_peaks(surface)
    mean = heights.mean()
    assert found.density == pytest.approx(7 / (160e-6 * 120e-6))
    np.testing.assert_allclose(found.heights + mean, 1e-6 * np.sort(tops)[::-1], rtol=1e-9)
    np.testing.assert_allclose(found.curvatures, (1 / radii[0] + 1 / radii[1]) / 2, rtol=1e-8)
    assert found.five_point_height + mean == pytest.approx(5e-6, rel=1e-9)


def test_hills_lower_than_five_per_cent_of_the_total_height_do_not_count():
    """Bumps of 4 % and 6 % of Sz beside one of the full height."""
    heights = np.zeros((60, 40))
    heights[10, 10], heights[30, 20], heights[50, 30] = 1.0, 0.04, 0.06
    surface = Surface(heights=heights, spacing=(1.0, 1.0), periodic=True)
    assert significant_peaks(surface).heights.size == 2
    assert significant_peaks(surface, 0.0).heights.size == 3
    assert significant_peaks(surface, 0.07).heights.size == 1


def test_the_summits_of_a_gaussian_surface_have_the_density_of_nayak():
    """Without pruning; the spectrum exp(−q²/2s²) has m2 = s² Sq² along a line.

    The 960 summits and the pits have a standard error of 1.4 %; the grid, 5 points over 1/s, misses 1 % of them.
    """
    n, s = 512, 0.2
    q = 2 * np.pi * np.fft.fftfreq(n)
    power = np.exp(-np.add.outer(q**2, q**2) / (2 * s**2))
    noise = np.fft.fft2(np.random.default_rng(7301).normal(size=(n, n)))
    heights = np.fft.ifft2(noise * np.sqrt(power)).real
    surface = Surface(heights=heights, spacing=(1.0, 1.0), periodic=True)
    second, fourth = ((power * q[:, None] ** order).sum() / power.sum() for order in (2, 4))
    assert second == pytest.approx(s**2, rel=1e-6)
    peaks, pits = significant_peaks(surface, 0.0), significant_pits(surface, 0.0)
    assert (peaks.density + pits.density) / 2 == pytest.approx(exact.summit_density(second, fourth), rel=0.05)
    assert significant_peaks(surface).density < 0.95 * peaks.density


@pytest.mark.parametrize("shift", [(1, 0), (-7, 23), (20, 25)])
def test_a_periodic_surface_has_no_edge(band_limited, shift):
    surface = band_limited(7302, (60, 50))
    moved = surface.with_heights(np.roll(surface.heights, shift, axis=(0, 1)))
    one, other = significant_peaks(surface), significant_peaks(moved)
    np.testing.assert_allclose(one.heights, other.heights, rtol=1e-9)
    assert one.mean_curvature == pytest.approx(other.mean_curvature)


def test_hills_at_an_edge_are_not_counted():
    """Of 4 by 3 crests in each family, the first ones lie on edges or their hills touch one."""
    closed = significant_peaks(egg_box(periodic=False))
    assert 0 < closed.heights.size < 24
    tilted = Surface(heights=np.add.outer(np.arange(9.0), np.arange(8.0)), spacing=(1.0, 1.0))
    found = significant_peaks(tilted)
    assert (found.density, found.mean_curvature, found.five_point_height) == (0.0, None, None)


def test_a_peak_beside_an_invalid_point_is_not_counted():
    surface = egg_box()
    invalid = np.zeros(surface.shape, dtype=bool)
    invalid[1, 1] = True  # beside the peak in the corner
    holed = dataclasses.replace(surface, invalid=invalid, heights=np.where(invalid, 1.0, surface.heights))
    found = significant_peaks(holed)
    assert found.heights.size == 23
    assert found.heights.max() < 1.01e-6
    invalid = np.zeros(surface.shape, dtype=bool)
    invalid[3, 4] = True  # on a flank
    assert significant_peaks(dataclasses.replace(surface, invalid=invalid)).heights.size == 24


@pytest.mark.parametrize("pruning", [-0.1, 1.1, np.nan])
def test_a_pruning_that_is_no_fraction_is_refused(pruning):
    with pytest.raises(InputError, match="from 0 to 1"):
        significant_peaks(egg_box(), pruning)
