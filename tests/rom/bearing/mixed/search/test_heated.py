"""Stribeck curves whose films are at the temperature at which their heat is balanced."""

import math
from dataclasses import replace
from pathlib import Path

import pytest

from roughfilm.cli.bearings_and_seals.stribeck import curve_entries
from roughfilm.contact.foundation.inputs import Inputs
from roughfilm.ladder import find
from roughfilm.rom.bearing.mixed.curves import curve_inputs
from roughfilm.rom.bearing.mixed.store import known_points, numbers_of, save_points, write_csv
from roughfilm.rom.bearing.mixed.stribeck import UNCERTAIN, stribeck
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene

CELLS = 16
OIL = {
    "viscosity": "0.03 Pa*s",
    "density": "870 kg/m^3",
    "heat_capacity": "2000 J/(kg*K)",
    "temperature": "40 degC",
    "thermoviscosity": {"law": "exponential", "temperature_coefficient": "0.035 1/K"},
}
JOURNAL = {"shape": "journal", "radius": "25 mm", "clearance": "30 um", "width": "40 mm"}
BORE = JOURNAL | {"shape": "lobes", "lobes": 2, "arc": "150 deg"}
PAD = {"shape": "linear", "length": "20 mm", "width": "20 mm", "rise": "10 um"}
ROUGH = {
    "roughness": {
        "kind": "surface",
        "surface": {
            "kind": "gaussian",
            "size": ["0.2 mm", "0.2 mm"],
            "points": [24, 24],
            "seed": 3,
            "rms_height": "0.5 um",
            "correlation_length": "30 um",
        },
    },
    "asperities": {
        "friction": 0.1,
        "solid": {"modulus": "210 GPa", "poisson": 0.3, "hardness": "3 GPa"},
        "solid_heat": {"conductivity": "46 W/(m*K)", "density": "7850 kg/m^3", "heat_capacity": "460 J/(kg*K)"},
    },
    "heat": {"heat_transfer": "500 W/(m^2*K)", "area": "0.02 m^2"},
}


def scene_of(geometry, speed="2 m/s", oil=(), **tables):
    lubricant, tables = OIL | dict(oil), {"load": {"pressure": "1 MPa"}} | tables
    return read_scene(
        {"name": "heated", "kind": "bearing", "geometry": geometry, "lubricant": lubricant, "motion": {"speed": speed}}
        | tables
    )


@pytest.mark.parametrize("geometry", [JOURNAL, BORE, PAD], ids=lambda one: one["shape"])
def test_a_point_is_the_film_of_heat_balance(geometry):
    """At one speed and load the curve has the film and the temperature of the model, on the same grid."""
    pressure = 1e6
    scene = scene_of(geometry)
    ((point,),) = (curve.points for curve in stribeck(scene, [2.0], [pressure], resolution=CELLS))
    result = find("bearing", "heat_balance").solve(scene, Request(resolution=CELLS))
    assert point.temperature == pytest.approx(result["effective_temperature"].value, abs=2e-3)
    assert point.outlet_temperature == pytest.approx(result["outlet_temperature"].value, abs=4e-3)
    assert point.friction == pytest.approx(result["friction"].value, rel=1e-4)
    assert point.temperature > 40.5
    assert 0 < point.uncertainty["temperature"] < point.temperature - 40


def test_points_whose_heat_transfer_is_estimated_are_said_once():
    """At 0.05 m/s what sliding carries, u c B/2 at most, takes less away than 300 W/(m² K) over 2RB; not at 8 m/s."""
    scene, speeds = scene_of(JOURNAL), (0.05, 8.0)
    curves = stribeck(scene, speeds, [1e5], resolution=CELLS)
    slow, fast = curves[0].points
    still = 300 * 50e-3 * 40e-3
    assert still - 870 * 2000 * 0.05 * 30e-6 * 40e-3 < slow.estimated_heat_transfer <= still
    assert fast.estimated_heat_transfer == 0
    entries = curve_entries(scene, curves, None, speeds)
    (warning,) = [one for one in entries["provenance"]["warnings"] if "heat.heat_transfer and heat.area" in one]
    assert warning.startswith("temperature: at 1 of 2 points ")
    assert warning.endswith("; the uncertainty contains a factor of two of it")
    assert entries["units"]["estimated_heat_transfer"] == "W/K"


def test_every_value_contains_a_factor_of_two_of_an_estimated_heat_transfer():
    """Half and twice of that to still air lead to values within the uncertainty, which they reach."""
    speed, pressure = 0.3, 1e5
    ((point,),) = (one.points for one in stribeck(scene_of(JOURNAL), [speed], [pressure], resolution=CELLS))
    assert point.estimated_heat_transfer > 0.1
    for name in UNCERTAIN:
        assert math.isfinite(point.uncertainty[name]), name
    reached, still = dict.fromkeys((*UNCERTAIN, "temperature"), 0.0), 300 * 50e-3 * 40e-3
    for part in (0.5, 2.0):
        transfer = point.estimated_heat_transfer + (part - 1) * still  # the flow takes away what is left of it
        heat = {"heat_transfer": f"{transfer!r} W/(m^2*K)", "area": "1 m^2"}
        curves = stribeck(scene_of(JOURNAL, heat=heat), [speed], [pressure], resolution=CELLS)
        ((other,),) = (one.points for one in curves)
        for name in reached:
            change = abs(getattr(other, name) - getattr(point, name))
            assert change <= 1.05 * point.uncertainty[name] + 1e-9 * abs(getattr(point, name)), name
            reached[name] = max(reached[name], change / point.uncertainty[name] if point.uncertainty[name] else 0.0)
    assert reached["temperature"] > 0.8
    assert reached["friction"] > 0.3
    assert point.temperature > 40.5


