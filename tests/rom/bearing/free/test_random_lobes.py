"""Random shafts in lobes under random loads keep the symmetries, scales and balances of their equations."""

import functools
import math

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.ladder import find
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene
from roughfilm.stability.checks.invariants import broken

SEEDS = range(6)
NAMES = ("load", "film_min", "friction", "pressure_max", "side_leakage", "inlet_flow", "eccentricity", "attitude_angle")


def drawn(seed):
    """Radius, clearance, width and viscosity in SI units, angles in degrees, and speed in m/s."""
    rng = np.random.default_rng(seed)
    lobes = int(rng.integers(1, 5))
    arc = 360 / lobes * rng.uniform(0.6, 0.9)
    film = {"lobes": lobes, "arc": arc, "first": rng.uniform(-100, -80), "preload": rng.uniform(0, 0.5)}
    radius, clearance, viscosity, speed = 0.05, rng.uniform(40e-6, 80e-6), 0.02, rng.uniform(5, 30)
    pressure = rng.uniform(0.03, 0.6) * viscosity * speed * radius / clearance**2
    return film | {
        "radius": radius,
        "clearance": clearance,
        "width": 2 * radius * rng.uniform(0.3, 1.2),
        "viscosity": viscosity,
        "speed": speed,
        "angle": rng.uniform(-120, -60),
        "pressure": pressure,
    }


def scene_of(one):
    geometry = {key: f"{one[key]!r} m" for key in ("radius", "clearance", "width")}
    geometry |= {key: f"{one[key]!r} deg" for key in ("arc", "first")}
    geometry |= {"shape": "lobes", "lobes": one["lobes"], "preload": one["preload"], "offset": one.get("offset", 0.5)}
    entries = {
        "name": "random lobes",
        "kind": "bearing",
        "geometry": geometry,
        "lubricant": {"viscosity": f"{one['viscosity']!r} Pa*s"},
        "motion": {"speed": f"{one['speed']!r} m/s"},
        "load": {"pressure": f"{one['pressure']!r} Pa", "angle": f"{one['angle']!r} deg"},
    }
    return read_scene(entries)


def solved(one):
    return find("bearing", "reynolds_cavitating").solve(scene_of(one), Request(resolution=32))


@functools.cache
def plain(seed):
    return solved(drawn(seed))


def agree(one, other, factors=None, names=NAMES):
    for name in names:
        factor = (factors or {}).get(name, 1.0)
        assert other[name].value == pytest.approx(factor * one[name].value, rel=1e-6), name


@pytest.mark.parametrize("seed", SEEDS)
def test_the_laws_of_films_are_kept(seed):
    result = plain(seed)
    assert broken(scene_of(drawn(seed)), result) == []
    thickness, x = result.fields["film_thickness"].values, result.fields["x"].values[:, 0]
    one = drawn(seed)
    along = np.degrees(x / one["radius"]) % (360 / one["lobes"])
    assert thickness[(along > 0.1) & (along < one["arc"] - 0.1)].min() >= result["film_min"].value * (1 - 1e-9)
    leaving = result["outlet_flow"].value + result["side_leakage"].value
    assert result["inlet_flow"].value == pytest.approx(leaving, rel=1e-9)


@pytest.mark.parametrize("seed", SEEDS)
def test_bore_and_load_turned_together_turn_the_shaft(seed):
    one, result = drawn(seed), plain(seed)
    turned = solved(one | {key: one[key] + 77.0 for key in ("first", "angle")})
    agree(result, turned)
    x, y = (result[f"eccentricity_{axis}"].value for axis in "xy")
    aside = x * math.cos(math.radians(77)) - y * math.sin(math.radians(77))
    assert turned["eccentricity_x"].value == pytest.approx(aside, abs=1e-6)


@pytest.mark.parametrize("seed", SEEDS)
def test_a_mirrored_bearing_has_the_mirrored_film(seed):
    """Mirrored in the plane of the y axis: angles φ become 180° - φ, and the shaft turns back."""
    one, result = drawn(seed), plain(seed)
    mirrored = solved(one | {key: 180.0 - one[key] for key in ("first", "angle")} | {"speed": -one["speed"]})
    agree(result, mirrored)
    assert mirrored["eccentricity_x"].value == pytest.approx(-result["eccentricity_x"].value, abs=1e-6)


@pytest.mark.parametrize("seed", SEEDS)
def test_only_viscosity_times_speed_and_ratios_of_lengths_count(seed):
    one, result = drawn(seed), plain(seed)
    thinner = solved(one | {"viscosity": one["viscosity"] / 3, "speed": one["speed"] * 3})
    agree(result, thinner, {"side_leakage": 3.0, "inlet_flow": 3.0})
    longer = solved(one | {key: 2.5 * one[key] for key in ("radius", "clearance", "width", "speed")})
    flows = dict.fromkeys(("side_leakage", "inlet_flow"), 2.5**3)
    agree(result, longer, {"load": 2.5**2, "friction": 2.5**2, "film_min": 2.5} | flows)


@pytest.mark.parametrize("seed", SEEDS)
def test_more_load_means_a_thinner_film_and_more_pressure(seed):
    one, result = drawn(seed), plain(seed)
    try:
        heavier = solved(one | {"pressure": 1.5 * one["pressure"]})
    except InputError as error:
        assert str(error).startswith("load: got")  # noqa: PT017
        return
    assert heavier["film_min"].value < result["film_min"].value
    assert heavier["pressure_max"].value > result["pressure_max"].value
