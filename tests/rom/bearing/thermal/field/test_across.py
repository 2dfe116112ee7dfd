"""Films whose temperature varies from wall to wall, with the walls of the table [heat] of a scene."""

import math

import pytest

import roughfilm as rf
from roughfilm.contact.foundation.errors import ConvergenceError
from roughfilm.ladder import find
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene

ACROSS, ADIABATIC = find("bearing", "across"), find("bearing", "adiabatic")
LUBRICANT = {
    "viscosity": "0.03 Pa*s",
    "density": "860 kg/m^3",
    "temperature": "40 degC",
    "heat_capacity": "2000 J/(kg*K)",
    "conductivity": "0.14 W/(m*K)",
    "thermoviscosity": {"law": "exponential", "temperature_coefficient": "0.035 1/K"},
}
WEDGE = {"shape": "linear", "length": "0.1 m", "width": "0.1 m", "film": "40 um", "rise": "40 um"}
JOURNAL = {"shape": "journal", "radius": "50 mm", "width": "80 mm", "clearance": "60 um", "eccentricity": 0.7}
BORE = {"shape": "lobes", "radius": "50 mm", "width": "80 mm", "clearance": "60 um", "eccentricity": [0.2, 0.1]}
GROOVE = {"kind": "groove", "angle": "90 deg", "length": "8 mm", "extent": "40 mm", "pressure": "0.2 MPa"}
LOBES = {"shape": "lobes", "lobes": 3, "arc": "100 deg", "radius": "50 mm", "width": "80 mm", "clearance": "60 um"}
STEEL = {"conductivity": "45 W/(m*K)"}
CONDUCTING = {"kind": "conducting", "thickness": "20 mm", **STEEL, "heat_transfer": "200 W/(m^2*K)"}
WALL = {"kind": "temperature", "temperature": "40 degC"}
HALF_SPACE = {"kind": "half_space", **STEEL, "density": "7800 kg/m^3", "heat_capacity": "460 J/(kg*K)"}


def scene(geometry, lubricant=LUBRICANT, **more):
    lubricant = {key: one for key, one in lubricant.items() if one is not None}
    entries = {"name": "hot", "kind": "bearing", "geometry": geometry, "lubricant": lubricant}
    return read_scene({**entries, "motion": {"speed": "12 m/s"}, **more})


def solved(bearing, cells=20, model=ACROSS):
    return model.solve(bearing, Request(resolution=cells))


def value(result, name):
    return result.quantities[name].value


def balanced(result):
    """The heat that is generated less what takes it away, over the former."""
    taken = sum(value(result, f"heat_to_{name}") for name in ("lubricant", "fixed_wall", "sliding_wall"))
    return 1 - taken / value(result, "heat_generated")


@pytest.fixture(scope="module")
def insulated():
    return solved(scene(WEDGE))


def test_walls_without_heat_agree_with_the_mean_temperature_at_small_heating(insulated):
    """With little heating the viscosity is even across the film, and both models have the same energy."""
    thin = {**LUBRICANT, "viscosity": "0.0005 Pa*s"}
    across, mean = (solved(scene(WEDGE, lubricant=thin), model=model) for model in (ACROSS, ADIABATIC))
    for name in ("load", "friction", "heat_generated"):
        assert value(across, name) == pytest.approx(value(mean, name), rel=5e-3), name
    rise = value(mean, "outlet_temperature") - 40
    assert value(across, "outlet_temperature") - 40 == pytest.approx(rise, rel=1e-2)
    assert value(insulated, "temperature_max") > value(insulated, "temperature_mean") > 40


def test_heat_leaves_by_lubricant_and_walls(insulated):
    walls = solved(scene(WEDGE, heat={"fixed_wall": CONDUCTING, "sliding_wall": HALF_SPACE}))
    for result in (insulated, walls):
        assert abs(balanced(result)) < 1e-8
        assert result.numerics.details["energy_imbalance"] < 1e-8
    assert value(insulated, "heat_to_sliding_wall") == pytest.approx(0, abs=1e-6)
    assert value(walls, "heat_to_sliding_wall") > value(walls, "heat_to_fixed_wall") > 0
    assert value(walls, "temperature_max") < value(insulated, "temperature_max")
    assert value(walls, "load") > value(insulated, "load")


