"""All parameters together: their order and units, what leaves them alone, and no surface that breaks them."""

import dataclasses

import numpy as np
import pint
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.parameters import exact
from roughfilm.contact.parameters.definitions import AREAL, PROFILE
from roughfilm.contact.parameters.roughness_parameters import parameters, profile_parameters
from roughfilm.contact.surfaces.surface import Surface

HEIGHTS = ("Sa", "Sq", "Sp", "Sv", "Sz", "Sk", "Spk", "Svk", "St", "Spm", "Svm", "Sxp", "S5p", "S5v", "S10z")
HEIGHTS += ("Vmp", "Vmc", "Vvc", "Vvv")
OF_FEATURES = ("Spc", "S5p", "S5v", "S10z")
"""Parameters that a surface without a significant peak or pit does not have."""

SHAPES = ("Ssk", "Sku", "Smr1", "Smr2", "Str")
TURNS = ("Std",)
LENGTHS = ("Sal",)
UNITS = {"Spd": "1/m^2", "Spc": "1/m"} | dict.fromkeys((*SHAPES, "Sdq", "Sdr"), "1") | dict.fromkeys(TURNS, "deg")
DIMENSIONS = {"m": "[length]", "1/m": "1/[length]", "1/m^2": "1/[length]**2", "1": "[]", "deg": "[]"}


def numbers(surface):
    return {name: quantity.value for name, quantity in parameters(surface).items()}


def assert_same(found, expected, *, rel=1e-9, names=HEIGHTS + SHAPES + LENGTHS + TURNS):
    for name in names:
        assert (name in found) == (name in expected)
        if name in found or name not in OF_FEATURES:
            assert found[name] == pytest.approx(expected[name], rel=rel, abs=1e-12 if name in SHAPES else 0), name


def test_they_come_in_order_with_units(band_limited):
    found = parameters(band_limited(7001, (40, 50)))
    assert list(found) == list(AREAL)
    units = pint.UnitRegistry()
    for name, quantity in found.items():
        assert quantity.unit == UNITS.get(name, "m")
        assert units.Quantity(quantity.value, quantity.unit).check(DIMENSIONS[quantity.unit])
        assert isinstance(quantity.value, float)


def test_ridges_have_all_their_closed_forms():
    """64 points a wave, 8 waves at 45° over a square."""
    i = np.arange(512)
    surface = Surface(
        heights=2e-6 * np.sin(2 * np.pi * (np.add.outer(i, -i) + 0.25) / 64), spacing=(1e-6, 1e-6), periodic=True
    )
    found, statistics, core = numbers(surface), exact.sinusoid_statistics(2e-6), exact.sinusoid_core(2e-6)
    expected = {
        "Sa": statistics.average,
        "Sq": statistics.rms,
        "Sz": statistics.total,
        "Sku": statistics.kurtosis,
        "Sk": core.height,
        "Spk": 0.0,
        "Sxp": 2e-6 * np.cos(0.025 * np.pi),
        "Sdq": 2e-6 * (2 * np.pi / 64e-6),  # the wave vector has the length √2 · 2π/64 µm
        "S5p": 2e-6,
        "S10z": 4e-6,
        "Sal": 64e-6 / np.sqrt(2) * np.arccos(0.2) / (2 * np.pi),
        "Std": 45.0,
        "Spm": 2e-6,
        "Svm": 2e-6,
    }
    for name, value in expected.items():
        assert found[name] == pytest.approx(value, rel=2e-3, abs=1e-15), name
    assert found["Ssk"] == pytest.approx(0, abs=1e-9)
    assert found["Str"] < 0.1


