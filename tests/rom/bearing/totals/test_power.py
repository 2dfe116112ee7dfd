"""Power, torque, flows and numbers of the load of films, where they have closed forms, and totals of rings."""

import math

import pytest
from places import SCENES

from roughfilm.ladder import find
from roughfilm.rom.bearing.closed_forms.sliding import linear_slider
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import load_scene, read_scene

VISCOSITY = 0.02
RADIUS, CLEARANCE, WIDTH, SPEED = 0.025, 25e-6, 0.05, 2.0
INNER, OUTER, FILM, CELLS = 0.15, 0.18, 10e-6, 30


def bearing(geometry, speed=SPEED, **tables) -> Bearing:
    lubricant = {"viscosity": f"{VISCOSITY} Pa*s"} | tables.pop("lubricant", {})
    entries = {"name": "b", "kind": "bearing", "geometry": geometry, "lubricant": lubricant}
    scene = read_scene(entries | {"motion": {"speed": f"{speed} m/s"}} | tables)
    assert isinstance(scene, Bearing)
    return scene


def journal(eccentricity, **changes) -> Bearing:
    shaft = {"radius": "25 mm", "clearance": "25 um", "width": "50 mm"}
    return bearing({"shape": "journal", "eccentricity": eccentricity} | shaft | changes)


def washer(**geometry) -> Bearing:
    ring = {"inner_radius": "150 mm", "outer_radius": "180 mm", "pockets": CELLS, "film": "10 um"}
    return bearing({"shape": "washer"} | ring | geometry, boundary={"sides": {"low": "0.1 MPa"}})


def sector(**geometry) -> Bearing:
    ring = {"inner_radius": "20 mm", "outer_radius": "40 mm", "angle": "45 deg", "film": "20 um", "rise": "20 um"}
    return bearing({"shape": "sector"} | ring | geometry)


def solve(scene, resolution=64, model="reynolds_cavitating"):
    return find("bearing", model).solve(scene, Request(resolution=resolution))


def test_a_couette_film_takes_the_power_of_its_shear():
    scene = bearing({"shape": "parallel", "length": "20 mm", "width": "10 mm", "film": "10 um"})
    area = 20e-3 * 10e-3
    result = solve(scene, 32)
    assert result["power_loss"].value == pytest.approx(VISCOSITY * SPEED**2 * area / 10e-6)
    assert result["power_loss"].unit == "W"
    assert "torque" not in result.quantities


def test_an_infinitely_wide_film_has_its_power_per_width():
    result = solve(bearing({"shape": "parallel", "length": "20 mm", "film": "10 um"}))
    assert result.quantities["power_loss_per_width"].value == pytest.approx(VISCOSITY * SPEED**2 * 20e-3 / 10e-6)
    assert result.quantities["power_loss_per_width"].unit == "W/m"
    assert "power_loss" not in result.quantities


def test_power_does_not_depend_on_the_sense_of_the_sliding():
    there = solve(bearing({"shape": "parallel", "length": "20 mm", "film": "10 um"}))
    back = solve(bearing({"shape": "parallel", "length": "20 mm", "film": "10 um"}, -SPEED))
    assert back["power_loss"].value == pytest.approx(there["power_loss"].value)


def test_a_concentric_journal_has_petroffs_friction_power_and_torque():
    result = solve(journal(0.0))
    force = VISCOSITY * SPEED / CLEARANCE * 2 * math.pi * RADIUS * WIDTH
    assert result["friction"].value == pytest.approx(force)
    assert result["torque"].value == pytest.approx(force * RADIUS)
    assert result["power_loss"].value == pytest.approx(force * SPEED)
    assert "friction_coefficient" not in result.quantities  # no load
    assert "hersey_number" not in result.quantities


def test_a_nearly_concentric_journal_has_petroffs_friction_coefficient():
    result = solve(journal(0.02, width="1 m"), model="reynolds")
    petroff = 2 * math.pi**2 * result["hersey_number"].value * RADIUS / CLEARANCE
    assert result["friction_coefficient"].value == pytest.approx(petroff, rel=1e-3)


