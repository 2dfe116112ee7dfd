"""Stiffness and damping at the temperature at which the heat of the film is balanced."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.special import lambertw

from roughfilm.ladder import find
from roughfilm.rom.bearing.dynamics.balance import balanced_equilibrium, point_of
from roughfilm.rom.bearing.dynamics.store import known_points, point_inputs, save_points, write_csv
from roughfilm.rom.bearing.dynamics.sweep import dynamics
from roughfilm.rom.bearing.dynamics.wall_errors import wall_errors
from roughfilm.rom.bearing.march.rough_walls import walls_of
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene
from roughfilm.words.heat import heat_warnings

COLD, DENSITY, CAPACITY, ETA, BETA = 40.0, 870.0, 2000.0, 0.03, 0.035
OIL = {
    "viscosity": f"{ETA} Pa*s",
    "density": f"{DENSITY} kg/m^3",
    "heat_capacity": f"{CAPACITY} J/(kg*K)",
    "temperature": f"{COLD} degC",
    "thermoviscosity": {"law": "exponential", "temperature_coefficient": f"{BETA} 1/K"},
}
FLAT = {"thermoviscosity": {"law": "exponential", "temperature_coefficient": "0 1/K"}}
BORE = {"shape": "lobes", "radius": "25 mm", "clearance": "30 um", "width": "40 mm"}
GROOVED = BORE | {"lobes": 2, "arc": "150 deg"}
WIDE = {name: value for name, value in GROOVED.items() if name != "width"}
TILTING = BORE | {"lobes": 4, "arc": "70 deg", "first": "-135 deg", "preload": 0.3, "pivot": 0.55, "offset": 0.55}
PAD = {"shape": "pivoted", "length": "50 mm", "width": "50 mm", "pivot": [0.58, 0.5]}
GROOVE = {"kind": "groove", "angle": "90 deg", "length": "8 mm", "extent": "24 mm", "pressure": "0.2 MPa"}
SPEED, PRESSURE, CELLS = 8.0, 1e6, 32


def scene_of(geometry=GROOVED, oil=(), **tables):
    lubricant, tables = OIL | dict(oil), {"load": {"pressure": "1 MPa"}} | tables
    return read_scene(
        {"name": "hot", "kind": "bearing", "geometry": geometry, "lubricant": lubricant, "motion": {"speed": "8 m/s"}}
        | tables
    )


def swept(scene, *speeds, pressure=PRESSURE, cells=CELLS):
    (curve,) = dynamics(scene, speeds or [SPEED], [pressure], resolution=cells)
    return curve


@pytest.fixture(scope="module")
def grooved():
    return swept(scene_of(), 2.0, SPEED, 20.0)


@pytest.mark.parametrize("geometry", [WIDE, TILTING, PAD], ids=["wide", "tilting pads", "pad"])
def test_the_film_is_that_of_heat_balance_and_its_forces_are_those_at_its_viscosity(geometry):
    """The model finds place and temperature on the same grid; an isothermal sweep takes the viscosity there."""
    (point,) = swept(scene_of(geometry)).points
    result = find("bearing", "heat_balance").solve(scene_of(geometry), Request(resolution=CELLS))
    assert point.numbers["temperature"] == pytest.approx(result["effective_temperature"].value, abs=1e-4)
    assert point.numbers["outlet_temperature"] == pytest.approx(result["outlet_temperature"].value, abs=2e-4)
    assert point.numbers["film_min"] == pytest.approx(result["film_min"].value, rel=1e-5)
    assert point.numbers["temperature"] > COLD + 3
    viscosity = ETA * math.exp(-BETA * (point.numbers["temperature"] - COLD))
    (same,) = swept(scene_of(geometry, oil={"viscosity": f"{viscosity!r} Pa*s"}).isothermal()).points
    for matrix in ("stiffness", "damping"):
        own, other = getattr(point, matrix), getattr(same, matrix)
        assert own == pytest.approx(other, rel=1e-5, abs=1e-6 * np.abs(other).max())
    assert point.numbers.get("whirl_ratio", 0.0) == pytest.approx(same.numbers.get("whirl_ratio", 0.0), rel=1e-5)


def test_a_viscosity_that_does_not_change_leaves_every_number_to_the_last_bit():
    scene = scene_of(oil=FLAT)
    hot, cold = swept(scene, 2.0, SPEED), swept(scene.isothermal(), 2.0, SPEED)
    for one, other in zip(hot.points, cold.points, strict=True):
        assert one.numbers["temperature"] > COLD + 1
        assert {name: one.numbers[name] for name in other.numbers} == other.numbers
        assert {name: one.uncertainty[name] for name in other.uncertainty} == other.uncertainty
        assert "temperature" not in other.numbers


def test_the_heat_of_friction_and_of_the_supply_leaves_through_the_sides():
    """All that the groove supplies leaves there: P + p Q = ρ c Q (T_out - T₀)."""
    (point,) = swept(scene_of(BORE, supply=[GROOVE])).points
    flow = point.numbers["side_leakage"]
    rise = (point.numbers["power_loss"] + 0.2e6 * flow) / (DENSITY * CAPACITY * flow)
    assert point.numbers["outlet_temperature"] == pytest.approx(COLD + rise, abs=1e-5 * rise)


def test_heat_moves_the_shaft_out_and_grows_with_the_speed(grooved):
    cold = swept(scene_of().isothermal(), 2.0, SPEED, 20.0)
    warmth = [point.numbers["temperature"] for point in grooved.points]
    assert np.all(np.diff(warmth) > 0)
    for one, other in zip(grooved.points, cold.points, strict=True):
        assert one.numbers["eccentricity"] > other.numbers["eccentricity"]
        assert one.numbers["power_loss"] < other.numbers["power_loss"]


def test_uncertainties_cover_the_numbers_on_a_finer_grid(grooved):
    point = grooved.points[1]
    (fine,) = swept(scene_of(), cells=4 * CELLS).points
    for name, value in fine.numbers.items():
        assert abs(value - point.numbers[name]) <= point.uncertainty[name] + 1e-12 * abs(value), name


def test_asperities_heat_the_film_and_factors_make_its_temperature_uncertain(tips):
    geometry = GROOVED | {"radius": "10 mm", "width": "10 mm", "clearance": "10 um"}
    tables = {"lubricant": OIL | {"viscosity": "0.1 Pa*s"}, "load": {"pressure": "5 MPa"}, "motion": {"speed": "2 m/s"}}
    scene = tips.scene(geometry, heat={"heat_transfer": "100 W/(m^2*K)", "area": "0.01 m^2"}, **tables)
    hot, cold = (swept(one, 0.2, pressure=5e6).points[0] for one in (scene, scene.isothermal()))
    assert hot.numbers["contact_share"] > cold.numbers["contact_share"] > 0
    assert hot.numbers["temperature"] > COLD + 1
    assert 0 < hot.uncertainty["temperature"] < hot.numbers["temperature"] - COLD


def test_the_errors_by_flow_factors_cover_a_film_whose_pressures_and_friction_are_larger():
    """The other film has 2 % more viscosity at all temperatures, and the temperature that follows.

    The damping across the axes hardly depends on the viscosity here, and more on the grid.
    """
    ridges = {"kind": "sinusoid", "amplitude": "2 um", "wavelength": "200 um"}
    scene, thick = (scene_of(roughness=ridges, oil={"viscosity": f"{more * ETA} Pa*s"}) for more in (1.0, 1.02))
    walls = replace(walls_of(scene), of_factors=lambda _film: 0.02)
    one, other = (balanced_equilibrium(each, walls, (CELLS, CELLS // 2)) for each in (scene, thick))
    error = wall_errors(scene, walls, one, 1.0)
    own, changed = (point_of(each, 1.0).numbers for each in (one, other))
    assert changed["temperature"] > own["temperature"] + 0.1
    for name in own.keys() - {f"{at}damping_{entry}" for at in ("", "whirl_") for entry in ("xy", "yx")}:
        assert abs(changed[name] - own[name]) <= error(name), name


def test_an_estimated_heat_transfer_makes_every_number_uncertain_by_a_factor_of_two_and_is_said_once():
    """Petroff's friction goes to the surroundings by 300 W/(m² K) over diameter times width: a Lambert function."""
    full = OIL | {"cavitation_pressure": "-10 MPa"}
    speed, load = 1.0, 1e4
    scene = scene_of(BORE, oil=full)
    curve = swept(scene, speed, 2 * speed, pressure=load)
    point = curve.points[0]

    def temperature(transfer):
        rise = 2 * math.pi * ETA * speed**2 * 25e-3 * 40e-3 / 30e-6 / (transfer * 50e-3 * 40e-3)
        return COLD + lambertw(BETA * rise).real / BETA

    colder, own, hotter = (temperature(part * 300.0) for part in (2.0, 1.0, 0.5))
    assert point.estimated_heat_transfer == pytest.approx(300 * 50e-3 * 40e-3, rel=0.05)
    assert point.numbers["temperature"] == pytest.approx(own, rel=0.01)
    assert point.uncertainty["temperature"] == pytest.approx(hotter - own, rel=0.1)
    thicker = math.exp(-BETA * (colder - own)) - 1
    assert point.uncertainty["damping_xx"] > abs(thicker) * point.numbers["damping_xx"]
    (warning,) = heat_warnings(scene, curve.points, "speeds")
    assert warning.startswith("temperature: at 2 of 2 speeds it depends most on heat.heat_transfer and heat.area, ")
    given = scene_of(BORE, oil=full, heat={"heat_transfer": "300 W/(m^2*K)", "area": "20 cm^2"})
    (known,) = swept(given, speed, pressure=load).points
    assert known.estimated_heat_transfer == 0
    assert known.uncertainty["temperature"] < 0.01 * (own - COLD)


def test_files_keep_temperatures(grooved, tmp_path):
    scene = scene_of()
    inputs = point_inputs(scene, CELLS, 1.0)
    save_points(tmp_path / "dynamics.h5", inputs, grooved.points)
    assert known_points(tmp_path / "dynamics.h5", inputs) == grooved.points
    assert point_inputs(scene.isothermal(), CELLS, 1.0).digest != inputs.digest
    write_csv(tmp_path / "dynamics.csv", scene, [grooved])
    assert "temperature (degC), outlet_temperature (degC)" in (tmp_path / "dynamics.csv").read_text().splitlines()[0]
    assert grooved.points[0]["temperature"].unit == "degC"
