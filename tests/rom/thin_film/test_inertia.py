"""The weighted force of inertia on a thin film against the integral of its acceleration over the film."""

import numpy as np
import pytest

from roughfilm.rom.thin_film import inertia

SPEED = 1.3
STEP = 1e-3
PLACE = (0.3, -0.2)
NODES, WEIGHTS = np.polynomial.legendre.leggauss(10)


def gap(x, y):
    return 1 + 0.2 * np.sin(1.1 * x + 0.7 * y) + 0.1 * np.cos(0.9 * x - y)


def stream(x, y):
    """Stream function of the flow h (U/2 + a, b), which is free of sources."""
    return 0.4 * y + 0.2 * np.sin(0.8 * x - 1.2 * y) + 0.1 * np.cos(2 * y + 0.6 * x)


def slope(function, axis, x, y, *more):
    """The derivative by central differences of fourth order."""

    def at(distance):
        return function(x + distance * (axis == 0), y + distance * (axis == 1), *more)

    return (8 * (at(STEP) - at(-STEP)) - at(2 * STEP) + at(-2 * STEP)) / (12 * STEP)


def excess(x, y):
    return slope(stream, 1, x, y) / gap(x, y) - SPEED / 2, -slope(stream, 0, x, y) / gap(x, y)


def velocity(x, y, z):
    """The components along the walls at the height z, the sliding wall at z = 1."""
    height = (z - 1) / gap(x, y) + 1
    a, b = excess(x, y)
    return np.array([SPEED * height + 6 * a * height * (1 - height), 6 * b * height * (1 - height)])


def normal_velocity(x, y, z):
    """The component across the film, from continuity."""
    above = z + (1 - z) * (NODES + 1) / 2
    outflow = slope(velocity, 0, x, y, above)[0] + slope(velocity, 1, x, y, above)[1]
    return (1 - z) / 2 * outflow @ WEIGHTS


def weighted_acceleration(component, weight):
    x, y = PLACE
    h = gap(x, y)
    height = (NODES + 1) / 2
    z = 1 - h + h * height
    u, v = velocity(x, y, z)
    w = np.array([normal_velocity(x, y, one) for one in z])
    rise = (velocity(x, y, z + STEP) - velocity(x, y, z - STEP))[component] / (2 * STEP)
    of_x, of_y = (slope(velocity, axis, x, y, z)[component] for axis in range(2))
    return h / 2 * (weight(height) * (u * of_x + v * of_y + w * rise)) @ WEIGHTS


def derivative(axis, term):
    def at(x, y):
        return term(gap(x, y), *excess(x, y))

    return slope(at, axis, *PLACE)


def test_the_normal_velocity_of_the_profile_vanishes_on_the_fixed_wall():
    x, y = PLACE
    below = slope(gap, 0, x, y) * 0.0
    assert normal_velocity(x, y, 1 - gap(x, y)) == pytest.approx(below, abs=1e-9)


def test_the_terms_are_the_weighted_acceleration():
    rise, (a, b) = slope(gap, 0, *PLACE), excess(*PLACE)
    between = lambda h, a, b: inertia.momentum_between(h, a, b, SPEED)  # noqa: E731
    along = derivative(0, lambda h, a, _b: inertia.momentum_along(h, a, SPEED)) + derivative(1, between)
    across = derivative(0, between) + derivative(1, lambda h, _a, b: inertia.momentum_across(h, b))
    sheared = derivative(0, lambda h, a, _b: inertia.shear_along(h, a, SPEED))
    sheared += derivative(1, lambda h, a, b: inertia.shear_between(h, a, b, SPEED))

    def bubble(height):
        return height * (1 - height)

    assert along + SPEED * rise * inertia.slope_along(a, SPEED) == pytest.approx(
        weighted_acceleration(0, bubble), rel=1e-7
    )
    assert across + SPEED * rise * inertia.slope_across(b) == pytest.approx(weighted_acceleration(1, bubble), rel=1e-7)
    assert sheared + SPEED * rise * inertia.shear_slope(a, SPEED) == pytest.approx(
        weighted_acceleration(0, lambda height: height), rel=1e-7
    )
