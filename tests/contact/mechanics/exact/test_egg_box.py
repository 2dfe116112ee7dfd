"""The two limits of an egg-box: from crests and troughs alone, and by a contact solver of a few lines."""

import numpy as np
import pytest
from scipy.integrate import quad

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.mechanics.exact.egg_box import EggBox
from roughfilm.contact.mechanics.exact.full_contact import full_contact_pressure
from roughfilm.contact.mechanics.exact.hertz import HertzSphere

DEPTH, LENGTH, MODULUS = 1.5e-6, 4e-4, 9e10
BOX = EggBox(amplitude=DEPTH, wavelength=LENGTH, composite_modulus=MODULUS)
FULL = BOX.full_contact_load


def heights(x, y):
    return DEPTH * np.cos(2 * np.pi * x / LENGTH) * np.cos(2 * np.pi * y / LENGTH)


def solved_area(ratio, count=192):
    """Contact area by conjugate gradients (Polonsky and Keer), less what the pixels of its edge have too much."""
    x = np.arange(count) * LENGTH / count
    q = 2 * np.pi * np.hypot(np.fft.fftfreq(count, x[1])[:, None], np.fft.rfftfreq(count, x[1])[None, :])
    q[0, 0] = np.inf
    undeformed = DEPTH - heights(x[:, None], x[None, :])
    pressure, search, before, keep = np.full((count, count), ratio * FULL), np.zeros((count, count)), 1.0, 0.0

    def lowered(p):
        return np.fft.irfft2(2 / (MODULUS * q) * np.fft.rfft2(p))

    for _ in range(400):
        touching = pressure > 0
        gap = undeformed + lowered(pressure)
        gap -= gap[touching].mean()
        now = np.sum(gap[touching] ** 2)
        search = np.where(touching, gap + keep * now / before * search, 0)
        step = lowered(search)
        step -= step[touching].mean()
        length = np.sum(gap[touching] * search[touching]) / np.sum(step[touching] * search[touching])
        last, before = pressure, now
        pressure = np.maximum(np.where(touching, pressure - length * search, pressure), 0)
        overlap = (pressure == 0) & (gap < 0)
        keep = 0.0 if overlap.any() else 1.0
        pressure = np.where(overlap, -length * gap, pressure)
        pressure *= ratio * FULL / pressure.mean()
        if np.abs(pressure - last).max() < 1e-8 * FULL:
            break
    touching = pressure > 0
    edges = sum(np.count_nonzero(touching != np.roll(touching, 1, axis)) for axis in (0, 1))
    return touching.mean() - (np.pi - 1 + np.log(2)) / 24 * edges / count**2


def test_full_contact_is_that_of_its_two_waves():
    """cos a cos b = ½ cos(a + b) + ½ cos(a − b)."""
    x, y = np.linspace(0, LENGTH, 13)[:, None], np.linspace(0, LENGTH, 17)
    q = 2 * np.pi / LENGTH
    waves = full_contact_pressure(
        x,
        y,
        amplitudes=[DEPTH / 2, DEPTH / 2],
        wave_vectors=[[q, q], [q, -q]],
        composite_modulus=MODULUS,
        load=1.2 * FULL,
    )
    np.testing.assert_allclose(BOX.full_contact_pressure(x, y, 1.2 * FULL), waves, rtol=1e-12)
    assert BOX.full_contact_pressure(LENGTH / 2, 0.0, FULL) == pytest.approx(0, abs=1e-9 * FULL)


def test_light_load_is_carried_by_two_spheres_in_a_period():
    step = 1e-4 * LENGTH
    curvature = (2 * heights(0, 0) - heights(step, 0) - heights(0, step)) / step**2
    assert 1 / BOX.crest_radius == pytest.approx(curvature, rel=1e-6)
    load = 1e-3 * FULL
    crest = HertzSphere(radius=1 / curvature, composite_modulus=MODULUS, force=load * LENGTH**2 / 2)
    area = 2 * np.pi * crest.contact_radius**2 / LENGTH**2
    assert BOX.light_load_area_fraction(load) == pytest.approx(area, rel=1e-6)


def test_the_last_troughs_are_cracks_that_just_stay_open():
    """The tension that closed them would have no stress intensity, ∝ ∫ σ r dr/sqrt(b² − r²), at their edge."""
    load = (1 - 1e-4) * FULL
    crack = LENGTH * np.sqrt((1 - BOX.nearly_full_area_fraction(load)) / (2 * np.pi))

    def tension(r):
        angle = np.linspace(0, 2 * np.pi, 8, endpoint=False)
        trough = heights(LENGTH / 2 + r * np.cos(angle), r * np.sin(angle)).mean() / DEPTH
        return -(load + FULL * trough)

    def intensity(part, integrand):
        return quad(lambda t: integrand(part * crack * np.sin(t)) * np.sin(t), 0, np.pi / 2)[0]

    of_constant = intensity(1, lambda _: tension(0.0))
    assert tension(0.0) > 0
    assert intensity(1, tension) == pytest.approx(0, abs=1e-3 * of_constant)
    assert intensity(1.05, tension) < -0.05 * of_constant
    assert intensity(0.95, tension) > 0.05 * of_constant


@pytest.mark.parametrize(("ratio", "error"), [(0.01, 0.03), (0.03, 0.06), (0.1, 0.16)])
def test_a_solved_contact_comes_near_at_light_load(ratio, error):
    exact = float(BOX.light_load_area_fraction(ratio * FULL))
    assert solved_area(ratio) / exact - 1 == pytest.approx(error, abs=0.01)


@pytest.mark.parametrize(("ratio", "error"), [(0.9, 0.04), (0.97, 0.03)])
def test_a_solved_contact_comes_near_at_almost_full_contact(ratio, error):
    exact = 1 - float(BOX.nearly_full_area_fraction(ratio * FULL))
    assert 1 - solved_area(ratio) == pytest.approx(exact, rel=error)


def test_the_limits_end_where_they_should():
    assert BOX.light_load_area_fraction(0.0) == 0
    assert (BOX.nearly_full_area_fraction([FULL, 2 * FULL]) == 1).all()


@pytest.mark.parametrize("load", [-1.0, np.nan])
def test_what_makes_no_sense_is_refused(load):
    with pytest.raises(InputError, match="load"):
        BOX.light_load_area_fraction(load)
    with pytest.raises(InputError, match="load"):
        BOX.full_contact_pressure(0.0, 0.0, load)


def test_full_contact_is_refused_below_its_load():
    with pytest.raises(InputError, match="complete from"):
        BOX.full_contact_pressure(0.0, 0.0, 0.99 * FULL)