def test_a_wall_has_its_given_temperature():
    walls = {"kind": "temperature", "temperature": "55 degC"}
    result = solved(scene(WEDGE, heat={"fixed_wall": walls, "sliding_wall": walls}))
    for name in ("fixed_wall_temperature", "sliding_wall_temperature"):
        assert result.fields[name].unit == "degC"
        assert result.fields[name].values == pytest.approx(55, abs=1e-6)


def test_lubricant_at_rest_in_a_recess_has_the_temperature_of_its_supply():
    """No lubricant flows inside of the recess of a pad at rest; what leaves is heated by its pressure, p/(ρ c)."""
    recess = {"kind": "pocket", "x": "25 mm", "length": "20 mm", "extent": "20 mm", "depth": "1 mm"}
    pad = {"shape": "parallel", "length": "50 mm", "width": "40 mm", "film": "20 um"}
    still = {"motion": {"speed": "0 m/s"}, "supply": [{**recess, "pressure": "3 MPa", "temperature": "35 degC"}]}
    result = solved(scene(pad, **still), 48)
    temperature = result.fields["temperature"].values
    assert temperature.min() == pytest.approx(35, abs=1e-3)
    assert temperature[24, 24] == pytest.approx(35, abs=1e-3)
    density, capacity = (float(LUBRICANT[name].split()[0]) for name in ("density", "heat_capacity"))
    assert value(result, "outlet_temperature") == pytest.approx(35 + 3e6 / (density * capacity), abs=1e-3)


def test_the_place_of_the_highest_temperature_lies_in_the_film():
    """A hot wall has its temperature everywhere, so that the place may be anywhere, but not beyond the film."""
    hot = {"kind": "temperature", "temperature": "90 degC"}
    result = solved(scene(WEDGE, heat={"sliding_wall": hot}), 32)
    for name, positions in (("temperature_max_x", "x"), ("temperature_max_y", "y")):
        place, ends = result.quantities[name], result.fields[positions].values
        assert place.uncertainty <= max(place.value - ends.min(), ends.max() - place.value)


def test_a_turning_shaft_takes_no_heat_in_sum():
    result = solved(scene(JOURNAL, heat={"fixed_wall": CONDUCTING, "sliding_wall": "turning"}))
    assert value(result, "heat_to_sliding_wall") == pytest.approx(0, abs=1e-6 * value(result, "heat_generated"))
    assert value(result, "inlet_temperature") < value(result, "shaft_temperature") < value(result, "temperature_max")
    assert result.fields["sliding_wall_temperature"].values == pytest.approx(value(result, "shaft_temperature"))
    assert abs(balanced(result)) < 1e-8


def test_lobes_under_a_load_turn_around_a_shaft():
    bearing = scene(LOBES, load={"force": "5 kN"}, heat={"sliding_wall": "turning"})
    result = solved(bearing, 24)
    assert value(result, "load") == pytest.approx(5e3, rel=1e-6)
    assert 40 < value(result, "shaft_temperature") < value(result, "temperature_max")


def test_a_constant_viscosity_gives_the_isothermal_pressure():
    constant = {**LUBRICANT, "thermoviscosity": {"law": "exponential", "temperature_coefficient": "0 1/K"}}
    bearing = scene(WEDGE, lubricant=constant)
    hot, plain = solved(bearing), solved(bearing, model=find("bearing", "reynolds_cavitating"))
    assert value(hot, "load") == pytest.approx(value(plain, "load"), rel=1e-9)
    assert value(hot, "friction") == pytest.approx(value(plain, "friction"), rel=1e-9)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (
            {"lubricant": {key: one for key, one in LUBRICANT.items() if key != "conductivity"}},
            "lubricant.conductivity",
        ),
        ({"geometry": BORE, "supply": [GROOVE], "heat": {"carried_over": 0.8}}, "carried_over is 0.8 behind supplies"),
    ],
)
def test_the_model_says_what_it_needs(change, words):
    fits = ACROSS.applies(scene(**{"geometry": WEDGE, **change}))
    assert not fits.applies
    assert words in fits.reason


