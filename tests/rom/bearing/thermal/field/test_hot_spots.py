"""The uncertainty of the largest temperature by places that become warmer on finer grids."""

from types import SimpleNamespace

import numpy as np
import pytest

from roughfilm.ladder import find
from roughfilm.rom.bearing.thermal.field.hot_spots import keeps_its_heat, warmer_elsewhere
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene

CELLS = (64.0, 32.0, 16.0)


def fields(order, rise):
    """A converged node at 80 K, and one at 79 K that approaches 79 + ``rise`` K with an order."""
    return [np.array([[80.0, 79.0 + rise * (1 - (64.0 / cells) ** order)]]) for cells in CELLS]


@pytest.mark.parametrize("order", [1.0, 1.5, 2.0])
def test_a_node_that_rises_bounds_the_largest_temperature(order):
    """It comes to 79 + rise; the bound is 1.5 times the rise that is left."""
    found = fields(order, 4.0)
    assert warmer_elsewhere(found, CELLS) == pytest.approx(1.5 * 4.0 - 1.0, rel=1e-9)


def test_two_grids_are_extrapolated_with_the_lowest_order():
    assert warmer_elsewhere(fields(1.0, 4.0)[:2], CELLS[:2]) == pytest.approx(5.0, rel=1e-9)


def test_nodes_that_cool_and_the_warmest_node_itself_add_nothing():
    assert warmer_elsewhere(fields(1.0, -4.0), CELLS) == 0.0
    assert warmer_elsewhere([np.array([[82.0, 79.0]]), np.array([[80.0, 79.0]])], CELLS[:2]) == 0.0


def test_a_turning_shaft_takes_heat_whatever_the_round_off_of_its_sum():
    whole = SimpleNamespace(periodic=(True, False)), SimpleNamespace(shape=SimpleNamespace(idle=()))
    heated = SimpleNamespace(shaft=320.0, to_fixed_wall=0.0, to_sliding_wall=0.0)
    assert not keeps_its_heat(SimpleNamespace(network=whole[0], problem=whole[1], heated=heated))


@pytest.mark.parametrize(("wall", "known"), [("turning", True), ("adiabatic", False)])
def test_the_largest_temperature_of_a_closed_bore_is_known_with_a_turning_shaft_alone(wall, known):
    """Both sides have one pressure, so that streamlines in the middle close: 45.9 °C at 128 cells with such a shaft."""
    lubricant = {
        "viscosity": "0.02 Pa*s",
        "density": "870 kg/m^3",
        "temperature": "40 degC",
        "heat_capacity": "1950 J/(kg*K)",
        "conductivity": "0.14 W/(m*K)",
        "thermoviscosity": {"law": "exponential", "temperature_coefficient": "0.03 1/K"},
    }
    geometry = {"shape": "lobes", "radius": "50 mm", "clearance": "100 um", "width": "20 mm", "eccentricity": [0, -0.7]}
    entries = {"name": "bore", "kind": "bearing", "lubricant": lubricant, "geometry": geometry}
    sides = {"sides": {"low": "0.5 MPa", "high": "0.5 MPa"}}
    bore = read_scene({**entries, "motion": {"speed": "5 m/s"}, "boundary": sides, "heat": {"sliding_wall": wall}})
    hottest = find("bearing", "across").solve(bore, Request(resolution=32)).quantities["temperature_max"]
    assert (hottest.uncertainty is not None) == known
    if known:
        assert abs(hottest.value - 45.93) <= hottest.uncertainty