def test_waves_whose_phases_are_all_different_have_their_volumes():
    """Each line along y is 1/256 of the spacing ahead of the one before; eight points have nearly the same height."""
    i, j = np.arange(256), np.arange(256)
    heights = 2e-6 * np.sin(2 * np.pi * (np.add.outer(i, j / 256) + 0.001) / 64)
    found = numbers(Surface(heights=heights, spacing=(1e-6, 1e-6)))
    peaks, valleys = exact.sinusoid_material_volume(0.1, 2e-6), exact.sinusoid_void_volume(0.8, 2e-6)
    assert found["Vmp"] == pytest.approx(peaks, rel=1e-3)
    assert found["Vmc"] == pytest.approx(exact.sinusoid_material_volume(0.8, 2e-6) - peaks, rel=1e-3)
    assert found["Vvc"] == pytest.approx(exact.sinusoid_void_volume(0.1, 2e-6) - valleys, rel=1e-3)
    assert found["Vvv"] == pytest.approx(valleys, rel=1e-3)


@pytest.mark.parametrize("shift", [(1, 0), (-7, 23), (20, 25)])
def test_a_periodic_shift_leaves_them_alone(band_limited, shift):
    surface = band_limited(7002, (40, 50))
    moved = surface.with_heights(np.roll(surface.heights, shift, axis=(0, 1)))
    assert_same(numbers(moved), numbers(surface))


@pytest.mark.parametrize("periodic", [True, False])
def test_height_of_the_mean_is_none(band_limited, periodic):
    surface = dataclasses.replace(band_limited(7003, (40, 50)), periodic=periodic)
    assert_same(numbers(surface.with_heights(surface.heights + 1e-4)), numbers(surface), rel=1e-6)


@pytest.mark.parametrize("periodic", [True, False])
@pytest.mark.parametrize(("up", "along"), [(3.0, 1.0), (1.0, 1e3), (1e-3, 1e-3), (7e5, 0.3)])
def test_lengths_scale_and_ratios_stay(band_limited, up, along, periodic):
    surface = dataclasses.replace(band_limited(7004, (40, 50)), periodic=periodic)
    scaled = dataclasses.replace(
        surface, heights=up * surface.heights, spacing=tuple(along * length for length in surface.spacing)
    )
    found, expected = numbers(scaled), numbers(surface)
    assert_same(found, expected, names=SHAPES + TURNS)
    assert_same(found, {name: up * expected[name] for name in HEIGHTS if name in expected}, names=HEIGHTS)
    assert_same(found, {name: along * expected[name] for name in LENGTHS}, names=LENGTHS)
    assert found["Sdq"] == pytest.approx(up / along * expected["Sdq"])
    assert found["Spd"] == pytest.approx(expected["Spd"] / along**2)
    if "Spc" in expected:
        assert found["Spc"] == pytest.approx(up / along**2 * expected["Spc"])


@pytest.mark.parametrize("periodic", [True, False])
def test_transposed_the_lay_is_mirrored_and_nothing_else_changes(band_limited, periodic):
    surface = dataclasses.replace(band_limited(7005, (40, 50), size=(1e-3, 7e-4)), periodic=periodic)
    turned = dataclasses.replace(
        surface, heights=surface.heights.T, spacing=surface.spacing[::-1], invalid=surface.invalid.T
    )
    found, expected = numbers(turned), numbers(surface)
    assert_same(found, expected, names=HEIGHTS + SHAPES + LENGTHS + ("Sdq", "Sdr", "Spd", "Spc"))
    assert (found["Std"] + expected["Std"] - 90) % 180 == pytest.approx(0, abs=0.01)


def test_upside_down_peaks_and_valleys_change_places(band_limited):
    surface = band_limited(7006, (60, 70))
    found, expected = numbers(surface.with_heights(-surface.heights)), numbers(surface)
    assert_same(found, expected, names=("Sa", "Sq", "Sz", "Sku", "Sk", "Sal", "Str", "Std"))
    for one, other in (("Sp", "Sv"), ("Spk", "Svk"), ("Spm", "Svm"), ("S5p", "S5v")):
        assert found[one] == pytest.approx(expected[other])
        assert found[other] == pytest.approx(expected[one])
    assert found["Ssk"] == pytest.approx(-expected["Ssk"])
    assert found["Smr1"] == pytest.approx(1 - expected["Smr2"])
    assert_same(found, expected, names=("S10z", "Sdq", "Sdr"))