def test_gaps_may_carry_a_part_of_the_hot_lubricant_over():
    assert ACROSS.applies(scene(LOBES | {"eccentricity": [0.2, 0.1]}, heat={"carried_over": 0.5})).applies


@pytest.mark.parametrize("geometry", [WEDGE, JOURNAL], ids=lambda geometry: geometry["shape"])
def test_lubricant_that_stays_between_insulated_walls_that_approach_has_no_steady_temperature(geometry):
    """Where sliding displaces less than the approach, a place lies inside the film from which lubricant only leaves."""
    motion = {"speed": "1 cm/s", "approach": "1 mm/s"}
    with pytest.raises(ConvergenceError, match=r"as walls that approach displace .* at which it stays; let them slide"):
        solved(scene(geometry, motion=motion), cells=12)
    cooled = solved(scene(geometry, motion=motion, heat={"fixed_wall": WALL}), cells=12)
    assert 40 < value(cooled, "temperature_max") < 60


SLOW = {"shape": "journal", "radius": "25 mm", "width": "25 mm", "clearance": "40 um"}
AIR = {"heat_transfer": "20 W/(m^2*K)", "area": "0.1 m^2", "surroundings": "20 degC"}


def test_a_concentric_shaft_gives_its_friction_to_the_surroundings_of_the_bearing():
    """Petroff's friction P leaves by the fixed wall, at T_a + P/(α A); over the film it is 1/2, in the mean 1/3 warmer.

    Lubricant that stays is heated evenly, and conducts with the parabola of a wall that takes no heat.
    """
    even = {**LUBRICANT, "thermoviscosity": {"law": "exponential", "temperature_coefficient": "0 1/K"}}
    concentric = {**BORE, "eccentricity": [0.0, 0.0]}
    still = {"sides": {"low": "0.1 MPa", "high": "0.1 MPa"}}
    result = solved(scene(concentric, even, heat=AIR, boundary=still, motion={"speed": "1 m/s"}))
    gap, surface = 60e-6, 2 * math.pi * 0.05 * 0.08
    power = 0.03 * surface / gap
    wall, across = 20 + power / 2.0, power / surface * gap / 0.14
    assert value(result, "heat_to_fixed_wall") == pytest.approx(power, rel=1e-6)
    assert result.fields["fixed_wall_temperature"].values == pytest.approx(wall, rel=1e-6)
    assert value(result, "temperature_mean") == pytest.approx(wall + across / 3, rel=1e-6)
    assert value(result, "temperature_max") == pytest.approx(wall + across / 2, rel=1e-6)


@pytest.mark.parametrize("given", [True, False], ids=["given", "estimated"])
def test_one_temperature_states_its_error_against_walls_that_take_the_same_heat(given):
    """At 10 rpm the solids take the heat: the error of one temperature is a few per cent, not above 100 %.

    It contains the difference to ``across`` with walls of that heat transfer, without being five times too wide, or
    more than the uncertainty of both.
    """
    entries = {
        "name": "slow",
        "kind": "bearing",
        "geometry": SLOW,
        "lubricant": {"oil": "ISO VG 46", "temperature": "60 degC"},
        "motion": {"speed": "10 rpm"},
        "load": {"force": "1 kN"},
    }
    bearing = read_scene(entries | ({"heat": AIR} if given else {}))
    found = rf.solve(bearing, model="heat_balance", resolution=64)
    if not given:
        area, nominal = 2 * math.pi * 25e-3 * 25e-3, 50e-3 * 25e-3
        transfer = value(found, "heat_to_surroundings") / (value(found, "effective_temperature") - 60) / area
        assert transfer == pytest.approx(300 * nominal / area, rel=0.15)
        wall = {"kind": "conducting", "heat_transfer": f"{transfer!r} W/(m^2*K)"}
        bearing = read_scene(entries | {"heat": {"fixed_wall": wall}})
    true = solved(bearing, cells=64)
    for name in ("film_min", "friction"):
        key = name if name == "film_min" else "friction_per_width"
        error = abs(value(found, name) / value(true, name) - 1)
        own = sum(one[name].uncertainty / one[name].value for one in (found, true))
        assert error <= found.expected_error[key] <= 5 * error + own, name
