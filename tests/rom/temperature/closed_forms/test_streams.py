"""Streams and sliding walls that take heat: the exact solutions by their equations and by one another."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

from roughfilm.rom.temperature.closed_forms.streams import (
    heated_shear_flow,
    heated_shear_flux,
    moving_half_space,
    plug_flow,
    plug_flow_mean,
)

ROD = {"film": 50e-6, "speed": 2.0, "diffusivity": 8e-8, "inlet": 313.0, "fixed": 343.0, "sliding": 328.0}
FLOW = {"shear_rate": 2e5, "diffusivity": 8e-8, "inlet": 313.0, "wall": 353.0}
WALL = {"flux": 2e5, "length": 0.06, "speed": 5.0, "conductivity": 46.0, "heat_per_volume": 3.6e6}


def second(function, at, step):
    return (function(at + step) - 2 * function(at) + function(at - step)) / step**2


def first(function, at, step):
    return (function(at + step) - function(at - step)) / (2 * step)


@pytest.mark.parametrize("height", [7e-6, 25e-6, 41e-6])
def test_a_rod_conducts_what_it_carries(height):
    x, z = np.array(2e-3), np.array(height)
    carried = ROD["speed"] * first(lambda x: plug_flow(x, z, **ROD), x, 1e-6)
    conducted = ROD["diffusivity"] * second(lambda z: plug_flow(x, z, **ROD), z, 1e-7)
    assert carried == pytest.approx(conducted, rel=1e-4)


def test_a_rod_enters_with_its_temperature_and_ends_between_its_walls():
    z = np.linspace(0, ROD["film"], 11)
    start = plug_flow(np.array(1e-5), z[2:-2], **ROD)
    np.testing.assert_allclose(start, 313, atol=1e-6)
    np.testing.assert_allclose(plug_flow(np.array(10.0), z, **ROD), np.linspace(343, 328, 11))
    np.testing.assert_allclose(plug_flow(np.array(1e-3), z[[0, -1]], **ROD), [343, 328])


def test_the_mean_of_a_rod_is_that_of_its_section():
    nodes, weights = np.polynomial.legendre.leggauss(40)
    x = np.array([3e-3])
    section = plug_flow(x, ROD["film"] * (1 + nodes) / 2, **ROD)
    assert plug_flow_mean(x, **ROD)[0] == pytest.approx(weights @ section / 2, abs=1e-9)


def test_a_short_rod_takes_heat_as_two_half_spaces_do():
    """The heat taken from a wall at a given temperature, 2 k ΔT √(t/(π κ)), until the layers meet."""
    x = np.array([2e-4])
    depth = 2 * math.sqrt(ROD["diffusivity"] * x[0] / ROD["speed"] / math.pi)
    rise = ((343 - 313) + (328 - 313)) * depth / ROD["film"]
    assert plug_flow_mean(x, **ROD)[0] - 313 == pytest.approx(rise, rel=1e-5)


def test_a_shear_flow_conducts_what_it_carries():
    x, z = np.array(0.02), np.array(12e-6)
    carried = FLOW["shear_rate"] * z * first(lambda x: heated_shear_flow(x, z, **FLOW), x, 1e-6)
    conducted = FLOW["diffusivity"] * second(lambda z: heated_shear_flow(x, z, **FLOW), z, 5e-8)
    assert carried == pytest.approx(conducted, rel=1e-4)
    flux = heated_shear_flux(x, conductivity=0.14, **FLOW)
    near = heated_shear_flow(x, np.array([0.0, 1e-9]), **FLOW)
    assert flux == pytest.approx(0.14 * (near[0] - near[1]) / 1e-9, rel=1e-5)


def test_the_flux_into_a_shear_flow_is_the_heat_that_it_carries():
    kappa, gamma = FLOW["diffusivity"], FLOW["shear_rate"]

    def carried(z):
        return gamma * z * (heated_shear_flow(np.array(0.02), np.array(z), **FLOW) - 313)

    into = quad(lambda s: 3 * s**2 * heated_shear_flux(np.array(s**3), conductivity=0.14, **FLOW), 0, 0.02 ** (1 / 3))
    assert 0.14 / kappa * quad(carried, 0, 2e-4)[0] == pytest.approx(into[0], rel=1e-7)


def test_the_surface_of_a_half_space_is_the_integral_over_the_flux():
    unit = math.sqrt(math.pi * 46.0 * 3.6e6 * 5.0)
    for x in (0.01, 0.06, 0.15):
        under = min(x, 0.06)
        integral = quad(lambda s: 2e5 / unit, 0, under, weight="alg", wvar=(0, -0.5))[0] if x <= 0.06 else None
        integral = integral or quad(lambda s, x=x: 2e5 / unit / math.sqrt(x - s), 0, under)[0]
        assert moving_half_space(np.array(x), np.array(0.0), **WALL) == pytest.approx(integral, rel=1e-9)
    assert moving_half_space(np.array(-0.01), np.array(0.0), **WALL) == 0


@pytest.mark.parametrize("x", [0.03, 0.1])
def test_a_half_space_carries_off_what_it_was_given(x):
    z, weights = np.polynomial.legendre.leggauss(60)
    deep = 8e-3
    held = weights @ moving_half_space(np.array(x), deep * (1 + z) / 2, **WALL) * deep / 2
    assert 3.6e6 * 5.0 * held == pytest.approx(2e5 * min(x, 0.06), rel=1e-6)
    at = np.array(1e-4)
    carried = 5.0 * first(lambda x: moving_half_space(x, at, **WALL), np.array(x), 1e-6)
    conducted = 46.0 / 3.6e6 * second(lambda z: moving_half_space(np.array(x), z, **WALL), at, 1e-6)
    assert carried == pytest.approx(conducted, rel=1e-3)