def test_the_numbers_of_a_journal_follow_from_its_turns_a_second():
    result = solve(journal(0.6))
    turns = SPEED / (2 * math.pi * RADIUS)
    pressure = result["load"].value / (2 * RADIUS * WIDTH)
    assert result["hersey_number"].value == pytest.approx(VISCOSITY * turns / pressure)
    sommerfeld = VISCOSITY * turns / pressure * (RADIUS / CLEARANCE) ** 2
    assert result["sommerfeld_number"].value == pytest.approx(sommerfeld)


def test_the_hersey_number_of_a_slider_is_viscosity_times_speed_over_load_per_width():
    known = linear_slider(film=10e-6, rise=12e-6, length=0.02, speed=SPEED, viscosity=VISCOSITY)
    result = solve(bearing({"shape": "linear", "length": "20 mm", "film": "10 um", "rise": "12 um"}), 2048)
    assert result["hersey_number"].value == pytest.approx(VISCOSITY * SPEED / known.load, rel=1e-6)


@pytest.mark.parametrize("model", ["reynolds", "reynolds_cavitating"])
def test_a_parallel_washer_has_the_friction_torque_and_power_of_shear_between_discs(model):
    result = solve(washer(), 64, model)
    turns, turn = SPEED / ((INNER + OUTER) / 2), 2 * math.pi / CELLS
    friction = VISCOSITY * turns / FILM * turn * (OUTER**3 - INNER**3) / 3
    torque = VISCOSITY * turns / FILM * turn * (OUTER**4 - INNER**4) / 4
    for name, value in {"friction": friction, "torque": torque, "power_loss": torque * turns}.items():
        one = result[name]
        assert one.value == pytest.approx(value, rel=1e-4)
        assert abs(one.value - value) <= one.uncertainty + 1e-12 * value


def test_a_washer_has_the_totals_of_all_its_cells_with_their_uncertainties():
    result = solve(washer(pocket={"depth": "0.1 mm", "share": 0.5, "extent": "15 mm"}), 48)
    for name in ("load", "friction", "power_loss", "torque", "side_leakage"):
        cell, whole = result.quantities[name], result.quantities[f"bearing_{name}"]
        assert (whole.value, whole.unit) == (pytest.approx(CELLS * cell.value), cell.unit)
        assert whole.uncertainty == pytest.approx(CELLS * cell.uncertainty)
    assert "bearing_friction_coefficient" not in result.quantities


def test_a_washer_carries_the_same_however_many_of_its_cells_are_solved_at_once():
    whole, halves = (solve(washer(pockets=count), 48) for count in (1, 2))
    for name in ("load", "friction", "torque", "power_loss", "side_leakage"):
        alone = whole.quantities[name]
        assert halves.quantities[f"bearing_{name}"].value == pytest.approx(alone.value, rel=2e-3)
        assert f"bearing_{name}" not in whole.quantities  # one piece is the whole bearing


def test_the_totals_of_a_sector_need_its_number_of_pads():
    assert not [name for name in solve(sector(), 32).quantities if name.startswith("bearing_")]
    six = solve(sector(pads=6), 32).quantities
    assert six["bearing_load"].value == pytest.approx(6 * six["load"].value)
    assert six["bearing_inlet_flow"].value == pytest.approx(6 * six["inlet_flow"].value)


@pytest.mark.parametrize("scene", [journal(0.6), sector(), load_scene(SCENES / "pad.toml")], ids=lambda one: one.name)
def test_what_flows_in_flows_out_through_the_outlet_and_the_sides(scene):
    flow = {name: one.value for name, one in solve(scene, 48).quantities.items()}
    assert flow["side_leakage"] == pytest.approx(flow["side_leakage_low"] + flow["side_leakage_high"])
    assert flow["inlet_flow"] == pytest.approx(flow["outlet_flow"] + flow["side_leakage"], rel=1e-6)


def test_the_torque_on_a_pad_lies_between_that_of_its_friction_at_both_radii():
    one = {name: quantity.value for name, quantity in solve(sector(), 48).quantities.items()}
    assert 0.02 * one["friction"] < one["torque"] < 0.04 * one["friction"]
    assert one["power_loss"] == pytest.approx(one["torque"] * SPEED / 0.03)
