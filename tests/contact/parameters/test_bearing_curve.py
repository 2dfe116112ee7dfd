"""The bearing curve and its core: closed forms, plateaus, few points, and the second program's numbers."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import integrate, stats

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.parameters import exact
from roughfilm.contact.parameters.bearing_curve import (
    bearing_core,
    bearing_curve,
    descending,
    height_at_ratio,
    material_ratio,
    material_volume,
    void_volume,
)

NAMES = ("height", "peak", "valley", "peak_ratio", "valley_ratio")


def core(heights):
    return bearing_core(descending(heights))


def test_a_gaussian_has_a_core_of_2_57396_rms(gaussian_heights):
    assert core(gaussian_heights(100_001, 1.0)).height == pytest.approx(2.57396, abs=1e-5)


def test_the_closed_form_of_a_gaussian_is_its_quadrature():
    """Slope of the line: ∫ (m − ½) h dm / ∫ (m − ½)² dm over 0.3 < m < 0.7; area above its end over Smr1."""
    top, _ = integrate.quad(lambda m: (m - 0.5) * stats.norm.isf(m), 0.3, 0.7)
    slope = top / (2 * 0.2**3 / 3)
    ratio = stats.norm.sf(-slope / 2)
    area, _ = integrate.quad(lambda z: stats.norm.sf(z), -slope / 2, np.inf)
    found = exact.gaussian_core(3e-7)
    assert found.height == pytest.approx(-slope * 3e-7, rel=1e-9)
    assert found.peak_ratio == pytest.approx(ratio, rel=1e-9)
    assert found.peak == pytest.approx(3e-7 * 2 * area / ratio, rel=1e-9)
    assert found.valley == found.peak
    assert found.valley_ratio == pytest.approx(1 - ratio, rel=1e-9)


def test_the_closed_form_of_a_sinusoid_is_its_quadrature():
    curve = exact.sinusoid_bearing_curve
    mean, _ = integrate.quad(lambda m: curve(m, 1.0), 0, 0.4)
    top, _ = integrate.quad(lambda m: (m - 0.2) * curve(m, 1.0), 0, 0.4)
    slope = top / (2 * 0.2**3 / 3)
    lower = mean / 0.4 + 0.8 * slope
    ratio = np.arccos(lower) / np.pi
    area, _ = integrate.quad(lambda m: lower - curve(m, 1.0), ratio, 1)
    found = exact.sinusoid_core(2.0)
    assert mean / 0.4 - 0.2 * slope > 1  # nothing stands above the line
    assert (found.peak, found.peak_ratio) == (0, 0)
    assert found.height == pytest.approx(-2 * slope, rel=1e-9)
    assert found.valley_ratio == pytest.approx(ratio, rel=1e-9)
    assert found.valley == pytest.approx(2 * 2 * area / (1 - ratio), rel=1e-9)


@pytest.mark.parametrize(("points", "tail"), [(1000, 2e-3), (100_000, 2e-5)])
def test_gaussian_heights_have_their_core(gaussian_heights, points, tail):
    """Ratios and line converge as n⁻², what depends on the unbounded tails as n⁻¹."""
    found, expected = core(gaussian_heights(points, 3e-7)), exact.gaussian_core(3e-7)
    for name in NAMES:
        tolerance = tail if name in ("peak", "valley") else 20 / points**2 + 1e-8
        assert getattr(found, name) == pytest.approx(getattr(expected, name), rel=tolerance), name


@pytest.mark.parametrize("points", [100, 1000, 10_000])
def test_a_sampled_sinusoid_has_its_core_to_second_order(points):
    """Sampled where no two points of a period have the same height."""
    found = core(3e-6 * np.sin(2 * np.pi * (np.arange(points) + 0.25) / points))
    expected = exact.sinusoid_core(3e-6)
    assert (found.peak, found.peak_ratio) == (0, 0)
    for name in ("height", "valley", "valley_ratio"):
        assert getattr(found, name) == pytest.approx(getattr(expected, name), rel=5 / points**2 + 1e-9), name


def test_of_two_equally_flat_windows_the_first_counts_whatever_the_rounding():
    """A sinusoid's bearing curve is as flat at its foot as at its head."""
    phase = 2 * np.pi * (np.arange(2000) + 0.5) / 2000
    for offset in (0.0, 0.1, 1 / 3, 0.7):
        assert core(np.sin(phase) + offset).peak == pytest.approx(0, abs=1e-12)


def test_evenly_spread_heights_are_all_core():
    found = core(np.linspace(-1e-6, 1e-6, 10_000))
    assert found.height == pytest.approx(2e-6, rel=2e-4)
    assert found.peak == pytest.approx(0, abs=1e-12)
    assert found.valley == pytest.approx(0, abs=1e-12)


def test_a_plateau_is_the_core_and_pits_are_valleys():
    """Three quarters level, a quarter 2 µm lower: the triangle with the area of the rectangle is twice as deep."""
    heights = np.repeat([0.1, 0.1 - 2e-6], [750, 250])
    found = core(heights)
    assert found.height == 0
    assert (found.peak, found.peak_ratio) == (0, 0)
    assert found.valley_ratio == pytest.approx(0.75, abs=1e-3)
    assert found.valley == pytest.approx(4e-6, rel=3e-3)


def test_the_core_turned_upside_down_changes_peaks_for_valleys():
    heights = np.random.default_rng(3311).gamma(3.0, 1e-6, 5000)
    up, down = core(heights), core(-heights)
    assert down.height == pytest.approx(up.height)
    assert (down.peak, down.valley) == pytest.approx((up.valley, up.peak))
    assert down.peak_ratio == pytest.approx(1 - up.valley_ratio)


