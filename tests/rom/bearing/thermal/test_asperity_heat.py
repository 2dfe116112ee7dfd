"""The heat of asperities: its sum is the power of boundary friction, and the lubricant takes it away."""

import numpy as np
import pytest

from roughfilm.rom.bearing.mixed.contact_load import asperity_load
from roughfilm.rom.bearing.mixed.quantities import contact_quantities, film_of_scene
from roughfilm.rom.bearing.mixed.wall import asperities_of
from roughfilm.rom.bearing.quantities import bearing_quantities
from roughfilm.rom.bearing.thermal.asperity_heat import asperity_heat
from roughfilm.rom.cavitation.solve import solve
from roughfilm.rom.lubricants.liquid import Liquid
from roughfilm.rom.temperature.across import temperature_across
from roughfilm.rom.temperature.mean import mean_temperature
from roughfilm.rom.temperature.walls import InsulatedWall

LINEAR = {"shape": "linear", "length": "20 mm", "width": "10 mm", "film": "1 um", "rise": "1.5 um"}
WASHER = {"shape": "washer", "inner_radius": "150 mm", "outer_radius": "180 mm", "pockets": 30, "film": "1 um"}
JOURNAL = {"shape": "journal", "radius": "10 mm", "width": "10 mm", "clearance": "9 um", "eccentricity": 0.9}


@pytest.mark.parametrize("geometry", [LINEAR, WASHER, JOURNAL], ids=lambda geometry: geometry["shape"])
@pytest.mark.parametrize("speed", ["0.1 m/s", "-0.1 m/s"])
def test_the_heat_is_the_power_of_boundary_friction(tips, geometry, speed):
    scene = tips.scene(geometry, boundary={"sides": {"low": "0.1 MPa"}}, motion={"speed": speed})
    film = solve(film_of_scene(scene), (16, 16))
    force = asperity_load(film.problem.shape, film.grid, asperities_of(scene)).force
    both, alone = (
        made["power_loss"].value for made in (contact_quantities(scene, film), bearing_quantities(scene, film))
    )
    heat = asperity_heat(film, force, tips.friction)
    assert heat.sum() == pytest.approx(both - alone, rel=1e-9)
    assert heat.shape == film.grid.shape
    np.testing.assert_allclose(asperity_heat(film, force, np.full(film.grid.shape, tips.friction)), heat)


def oil(capacity=1.7e6):
    """A liquid whose viscosity stays, so that the heat that is added does not change the dissipation."""
    return Liquid(
        temperature=313.0,
        viscosity=lambda t: (np.full(np.shape(t), 0.1), np.zeros(np.shape(t))),
        heat=lambda t: (capacity * (t - 313.0), np.full(np.shape(t), capacity)),
        conductivity=0.14,
    )


@pytest.fixture
def boundary_friction(tips):
    scene = tips.scene(LINEAR)
    film = solve(film_of_scene(scene), (8, 8))
    force = asperity_load(film.problem.shape, film.grid, asperities_of(scene)).force
    return film, asperity_heat(film, force, 0.01 * tips.friction)  # as walls that take none would become too hot


def test_the_lubricant_takes_the_heat_of_asperities_away(boundary_friction):
    film, heat = boundary_friction
    plain, hot = mean_temperature(film, oil()), mean_temperature(film, oil(), added_power=heat)
    taken, before = (sum(one.heat_out - one.heat_in for one in found.carried.values()) for found in (hot, plain))
    assert heat.sum() > 0.1 * before
    assert taken - before == pytest.approx(heat.sum(), rel=1e-8)
    assert hot.dissipation.sum() - plain.dissipation.sum() == pytest.approx(heat.sum(), rel=1e-10)
    assert hot.imbalance < 1e-10
    assert (hot.temperature >= plain.temperature - 1e-9).all()


def test_so_it_does_across_the_film_between_walls_that_take_none(boundary_friction):
    film, heat = boundary_friction
    walls = {"sliding_wall": InsulatedWall(), "fixed_wall": InsulatedWall(), "modes": 4}
    plain, hot = temperature_across(film, oil(), **walls), temperature_across(film, oil(), added_power=heat, **walls)
    assert hot.balance.dissipation - plain.balance.dissipation == pytest.approx(heat.sum(), rel=1e-10)
    assert hot.balance.leaving - plain.balance.leaving == pytest.approx(heat.sum(), rel=1e-6)
    assert hot.mean.max() > plain.mean.max()
