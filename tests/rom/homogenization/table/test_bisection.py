"""Refinement of tables: how many points it takes, and whether the stated errors contain the true ones."""

from dataclasses import replace

import numpy as np
import pytest
import scipy

from roughfilm.rom.homogenization.factors import FlowFactors
from roughfilm.rom.homogenization.table.bisection import MAX_POINTS, bisected
from roughfilm.rom.homogenization.table.factor_table import Point
from roughfilm.rom.ladder.model import silent

NONE = FlowFactors(mean_gap=0.0, pressure=np.zeros((2, 2)), shear=np.zeros(2), couette=0.0, shear_couette=0.0)


def point(x):
    return Point(
        separation=x,
        contact=0.0,
        factors=replace(NONE, mean_gap=x),
        uncertainty=NONE,
        unsolved=0.0,
        iterations=1,
        residual=0.0,
        cpu_s=0.0,
    )


def places(points):
    return np.array([one.separation for one in points])


def refined(function, *, tolerance, first=9, least=1e-6, slope=None):
    """The refined points of a function on [0, 1], interpolated by monotone cubics, or by cubics of given slopes."""

    def interpolant(points):
        x = places(points)
        if slope is None:
            return scipy.interpolate.PchipInterpolator(x, function(x))
        return scipy.interpolate.CubicHermiteSpline(x, function(x), slope(x))

    def errors(others, one):
        return float(abs(interpolant(others)(one.separation) - function(one.separation))), 0.0, 0.0

    points = bisected(
        [point(x) for x in np.linspace(0, 1, first)],
        place=lambda one: one.separation,
        half_way=lambda one, two: (
            None if two.separation - one.separation < least else point((one.separation + two.separation) / 2)
        ),
        errors=errors,
        order=3 if slope is None else 4,
        tolerance=tolerance,
        threads=1,
        progress=silent,
    )
    return points, interpolant(points)


SMOOTH = {
    "exponential": (lambda x: np.exp(3 * x) / 20, lambda x: 3 * np.exp(3 * x) / 20, 9),
    "wave": (lambda x: np.sin(9 * x), lambda x: 9 * np.cos(9 * x), 30),
    "front": (lambda x: np.tanh(40 * (x - 0.37)), lambda x: 40 / np.cosh(40 * (x - 0.37)) ** 2, 40),
    "onset": (lambda x: np.maximum(x - 0.3, 0) ** 2, lambda x: 2 * np.maximum(x - 0.3, 0), 12),
}


@pytest.mark.parametrize("name", SMOOTH)
@pytest.mark.parametrize("slopes", [False, True])
def test_the_error_between_points_stays_below_the_tolerance_and_the_stated_one(name, slopes):
    function, slope, _ = SMOOTH[name]
    points, table = refined(function, tolerance=2e-3, slope=slope if slopes else None)
    x = np.linspace(0, 1, 5001)
    error = np.abs(table(x) - function(x))
    stated = np.array([one.missed for one in points])
    after = np.clip(np.searchsorted(places(points), x), 1, len(points) - 1)
    assert stated.max() <= 2e-3
    assert (error <= 2e-3).mean() > 0.99
    assert (error <= np.maximum(stated[after - 1], stated[after]) + 1e-12).mean() > 0.95


@pytest.mark.parametrize("name", SMOOTH)
def test_points_with_slopes_are_few(name):
    function, slope, most = SMOOTH[name]
    assert len(refined(function, tolerance=2e-3, slope=slope)[0]) <= most


def test_a_jump_is_not_taken_for_a_smooth_course():
    points, _ = refined(lambda x: np.where(x < 0.431, 0.0, 0.1), tolerance=2e-3, least=1e-3)
    beside = np.abs(places(points) - 0.431) < 1e-3
    assert min(one.missed for one, near in zip(points, beside, strict=True) if near) >= 0.04
    assert max(one.missed for one in points if abs(one.separation - 0.431) > 0.1) <= 2e-3
    assert len(points) <= 40


def test_a_table_of_two_points_is_refined_and_the_number_of_points_is_limited():
    assert len(refined(lambda x: x, tolerance=1e-3, first=2)[0]) == 3
    points, _ = refined(lambda x: np.sin(1e4 * x), tolerance=1e-6)
    assert len(points) == MAX_POINTS
    assert max(one.missed for one in points) > 1e-2
