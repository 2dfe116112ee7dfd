"""The S- and the L-filter transmit waves as ISO 16610-61 states, and neither holes nor edges bias them."""

import warnings

import numpy as np
import pytest
from scipy import ndimage

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.preparation.filters import l_filter, nesting_warnings, s_filter
from roughfilm.contact.surfaces.surface import Surface

SIGMA = np.sqrt(np.log(2) / 2) / np.pi
"""Standard deviation of the weights over the nesting index: π/(α λ)² = 1/(2 σ²) with α² = ln 2/π."""


def wave(shape, spacing, counts, *, periodic=True):
    """One cosine with so many periods along each side."""
    phase = sum(
        np.multiply.outer(*[np.arange(n) if axis == k else np.ones(n) for k, n in enumerate(shape)])
        * (2 * np.pi * counts[axis] / shape[axis])
        for axis in (0, 1)
    )
    return Surface(heights=1e-6 * np.cos(phase), spacing=spacing, periodic=periodic)


@pytest.mark.parametrize("counts", [(3, 0), (0, 5), (4, -7), (30, 2)])
@pytest.mark.parametrize("index", [4e-6, 17.3e-6, 60e-6])
def test_a_periodic_wave_keeps_the_stated_fraction(counts, index):
    given = wave((90, 64), (1e-6, 1.7e-6), counts)
    frequency = np.hypot(counts[0] / given.size[0], counts[1] / given.size[1])
    kept = np.exp(-np.pi * (np.log(2) / np.pi) * (index * frequency) ** 2)
    assert np.abs(s_filter(given, index).heights - kept * given.heights).max() < 1e-6 * 1e-14
    assert np.abs(l_filter(given, index).heights - (1 - kept) * given.heights).max() < 1e-6 * 1e-14


@pytest.mark.parametrize("filter_", [s_filter, l_filter])
def test_a_wave_of_the_nesting_index_keeps_half_inside_a_surface_that_is_not_periodic(filter_):
    """Along the diagonal, on pixels that are not square; the weights of the edges reach 1.6 nesting indices."""
    given = wave((240, 200), (0.5e-6, 0.6e-6), (6, 6), periodic=False)
    index = 20e-6 / np.sqrt(2)
    inside = (slice(48, -48), slice(40, -40))
    assert np.abs(filter_(given, index).heights - 0.5 * given.heights)[inside].max() < 1e-6 * 1e-13


def test_weights_are_those_of_scipy_divided_by_their_sum():
    heights = np.random.default_rng(831).normal(size=(70, 50)) * 1e-6
    valid = np.random.default_rng(832).random((70, 50)) < 0.8
    valid[20:35, 10:30] = False
    given = Surface(heights=heights, spacing=(1e-6, 1.4e-6), invalid=~valid)
    sigma = [SIGMA * 9e-6 / step for step in given.spacing]
    sums, weights = (
        ndimage.gaussian_filter(field, sigma, mode="constant", radius=49)
        for field in (np.where(valid, heights, 0), valid * 1.0)
    )
    filtered = s_filter(given, 9e-6)
    assert np.abs(filtered.heights - sums / weights)[valid].max() < 1e-6 * 1e-12
    assert np.array_equal(filtered.invalid, ~valid)


@pytest.mark.parametrize("periodic", [False, True])
def test_a_constant_height_stays_beside_holes_and_edges(periodic):
    invalid = np.random.default_rng(833).random((60, 40)) < 0.3
    given = Surface(heights=np.full((60, 40), 3e-3), spacing=(1e-6, 1e-6), invalid=invalid, periodic=periodic)
    for index in (1e-6, 12e-6, 40e-6):
        assert np.abs(s_filter(given, index).heights[~invalid] - 3e-3).max() < 3e-3 * 1e-14
        assert np.abs(l_filter(given, index).heights).max() < 3e-3 * 1e-14


def test_a_plane_stays_inside_and_between_holes_that_lie_symmetrically():
    x = np.arange(120.0)[:, None] * 1e-7 * np.ones(80)
    inside = (slice(40, -40), slice(None))
    invalid = np.zeros(x.shape, bool)
    invalid[[55, 65]] = True
    for mask, places in ((np.zeros_like(invalid), inside), (invalid, (60, slice(None)))):
        filtered = s_filter(Surface(heights=x, spacing=(1e-6, 1e-6), invalid=mask), 20e-6)
        assert np.abs(filtered.heights - x)[places].max() < 1e-5 * 1e-13


