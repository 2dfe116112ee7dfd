"""The bearing area: from bearing curves in closed form, and as the limit of soft contact."""

import numpy as np
import pytest
from scipy import stats
from scipy.integrate import quad

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.mechanics.estimates.truncation import bearing_area
from roughfilm.contact.mechanics.moments import wave_power
from roughfilm.contact.mechanics.press import Press
from roughfilm.contact.parameters.exact import gaussian_bearing_curve, sinusoid_bearing_curve
from roughfilm.contact.synthetic.self_affine import self_affine


def mean_gap_below(curve, ratio):
    """∫ (c(ratio) − c(m)) dm over the part that stays below the plane."""
    return quad(lambda m: curve(ratio) - curve(m), ratio, 1)[0]


@pytest.mark.parametrize("ratio", [0.01, 0.1, 0.5, 0.9])
def test_a_sinusoid_is_cut_where_its_bearing_curve_says(ratio):
    z = 2e-6 * np.sin(2 * np.pi * (np.arange(4000) + 0.5) / 4000)
    found = bearing_area(z[:, None], load=ratio * 3e9, hardness=3e9)
    assert found.area_fraction == found.plastic_fraction == pytest.approx(ratio)
    assert found.mean_gap == pytest.approx(mean_gap_below(lambda m: sinusoid_bearing_curve(m, 2e-6), ratio), rel=1e-3)
    assert found.mean_contact_pressure == pytest.approx(3e9)
    assert found.plasticity_index == 1


@pytest.mark.parametrize("ratio", [0.01, 0.3, 0.7])
def test_gaussian_heights_are_cut_where_their_bearing_curve_says(ratio, gaussian_heights):
    found = bearing_area(gaussian_heights(20_000, 1e-6), load=ratio, hardness=1.0)
    expected = mean_gap_below(lambda m: gaussian_bearing_curve(m, 1e-6), ratio)
    assert found.mean_gap == pytest.approx(expected, rel=1e-3)


def test_no_load_and_the_hardness_are_limits():
    z = stats.norm.rvs(size=(30, 20), random_state=5119) * 1e-6
    untouched, flat = (bearing_area(z, load=load, hardness=2e9) for load in (0.0, 2e9))
    assert untouched.area_fraction == 0
    assert untouched.mean_gap == pytest.approx(z.max() - z.mean())
    assert flat.area_fraction == 1
    assert flat.mean_gap == 0


def test_it_is_the_limit_of_a_soft_solid():
    """H = 0.01 E* g': the solved gap is below it, by less the softer the solid."""
    surface = self_affine(
        size=(1e-3, 1e-3), points=(96, 96), seed=5147, hurst=0.8, roll_off=2e-4, cut_off=5e-5, rms_slope=0.1
    )
    slope = wave_power(surface.heights, surface.spacing).moments.rms_slope
    short = []
    for softness in (0.1, 0.01):
        hardness = softness * 1e11 * slope
        solved = Press(surface.heights, surface.spacing, 1e11, hardness=hardness).at(0.2 * hardness, tolerance=1e-6)
        found = bearing_area(
            surface.heights, load=0.2 * hardness, hardness=hardness, composite_modulus=1e11, rms_slope=slope * 1.001
        )
        assert found.trusted
        assert solved.area_fraction_pixel == pytest.approx(found.area_fraction, rel=0.4 * softness)
        short.append(1 - solved.mean_gap / found.mean_gap)
    assert 0 < short[1] < 0.2 * short[0]
    assert short[0] < 0.15


def test_a_hard_solid_is_not_trusted_to_it():
    z = np.array([[0.0, 1e-6], [2e-6, 3e-6]])
    assert not bearing_area(z, load=1e9, hardness=4e9, composite_modulus=1e11, rms_slope=0.1).trusted
    assert bearing_area(z, load=1e9, hardness=4e9).trusted


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"hardness": np.inf}, "solid is elastic"),
        ({"hardness": 0.0}, "hardness"),
        ({"load": 5e9}, "beyond the hardness"),
        ({"load": -1.0}, "load"),
        ({"load": np.nan}, "load"),
        ({"composite_modulus": 1e11}, "rms_slope"),
    ],
)
def test_what_makes_no_sense_is_refused(changes, words):
    with pytest.raises(InputError, match=words):
        bearing_area([0.0, 1e-6], **({"load": 1e9, "hardness": 4e9} | changes))
