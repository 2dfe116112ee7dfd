"""Closed forms of journals against quadratures of Reynolds' equation, and what the solver makes of them."""

import math
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad

from roughfilm.contact.foundation.errors import InputError
from roughfilm.ladder import find
from roughfilm.rom.bearing.closed_forms.journal import (
    long_journal_squeeze,
    long_journal_squeeze_time,
    ocvirk,
    ocvirk_coefficients,
    short_journal_squeeze,
    short_journal_squeeze_time,
    sommerfeld,
    sommerfeld_coefficients,
)
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene

RADIUS, CLEARANCE, WIDTH, SPEED, VISCOSITY = 0.03, 40e-6, 2e-3, 3.1, 0.021
SHAFT = {"radius": RADIUS, "clearance": CLEARANCE, "viscosity": VISCOSITY}
SHORT = {**SHAFT, "width": WIDTH, "speed": SPEED}


def short_force(place, velocity):
    """The film force along x and y on a shaft, with a film where p > 0, by quadrature; x is the direction of e."""
    omega = SPEED / RADIUS

    def line_load(angle):
        """∫ p dy at an angle from the x axis, in the direction of rotation; 0 where it would be negative."""
        radial = (math.cos(angle), math.sin(angle))
        h = CLEARANCE - place[0] * radial[0] - place[1] * radial[1]
        slope = place[0] * radial[1] - place[1] * radial[0]
        rate = omega / 2 * slope - velocity[0] * radial[0] - velocity[1] * radial[1]
        return max(0.0, -VISCOSITY * WIDTH**3 / h**3 * rate)

    angles = np.linspace(0, 2 * math.pi, 6001)[:-1]
    loads = np.array([line_load(angle) for angle in angles]) * RADIUS * (angles[1] - angles[0])
    return -np.array([(loads * np.cos(angles)).sum(), (loads * np.sin(angles)).sum()])


def along_load(force):
    """The axes x along the load, against the film force, and y at 90° from it in the direction of rotation."""
    x = -force / np.hypot(*force)
    return np.array([x, [-x[1], x[0]]])


@pytest.mark.parametrize("eccentricity", [0.15, 0.8])
def test_ocvirks_bearing_is_the_integral_of_its_pressure(eccentricity):
    known = ocvirk(clearance=CLEARANCE, eccentricity=eccentricity, width=WIDTH, speed=SPEED, viscosity=VISCOSITY)
    force = short_force((eccentricity * CLEARANCE, 0.0), (0.0, 0.0))
    assert np.hypot(*force) == pytest.approx(known.load, rel=1e-6)
    # the load points back by the attitude angle from the line of centres, which is ahead of it in the rotation
    assert math.degrees(math.atan2(force[1], -force[0])) == pytest.approx(known.attitude_angle, abs=1e-4)


@pytest.mark.parametrize("eccentricity", [0.15, 0.8])
def test_stiffness_and_damping_of_ocvirks_bearing_are_differences_of_its_force(eccentricity):
    known = ocvirk_coefficients(eccentricity=eccentricity, **SHORT)
    place = np.array([eccentricity * CLEARANCE, 0.0])
    turn = along_load(short_force(place, (0.0, 0.0)))
    step, rate = 1e-4 * CLEARANCE, 1e-4 * CLEARANCE * SPEED / RADIUS
    stiffness, damping = np.empty((2, 2)), np.empty((2, 2))
    for column, direction in enumerate(turn):
        ahead, behind = (short_force(place + sign * step * direction, (0.0, 0.0)) for sign in (1, -1))
        stiffness[:, column] = -turn @ (ahead - behind) / (2 * step)
        ahead, behind = (short_force(place, sign * rate * direction) for sign in (1, -1))
        damping[:, column] = -turn @ (ahead - behind) / (2 * rate)
    assert np.allclose(known.stiffness, stiffness, rtol=1e-4, atol=1e-4 * np.abs(stiffness).max())
    assert np.allclose(known.damping, damping, rtol=1e-4, atol=1e-4 * np.abs(damping).max())


def long_force(place, velocity):
    """The film force per width on a shaft in a full, infinitely wide film, by quadrature of dp/dx."""
    omega, count = SPEED / RADIUS, 2000
    angles = np.arange(count) * 2 * math.pi / count
    h = CLEARANCE - place[0] * np.cos(angles) - place[1] * np.sin(angles)
    rate = -velocity[0] * np.cos(angles) - velocity[1] * np.sin(angles)
    # flow q = ω R h/2 - h³/(12 η R) dp/dφ with dq/dφ = -R ∂h/∂t, whose integral is exact, and p periodic
    squeezed = -RADIUS * (-velocity[0] * np.sin(angles) + velocity[1] * np.cos(angles))
    mean = ((omega * RADIUS * h / 2 - squeezed) / h**3).sum() / (1 / h**3).sum()
    slope = 12 * VISCOSITY * RADIUS / h**3 * (omega * RADIUS * h / 2 - squeezed - mean)
    assert abs(rate.sum()) < 1e-9 * (np.abs(rate).sum() or 1.0)
    # ∮ p cos φ dφ = -∮ p' sin φ dφ
    weight = RADIUS * 2 * math.pi / count
    return np.array([(slope * np.sin(angles)).sum(), -(slope * np.cos(angles)).sum()]) * weight


