"""The heat of asperities: its sum is the power of boundary friction."""

import numpy as np
import pytest

from roughfilm.rom.bearing.mixed.contact_load import asperity_load
from roughfilm.rom.bearing.mixed.quantities import film_of_scene, mixed_quantities
from roughfilm.rom.bearing.mixed.wall import asperities_of
from roughfilm.rom.bearing.quantities import bearing_quantities
from roughfilm.rom.bearing.thermal.asperity_heat import asperity_heat
from roughfilm.rom.cavitation.solve import solve

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
        made["power_loss"].value for made in (mixed_quantities(scene, film), bearing_quantities(scene, film))
    )
    heat = asperity_heat(film, force, tips.friction)
    assert heat.sum() == pytest.approx(both - alone, rel=1e-9)
    assert heat.shape == film.grid.shape
    np.testing.assert_allclose(asperity_heat(film, force, np.full(film.grid.shape, tips.friction)), heat)
