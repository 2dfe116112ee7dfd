"""Closed forms of film flow against independent solutions of the same balance."""

import numpy as np
import pytest
from numpy.polynomial import Polynomial
from scipy.integrate import quad

from roughfilm.ladder import find
from roughfilm.rom.pocket import closed_form as film_flow

CASES = [(1.0, 0.1, 0.516), (1.25, -0.2, 0.516), (1.7, 0.4, 0.53), (2.25, -0.05, 0.52), (0.6, 0.3, 0.4)]


def first_order_gradient(h: float, slope: float, q: float) -> float:
    """dp/dx per Re of first-order inertia, from the boundary-value problem across the film itself.

    u1'' = h² (u0 u0_x + (ω0/h) u0_Y + p1'), u1 = 0 on both walls, no extra flow; all polynomials in Y.
    """
    y = Polynomial([0, 1])
    bow = y * (1 - y)
    a = q / h - 0.5
    u = y + 6 * a * bow
    u_x = 6 * (-q * slope / h**2) * bow
    omega = -(slope * u + h * u_x).integ()
    assert omega(1) == pytest.approx(0, abs=1e-14)
    inertia = u * u_x + omega / h * u.deriv()

    def extra_flow(gradient: float) -> float:
        particular = (h**2 * (inertia + gradient)).integ(2)
        u1 = particular - particular(1) * y
        return float(u1.integ()(1))

    without, change = extra_flow(0.0), extra_flow(1.0) - extra_flow(0.0)
    return -without / change


@pytest.mark.parametrize(("h", "slope", "q"), CASES)
def test_inertia_gradient_solves_the_first_order_problem(h, slope, q):
    got = film_flow.inertia_pressure_gradient(np.array([h]), np.array([slope]), q)[0]
    assert got == pytest.approx(first_order_gradient(h, slope, q), rel=1e-12)


@pytest.mark.parametrize("q", [0.4, 0.516, 0.53])
def test_inertia_pressure_integrates_that_gradient(q):
    for h in (0.6, 1.25, 2.25):
        expected, _ = quad(lambda s: first_order_gradient(s, 1.0, q), 1.0, h, epsabs=1e-13)
        assert film_flow.inertia_pressure(np.array([h]), q)[0] == pytest.approx(expected, rel=1e-10)


@pytest.mark.parametrize(("width", "depth"), [(0.3, 0.25), (0.5, 0.25), (0.3, 0.01)])
def test_depth_averaged_momentum_with_the_parabola_differs(make_scene, width, depth):
    """Averaging the momentum instead of weighting it loses a sixth of the load.

    By hand, at q = 1/2 and h near 1: weighting gives 6 N = -h'/5, averaging d/dx of h <u²> gives -h'/6, so 5/6.
    """
    scene = make_scene(width, depth, 40)
    result = find("pocket", "inertial_reynolds").solve(scene)
    gap = scene.gap()
    count = 200_000
    x = ((np.arange(count) + 0.5) / count - 0.5) * gap.length / gap.film
    h = gap.thickness(x * gap.film) / gap.film
    q = (h**-2.0).mean() / (2 * (h**-3.0).mean())
    a = q / h - 0.5
    momentum_flux = h * (1 / 3 + a + 6 * a**2 / 5)
    averaged = np.cumsum(-scene.reynolds_number / h * np.gradient(momentum_flux, x)) * (x[1] - x[0])
    ratio = averaged.mean() * scene.plus_factor / result.quantities["load_plus"].value
    assert ratio == pytest.approx(5 / 6, abs=0.01)


@pytest.mark.parametrize(("h", "_slope", "q"), CASES)
def test_profile_numbers_match_the_profile(h, _slope, q):
    y = np.linspace(0, 1, 100_001)
    u = y + 6 * (q / h - 0.5) * y * (1 - y)
    assert np.trapezoid(u, y) == pytest.approx(q / h, abs=1e-9)
    shear = (u[-1] - u[-2]) / (y[1] - y[0]) / h
    assert film_flow.sliding_wall_shear(np.array([h]), q)[0] == pytest.approx(shear, rel=1e-4, abs=1e-4)
    assert film_flow.back_flow(np.array([h]), q) == pytest.approx(max(0.0, -u.min()), abs=1e-9)


def test_some_case_has_back_flow_and_some_has_none():
    assert film_flow.back_flow(np.array([2.25]), 0.52) > 0.01
    assert film_flow.back_flow(np.array([1.25]), 0.516) == 0.0
