"""Temperatures across the film of a journal bearing with a cavity and a supply."""

import numpy as np
import pytest
from warm_films import CAPACITY, CLEARANCE, RADIUS, SUPPLY, imbalance, journal, liquid

from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.cavitation.evaluation.friction import friction
from roughfilm.rom.temperature.across import temperature_across
from roughfilm.rom.temperature.mean import mean_temperature
from roughfilm.rom.temperature.walls import ConductingWall, InsulatedWall, SlidingHalfSpace, TurningWall

OUTSIDE = ConductingWall(resistance=2e-3, surroundings=SUPPLY)


@pytest.fixture(scope="module")
def film():
    found = journal(24)
    assert found.state.fill.min() < 0.5
    return found


@pytest.fixture(scope="module")
def field(film):
    return temperature_across(film, liquid(viscosity=0.02, slope=0.03), sliding_wall=TurningWall(), fixed_wall=OUTSIDE)


def test_heat_is_conserved(field):
    assert abs(imbalance(field.balance)) < 1e-8
    assert field.residual < 1e-8
    assert abs(field.balance.sliding_wall) < 1e-8 * field.balance.dissipation
    assert field.balance.fixed_wall > 0.01 * field.balance.dissipation


def test_heat_is_conserved_with_a_heat_capacity_that_grows(film):
    oil = liquid(viscosity=0.02, slope=0.03, growth=3e-3)
    warm = temperature_across(film, oil, sliding_wall=TurningWall(), fixed_wall=OUTSIDE, entering=SUPPLY + 20)
    assert abs(imbalance(warm.balance)) < 1e-8
    assert warm.balance.entering > 0.1 * warm.balance.dissipation


@pytest.mark.parametrize("growth", [0.0, 3e-3])
@pytest.mark.parametrize(
    "sliding", [InsulatedWall(), TurningWall(), ConductingWall(resistance=1e-4, surroundings=SUPPLY)]
)
@pytest.mark.parametrize("fixed", [InsulatedWall(), OUTSIDE])
def test_heat_is_conserved_at_a_low_peclet_number(sliding, fixed, growth):
    """ρc u h²/(k L) = 1e-3 in a film that heats by 0.1 to 1 K: to 1e-8 of the greatest heat flow."""
    thin, length = journal(16, viscosity=2e-4), 2 * np.pi * RADIUS
    conductivity = CAPACITY * thin.problem.speed * CLEARANCE**2 / length / 1e-3
    oil = liquid(viscosity=2e-4, slope=0.03, conductivity=conductivity, growth=growth)
    balance = temperature_across(thin, oil, sliding_wall=sliding, fixed_wall=fixed).balance
    flows = balance.dissipation, balance.leaving, balance.sliding_wall, balance.fixed_wall
    assert abs(imbalance(balance)) * balance.dissipation < 1e-8 * max(abs(flow) for flow in flows)


def test_the_power_is_that_of_friction_and_supply(film):
    """The supply adds its pressure times its flow, a small part of the power."""
    warm = temperature_across(film, liquid(viscosity=0.02), sliding_wall=InsulatedWall(), fixed_wall=OUTSIDE)
    assert warm.balance.dissipation == pytest.approx(friction(film) * film.problem.speed, rel=0.05)
    assert warm.balance.dissipation > friction(film) * film.problem.speed


@pytest.mark.parametrize("slope", [0.0, 0.03])
def test_fast_conduction_gives_the_temperature_of_the_mean_energy_equation(film, slope):
    """With insulated walls; the two discretisations differ by limited slopes at the edges of the supply."""
    oil = liquid(viscosity=0.02, slope=slope, conductivity=100.0)
    across = temperature_across(film, oil, sliding_wall=InsulatedWall(), fixed_wall=InsulatedWall())
    mean = mean_temperature(film, oil)
    rise = mean.temperature - SUPPLY
    assert np.abs(across.mean - mean.temperature).mean() < 0.01 * rise.max()
    assert across.balance.dissipation == pytest.approx(mean.dissipation.sum(), rel=5e-3)


def test_without_power_a_uniform_temperature_stays():
    thin = journal(24, viscosity=1e-13, supply=0.0)
    warm = temperature_across(
        thin, liquid(viscosity=1e-13), sliding_wall=InsulatedWall(), fixed_wall=InsulatedWall(), entering=SUPPLY + 40
    )
    np.testing.assert_allclose(warm.temperature, SUPPLY + 40, rtol=1e-11)


def test_insulated_walls_leave_all_power_to_the_lubricant(film):
    warm = temperature_across(film, liquid(viscosity=0.02), sliding_wall=InsulatedWall(), fixed_wall=InsulatedWall())
    assert warm.balance.leaving == pytest.approx(warm.balance.dissipation, rel=1e-8)
    assert warm.largest >= warm.temperature.max()


def test_a_start_near_the_solution_saves_sweeps(film, field):
    oil = liquid(viscosity=0.02, slope=0.03)
    again = temperature_across(film, oil, sliding_wall=TurningWall(), fixed_wall=OUTSIDE, start=field)
    assert again.sweeps < field.sweeps / 2
    np.testing.assert_allclose(again.temperature, field.temperature, atol=0.2)


def test_a_half_space_needs_an_inlet(film):
    wall = SlidingHalfSpace(conductivity=46.0, heat_capacity=3.6e6, temperature=SUPPLY)
    with pytest.raises(InputError, match="inlet"):
        temperature_across(film, liquid(), sliding_wall=wall, fixed_wall=OUTSIDE)


def test_too_few_modes_are_an_error(film):
    with pytest.raises(InputError, match="at least 2"):
        temperature_across(film, liquid(), sliding_wall=TurningWall(), fixed_wall=OUTSIDE, modes=1)