@pytest.mark.parametrize("axis", [0, 1])
@pytest.mark.parametrize("periodic", [True, False])
def test_mirrored_nothing_changes_but_the_lay(band_limited, axis, periodic):
    surface = dataclasses.replace(band_limited(7010, (60, 50)), periodic=periodic)
    found, expected = numbers(surface.with_heights(np.flip(surface.heights, axis))), numbers(surface)
    assert_same(found, expected, names=HEIGHTS + SHAPES + LENGTHS + ("Sdq", "Sdr", "Spd", "Spc"))
    assert (found["Std"] + expected["Std"]) % 180 == pytest.approx(0, abs=0.01)


@pytest.mark.parametrize("shape", [(128, 128), (129, 131), (180, 128)])
def test_resampled_without_loss_they_stay(band_limited, shape):
    """Moments and lay are exact while four times the band fits; the rest has its error at 5 points a bump."""
    found, expected = numbers(band_limited(7007, shape, band=24)), numbers(band_limited(7007, (512, 512), band=24))
    assert_same(found, expected, names=("Sq", "Ssk", "Sku", "Std"), rel=1e-9)
    assert_same(found, expected, names=("Sal", "Str", "Sa"), rel=3e-4)
    assert_same(found, expected, names=("Sp", "Sv", "Sz", "St", "Spm", "Svm"), rel=0.02)
    assert_same(found, expected, names=("Sk", "Spk", "Svk", "Sxp", "Vmp", "Vmc", "Vvc", "Vvv"), rel=0.02)
    assert_same(found, expected, names=("Smr1", "Smr2"), rel=0.05)
    assert_same(found, expected, names=("Sdq", "Sdr"), rel=0.15)


def test_what_is_not_measured_does_not_count(band_limited):
    surface = band_limited(7008, (90, 80))
    invalid = np.zeros(surface.shape, dtype=bool)
    invalid[30:40, 20:60] = True
    holed = surface.with_heights(np.where(invalid, 1.0, surface.heights), invalid=invalid)
    valid = surface.heights[~invalid]
    found = numbers(holed)
    assert found["Sq"] == pytest.approx(valid.std())
    assert found["Sz"] == pytest.approx(np.ptp(valid))
    assert found["Sp"] == pytest.approx(valid.max() - valid.mean())
    whole = numbers(surface)
    assert found["Sal"] == pytest.approx(whole["Sal"], rel=0.1)
    assert found["Std"] == pytest.approx(whole["Std"], abs=5)


@pytest.mark.parametrize("level", [0.0, 0.1, -1e5])
def test_a_constant_surface_is_refused(level):
    with pytest.raises(InputError, match="all the same; roughness needs") as caught:
        parameters(Surface(heights=np.full((6, 7), level), spacing=(1e-6, 1e-6)))
    assert "\n" not in str(caught.value)


@settings(max_examples=150, deadline=None)
@given(
    heights=arrays(
        float,
        st.tuples(st.integers(2, 9), st.integers(2, 9)),
        elements=st.integers(-3, 3).map(float) | st.floats(-1e6, 1e6),
    ),
    holes=st.integers(0, 2**32 - 1),
    part=st.sampled_from([0.0, 0.2, 0.7]),
    periodic=st.booleans(),
    stretch=st.sampled_from([1.0, 1e-3, 1e6]),
)
def test_any_surface_has_finite_parameters_or_is_refused(heights, holes, part, periodic, stretch):
    invalid = np.random.default_rng(holes).random(heights.shape) < part
    try:
        found = numbers(Surface(heights=heights, spacing=(1e-3, stretch * 1e-3), invalid=invalid, periodic=periodic))
    except InputError:
        valid = heights[~invalid]
        assert valid.size == 0 or np.ptp(valid) <= 1e-13 * np.abs(valid).max() + 1e-30
        return
    assert all(np.isfinite(value) for value in found.values())
    assert 0 < found["Sa"] <= found["Sq"] * (1 + 1e-12) <= found["Sz"]
    assert found["Sku"] >= 1 - 1e-9
    assert 0 < found["Str"] <= 1
    assert 0 <= found["Std"] < 180
    for one, other in (("Spm", "Sp"), ("S5p", "Sp"), ("S5v", "Sv"), ("Vmp", "Sz"), ("Vvv", "Sz")):
        assert found.get(one, 0.0) <= found[other] * (1 + 1e-12)
    assert min(found[name] for name in ("Vmp", "Vmc", "Vvc", "Vvv", "Spd", "Sxp")) >= 0
    assert found["Svm"] <= found["Sv"] * (1 + 1e-12)
    assert 0 <= found["Smr1"] <= found["Smr2"] <= 1


