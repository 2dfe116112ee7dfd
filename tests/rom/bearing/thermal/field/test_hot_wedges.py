"""Wedges whose temperature varies across the film, against finite differences that share no code with the project."""

import math

import pytest

import roughfilm as rf
from roughfilm.ladder import find
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene
from scripts.studies.coverage.truths.hot_wedge import marched, truth, wedge_of

LENGTH, FILM, DENSITY, CAPACITY, CONDUCTIVITY, SUPPLIED, BETA = 0.05, 150e-6, 870.0, 2000.0, 0.13, 40.0, 0.04


def numbers_of(peclet, nahme):
    """Speed and viscosity with ρ c u h²/(k L) and β η u²/k."""
    speed = peclet * CONDUCTIVITY * LENGTH / (DENSITY * CAPACITY * FILM**2)
    return speed, nahme * CONDUCTIVITY / (BETA * speed**2)


def scene_of(peclet, nahme, rise, *, wall=None, conductivity=True):
    speed, viscosity = numbers_of(peclet, nahme)
    lubricant = {
        "viscosity": f"{viscosity} Pa*s",
        "density": f"{DENSITY} kg/m^3",
        "heat_capacity": f"{CAPACITY} J/(kg*K)",
        "temperature": f"{SUPPLIED} degC",
        "thermoviscosity": {
            "law": "exponential",
            "temperature_coefficient": f"{BETA} 1/K",
            "valid_from": "-100 degC",
            "valid_to": "600 degC",
        },
    }
    lubricant |= {"conductivity": f"{CONDUCTIVITY} W/(m*K)"} if conductivity else {}
    geometry = {"shape": "linear", "length": f"{LENGTH} m", "film": f"{FILM} m", "rise": f"{rise * FILM} m"}
    entries = {"name": "hot wedge", "kind": "bearing", "geometry": geometry, "lubricant": lubricant}
    heat = {} if wall is None else {"heat": dict.fromkeys(("fixed_wall", "sliding_wall"), wall)}
    return read_scene({**entries, "motion": {"speed": f"{speed} m/s"}, **heat})


@pytest.mark.parametrize(
    ("peclet", "nahme", "rise", "wall"),
    [
        (0.3, 3.0, 0.5, None),
        (3.0, 10.0, 0.5, None),
        (30.0, 10.0, 0.5, None),
        (84.0, 31.0, 0.47, None),
        (3.0, 10.0, 0.5, {"kind": "temperature", "temperature": f"{SUPPLIED} degC"}),
    ],
)
def test_the_model_across_the_film_is_that_of_the_other_program(peclet, nahme, rise, wall):
    """Both agree to the uncertainty of the other one, which is extrapolated at its first order along the film."""
    scene = scene_of(peclet, nahme, rise, wall=wall)
    found, true = find("bearing", "across").solve(scene, Request(resolution=128)), truth(scene)
    for name, value in true.values.items():
        error = true.uncertainty[name] + (found[name].uncertainty or 0.0)
        assert abs(found[name].value - value) <= 2 * error, name
        assert error < 0.03 * abs(value - (SUPPLIED if "temperature" in name else 0.0)), name


def test_the_other_program_converges_at_first_order_at_least():
    wedge = wedge_of(scene_of(3.0, 10.0, 0.5))
    loads = [marched(wedge, columns)["load_per_width"] for columns in (50, 100, 200)]
    assert 1.8 < (loads[1] - loads[0]) / (loads[2] - loads[1]) < 4.5


@pytest.mark.parametrize(("peclet", "nahme"), [(0.1, 3.0), (3.0, 1.0), (30.0, 3.0), (300.0, 30.0)])
@pytest.mark.parametrize("conductivity", [True, False])
def test_errors_of_one_temperature_across_the_film_contain_the_difference(peclet, nahme, conductivity):
    """Also of a lubricant without a conductivity, which that of oils replaces; they are at most thrice as large."""
    true = truth(scene_of(peclet, nahme, 0.5)).values["load_per_width"]
    scene = scene_of(peclet, nahme, 0.5, conductivity=conductivity)
    found = rf.solve(scene, model="adiabatic", resolution=128)
    error = abs(found["load_per_width"].value - true) / true
    stated = found.expected_error["load_per_width"]
    assert error <= stated <= 3 * error + 0.02


def test_the_heat_of_a_fast_film_stays_where_it_is_made():
    """Without conduction the error of adiabatic is that of the Nahme number over the root of the Péclet number."""
    errors = []
    for peclet in (30.0, 120.0):
        nahme = 0.3 * math.sqrt(peclet)
        pair = [
            find("bearing", model).solve(scene_of(peclet, nahme, 0.5), Request(resolution=128))
            for model in ("adiabatic", "across")
        ]
        errors.append(pair[0]["load_per_width"].value / pair[1]["load_per_width"].value - 1)
    assert min(errors) > 0.02
    assert errors[1] == pytest.approx(errors[0], rel=0.25)
