"""Sources of heat on a half-space: the closed forms by integrals over moving point sources."""

import math
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import k0

from roughfilm.rom.temperature.closed_forms.moving_sources import (
    fast_circle,
    moving_band,
    moving_circle,
    resting_circle,
)
from roughfilm.rom.temperature.closed_forms.streams import moving_half_space

RADIUS, FLUX, CONDUCTIVITY, HEAT = 10e-6, 46e6, 46.0, 3.6e6
SOLID = {"conductivity": CONDUCTIVITY, "heat_per_volume": HEAT}
ANGLES, WEIGHTS = np.polynomial.legendre.leggauss(400)


def speed_at(peclet):
    return peclet * 2 * CONDUCTIVITY / (HEAT * RADIUS)


def point_sources(x, y, speed):
    """∫ q exp(-u (r - X)/(2κ))/(2πk r) over a circle, by polar coordinates about (x, y); x points downstream."""
    angle = math.pi * (1 + ANGLES)
    along = x * np.cos(angle) + y * np.sin(angle)
    chord = -along + np.sqrt(np.maximum(along**2 - (x**2 + y**2 - RADIUS**2), 0))
    rate = speed * HEAT / (2 * CONDUCTIVITY) * (1 + np.cos(angle))
    inner = np.where(rate * chord > 1e-9, -np.expm1(-rate * chord) / np.where(rate > 0, rate, 1), chord)
    return FLUX / (2 * math.pi * CONDUCTIVITY) * math.pi * float(WEIGHTS @ inner)


def mean_and_greatest(peclet):
    speed = speed_at(peclet)
    greatest = max(point_sources(x, 0.0, speed) for x in np.linspace(0, RADIUS, 101)[:-1])
    radii, weights = np.polynomial.legendre.leggauss(10)
    turns = np.pi * (np.arange(16) + 0.5) / 16
    rings = [
        weight * (1 + radius) / 2 * np.mean([point_sources(*(RADIUS * (1 + radius) / 2 * at), speed) for at in around])
        for radius, weight in zip(radii, weights, strict=True)
        for around in [np.column_stack([np.cos(turns), np.sin(turns)])]
    ]
    return sum(rings), greatest


def test_a_resting_circle_is_the_integral_of_point_sources():
    mean, greatest = mean_and_greatest(0.0)
    rise = resting_circle(radius=RADIUS, flux=FLUX, conductivity=CONDUCTIVITY)
    assert rise.greatest == pytest.approx(greatest, rel=1e-6)
    assert rise.mean == pytest.approx(mean, rel=1e-3)


@pytest.mark.parametrize("peclet", [0.03, 0.3, 1.0, 3.0, 30.0])
def test_a_moving_circle_is_within_four_percent_of_the_integral(peclet):
    mean, greatest = mean_and_greatest(peclet)
    rise = moving_circle(radius=RADIUS, flux=FLUX, speed=speed_at(peclet), **SOLID)
    assert rise.greatest == pytest.approx(greatest, rel=0.025)
    assert rise.mean == pytest.approx(mean, rel=0.04)


def test_a_fast_circle_is_the_limit_of_the_integral():
    errors = []
    for peclet in (10.0, 40.0, 160.0):
        mean, greatest = mean_and_greatest(peclet)
        rise = fast_circle(radius=RADIUS, flux=FLUX, speed=speed_at(peclet), **SOLID)
        errors.append((rise.mean / mean - 1, rise.greatest / greatest - 1))
    assert np.all(np.diff(errors, axis=0) < 0)
    assert errors[-1] == pytest.approx((0, 0), abs=0.012)


def test_a_moving_circle_has_the_limits_of_the_resting_and_the_fast_one():
    slow = moving_circle(radius=RADIUS, flux=FLUX, speed=0.0, **SOLID)
    rest = resting_circle(radius=RADIUS, flux=FLUX, conductivity=CONDUCTIVITY)
    assert (slow.mean, slow.greatest) == pytest.approx((rest.mean, rest.greatest), rel=1e-3)
    quick = moving_circle(radius=RADIUS, flux=FLUX, speed=speed_at(1e6), **SOLID)
    limit = fast_circle(radius=RADIUS, flux=FLUX, speed=speed_at(1e6), **SOLID)
    assert (quick.mean, quick.greatest) == pytest.approx((limit.mean, limit.greatest), rel=1e-3)


@pytest.mark.parametrize("x", [-4e-6, 0.0, 5e-6, 20e-6, 31e-6])
def test_a_band_is_the_integral_of_line_sources(x):
    length, speed = 20e-6, 2.0
    rate = speed * HEAT / (2 * CONDUCTIVITY)

    def line(distance):
        return FLUX / (math.pi * CONDUCTIVITY) * math.exp(rate * distance) * k0(rate * abs(distance))

    pieces = sorted({x - length, x, *([0.0] if 0 < x < length else [])})
    integral = sum(quad(line, *ends, epsabs=0, limit=200)[0] for ends in pairwise(pieces))
    rise = moving_band(np.array(x), length=length, flux=FLUX, speed=speed, **SOLID)
    assert float(rise) == pytest.approx(integral, rel=1e-7)


def test_a_fast_band_is_a_sliding_half_space():
    x = np.array([4e-6, 12e-6, 20e-6])
    given = {"length": 20e-6, "flux": FLUX, **SOLID}
    errors = [
        np.abs(moving_band(x, speed=speed, **given) / moving_half_space(x, np.zeros(3), speed=speed, **given) - 1).max()
        for speed in (200.0, 2000.0)
    ]
    assert errors[1] == pytest.approx(errors[0] / math.sqrt(10), rel=0.05)  # by conduction at the trailing edge
    assert errors[1] < 0.011