@pytest.mark.parametrize("eccentricity", [0.15, 0.8])
def test_stiffness_and_damping_of_the_long_bearing_are_differences_of_its_force(eccentricity):
    known = sommerfeld_coefficients(eccentricity=eccentricity, speed=SPEED, **SHAFT)
    place = np.array([eccentricity * CLEARANCE, 0.0])
    force = long_force(place, (0.0, 0.0))
    assert np.hypot(*force) == pytest.approx(sommerfeld(eccentricity=eccentricity, speed=SPEED, **SHAFT).load, rel=1e-9)
    turn = along_load(force)
    step, rate = 1e-4 * CLEARANCE, 1e-4 * CLEARANCE * SPEED / RADIUS
    stiffness, damping = np.empty((2, 2)), np.empty((2, 2))
    for column, direction in enumerate(turn):
        ahead, behind = (long_force(place + sign * step * direction, (0.0, 0.0)) for sign in (1, -1))
        stiffness[:, column] = -turn @ (ahead - behind) / (2 * step)
        ahead, behind = (long_force(place, sign * rate * direction) for sign in (1, -1))
        damping[:, column] = -turn @ (ahead - behind) / (2 * rate)
    assert np.allclose(known.stiffness, stiffness, rtol=1e-5, atol=1e-5 * np.abs(stiffness).max())
    assert np.allclose(known.damping, damping, rtol=1e-5, atol=1e-5 * np.abs(damping).max())


@pytest.mark.parametrize("eccentricity", [-0.9, 0.0, 0.6])
def test_squeeze_of_the_short_journal_is_the_integral_of_its_pressure(eccentricity):
    known = short_journal_squeeze(eccentricity=eccentricity, width=WIDTH, approach=1e-3, **SHAFT)
    integral = quad(lambda psi: math.cos(psi) ** 2 / (1 - eccentricity * math.cos(psi)) ** 3, -math.pi / 2, math.pi / 2)
    assert known == pytest.approx(VISCOSITY * 1e-3 * RADIUS * WIDTH**3 / CLEARANCE**3 * integral[0], rel=1e-9)


def test_times_of_squeeze_are_integrals_over_the_eccentricity():
    load, between = 12.0, (-0.5, 0.7)

    def short(eccentricity):
        at_unit = short_journal_squeeze(eccentricity=eccentricity, width=WIDTH, approach=1.0, **SHAFT)
        return CLEARANCE * at_unit / load

    known = short_journal_squeeze_time(eccentricities=between, width=WIDTH, load=load, **SHAFT)
    assert known == pytest.approx(quad(short, *between)[0], rel=1e-9)

    def long(eccentricity):
        return CLEARANCE * long_journal_squeeze(eccentricity=eccentricity, approach=1.0, **SHAFT) / load

    known = long_journal_squeeze_time(eccentricities=(0.1, 0.7), load=load, **SHAFT)
    assert known == pytest.approx(quad(long, 0.1, 0.7)[0], rel=1e-9)


def squeezed(geometry, cells, model="reynolds_cavitating"):
    entries = {
        "name": "squeezed journal",
        "kind": "bearing",
        "geometry": {"shape": "journal", "radius": f"{RADIUS} m", "clearance": f"{CLEARANCE} m", **geometry},
        "lubricant": {"viscosity": f"{VISCOSITY} Pa*s"},
        "motion": {"speed": "0 m/s", "approach": "1 mm/s"},
    }
    return find("bearing", model).solve(read_scene(entries), Request(resolution=cells))


def test_the_solver_meets_the_long_journal_at_second_order():
    known = long_journal_squeeze(eccentricity=0.6, approach=1e-3, **SHAFT)
    results = [squeezed({"eccentricity": 0.6}, cells) for cells in (32, 64, 128)]
    errors = [abs(result["load_per_width"].value / known - 1) for result in results]
    assert all(coarse / fine > 3.5 for coarse, fine in pairwise(errors) if fine > 1e-12)
    assert errors[-1] < 1e-3
    last = results[-1]
    assert abs(last["load_per_width"].value - known) <= last["load_per_width"].uncertainty
    assert last["attitude_angle"].value == pytest.approx(0, abs=1e-6)
    assert last["cavitated_fraction"].value == 0


def test_a_narrow_journal_approaches_the_short_one_with_an_empty_far_half():
    """The error of the short bearing falls with (B/D)²."""
    errors = []
    for width in (12e-3, 6e-3):
        known = short_journal_squeeze(eccentricity=0.5, width=width, approach=1e-3, **SHAFT)
        result = squeezed({"eccentricity": 0.5, "width": f"{width} m"}, 96)
        errors.append(1 - result["load"].value / known)
        assert result["side_leakage"].value == pytest.approx(2 * RADIUS * width * 1e-3, rel=0.05)
    assert 0 < errors[1] < 0.02
    assert 3 < errors[0] / errors[1] < 5
    assert result["cavitated_fraction"].value == pytest.approx(0.5, abs=0.05)
    assert result["theta_min"].value == pytest.approx(0, abs=1e-9)


@pytest.mark.parametrize("eccentricity", [-0.1, 0.0, 1.0])
def test_coefficients_need_an_eccentricity(eccentricity):
    with pytest.raises(InputError, match="eccentricity"):
        ocvirk_coefficients(eccentricity=eccentricity, **SHORT)
    with pytest.raises(InputError, match="eccentricity"):
        sommerfeld_coefficients(eccentricity=eccentricity, speed=SPEED, **SHAFT)
