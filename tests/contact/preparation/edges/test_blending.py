"""Joined edges meet; the middle, and ridges across the joint, stay as they were."""

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.preparation.edges.blending import blend_edges, largest_width
from roughfilm.contact.surfaces.periodicity import MISMATCH_THRESHOLD, periodicity_mismatch
from roughfilm.contact.surfaces.surface import Surface


def rough(seed, shape=(200, 160), keep=20):
    """A window of a smooth random surface: its edges know nothing of each other."""
    rng = np.random.default_rng(seed)
    n = 512
    q = np.hypot(np.fft.fftfreq(n)[:, None], np.fft.rfftfreq(n)[None, :]) * n
    heights = np.fft.irfft2(np.fft.rfft2(rng.normal(size=(n, n))) * (q < 2.5 * keep), s=(n, n))
    return Surface(heights=heights[: shape[0], : shape[1]] / heights.std(), spacing=(1.0, 0.8))


@pytest.mark.parametrize("direction", ["x", "y", "both"])
def test_the_middle_stays_untouched_to_the_last_bit(direction):
    given = rough(821)
    joined = blend_edges(given, direction, width=(4.0, 3.2)).surface
    reach = {"x": (2 * 12 + 1, 0), "y": (0, 2 * 15 + 1), "both": (25, 31)}[direction]
    inner = tuple(slice(r, n - r) for r, n in zip(reach, given.shape, strict=True))
    assert np.array_equal(joined.heights[inner], given.heights[inner])
    assert joined.periodic


def test_edges_meet_as_closely_as_neighbours_inside_do():
    given = rough(822)
    joined = blend_edges(given, "both", width=(4.0, 3.2)).surface
    for axis in (0, 1):
        steps = np.sqrt(np.mean(np.diff(joined.heights, axis=axis) ** 2))
        before, after = (
            np.sqrt(np.mean((s.heights.take(0, axis) - s.heights.take(-1, axis)) ** 2)) for s in (given, joined)
        )
        assert before > 3 * steps
        assert after < steps
    assert periodicity_mismatch(given) > 0.5
    assert periodicity_mismatch(joined) < MISMATCH_THRESHOLD


def test_a_periodic_wave_hardly_changes():
    """The filter takes a wave down to exp(−σ²q²/2): no point can lose more than the rest."""
    x = np.arange(200)
    wave = Surface(heights=np.cos(2 * np.pi * x / 100)[:, None] * np.ones((1, 50)), spacing=(1.0, 1.0))
    joined = blend_edges(wave, "x", width=(3.0, 3.0)).surface
    lost = 1 - np.exp(-0.5 * (3 * 2 * np.pi / 100) ** 2)
    assert 0.5 * lost < np.abs(joined.heights - wave.heights).max() <= lost


def test_ridges_along_the_joined_direction_stay_sharp():
    ridges = np.random.default_rng(823).normal(size=160)[None, :] * np.ones((200, 1))
    given = Surface(heights=ridges, spacing=(1.0, 0.8))
    assert np.allclose(blend_edges(given, "x", width=(4.0, 3.2)).surface.heights, ridges, atol=1e-13)
    assert np.abs(blend_edges(given, "both", width=(4.0, 3.2)).surface.heights - ridges).max() > 1


def test_corners_take_part_in_both_joints():
    joined = blend_edges(rough(824), "both", width=(4.0, 3.2)).surface
    corners = joined.heights[np.ix_([0, -1], [0, -1])]
    assert np.ptp(corners) < 0.5 * joined.heights.std()


def test_joining_nothing_leaves_a_measurement_what_it_is():
    given = rough(826)
    for periodic in (False, True):
        left = blend_edges(given.with_heights(given.heights, periodic=periodic), "none", width=(0.0, 0.0)).surface
        assert left.periodic is periodic
        assert np.array_equal(left.heights, given.heights)


@pytest.mark.parametrize("count", [11, 12, 50, 51, 52, 53, 240])
def test_the_widest_filter_leaves_the_middle_alone_and_a_wider_one_is_refused(count):
    heights = np.random.default_rng(827).normal(size=(count, 9))
    given = Surface(heights=heights, spacing=(1.0, 1.0))
    joined = blend_edges(given, "x", width=(largest_width(count), 0.0)).surface
    assert np.array_equal(joined.heights[count // 2], heights[count // 2])
    with pytest.raises(InputError, match=r"^edges: got a width"):
        blend_edges(given, "x", width=(largest_width(count) * 1.01, 0.0))


def test_too_few_pixels_are_refused():
    with pytest.raises(InputError, match=r"^edges: got 10 pixels along y; joining edges needs 11 and more"):
        blend_edges(rough(828, shape=(40, 10)), "y", width=(1.0, 1.0))


@pytest.mark.parametrize("width", [0.1, 60.0])
def test_a_width_out_of_range_is_refused(width):
    with pytest.raises(InputError, match=r"^edges: got a width of .* pixels along x; give 0.5 to"):
        blend_edges(rough(825), "x", width=(width, 1.0))
