"""Masked points of an array are unknown: a surface marks them as invalid, and everything else refuses them."""

import numpy as np
import pytest

import roughfilm as rf
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.mechanics.estimates.truncation import bearing_area
from roughfilm.contact.mechanics.moments import wave_power
from roughfilm.contact.mechanics.press import Press
from roughfilm.contact.mechanics.reference.stanley_kato import stanley_kato
from roughfilm.contact.parameters.bearing_curve import bearing_curve
from roughfilm.contact.parameters.heights import height_statistics
from roughfilm.contact.parameters.roughness_parameters import profile_parameters
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.contact.synthetic.rearrangement import rearranged
from roughfilm.rom.bearing.mixed.tabulate import tabulate_pressed
from roughfilm.rom.homogenization.flow_factors import flow_factors
from roughfilm.rom.homogenization.line import line_factors, profile_over_gap
from roughfilm.rom.homogenization.table.tabulate import tabulate
from roughfilm.rom.seal.leakage.direct import direct_leakage
from roughfilm.rom.seal.leakage.homogenized import homogenized_leakage

SPACING = (1e-6, 1e-6)
PLAIN = 1e-6 * np.random.default_rng(4).random((16, 12))
MASKED = np.ma.masked_greater(PLAIN, 0.9e-6)

USES = {
    "press": lambda z: Press(z, SPACING, 1e11),
    "stanley_kato": lambda z: stanley_kato(z, SPACING, 1e11, 1e7),
    "wave_power": lambda z: wave_power(z, SPACING),
    "bearing_area": lambda z: bearing_area(z, load=1e6, hardness=1e9),
    "bearing_curve": bearing_curve,
    "height_statistics": height_statistics,
    "profile_parameters": lambda z: profile_parameters(z.ravel(), 1e-6),
    "rearranged": lambda z: rearranged(z.ravel(), seed=1, folds=1, levels=1),
    "flow_factors": lambda z: flow_factors(z, SPACING),
    "line_factors": lambda z: line_factors(z.ravel()),
    "profile_over_gap": lambda z: profile_over_gap(z.ravel()),
    "tabulate": lambda z: tabulate(z, SPACING),
    "tabulate_pressed": lambda z: tabulate_pressed(z, SPACING, 1e11),
    "direct_leakage": lambda z: direct_leakage(z, SPACING),
    "homogenized_leakage": lambda z: homogenized_leakage(z, SPACING),
    "interface press": lambda z: rf.press(z, spacing=1e-6, modulus=1e11, load=1e7),
    "interface parameters": lambda z: rf.parameters(z, spacing=1e-6),
    "interface flow factors": lambda z: rf.flow_factors(z, spacing=1e-6, gap=3e-6),
}


@pytest.mark.parametrize("use", USES)
def test_masked_heights_and_gaps_are_refused(use):
    with pytest.raises(InputError, match=f"{np.ma.count_masked(MASKED)} of 192 points are masked") as caught:
        USES[use](MASKED)
    assert "\n" not in str(caught.value)


def test_a_surface_uses_the_mask():
    surface = Surface(heights=MASKED, spacing=SPACING)
    assert np.array_equal(surface.invalid, MASKED.mask)
    assert surface.heights[surface.valid] == pytest.approx(PLAIN[~MASKED.mask])
    assert not surface.heights[surface.invalid].any()


def test_a_mask_adds_to_the_invalid_points():
    invalid = np.zeros(PLAIN.shape, dtype=bool)
    invalid[3, 4] = True
    assert np.array_equal(Surface(heights=MASKED, spacing=SPACING, invalid=invalid).invalid, MASKED.mask | invalid)


def test_an_array_without_a_masked_point_is_like_any_other():
    whole = np.ma.masked_array(PLAIN)
    contact = rf.press(whole, spacing=1e-6, modulus=1e11, load=1e7)
    assert contact.mean_gap == rf.press(PLAIN, spacing=1e-6, modulus=1e11, load=1e7).mean_gap
