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
from roughfilm.contact.parameters.roughness_parameters import parameters, profile_parameters
from roughfilm.contact.surfaces.surface import Surface

HEIGHTS = ("Sa", "Sq", "Sp", "Sv", "Sz", "Sk", "Spk", "Svk", "St", "Spm", "Svm")
SHAPES = ("Ssk", "Sku", "Smr1", "Smr2", "Str")
TURNS = ("Std",)
LENGTHS = ("Sal",)


def numbers(surface):
    return {name: quantity.value for name, quantity in parameters(surface).items()}


def assert_same(found, expected, *, rel=1e-9, names=HEIGHTS + SHAPES + LENGTHS + TURNS):
    for name in names:
        assert found[name] == pytest.approx(expected[name], rel=rel, abs=1e-12 if name in SHAPES else 0), name


def test_they_come_in_order_with_units(band_limited):
    found = parameters(band_limited(7001, (40, 50)))
    assert " ".join(found) == "Sa Sq Sp Sv Sz Ssk Sku Sk Spk Svk Smr1 Smr2 Sal Str Std St Spm Svm"
    for name, quantity in found.items():
        assert quantity.unit == ("1" if name in SHAPES else "deg" if name in TURNS else "m")
        assert pint.UnitRegistry().Quantity(quantity.value, quantity.unit).check("[length]") == (quantity.unit == "m")
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
        "Sal": 64e-6 / np.sqrt(2) * np.arccos(0.2) / (2 * np.pi),
        "Std": 45.0,
        "Spm": 2e-6,
        "Svm": 2e-6,
    }
    for name, value in expected.items():
        assert found[name] == pytest.approx(value, rel=2e-3, abs=1e-15), name
    assert found["Ssk"] == pytest.approx(0, abs=1e-9)
    assert found["Str"] < 0.1


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
    assert_same(found, {name: up * expected[name] for name in HEIGHTS}, names=HEIGHTS)
    assert_same(found, {name: along * expected[name] for name in LENGTHS}, names=LENGTHS)


@pytest.mark.parametrize("periodic", [True, False])
def test_transposed_the_lay_is_mirrored_and_nothing_else_changes(band_limited, periodic):
    surface = dataclasses.replace(band_limited(7005, (40, 50), size=(1e-3, 7e-4)), periodic=periodic)
    turned = dataclasses.replace(
        surface, heights=surface.heights.T, spacing=surface.spacing[::-1], invalid=surface.invalid.T
    )
    found, expected = numbers(turned), numbers(surface)
    assert_same(found, expected, names=HEIGHTS + SHAPES + LENGTHS)
    assert (found["Std"] + expected["Std"] - 90) % 180 == pytest.approx(0, abs=0.01)


def test_upside_down_peaks_and_valleys_change_places(band_limited):
    surface = band_limited(7006, (60, 70))
    found, expected = numbers(surface.with_heights(-surface.heights)), numbers(surface)
    assert_same(found, expected, names=("Sa", "Sq", "Sz", "Sku", "Sk", "Sal", "Str", "Std"))
    for one, other in (("Sp", "Sv"), ("Spk", "Svk"), ("Spm", "Svm")):
        assert found[one] == pytest.approx(expected[other])
        assert found[other] == pytest.approx(expected[one])
    assert found["Ssk"] == pytest.approx(-expected["Ssk"])
    assert found["Smr1"] == pytest.approx(1 - expected["Smr2"])


@pytest.mark.parametrize("shape", [(128, 128), (129, 131), (180, 128)])
def test_resampled_without_loss_they_stay(band_limited, shape):
    """Moments and lay are exact while four times the band fits; the rest has its error at 5 points a bump."""
    found, expected = numbers(band_limited(7007, shape, band=24)), numbers(band_limited(7007, (512, 512), band=24))
    assert_same(found, expected, names=("Sq", "Ssk", "Sku", "Std"), rel=1e-9)
    assert_same(found, expected, names=("Sal", "Str", "Sa"), rel=3e-4)
    assert_same(found, expected, names=("Sp", "Sv", "Sz", "St", "Spm", "Svm"), rel=0.02)
    assert_same(found, expected, names=("Sk", "Spk", "Svk"), rel=0.02)
    assert_same(found, expected, names=("Smr1", "Smr2"), rel=0.05)


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
    assert found["Spm"] <= found["Sp"] * (1 + 1e-12)
    assert found["Svm"] <= found["Sv"] * (1 + 1e-12)
    assert 0 <= found["Smr1"] <= found["Smr2"] <= 1


def test_a_profile_has_those_of_a_surface_of_the_same_heights():
    heights = np.random.default_rng(7009).normal(size=4000) * 1e-7
    line = profile_parameters(heights)
    plane = parameters(Surface(heights=heights.reshape(50, 80), spacing=(1e-6, 1e-6)))
    assert " ".join(line) == "Ra Rq Rt Rsk Rku Rk Rpk Rvk Rmr1 Rmr2"
    for name, quantity in line.items():
        assert quantity == plane["S" + name[1:]]


def test_a_sinusoidal_profile_has_its_closed_form():
    line = profile_parameters(3e-6 * np.sin(2 * np.pi * (np.arange(10_000) + 0.25) / 1000))
    assert line["Ra"].value == pytest.approx(6e-6 / np.pi, rel=1e-5)
    assert line["Rq"].value == pytest.approx(3e-6 / np.sqrt(2), rel=1e-9)
    assert line["Rsk"].value == pytest.approx(0, abs=1e-9)
    assert line["Rku"].value == pytest.approx(1.5, rel=1e-9)


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
        profile_parameters(heights)
