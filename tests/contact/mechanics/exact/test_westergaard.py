"""Ridges in line contact: pressure, gap and displacement that fit together, by quadrature alone."""

import dataclasses

import numpy as np
import pytest
from scipy.integrate import quad

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.mechanics.exact.westergaard import Westergaard

DEPTH, LENGTH, MODULUS = 2e-6, 3e-4, 1.1e11
FULL = np.pi * MODULUS * DEPTH / LENGTH


def ridges(ratio):
    """Under a part of the load of full contact."""
    return Westergaard(amplitude=DEPTH, wavelength=LENGTH, composite_modulus=MODULUS, load=ratio * FULL)


def integral(function, start, end, points=None):
    return quad(function, start, end, points=points, epsabs=0, epsrel=1e-10, limit=400)[0]


def displaced(contact, x):
    """Displacement at a point by the periodic line load, −2/(πE*) ∫ p(s) ln|2 sin(π(x − s)/L)| ds; its mean is 0."""
    a = contact.half_width
    inside = [x] if abs(x) < a else None
    with np.errstate(divide="ignore"):
        total = integral(
            lambda s: contact.pressure(s) * np.log(np.abs(2 * np.sin(np.pi * (x - s) / LENGTH))), -a, a, inside
        )
    return -2 / (np.pi * MODULUS) * total


@pytest.mark.parametrize("ratio", [0.003, 0.1, 0.3, 0.8, 0.999, 1.0, 2.5])
def test_pressure_is_above_0_in_contact_and_bears_the_load(ratio):
    contact = ridges(ratio)
    a = contact.half_width
    assert integral(contact.pressure, 0, a) * 2 / LENGTH == pytest.approx(ratio * FULL, rel=1e-9)
    assert (contact.pressure(np.linspace(-0.999, 0.999, 501) * a) > 0).all()
    if ratio < 1:
        assert (contact.pressure(np.linspace(1.000001 * a, LENGTH - 1.000001 * a, 501)) == 0).all()


@pytest.mark.parametrize("ratio", [0.0, 0.003, 0.1, 0.3, 0.8, 0.999, 1.0, 2.5])
def test_gap_opens_outside_contact_and_has_the_stated_mean(ratio):
    contact = ridges(ratio)
    a = contact.half_width
    assert (contact.gap(np.linspace(-1, 1, 501) * a * (1 - 1e-12)) == 0).all()
    mean = integral(contact.gap, a, LENGTH / 2) * 2 / LENGTH if ratio < 1 else 0.0
    assert contact.mean_gap == pytest.approx(mean, rel=1e-6, abs=1e-15 * DEPTH)
    outside = contact.gap(np.linspace(a, LENGTH / 2, 301))
    assert (np.diff(outside) > 0).all() or ratio >= 1


@pytest.mark.parametrize("ratio", [0.05, 0.3, 0.7])
def test_the_pressure_deforms_the_ridges_to_that_gap(ratio):
    """Gap and pressure are complementary by a displacement that knows the pressure alone."""
    contact = ridges(ratio)
    a = contact.half_width
    for x in [0.0, 0.31 * a, 0.9 * a, a + 0.1 * (LENGTH / 2 - a), 0.8 * LENGTH / 2, LENGTH / 2]:
        down = displaced(contact, x)
        assert contact.displacement(x) == pytest.approx(down, abs=1e-8 * DEPTH)
        gap = DEPTH * (1 - np.cos(2 * np.pi * x / LENGTH)) + down - contact.approach
        assert contact.gap(x) == pytest.approx(gap, abs=1e-8 * DEPTH)


def test_from_the_load_of_full_contact_on_the_pressure_is_a_wave():
    x = np.linspace(0, LENGTH, 41)
    for ratio in (1.0, 1.7):
        contact = ridges(ratio)
        assert contact.area_fraction == 1
        assert contact.approach == pytest.approx(DEPTH)
        wave = FULL * (ratio + np.cos(2 * np.pi * x / LENGTH))
        np.testing.assert_allclose(contact.pressure(x), wave, rtol=0, atol=1e-12 * FULL)
    nearly = ridges(1 - 1e-12).pressure(x)
    np.testing.assert_allclose(nearly, FULL * (1 + np.cos(2 * np.pi * x / LENGTH)), rtol=0, atol=3e-6 * FULL)


def test_lightly_loaded_crests_are_hertzian():
    """A crest of radius L²/(4π²D) bears f = PL: a² = 4fR/(πE*), with an error of the order of the load."""
    radius = LENGTH**2 / (4 * np.pi**2 * DEPTH)
    errors = []
    for ratio in (1e-2, 1e-3):
        hertz = np.sqrt(4 * ratio * FULL * LENGTH * radius / (np.pi * MODULUS))
        errors.append(ridges(ratio).half_width / hertz - 1)
    assert errors[0] < 2e-3
    assert errors[0] / errors[1] == pytest.approx(10, rel=0.01)


def test_a_period_on_nothing_changes():
    contact, x = ridges(0.4), np.linspace(-LENGTH, LENGTH, 57)
    for profile in (contact.pressure, contact.gap, contact.displacement):
        scale = np.abs(profile(x)).max()
        np.testing.assert_allclose(profile(x + LENGTH), profile(x), rtol=0, atol=1e-6 * scale)
        np.testing.assert_allclose(profile(-x), profile(x), rtol=0, atol=1e-12 * scale)


@pytest.mark.parametrize("name", ["amplitude", "wavelength", "composite_modulus", "load"])
@pytest.mark.parametrize("value", [-1.0, float("nan"), float("inf"), True, "1"])
def test_what_makes_no_sense_is_refused(name, value):
    with pytest.raises(InputError, match=name):
        dataclasses.replace(ridges(0.5), **{name: value})
