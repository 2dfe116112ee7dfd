"""Temperatures that develop along plane films, against eigenfunctions and published numbers."""

from functools import cache

import numpy as np
import pytest
from scipy.linalg import eig
from warm_films import CAPACITY, CONDUCTIVITY, GAP, SPEED, SUPPLY, VISCOSITY, imbalance, liquid, plates

from roughfilm.rom.temperature.across import temperature_across
from roughfilm.rom.temperature.walls import (
    InsulatedWall,
    SlidingHalfSpace,
    WallAtTemperature,
    heating_of_half_space,
)

AT_SUPPLY = WallAtTemperature(temperature=SUPPLY)

LENGTH = 0.4 * SPEED * CAPACITY * GAP**2 / CONDUCTIVITY / 10
"""Length over which heat diffuses over a part of the film thickness, m."""


@cache
def eigenfunctions(points=48):
    """ζ, λ and φ of φ'' = -λ (1 - ζ) φ, 0 at both walls, by Chebyshev collocation with many points."""
    x = np.cos(np.pi * np.arange(points + 1) / points)
    sizes = np.concatenate([[2.0], np.ones(points - 1), [2.0]]) * (-1.0) ** np.arange(points + 1)
    first = np.outer(sizes, 1 / sizes) / (x[:, None] - x + np.eye(points + 1))
    first -= np.diag(first.sum(axis=1))
    zeta = (x[1:-1] + 1) / 2
    values, vectors = eig(4 * (first @ first)[1:-1, 1:-1], np.diag(1 - zeta))
    return zeta, -values.real, vectors.real


def mean(zeta, inside):
    """The integral over ζ in (0, 1) of values that are 0 at both ends."""
    whole = np.polynomial.Chebyshev.fit(
        2 * np.concatenate([[1.0], zeta, [0.0]]) - 1, np.concatenate([[0.0], inside, [0.0]]), zeta.size + 1
    ).integ()
    return float(whole(1) - whole(-1)) / 2


def developing(at):
    """Mean of T - T₀ of (1 - ζ) ∂T/∂s = ∂²T/∂ζ² + 1 from T₀ with walls at T₀; s is x k/(ρc u h²)."""
    zeta, rates, vectors = eigenfunctions()
    steady = zeta * (1 - zeta) / 2
    return mean(zeta, steady - vectors @ (np.linalg.solve(vectors, steady) * np.exp(-rates * at)))


def following(at):
    """Mean of T - T₀ of (1 - ζ) ∂T/∂s = ∂²T/∂ζ² from T₀ with walls at T₀ + s²."""
    zeta, rates, vectors = eigenfunctions()
    parts = np.linalg.solve(vectors, np.ones_like(zeta))
    return at**2 - 2 * mean(zeta, vectors @ (parts * (at / rates - (1 - np.exp(-rates * at)) / rates**2)))


def at_the_end(cells, modes):
    """Mean over ζ of T - T₀ over η u²/k at the last face of the film."""
    film = plates(cells, length=LENGTH)
    field = temperature_across(film, liquid(), sliding_wall=AT_SUPPLY, fixed_wall=AT_SUPPLY, modes=modes)
    return float(field.mean[-1, 0] - SUPPLY) * CONDUCTIVITY / (VISCOSITY * SPEED**2)


S = LENGTH * CONDUCTIVITY / (CAPACITY * SPEED * GAP**2)


