"""Lubricant that circulates in a full bore, against closed forms across the film."""

import numpy as np
import pytest
from warm_films import CAPACITY, CONDUCTIVITY, SUPPLY, imbalance, liquid

from roughfilm.contact.foundation.errors import ConvergenceError
from roughfilm.rom.cavitation.discretise import Ends
from roughfilm.rom.cavitation.problem import Problem
from roughfilm.rom.cavitation.shape import Shape
from roughfilm.rom.cavitation.solve import solve
from roughfilm.rom.temperature.across import temperature_across
from roughfilm.rom.temperature.walls import ConductingWall, InsulatedWall, TurningWall, WallAtTemperature

GAP, SPEED, VISCOSITY, LENGTH, WIDTH = 2e-4, 10.0, 0.02, 0.3, 0.05
TURNS = GAP**2 * CAPACITY / CONDUCTIVITY * SPEED / LENGTH
"""Turns of the wall in the time in which heat diffuses over the film thickness."""

SCALE = VISCOSITY * SPEED**2 / CONDUCTIVITY
"""η u²/k, K."""

FLUX = VISCOSITY * SPEED**2 / GAP
"""Power of the film on an area, W/m²."""


@pytest.fixture(scope="module")
def bore():
    """A concentric bore with closed ends."""
    shape = Shape(
        thickness=lambda x, y: GAP + 0 * x + 0 * y,
        breaks=(0.0, LENGTH),
        across=(0.0, WIDTH),
        wide=False,
        joined=(True, False),
    )
    ends = Ends(anchor=(0.0, 0.0, 0.0))
    return solve(Problem(shape=shape, ends=ends, speed=SPEED, viscosity=VISCOSITY), (24, 4))


def test_walls_at_the_same_temperature(bore):
    """Brinkman: T - T_w = η u²/(2 k) ζ (1 - ζ), whatever heat is carried around."""
    assert TURNS > 15
    wall = WallAtTemperature(temperature=SUPPLY)
    field = temperature_across(bore, liquid(viscosity=VISCOSITY), sliding_wall=wall, fixed_wall=wall)
    exact = SCALE / 2 * field.points * (1 - field.points)
    np.testing.assert_allclose(field.temperature - SUPPLY, np.broadcast_to(exact, field.temperature.shape), rtol=1e-5)
    assert abs(imbalance(field.balance)) < 1e-8


@pytest.mark.parametrize("wall", [InsulatedWall(), TurningWall()])
def test_all_heat_through_the_fixed_wall(bore, wall):
    """Without heat into the shaft, T = T_a + R η u²/h + η u²/(2 k) (1 - ζ²)."""
    cool = ConductingWall(resistance=2 * GAP / CONDUCTIVITY, surroundings=SUPPLY - 5)
    field = temperature_across(bore, liquid(viscosity=VISCOSITY), sliding_wall=wall, fixed_wall=cool)
    exact = -5 + 2 * SCALE + SCALE / 2 * (1 - field.points**2)
    np.testing.assert_allclose(field.temperature - SUPPLY, np.broadcast_to(exact, field.temperature.shape), rtol=1e-5)
    np.testing.assert_allclose(field.fixed_wall.flux, FLUX, rtol=1e-5)
    assert abs(imbalance(field.balance)) < 1e-8
    assert field.sweeps < 200


def test_too_hot_a_film_is_an_answer_with_its_place(bore):
    """A resistance that the power passes at 3000 K."""
    cool = ConductingWall(resistance=3000 / FLUX, surroundings=SUPPLY)
    with pytest.raises(ConvergenceError, match=r"more than 1000 K .* at x = .* m, y = .* m"):
        temperature_across(bore, liquid(viscosity=VISCOSITY), sliding_wall=InsulatedWall(), fixed_wall=cool)


def test_heat_without_a_way_out(bore):
    """Between insulated walls no lubricant leaves a closed bore, so that it has no temperature."""
    walls = {"sliding_wall": InsulatedWall(), "fixed_wall": InsulatedWall()}
    with pytest.raises(ConvergenceError, match=r"neither walls nor lubricant take|more than 1000 K"):
        temperature_across(bore, liquid(viscosity=VISCOSITY), **walls)
