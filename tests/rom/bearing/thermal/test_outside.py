"""Scenes whose temperatures a model cannot have: heat that nothing takes away, and places that run too hot."""

import pytest

from roughfilm.contact.foundation.errors import ConvergenceError
from roughfilm.ladder import find
from roughfilm.rom.ladder.kind import kind_of_scene
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene

OIL = {"oil": "ISO VG 68", "temperature": "40 degC", "cavitation_pressure": "-0.1 MPa"}
ROUGH = {
    "roughness": {
        "kind": "surface",
        "surface": {
            "kind": "gaussian",
            "size": ["0.2 mm", "0.2 mm"],
            "points": [24, 24],
            "seed": 1,
            "rms_height": "0.3 um",
            "correlation_length": "30 um",
        },
    },
    "asperities": {"friction": 0.12, "solid": {"modulus": "210 GPa", "poisson": 0.3, "hardness": "3 GPa"}},
}
WASHER = {"shape": "washer", "inner_radius": "20 mm", "outer_radius": "30 mm", "pockets": 12}
POCKET = {"depth": "0.2 mm", "share": 0.3, "extent": "6 mm"}
COLD = {"kind": "temperature", "temperature": "40 degC"}


def washer(speed, **tables):
    entries = {"name": "washer", "kind": "bearing", "geometry": WASHER | {"pocket": POCKET}, "lubricant": OIL}
    return read_scene({**entries, "motion": {"speed": speed}, "load": {"pressure": "2 MPa"}, **ROUGH, **tables})


def outside(scene, model):
    return kind_of_scene(scene).outside(scene, find("bearing", model), None)


@pytest.mark.parametrize("model", ["adiabatic", "across"])
def test_asperities_that_touch_at_low_speed_need_walls_that_take_heat(model):
    """1 rpm: friction heats all lubricant that slides, u h/2 of a width, by 2 μ p L/(ρ c h), thousands of kelvins."""
    (sentence,) = outside(washer("1 rpm"), model)
    assert "the walls take most heat, and those of this model take none" in sentence
    assert "heat_balance" in sentence


def test_models_that_give_the_heat_off_are_in_their_range():
    assert outside(washer("1 rpm"), "heat_balance") == ()
    assert outside(washer("1 rpm"), "mixed") == ()
    assert outside(washer("1 rpm", heat={"fixed_wall": COLD}), "across") == ()


def test_a_place_that_runs_too_hot_is_an_angle_on_a_ring():
    ring = {"shape": "sector", "inner_radius": "30 mm", "outer_radius": "60 mm", "angle": "40 deg", "pads": 8}
    oil = {
        "viscosity": "0.03 Pa*s",
        "density": "870 kg/m^3",
        "heat_capacity": "2000 J/(kg*K)",
        "conductivity": "0.13 W/(m*K)",
        "temperature": "40 degC",
        "thermoviscosity": {"law": "exponential", "temperature_coefficient": "0 1/K"},
    }
    geometry = ring | {"film": "1 um", "rise": "1 um"}
    entries = {"name": "hot ring", "kind": "bearing", "geometry": geometry, "lubricant": oil}
    scene = read_scene({**entries, "motion": {"speed": "10000 rpm"}})
    with pytest.raises(ConvergenceError, match=r"the supply at [\d.]+° of the angle, radius 0.0\d+ m, .*heat_balance"):
        find("bearing", "across").solve(scene, Request(resolution=16))
