"""Developed temperatures across plane films, against closed forms."""

import numpy as np
import pytest
from scipy.integrate import quad
from warm_films import CAPACITY, CONDUCTIVITY, GAP, SPEED, SUPPLY, VISCOSITY, imbalance, liquid, plates

from roughfilm.rom.cavitation.evaluation.friction import friction
from roughfilm.rom.cavitation.fluid import Viscosities
from roughfilm.rom.temperature.across import temperature_across
from roughfilm.rom.temperature.walls import ConductingWall, InsulatedWall, TurningWall, WallAtTemperature

SLOW = 1e3
"""Heat capacity, J/(m³ K), at which heat is carried over much less than a cell."""

AT_SUPPLY = WallAtTemperature(temperature=SUPPLY)


@pytest.fixture(scope="module")
def film():
    return plates(12)


def developed(field):
    """Temperatures above that of the supply in the middle of the film, over ζ."""
    return field.temperature[field.temperature.shape[0] // 2, 0] - SUPPLY


def test_walls_at_the_same_temperature(film):
    """Brinkman: T - T_w = η u²/(2 k) ζ (1 - ζ); each wall takes half of the power."""
    field = temperature_across(film, liquid(capacity=SLOW), sliding_wall=AT_SUPPLY, fixed_wall=AT_SUPPLY)
    scale = VISCOSITY * SPEED**2 / CONDUCTIVITY
    np.testing.assert_allclose(developed(field), scale / 2 * field.points * (1 - field.points), rtol=1e-5)
    assert field.largest - SUPPLY == pytest.approx(scale / 8, rel=1e-5)
    assert field.place[2] == pytest.approx(0.5, abs=0.02)
    assert field.sliding_wall.flux[6, 0] == pytest.approx(VISCOSITY * SPEED**2 / GAP / 2, rel=1e-4)
    assert field.mean[6, 0] - SUPPLY == pytest.approx(scale / 12, rel=1e-5)


def test_one_insulated_wall(film):
    """T - T_w = η u²/(2 k) (1 - (1 - s)²) over the distance s from the other wall, over h."""
    scale = VISCOSITY * SPEED**2 / CONDUCTIVITY
    slow = liquid(capacity=SLOW)
    field = temperature_across(film, slow, sliding_wall=InsulatedWall(), fixed_wall=AT_SUPPLY)
    np.testing.assert_allclose(developed(field), scale / 2 * (1 - field.points**2), rtol=1e-5)
    assert field.sliding_wall.temperature[6, 0] - SUPPLY == pytest.approx(scale / 2, rel=1e-5)
    assert not field.sliding_wall.flux.any()
    field = temperature_across(film, slow, sliding_wall=AT_SUPPLY, fixed_wall=InsulatedWall())
    np.testing.assert_allclose(developed(field), scale / 2 * (1 - (1 - field.points) ** 2), rtol=1e-5)


def test_a_conducting_wall_is_warmer_by_its_flux(film):
    """All power η u²/h passes the resistance R: T(ζ = 1) = T_a + R η u²/h."""
    wall = ConductingWall(resistance=2e-5, surroundings=SUPPLY - 5)
    field = temperature_across(film, liquid(capacity=SLOW), sliding_wall=InsulatedWall(), fixed_wall=wall)
    flux = VISCOSITY * SPEED**2 / GAP
    assert field.fixed_wall.flux[6, 0] == pytest.approx(flux, rel=1e-4)
    assert field.fixed_wall.temperature[6, 0] == pytest.approx(SUPPLY - 5 + 2e-5 * flux, rel=1e-6)


def test_a_turning_wall_takes_no_heat_in_sum(film):
    """It takes heat where the film is hot and gives it where it is cold."""
    field = temperature_across(film, liquid(capacity=1e6), sliding_wall=TurningWall(), fixed_wall=AT_SUPPLY)
    area = film.grid.areas[:, 0]
    assert abs((area * field.sliding_wall.flux[:, 0]).sum()) < 1e-8 * field.balance.dissipation
    np.testing.assert_allclose(field.sliding_wall.temperature, field.shaft, rtol=1e-12)
    assert np.ptp(field.sliding_wall.flux) > 0.1 * VISCOSITY * SPEED**2 / GAP
    assert abs(imbalance(field.balance)) < 1e-8
    scale = VISCOSITY * SPEED**2 / CONDUCTIVITY
    assert 0 < field.shaft - SUPPLY < scale / 2


def test_exponential_viscosity():
    """Gavis and Laurence 1968: with N = β η u²/k, β (T_max - T_w) = ln(1 + N/8), and the stress of the closed form."""
    slope = 3 * CONDUCTIVITY / (VISCOSITY * SPEED**2)
    oil = liquid(slope=slope, capacity=SLOW)
    film = plates(8)
    walls = {"sliding_wall": AT_SUPPLY, "fixed_wall": AT_SUPPLY, "modes": 12}
    field = temperature_across(film, oil, **walls)
    for _ in range(25):
        across = field.viscosities
        uniform = [values[4, 0] for values in (across.flow, across.shear, across.carried)]

        def viscosities(x, y, uniform=uniform):
            flow, shear, carried = (value + 0 * x + 0 * y for value in uniform)
            return Viscosities(flow=flow, shear=shear, carried=carried)

        film = plates(8, viscosities=viscosities)
        field = temperature_across(film, oil, **walls, start=field)
    root = np.sqrt(3 / 8)
    greatest, rate = np.log(1 + root**2), np.arcsinh(root)
    stress = VISCOSITY * SPEED / GAP * rate / (root * np.sqrt(1 + root**2))
    assert friction(film) / 0.05 == pytest.approx(stress, rel=1e-6)
    exact = greatest - 2 * np.log(np.cosh(rate * (2 * field.points - 1)))
    np.testing.assert_allclose(slope * developed(field), exact, rtol=1e-5)
    moment = quad(lambda s: s**2 * (1 + root**2) / np.cosh(2 * rate * s) ** 2, -0.5, 0.5, epsabs=1e-12)[0]
    assert field.viscosities.flow[4, 0] == pytest.approx(VISCOSITY / 12 / moment, rel=1e-6)
    assert field.viscosities.shear[4, 0] == pytest.approx(stress * GAP / SPEED, rel=1e-6)
    assert field.viscosities.carried[4, 0] == pytest.approx(1, rel=1e-4)


def test_flow_by_pressure_between_fixed_walls():
    """Power η (∂u/∂z)² of a parabolic velocity: k T'' = -(p' (z - h/2))²/η, a quartic, and a uniform plug of heat."""
    film = plates(12, speed=0.0, inlet=5e6)
    field = temperature_across(film, liquid(capacity=SLOW), sliding_wall=AT_SUPPLY, fixed_wall=AT_SUPPLY)
    gradient = 5e6 / 0.05
    scale = gradient**2 * GAP**4 / (12 * VISCOSITY * CONDUCTIVITY)
    np.testing.assert_allclose(developed(field), scale * (1 / 16 - (field.points - 0.5) ** 4), rtol=1e-4)


def test_conduction_so_fast_that_the_temperature_is_uniform_across():
    """With insulated walls the heat carried, ρc u h/2 (T - T₀), is the power since the inlet, η u² x/h."""
    film = plates(40)
    oil = liquid(conductivity=50.0)
    field = temperature_across(film, oil, sliding_wall=InsulatedWall(), fixed_wall=InsulatedWall())
    exact = 2 * VISCOSITY * SPEED * film.grid.x / (CAPACITY * GAP**2)
    np.testing.assert_allclose(field.carried[1:, 0] - SUPPLY, exact[1:], rtol=1e-9)
    assert float(np.ptp(field.temperature, axis=2).max()) < 1e-3 * exact[-1]
