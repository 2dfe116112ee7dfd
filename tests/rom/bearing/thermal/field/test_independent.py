"""Films between walls that take no heat, against spectral collocation that shares no code with the project."""

import pytest

from roughfilm.ladder import find
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene
from roughfilm.validation.hot_pad import HotPad, hot_film

SUPPLIED, VISCOSITY, DENSITY, CAPACITY = 40.0, 0.05, 860.0, 2000.0

QUANTITIES = {
    "load": "load",
    "friction": "friction",
    "inlet_flow": "inlet_flow",
    "side_leakage": "side_leakage",
    "temperature_max": "rise",
}
"""Quantities of the model, and the names of the same numbers of the other method."""


def ours(thinning):
    lubricant = {
        "viscosity": f"{VISCOSITY} Pa*s",
        "density": f"{DENSITY} kg/m^3",
        "temperature": f"{SUPPLIED} degC",
        "heat_capacity": f"{CAPACITY} J/(kg*K)",
        "thermoviscosity": {"law": "exponential", "temperature_coefficient": f"{thinning} 1/K"},
    }
    geometry = {"shape": "linear", "length": "0.1 m", "width": "0.1 m", "film": "40 um", "rise": "40 um"}
    entries = {"name": "hot", "kind": "bearing", "geometry": geometry, "lubricant": lubricant}
    scene = read_scene({**entries, "motion": {"speed": "10 m/s"}})
    return find("bearing", "adiabatic").solve(scene, Request(resolution=64))


def theirs(thinning, points):
    return hot_film(
        HotPad(
            length=0.1,
            width=0.1,
            film=lambda x: 80e-6 - 40e-6 * x / 0.1,
            speed=10.0,
            viscosity=VISCOSITY,
            thinning=thinning,
            capacity=DENSITY * CAPACITY,
        ),
        points,
    )


@pytest.mark.parametrize("thinning", [0.02, 0.1])
def test_a_hot_pad_of_finite_width_is_that_of_a_second_method(thinning):
    """Heating lowers the load by 14 and 42 %. Both uncertainties together bound each difference, and are small."""
    found, coarse, fine = ours(thinning), theirs(thinning, 10), theirs(thinning, 14)
    for name, other in QUANTITIES.items():
        quantity = found.quantities[name]
        value = quantity.value - SUPPLIED if name == "temperature_max" else quantity.value
        true, error = getattr(fine, other), abs(getattr(fine, other) - getattr(coarse, other))
        assert abs(value - true) <= quantity.uncertainty + error, name
        assert quantity.uncertainty + error < 3e-3 * true, name