def test_holes_do_not_shift_the_roughness(band_limited):
    """A tenth of the points at random: the difference is without a mean, and far below the heights."""
    given = band_limited(834, (96, 96))
    invalid = np.random.default_rng(835).random(given.shape) < 0.1
    whole = s_filter(given, 50e-6)
    holed = s_filter(given.with_heights(given.heights, invalid=invalid), 50e-6)
    difference = (holed.heights - whole.heights)[~invalid]
    assert difference.std() < 0.02 * whole.heights.std()
    assert abs(difference.mean()) < 0.002 * whole.heights.std()


def test_short_and_long_waves_are_removed_in_either_order(band_limited):
    given = band_limited(836, (64, 48))
    first, second = l_filter(s_filter(given, 60e-6), 300e-6), s_filter(l_filter(given, 300e-6), 60e-6)
    assert np.abs(first.heights - second.heights).max() < 1e-13 * np.abs(given.heights).max()


def test_the_variance_that_is_left_is_that_of_the_waves():
    """Two S-filters act as one whose squared nesting index is the sum of theirs; the variances of waves add."""
    small, large = wave((64, 64), (1e-6, 1e-6), (2, 1)), wave((64, 64), (1e-6, 1e-6), (5, -3))
    both = small.with_heights(small.heights + 2 * large.heights)
    kept = [np.exp(-np.log(2) * 10**2 * (a * a + b * b) / 64**2) for a, b in ((2, 1), (5, -3))]
    assert s_filter(both, 10e-6).heights.var() == pytest.approx((kept[0] ** 2 + 4 * kept[1] ** 2) * 0.5e-12, rel=1e-12)
    twice = s_filter(s_filter(both, 6e-6), 8e-6)
    assert np.abs(twice.heights - s_filter(both, 10e-6).heights).max() < 1e-6 * 1e-13


@pytest.mark.parametrize("filter_", [s_filter, l_filter])
def test_units_and_the_order_of_the_axes_do_not_matter(filter_):
    rng = np.random.default_rng(837)
    given = Surface(heights=rng.normal(size=(41, 30)), spacing=(1.0, 1.3), invalid=rng.random((41, 30)) < 0.1)
    plain = filter_(given, 7.0).heights
    scaled = Surface(heights=given.heights * 1e-9, spacing=(1e-6, 1.3e-6), invalid=given.invalid)
    turned = Surface(heights=given.heights.T, spacing=(1.3, 1.0), invalid=given.invalid.T)
    assert np.abs(filter_(scaled, 7e-6).heights * 1e9 - plain).max() < 1e-12
    assert np.abs(filter_(turned, 7.0).heights.T - plain).max() < 1e-12


@pytest.mark.parametrize(
    ("filter_", "index", "message"),
    [
        (s_filter, 1.5e-6, r"^s_filter: got a nesting index of 1\.5e-06 m, shorter than the pixel spacing of 2e-06 m"),
        (l_filter, 1.5e-6, r"^l_filter: got a nesting index of 1\.5e-06 m, shorter than the pixel spacing of 2e-06 m"),
        (s_filter, 2.1e-5, r"^s_filter: got a nesting index of 2\.1e-05 m, longer than the shorter side"),
    ],
)
def test_an_index_that_the_surface_cannot_hold_is_refused(filter_, index, message):
    with pytest.raises(InputError, match=message):
        filter_(Surface(heights=np.eye(20), spacing=(1e-6, 2e-6)), index)


def test_indices_that_pixels_or_sides_do_not_support_warn():
    surface = Surface(heights=np.eye(20), spacing=(1e-6, 2e-6))
    assert nesting_warnings(surface, 6e-6, 20e-6) == ()
    short, long = nesting_warnings(surface, 5.9e-6, 21e-6)
    assert "5.9 µm is below 3 pixels, 6 µm" in short
    assert "21 µm is above the shorter side of the measurement, 20 µm" in long


@pytest.mark.measured
@pytest.mark.parametrize("name", ["milled_NT1100.opd", "isotropic.al3d", "periodic_grooves.plu"])
def test_the_interior_of_measured_surfaces_is_that_of_surfalize(measured, name):
    """The same weights, which it truncates at 4 σ; at edges it mirrors the heights."""
    filters = pytest.importorskip("surfalize.filter")
    surfalize = pytest.importorskip("surfalize")
    surface = measured(name)
    surface = surface.with_heights(surface.heights, invalid=np.zeros(surface.shape, bool))
    micro = [length * 1e6 for length in surface.spacing]
    index = 20 * max(micro)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # about pixels that are not square, which its filter takes into account
        other = filters.GaussianFilter(index, "lowpass")(surfalize.Surface(surface.heights.T * 1e6, *micro)).data.T
    ours = s_filter(surface, index * 1e-6).heights * 1e6
    inside = tuple(slice(reach, -reach) for reach in (int(1.6 * index / step) + 1 for step in micro))
    assert np.abs(other - ours)[inside].max() < 2e-4 * np.ptp(ours)