@given(st.lists(st.integers(-20, 20), min_size=2, max_size=40).filter(lambda heights: len(set(heights)) > 1))
def test_few_points_and_ties_still_have_a_core(heights):
    found = core(np.array(heights) * 1e-7)
    total = np.ptp(heights) * 1e-7
    assert 0 <= found.peak_ratio <= found.valley_ratio <= 1
    assert 0 <= found.height < np.inf
    assert 0 <= found.peak <= 2.1 * total
    assert 0 <= found.valley <= 2.1 * total


def test_the_drawn_curve_falls_from_the_highest_point_to_the_lowest():
    heights = np.random.default_rng(3312).normal(size=(30, 40))
    ratio, height = bearing_curve(heights, 101)
    assert (ratio[0], ratio[-1], ratio.size) == (0, 1, 101)
    assert (height[0], height[-1]) == (heights.max(), heights.min())
    assert (np.diff(height) <= 0).all()


def test_the_drawn_curve_of_a_sinusoid_is_a_cosine():
    ratio, height = bearing_curve(2e-6 * np.sin(2 * np.pi * (np.arange(5000) + 0.5) / 5000))
    np.testing.assert_allclose(height, exact.sinusoid_bearing_curve(ratio, 2e-6), atol=1e-12)


def test_the_drawn_curve_of_a_gaussian_is_its_quantile(gaussian_heights):
    ratio, height = bearing_curve(gaussian_heights(20_000, 1e-7), 21)
    np.testing.assert_allclose(height[1:-1], exact.gaussian_bearing_curve(ratio[1:-1], 1e-7), rtol=1e-6, atol=1e-14)


def test_one_ratio_is_no_curve():
    with pytest.raises(InputError, match="at least 2"):
        bearing_curve([0.0, 1.0], 1)


def test_constant_heights_have_no_curve():
    with pytest.raises(InputError, match="all the same"):
        bearing_curve(np.full(20, 0.3))


@pytest.mark.parametrize("ratio", [0.1, 0.5, 0.8])
def test_closed_forms_of_volumes_are_their_quadratures(ratio):
    """Vm(p) = ∫₀ᵖ (Smc(r) − Smc(p)) dr and Vv(p) = ∫ₚ¹ (Smc(p) − Smc(r)) dr."""
    for curve, material, void in (
        (exact.gaussian_bearing_curve, exact.gaussian_material_volume, exact.gaussian_void_volume),
        (exact.sinusoid_bearing_curve, exact.sinusoid_material_volume, exact.sinusoid_void_volume),
    ):
        above, _ = integrate.quad(lambda r, curve=curve: curve(r, 2.0) - curve(ratio, 2.0), 0, ratio)
        below, _ = integrate.quad(lambda r, curve=curve: curve(ratio, 2.0) - curve(r, 2.0), ratio, 1)
        assert material(ratio, 2.0) == pytest.approx(above, rel=1e-7)
        assert void(ratio, 2.0) == pytest.approx(below, rel=1e-7)


@pytest.mark.parametrize("ratio", [0.1, 0.8])
def test_gaussian_heights_have_their_volumes(gaussian_heights, ratio):
    ordered = descending(gaussian_heights(100_001, 3e-7))
    assert material_volume(ordered, ratio) == pytest.approx(exact.gaussian_material_volume(ratio, 3e-7), rel=2e-4)
    assert void_volume(ordered, ratio) == pytest.approx(exact.gaussian_void_volume(ratio, 3e-7), rel=2e-4)


def test_the_volumes_of_a_sinusoid_converge_with_second_order():
    counts = np.array([100, 200, 400, 800])
    for volume, expected in (
        (material_volume, exact.sinusoid_material_volume(0.1, 1.0)),
        (void_volume, exact.sinusoid_void_volume(0.8, 1.0)),
    ):
        errors = [
            abs(
                volume(
                    descending(np.sin(2 * np.pi * (np.arange(n) + 0.25) / n)), 0.1 if volume is material_volume else 0.8
                )
                - expected
            )
            for n in counts
        ]
        assert np.polyfit(np.log(counts), np.log(errors), 1)[0] < -1.8


def test_material_and_void_differ_by_the_height_above_the_mean():
    """Vv(p) − Vm(p) = Smc(p) − ⟨z⟩, whatever the heights."""
    ordered = descending(np.random.default_rng(3313).gamma(2.0, 1e-6, 777))
    for ratio in (0.0, 0.1, 0.37, 0.8, 1.0):
        difference = void_volume(ordered, ratio) - material_volume(ordered, ratio)
        assert difference == pytest.approx(height_at_ratio(ordered, ratio) - ordered.mean(), rel=1e-9)


def test_the_height_at_a_ratio_inverts_the_ratio_at_a_height():
    ordered = descending(np.random.default_rng(3314).normal(size=500))
    for ratio in (0.01, 0.25, 0.5, 0.975):
        assert material_ratio(ordered, height_at_ratio(ordered, ratio)) == pytest.approx(ratio, rel=1e-9)
    assert (material_ratio(ordered, 9.0), material_ratio(ordered, -9.0)) == (0.0, 1.0)
    assert (height_at_ratio(ordered, 0.0), height_at_ratio(ordered, 1.0)) == (ordered[0], ordered[-1])


@pytest.mark.parametrize("ratio", [-0.1, 1.1, np.nan])
def test_a_ratio_out_of_range_is_refused(ratio):
    with pytest.raises(InputError, match="from 0 to 1"):
        height_at_ratio(descending([0.0, 1.0]), ratio)
