"""The mismatch distinguishes true periods from windows, and does not depend on where a surface is cut."""

import numpy as np
import pytest

from roughfilm.contact.surfaces.periodicity import MISMATCH_THRESHOLD, periodicity_mismatch
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.contact.synthetic.self_affine import self_affine


def periodic(seed, n=256):
    return self_affine(
        size=(1e-3, 1e-3), points=(n, n), seed=seed, hurst=0.8, roll_off=1e-3 / 8, cut_off=1e-3 / 64, rms_height=1e-6
    )


def test_truly_periodic_surfaces_pass_and_windows_of_them_fail():
    whole, part = [], []
    for seed in range(900, 940):
        surface = periodic(seed)
        whole.append(periodicity_mismatch(surface))
        window = surface.with_heights(surface.heights[:192, :192], invalid=np.zeros((192, 192), bool))
        part.append(periodicity_mismatch(window))
    assert np.mean(np.array(whole) > MISMATCH_THRESHOLD) <= 0.05
    assert min(part) > MISMATCH_THRESHOLD
    assert np.median(part) > 0.5


def test_a_scratch_hides_no_joint():
    """One place inside that is steeper than the joint must not pass for what is usual there."""
    window = periodic(943).heights[:192, :192].copy()
    plain = periodicity_mismatch(Surface(heights=window, spacing=(1.0, 1.0)))
    window[50] -= 6e-6
    window[:, 70] -= 6e-6
    assert periodicity_mismatch(Surface(heights=window, spacing=(1.0, 1.0))) > 0.4 * plain > 2 * MISMATCH_THRESHOLD


def test_a_ridge_that_does_not_go_on_is_found_through_a_smooth_joint():
    """Slanted ridges, faded to nothing over three lines at the joint: no jump is left, the mismatch is."""
    x, y = np.meshgrid(np.arange(256), np.arange(256), indexing="ij")
    ridges = np.sin(2 * np.pi * (x / 32 + 0.5 * y / 256))
    distance = np.minimum(np.arange(256), np.arange(256)[::-1])
    faded = ridges * np.minimum(1, distance / 3)[None, :]
    assert np.abs(faded[:, 0] - faded[:, -1]).max() == 0
    assert periodicity_mismatch(Surface(heights=faded, spacing=(1.0, 1.0))) > 3 * MISMATCH_THRESHOLD
    whole = np.sin(2 * np.pi * (x / 32 + y / 256))
    assert periodicity_mismatch(Surface(heights=whole, spacing=(1.0, 1.0))) == pytest.approx(0, abs=1e-12)


def test_it_has_no_unit_and_no_preferred_axis():
    heights = periodic(941).heights[:150, :200]
    value = periodicity_mismatch(Surface(heights=heights, spacing=(1e-6, 2e-6)))
    for other in (7 * heights + 3e-6, heights.T, heights[::-1], -heights):
        assert periodicity_mismatch(Surface(heights=other, spacing=(1e-6, 1e-6))) == pytest.approx(value, rel=1e-9)


@pytest.mark.parametrize("shape", [(2, 2), (2, 9), (3, 5)])
def test_few_pixels_are_no_fault(shape):
    heights = np.random.default_rng(942).normal(size=shape)
    assert np.isfinite(periodicity_mismatch(Surface(heights=heights, spacing=(1.0, 1.0))))