def test_a_profile_has_those_of_a_surface_of_the_same_heights():
    heights = np.random.default_rng(7009).normal(size=4000) * 1e-7
    line = profile_parameters(heights, 1e-6)
    plane = parameters(Surface(heights=heights.reshape(50, 80), spacing=(1e-6, 1e-6)))
    assert list(line) == list(PROFILE)
    for name in ["Ra", "Rq", "Rsk", "Rku", "Rk", "Rpk", "Rvk", "Rmr1", "Rmr2"]:
        assert line[name] == plane["S" + name[1:]]
    assert line["Rt"] == plane["Sz"]


def test_a_sinusoidal_profile_has_its_closed_form():
    line = profile_parameters(3e-6 * np.sin(2 * np.pi * (np.arange(10_000) + 0.25) / 1000), 1e-7)
    expected = {
        "Ra": 6e-6 / np.pi,
        "Rq": 3e-6 / np.sqrt(2),
        "Rt": 6e-6,
        "Rp": 3e-6,
        "Rv": 3e-6,
        "Rz": 6e-6,
        "Rku": 1.5,
        "Rdq": 3e-6 / np.sqrt(2) * 2 * np.pi / 1e-4,
        "Rsm": 1e-4,
        "Rc": 6e-6,
    }
    for name, value in expected.items():
        assert line[name].value == pytest.approx(value, rel=1e-4), name
        assert line[name].unit == PROFILE[name].unit
    assert line["Rsk"].value == pytest.approx(0, abs=1e-9)


def test_the_letter_is_that_of_the_profile():
    heights = np.random.default_rng(7011).normal(size=200)
    line = profile_parameters(heights, 1e-6)
    for letter in ("P", "W"):
        other = profile_parameters(heights, 1e-6, profile=letter)
        assert {letter + name[1:]: quantity for name, quantity in line.items()} == other


def test_shifted_or_backwards_a_profile_has_the_same_parameters():
    heights = np.convolve(np.random.default_rng(7012).normal(size=1010), np.ones(11), mode="valid") * 1e-7
    expected = {name: quantity.value for name, quantity in profile_parameters(heights, 1e-6).items()}
    for changed in (heights + 1e-5, heights[::-1]):
        for name, quantity in profile_parameters(changed, 1e-6).items():
            assert quantity.value == pytest.approx(expected[name], rel=1e-6), name


@pytest.mark.parametrize(
    ("heights", "words"),
    [
        (np.zeros((3, 4)), "one line"),
        (3.0, "one line"),
        ([], "got 0 of"),
        ([1e-6], "all the same"),
        ([0.0, np.nan], "leave out"),
    ],
)
def test_what_is_no_profile_is_refused(heights, words):
    with pytest.raises(InputError, match=words):
        profile_parameters(heights, 1e-6)


@pytest.mark.parametrize("spacing", [0.0, -1e-6, np.inf, np.nan])
def test_a_spacing_that_is_none_is_refused(spacing):
    with pytest.raises(InputError, match="above 0"):
        profile_parameters([0.0, 1.0, 0.0], spacing)