def test_second_order_in_cells():
    errors = []
    for cells in (16, 32, 64):
        film = plates(cells, length=LENGTH)
        place = film.grid.x[:, None] / LENGTH * S
        wall = WallAtTemperature(temperature=SUPPLY + 1e4 * place**2)
        cool = liquid(viscosity=1e-9)
        field = temperature_across(film, cool, sliding_wall=wall, fixed_wall=wall, modes=12)
        places = range(cells // 8, cells + 1, cells // 8)
        exact = np.array([1e4 * following(place[i, 0]) for i in places])
        errors.append(float(np.abs(field.mean[places, 0] - SUPPLY - exact).max() / exact.max()))
    assert errors[-1] < 1e-3
    assert np.log2(errors[0] / errors[2]) / 2 == pytest.approx(2, abs=0.2)


def test_spectral_in_modes():
    errors = [abs(at_the_end(640, modes) - developing(S)) / developing(S) for modes in (3, 5, 8)]
    assert errors[1] < errors[0] / 5
    assert errors[2] < 1e-5


@pytest.mark.parametrize(("wall", "number"), [(AT_SUPPLY, 7.5407), (InsulatedWall(), 4.8608)])
def test_nusselt_numbers_of_flow_by_pressure(wall, number):
    """Shah and London 1978: q 2h/(k (T_w - T_b)) far from the inlet, by wall at a temperature and the other."""
    pressure = 1e7
    rate = GAP**2 * pressure / (12 * VISCOSITY)
    film = plates(160, length=np.sqrt(rate * CAPACITY * GAP**2 / CONDUCTIVITY), speed=0.0, inlet=pressure)
    oil = liquid(viscosity=VISCOSITY)
    hot = temperature_across(film, oil, sliding_wall=wall, fixed_wall=AT_SUPPLY, entering=SUPPLY + 50)
    cold = temperature_across(film, oil, sliding_wall=wall, fixed_wall=AT_SUPPLY)
    there = 120  # the difference of two films does not depend on the dissipation
    flux = hot.fixed_wall.flux[there, 0] - cold.fixed_wall.flux[there, 0]
    assert flux * 2 * GAP / (CONDUCTIVITY * (hot.carried - cold.carried)[there, 0]) == pytest.approx(number, rel=1e-3)


def test_back_flow_at_the_inlet():
    """Against so large a pressure that most lubricant enters at the outlet, heat is conserved."""
    film = plates(60, outlet=1.5 * 6 * VISCOSITY * SPEED * 0.05 / GAP**2)
    field = temperature_across(film, liquid(), sliding_wall=InsulatedWall(), fixed_wall=AT_SUPPLY, entering=SUPPLY + 7)
    assert abs(imbalance(field.balance)) < 1e-8
    assert field.balance.leaving > 0
    assert float(field.temperature.min()) > SUPPLY - 0.1


def test_heating_of_a_half_space():
    """Carslaw and Jaeger 1959: 2 q √(x/(π k ρc u)) of a uniform flux, and q' x √π/(2 √(k ρc u)) of q' √x."""
    film = plates(64)
    wall = SlidingHalfSpace(conductivity=46.0, heat_capacity=3.6e6, temperature=SUPPLY)
    heating, x = heating_of_half_space(wall, film), film.grid.x
    scale = 1 / np.sqrt(46.0 * 3.6e6 * SPEED)
    np.testing.assert_allclose(heating[1:].sum(axis=1), 2 * scale * np.sqrt(x[1:] / np.pi), rtol=1e-12)
    assert (heating @ np.sqrt(x))[-1] == pytest.approx(scale * x[-1] * np.sqrt(np.pi) / 2, rel=1e-3)


def test_a_half_space_takes_the_power_of_a_film():
    """A liquid that carries no heat gives all its power to the wall, whose flux is uniform."""
    film = plates(64)
    wall = SlidingHalfSpace(conductivity=46.0, heat_capacity=3.6e6, temperature=SUPPLY)
    field = temperature_across(film, liquid(capacity=1e2), sliding_wall=wall, fixed_wall=InsulatedWall())
    flux = VISCOSITY * SPEED**2 / GAP
    rise = 2 * flux * np.sqrt(film.grid.x / (np.pi * 46.0 * 3.6e6 * SPEED))
    np.testing.assert_allclose(field.sliding_wall.flux[1:], flux, rtol=1e-4)
    np.testing.assert_allclose(field.sliding_wall.temperature[1:, 0] - SUPPLY, rise[1:], rtol=3e-4)
    assert abs(imbalance(field.balance)) < 1e-8
