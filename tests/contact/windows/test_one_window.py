"""One window shows the scatter of Sq between windows to a factor of two; elsewhere it shows a bound, or nothing."""

import numpy as np
import pytest

from roughfilm.contact.surfaces.surface import Surface
from roughfilm.contact.synthetic.description import make, read_entries
from roughfilm.contact.windows.one_window import MAX_SCATTER, rms_height_scatter

SIZE = {"size": ["512 um", "512 um"], "points": [512, 512]}
RANDOM = {**SIZE, "seed": 5, "rms_height": "1 um", "amplitudes": "random"}
GAUSSIAN = {**RANDOM, "kind": "gaussian"}
AFFINE = {**RANDOM, "kind": "self_affine", "cut_off": "4 um"}
HONED = {
    **SIZE,
    "kind": "plateau_honed",
    "seed": 5,
    "plateau_rms_height": "0.15 um",
    "plateau_correlation_length": "8 um",
    "valley_rms_height": "1.2 um",
    "valley_correlation_length": "10 um",
    "material_ratio": 0.8,
}
HATCHED = {
    **SIZE,
    "kind": "cross_hatch",
    "spacing": "64 um",
    "half_angle": "45 deg",
    "depth": "1 um",
    "width": "6 um",
}
MILLED = {**SIZE, "kind": "milled", "radius": "700 um", "feed": "8 um", "depth": "1 um", "back_lift": "0.3 um"}
KINDS = {
    "fine": {**GAUSSIAN, "correlation_length": "6 um"},
    "coarse": {**GAUSSIAN, "correlation_length": "15 um"},
    "exponential": {**GAUSSIAN, "correlation_length": "10 um", "autocorrelation": "exponential"},
    "lay": {**GAUSSIAN, "correlation_length": "4 um", "anisotropy": 8, "lay_angle": "30 deg"},
    "skew": {**GAUSSIAN, "correlation_length": "8 um", "height_distribution": {"skewness": -0.5}},
    "Hurst 0.3": {**AFFINE, "hurst": 0.3, "roll_off": "40 um"},
    "Hurst 0.8": {**AFFINE, "hurst": 0.8, "roll_off": "40 um"},
}


def windows_of(description, side=64):
    """All windows of a described surface, and the relative standard deviation of Sq between them."""
    heights = make(read_entries(description)).heights
    cut = [heights[i : i + side, j : j + side] for i, j in side * np.array(list(np.ndindex(512 // side, 512 // side)))]
    sq = np.array([one.std() for one in cut])
    return [Surface(heights=one, spacing=(1e-6, 1e-6)) for one in cut], sq.std(ddof=1) / sq.mean()


@pytest.mark.parametrize("name", KINDS)
def test_the_scatter_that_one_window_shows_is_that_of_many_to_a_factor_of_two(name):
    windows, true = windows_of(KINDS[name])
    shown = [rms_height_scatter(one) for one in windows]
    ratios = np.array([one for one in shown if one is not None and one <= MAX_SCATTER]) / true
    assert len(ratios) >= 32
    assert np.mean((ratios >= 0.5) & (ratios <= 2)) >= 0.9


def test_the_scatter_of_periodic_grooves_is_at_most_that_shown():
    windows, true = windows_of(MILLED)
    assert min(map(rms_height_scatter, windows)) > true


def test_a_window_without_its_longest_waves_shows_a_lower_bound():
    windows, true = windows_of({**GAUSSIAN, "correlation_length": "50 um"})
    shown = np.array([one for one in map(rms_height_scatter, windows) if one is not None])
    assert np.median(shown) > MAX_SCATTER
    assert np.median(shown) < true


@pytest.mark.parametrize("description", [HONED, HATCHED])
def test_rare_valleys_show_nothing(description):
    windows, _ = windows_of(description)
    assert np.mean([rms_height_scatter(one) is None for one in windows]) > 0.9


def test_a_flat_surface_shows_nothing():
    assert rms_height_scatter(Surface(heights=np.ones((8, 8)), spacing=(1.0, 1.0))) is None
