"""Stiffness and damping of fast motions: against marches of the same films, and their limit of slow ones."""

import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from moving_films import CLEARANCE, RADIUS, SPEED, course, journal, steady

from roughfilm.rom.bearing.dynamics.whirl import RATIOS_OF_MEMORY, whirl_of
from roughfilm.rom.cavitation.balance import CAVITY
from roughfilm.rom.cavitation.motion.coefficients import SmallMotion
from roughfilm.rom.cavitation.motion.film import Inflow
from roughfilm.rom.cavitation.motion.march import begun, march

RATE = SPEED / RADIUS
PLACE = np.array([0.35, -0.2]) * CLEARANCE
STEPS = 96


@pytest.fixture(scope="module")
def refilling():
    """A journal whose cavity is refilled by the film that is carried around, since no groove ends it."""
    film = journal((48, 6), halved=True, groove=False)
    hole = Inflow(covers=lambda x, y: (np.abs(x) < 1e-9) & (y < 0.006), pressure=2e5)
    film = replace(film, inflows=(hole,))
    at = steady(film, PLACE, tolerance=1e-12)
    assert (at.kind == CAVITY).any()
    return film, at, SmallMotion(film, at, speed=SPEED)


def test_slow_motions_have_the_slow_coefficients(refilling):
    _, _, motion = refilling
    z = motion.impedance(1e-5 * RATE)
    assert motion.has_memory
    np.testing.assert_allclose(z.real, motion.slow.stiffness, rtol=1e-6)
    np.testing.assert_allclose(z.imag / (1e-5 * RATE), motion.slow.damping, rtol=1e-4, atol=1e-6 * z.imag.max())


@pytest.mark.parametrize("ratio", [0.3, 0.5, 1.0])
def test_a_small_orbit_has_the_force_of_the_impedance(refilling, ratio):
    """The force over the last of some periods of a given motion, as its Fourier component, against Z δq."""
    film, at, motion = refilling
    frequency, size = ratio * RATE, 1e-4 * CLEARANCE
    period = 2 * math.pi / frequency

    def path(time):
        return at.place + size * np.array([math.sin(frequency * time), 0.0])

    velocity = np.array([size * frequency, 0.0])
    moved = list(
        march(
            film,
            course(film, place=path),
            begun(film, at, velocity=velocity),
            4 * period,
            largest_step=period / STEPS,
            error=None,
            tolerance=1e-11,
        )
    )
    still, last = film.force(at.state.pressure), moved[-STEPS:]
    phase = np.array([np.exp(-1j * frequency * one.now.time) for one in last])
    force = np.array([film.force(one.instant.state.pressure) - still for one in last])
    found = 2 * (phase[:, None] * force).mean(axis=0) * 1j / size  # of sin = Im exp
    assert found == pytest.approx(
        -motion.impedance(frequency)[:, 0], abs=0.01 * np.abs(motion.impedance(frequency)).max()
    )


def growth(film, at, mass, frequency):
    """The rate of growth of small motions of a mass, 1/s: the root of the recursion that later positions follow."""
    load, step = -film.force(at.state.pressure), 2 * math.pi / frequency / 64
    start = begun(film, at, velocity=np.array([1e-3 * CLEARANCE * frequency, 0.0]))
    free = course(film, force=lambda _time: load, mass=mass, scale=CLEARANCE * RATE)
    moved = march(film, free, start, 8 * 64 * step, largest_step=step, error=None)
    places = np.array([one.now.place - at.place for one in moved])[3 * 64 :]
    apart = 10
    before = np.stack([places[apart:-apart].ravel(), places[: -2 * apart].ravel()], axis=1)
    first, second = np.linalg.lstsq(before, places[2 * apart :].ravel(), rcond=None)[0]
    return float(np.log(np.roots([1, -first, -second])).real.max()) / (apart * step)


def test_the_critical_mass_is_that_at_which_small_motions_neither_grow_nor_decay(refilling):
    film, at, motion = refilling

    @cache
    def matrices(frequency):
        if frequency == 0:
            return motion.slow.stiffness, motion.slow.damping
        z = motion.impedance(frequency)
        return z.real, z.imag / frequency

    whirl = whirl_of(matrices, RATE, RATIOS_OF_MEMORY)
    mass, frequency = 1 / whirl.inverse_mass, math.sqrt(whirl.frequency_squared)
    below, above = (growth(film, at, part * mass, frequency) for part in (0.95, 1.05))
    assert below < 0 < above
