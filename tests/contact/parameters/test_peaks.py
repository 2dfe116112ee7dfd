"""Peaks are counted once each, and a flank or a plateau is no second peak."""

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.parameters.peaks import highest_peaks, lowest_valleys
from roughfilm.contact.surfaces.surface import Surface


def bumps(places, tops, *, shape=(120, 90), width=4.0, periodic=True):
    """Gaussian bumps far enough apart not to touch, on a plane; heights in µm, lengths in pixels of 1 by 2 µm."""
    heights = np.zeros(shape)
    for (px, py), top in zip(places, tops, strict=True):
        distance = [np.abs(np.arange(n) - p) for n, p in zip(shape, (px, py), strict=True)]
        x, y = (np.minimum(d, n - d) for d, n in zip(distance, shape, strict=True))
        heights += top * np.exp(-np.add.outer(x**2, y**2) / (2 * width**2))
    return Surface(heights=heights * 1e-6, spacing=(1e-6, 2e-6), periodic=periodic)


PLACES = [(15, 15), (60, 15), (100, 20), (20, 60), (60, 60), (100, 70)]
TOPS = np.array([3.0, 7.0, 5.0, 2.0, 6.0, 4.0])


@pytest.mark.parametrize("periodic", [True, False])
def test_the_five_highest_bumps_are_found(periodic):
    surface = bumps(PLACES, TOPS, periodic=periodic)
    found = highest_peaks(surface, 20e-6)
    np.testing.assert_allclose(found, np.array([7, 6, 5, 4, 3]) * 1e-6 - surface.heights.mean(), rtol=1e-9)
    holes = surface.with_heights(-surface.heights)
    np.testing.assert_allclose(lowest_valleys(holes, 20e-6), found, rtol=1e-12)


def test_distance_is_in_metres_along_both_axes():
    """Bumps 20 pixels apart: 20 µm along x, 40 µm along y."""
    along_x, along_y = bumps([(40, 40), (60, 40)], [2, 1]), bumps([(40, 30), (40, 50)], [2, 1])
    np.testing.assert_allclose(highest_peaks(along_x, 30e-6), [2e-6 - along_x.heights.mean()], rtol=1e-3)
    np.testing.assert_allclose(highest_peaks(along_y, 30e-6), [2e-6, 1e-6] - along_y.heights.mean(), rtol=1e-3)


@pytest.mark.parametrize("shift", [(0, 0), (-15, 0), (60, 29), (-60, -60), (7, 81)])
def test_periodic_surfaces_have_no_edge(shift):
    surface = bumps(PLACES, TOPS)
    moved = surface.with_heights(np.roll(surface.heights, shift, axis=(0, 1)))
    np.testing.assert_allclose(highest_peaks(moved, 20e-6), highest_peaks(surface, 20e-6), rtol=1e-12)


def test_a_peak_cut_by_the_edge_counts_once():
    """Rolled half out, a bump shows at two edges of an open surface, but is one on a periodic one."""
    surface = bumps([(60, 45)], [1.0])
    cut = surface.with_heights(np.roll(surface.heights, 60, axis=0))
    opened = Surface(heights=cut.heights, spacing=cut.spacing)
    level = 1e-7
    assert (highest_peaks(cut, 20e-6) > level).sum() == 1
    assert (highest_peaks(opened, 20e-6) > level).sum() == 2


def test_a_plateau_counts_once():
    surface = bumps(PLACES, TOPS)
    cut = surface.with_heights(surface.heights.clip(max=2.5e-6))
    top = 2.5e-6 - cut.heights.mean()
    np.testing.assert_allclose(highest_peaks(cut, 20e-6), np.full(5, top), rtol=1e-12)
    one = bumps([(60, 45)], [3.0])
    flat = one.with_heights(one.heights.clip(max=2.5e-6))
    assert (highest_peaks(flat, 20e-6) > 1e-6).sum() == 1


def test_invalid_points_are_no_peaks_and_hide_none():
    surface = bumps(PLACES, TOPS)
    invalid = np.zeros(surface.shape, dtype=bool)
    invalid[40:80, :30] = True  # the highest bump
    holed = surface.with_heights(surface.heights, invalid=invalid)
    mean = surface.heights[~invalid].mean()
    np.testing.assert_allclose(highest_peaks(holed, 20e-6), np.array([6, 5, 4, 3, 2]) * 1e-6 - mean, rtol=1e-9)


def test_fewer_than_five_are_all_there_are():
    x = np.arange(64)
    ridges = Surface(heights=np.outer(np.cos(2 * np.pi * x / 32), np.ones(8)), spacing=(1.0, 1.0), periodic=True)
    np.testing.assert_allclose(highest_peaks(ridges, 10.0), [1, 1], rtol=1e-12)


@pytest.mark.parametrize("distance", [0.0, -1.0, np.nan])
def test_a_distance_that_is_none_is_refused(distance):
    with pytest.raises(InputError, match="above zero"):
        highest_peaks(bumps(PLACES, TOPS), distance)