def test_the_input_that_leads_is_named_where_no_heat_transfer_is_estimated():
    """At 20 m/s oil that is 5 K warmer, and flows away, makes the film about 5 K warmer at most."""
    scene = scene_of(JOURNAL, speed="20 m/s")
    curves = stribeck(scene, [20.0], [1e6], resolution=CELLS)
    (point,) = curves[0].points
    assert point.leading.startswith("it depends most on ")
    (warning,) = [one for one in curve_entries(scene, curves, None, [20.0])["provenance"]["warnings"] if "most" in one]
    assert warning == f"temperature: at 7639 rpm under 1 MPa {point.leading}"


def test_heat_lowers_friction_and_film_at_high_speeds_and_leaves_low_ones():
    scene = scene_of(JOURNAL)
    (hot,), (cold,) = (stribeck(one, [0.01, 20.0], [1e6], resolution=CELLS) for one in (scene, scene.isothermal()))
    slow, fast = hot.points
    assert 40 < slow.temperature < 40.5
    assert slow.friction == pytest.approx(cold.points[0].friction, rel=1e-2)
    assert fast.friction < 0.7 * cold.points[1].friction
    assert fast.separation < cold.points[1].separation
    assert cold.points[0].temperature is None
    assert cold.points[0].uncertainty.keys() == hot.points[0].uncertainty.keys() - {"temperature", "outlet_temperature"}


def test_a_viscosity_that_does_not_change_leaves_the_curve():
    oil = {"thermoviscosity": {"law": "exponential", "temperature_coefficient": "0 1/K"}}
    scene = scene_of(JOURNAL, oil=oil)
    (hot,), (cold,) = (stribeck(one, [0.1, 5.0], [1e6], resolution=CELLS) for one in (scene, scene.isothermal()))
    for one, other in zip(hot.points, cold.points, strict=True):
        assert one.friction == pytest.approx(other.friction, rel=1e-5)
        assert one.separation == pytest.approx(other.separation, rel=1e-5)


@pytest.fixture(scope="module")
def rough():
    scene = scene_of(PAD, **ROUGH)
    (hot,), (cold,) = (stribeck(one, [0.0, 0.2, 30.0], [3e6], resolution=CELLS) for one in (scene, scene.isothermal()))
    return scene, hot, cold


def test_asperities_heat_the_film_too(rough):
    """At rest nothing heats; where asperities carry, P is their friction, and heat leaves them more of the load."""
    _, hot, cold = rough
    rest, mixed, _ = hot.points
    assert rest.temperature == pytest.approx(40, abs=1e-3)
    assert mixed.contact_share > cold.points[1].contact_share > 0
    assert mixed.temperature > 40.1
    assert mixed.friction > 0.1 * mixed.contact_load
    assert hot.lift_off.speed > cold.lift_off.speed > 0
    assert math.isfinite(hot.lift_off.uncertainty)


def test_spots_in_contact_are_as_hot_as_by_the_model_and_cold_where_nothing_slides_or_touches(rough):
    _, hot, cold = rough
    rest, mixed, parted = hot.points
    assert (rest.flash_temperature, parted.flash_temperature_high) == (0.0, None)
    assert 0 < mixed.flash_temperature_low <= mixed.flash_temperature < mixed.flash_temperature_high
    film = find("bearing", "mixed").solve(
        scene_of(PAD, speed="0.2 m/s", **ROUGH | {"load": {"pressure": "3 MPa"}}).isothermal(),
        Request(resolution=CELLS),
    )
    for name in ("flash_temperature", "flash_temperature_low", "flash_temperature_high"):
        assert getattr(cold.points[1], name) == pytest.approx(film[name].value, rel=1e-3)


def test_a_heat_transfer_that_is_estimated_counts_at_rest_and_for_kept_points():
    """Without any heat nothing depends on it; the bar of a point does not depend on when its film was solved."""
    scene = scene_of(PAD, **{name: table for name, table in ROUGH.items() if name != "heat"})
    (curve,) = stribeck(scene, [0.0, 0.2], [3e6], resolution=CELLS)
    rest, mixed = curve.points
    assert rest.temperature == pytest.approx(40, abs=1e-3)
    assert rest.uncertainty["temperature"] == pytest.approx(0, abs=1e-3)
    assert mixed.uncertainty["temperature"] > 0.5 * (mixed.temperature - 40) > 0
    kept = [replace(point, uncertainty={}) for point in curve.points]
    (again,) = stribeck(scene, [0.0, 0.2], [3e6], resolution=CELLS, known=kept)
    assert again.points[1].uncertainty["temperature"] == pytest.approx(mixed.uncertainty["temperature"], rel=1e-2)


def test_the_file_keeps_temperatures(rough, tmp_path: Path):
    scene, hot, cold = rough
    inputs: Inputs = curve_inputs(scene, None, CELLS)
    save_points(tmp_path / "hot.h5", inputs, hot.points)
    assert known_points(tmp_path / "hot.h5", inputs) == hot.points
    write_csv(tmp_path / "hot.csv", [hot])
    heads = (tmp_path / "hot.csv").read_text().splitlines()[0]
    assert "temperature (degC), outlet_temperature (degC), flash_temperature (K)" in heads
    parted = (tmp_path / "hot.csv").read_text().splitlines()[-1].split(", ")
    assert parted[heads.split(", ").index("flash_temperature (K)")] == ""
    assert "temperature" not in numbers_of(cold.points)
    assert curve_inputs(scene.isothermal(), None, CELLS).digest != inputs.digest
