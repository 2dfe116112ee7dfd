"""Liquids by name: published numbers, their sources, and what a scene takes from them."""

import re

import numpy as np
import pytest
from places import ROOT

import roughfilm as rf
from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.bearing.lubricant import BearingLubricant
from roughfilm.rom.ladder.scene import given_entries, scene_entries
from roughfilm.rom.lubricants.library import density_15, found_name, sources

CELSIUS = 273.15


def scene(**lubricant):
    geometry = {"shape": "linear", "length": "20 mm", "width": "20 mm", "film": "10 um", "rise": "10 um"}
    entries = {"name": "pad", "kind": "bearing", "geometry": geometry, "motion": {"speed": "5 m/s"}}
    return rf.read_scene({**entries, "lubricant": lubricant})


def oil(name, celsius):
    return BearingLubricant.model_validate({"oil": name, "temperature": f"{celsius} degC"})


def test_every_liquid_has_a_source_and_all_numbers():
    assert len(sources()) >= 20
    for name, source in sources().items():
        one = oil(name, 40)
        assert one.oil == name
        assert source
        assert one.lacking == ()
        assert 0.1 < one.liquid.conductivity < 0.7
        assert 1500 < one.heat_capacity.heat(np.array([313.15]), 313.15)[1][0] < 4300


@pytest.mark.parametrize(
    ("celsius", "viscosity", "density", "capacity", "conductivity"),
    [(20, 1.0016e-3, 998.2, 4184, 0.598), (60, 0.4660e-3, 983.2, 4185, 0.651), (99.6, 0.2828e-3, 958.6, 4215, 0.677)],
)
def test_water_by_iapws_95_and_the_formulations_of_viscosity_2008_and_conductivity_2011(
    celsius, viscosity, density, capacity, conductivity
):
    one = oil("water", celsius)
    assert one.viscosity == pytest.approx(viscosity, rel=1e-3)
    assert one.density == pytest.approx(density, rel=1e-4)
    assert one.heat_capacity.heat(np.array([one.temperature]), 300.0)[1][0] == pytest.approx(capacity, rel=1e-3)
    assert one.conductivity == pytest.approx(conductivity, rel=2e-3)


@pytest.mark.parametrize(("celsius", "viscosity"), [(5, 1.5182e-3), (25, 0.8900e-3), (55, 0.5040e-3), (85, 0.3333e-3)])
def test_water_between_its_rows(celsius, viscosity):
    assert oil("water", celsius).viscosity == pytest.approx(viscosity, rel=3e-3)


@pytest.mark.parametrize("grade", [22, 32, 46, 68, 100, 150, 220, 320])
def test_an_iso_grade_has_the_kinematic_viscosity_of_its_name_and_the_density_of_usual_oils(grade):
    one = oil(f"ISO VG {grade}", 40)
    assert one.viscosity / one.density == pytest.approx(grade * 1e-6, rel=1e-9)
    assert 860 < density_15(grade) < 900
    assert one.density == pytest.approx(density_15(grade) - 0.66 * 25, abs=2)


@pytest.mark.parametrize(("grade", "least", "most"), [(20, 5.6, 9.3), (30, 9.3, 12.5), (40, 12.5, 16.3)])
def test_sae_grades_are_near_the_limits_of_sae_j300_at_100_degrees(grade, least, most):
    one = oil(f"SAE {grade}", 100)
    assert 0.92 * least < 1e6 * one.viscosity / one.density < most


def test_the_viscosity_of_sae_30_by_its_formula():
    """η = 0.0141e-6 exp(1360/(T + 95)) lbf s/in², T in °F, at 140 °F = 60 °C."""
    assert oil("SAE 30", 60).viscosity == pytest.approx(6894.757 * 0.0141e-6 * np.exp(1360 / 235), rel=1e-6)


def test_heat_and_expansion_of_a_mineral_oil_by_their_formulas():
    one, d = oil("ISO VG 46", 60), density_15(46) / 999.1
    capacity = one.heat_capacity.heat(np.array([333.15]), 300.0)[1][0]
    assert capacity == pytest.approx(4186.8 * (0.388 + 0.00045 * 140) / np.sqrt(d), rel=1e-3)
    assert one.conductivity == pytest.approx(0.813 * 0.144228 / d * (1 - 0.0003 * (140 - 32)), rel=1e-3)
    assert one.density == pytest.approx(density_15(46) * np.exp(-0.6278 / density_15(46) * 45 * 1.026), rel=1e-4)


@pytest.mark.parametrize("name", ["ISO VG 32", "SAE 40", "water", "propylene glycol 50 %"])
def test_another_temperature_is_near_that_of_the_library(name):
    warm, there = oil(name, 40).at(70 + CELSIUS), oil(name, 70)
    assert warm.viscosity == pytest.approx(there.viscosity, rel=3e-3)
    assert warm.density == pytest.approx(there.density, rel=3e-3)


@pytest.mark.parametrize("name", ["ISO VG 32", "SAE 30", "water"])
def test_a_scene_stores_all_numbers_and_changes_as_a_whole(name):
    first = scene(oil=name, temperature="40 degC")
    stored = scene_entries(first)
    assert {"viscosity", "density", "heat_capacity", "conductivity", "thermoviscosity"} <= stored["lubricant"].keys()
    assert rf.read_scene(stored) == first
    warm = rf.replace(first, "lubricant.temperature", 353.15)
    assert warm == scene(oil=name, temperature="80 degC")
    assert rf.replace(rf.read_scene(stored), "lubricant.temperature", 353.15) == warm
    assert rf.replace(first, "lubricant.oil", "ISO VG 68") == scene(oil="ISO VG 68", temperature="40 degC")


def test_given_numbers_stand_above_those_of_the_library():
    own = {"density": "900 kg/m^3", "thermoviscosity": {"law": "iso_vg", "grade": 32, "viscosity_index": 150}}
    one = scene(oil="ISO VG 32", temperature="40 degC", **own)
    assert one.lubricant.density == 900
    assert one.lubricant.viscosity == pytest.approx(900 * 32e-6, rel=1e-9)
    assert given_entries(one)["lubricant"].keys() >= own.keys()
    assert rf.replace(one, "lubricant.temperature", 353.15).lubricant.density == 900


def test_names_are_found_in_any_spelling():
    assert found_name("vg 32".replace("vg", "iso-vg")) == "ISO VG 32"
    assert found_name("Water") == "water"


@pytest.mark.parametrize(
    ("entries", "words"),
    [
        ({"oil": "ISO VG 33"}, r"oil: got 'ISO VG 33', which is not in the library; did you mean 'ISO VG 32' or"),
        ({"oil": "olive"}, r"oil: got 'olive', .*it has ISO VG 7 to ISO VG 3200, SAE 10 to SAE 60, water, .*; give "),
        ({"oil": "ISO VG 3"}, r"oil: got 'ISO VG 3', which is too thin for a viscosity index; give"),
        ({"oil": "water", "temperature": None}, r"temperature: missing; with oil give"),
        (
            {"oil": "water", "temperature": "140 degC"},
            r"temperature: got 140 °C; it must be from 0 °C to 100 °C",
        ),
        ({"oil": "water", "temperature": "40"}, r"temperature: got '40', a number without a unit"),
        (
            {"oil": "water", "viscosity": "1 mPa*s"},
            r"viscosity: got 0\.001 Pa s, but water has .*; leave viscosity out",
        ),
    ],
)
def test_wrong_input_is_refused_in_one_line(entries, words):
    with pytest.raises(InputError, match=words) as refused:
        scene(**{key: value for key, value in {"temperature": "40 degC", **entries}.items() if value is not None})
    assert "\n" not in str(refused.value)


def test_a_supply_outside_of_the_range_of_the_viscosity_is_marked():
    cold = rf.solve(scene(oil="SAE 30", temperature="5 degC"), model="reynolds_incompressible")
    assert "temperature: 5 °C; the law vogel of the viscosity is valid from 10 °C to 140 °C" in cold.outside
    assert cold.expected_error == {}
    assert oil("SAE 30", 40).beyond(313.15, 313.15) == []


@pytest.mark.parametrize("name", [one for one in sources() if "glycol" not in one and one != "water"])
def test_every_mineral_oil_has_a_range_between_its_pour_and_its_flash_point(name):
    """An oil at 40 °C is in its range; at 240 °C it burns, and at -45 °C it does not flow."""
    one = oil(name, 40)
    assert one.beyond(273.15 + 15, 273.15 + 110) == []
    for temperature in (-45.0, 240.0):
        (sentence,) = one.beyond(temperature + 273.15, temperature + 273.15)
        assert sentence.startswith(f"temperature: {temperature:g} °C; the law ")
    assert one.hot(273.15 + 120) == []
    assert "ISO 7902-3 permits 125 °C at most" in one.hot(273.15 + 130)[0]


def test_the_table_of_the_manual_has_the_numbers_of_the_library():
    page = (ROOT / "docs" / "theory" / "lubricants.md").read_text(encoding="utf-8")
    rows = [line.strip("| ").split(" | ") for line in page.splitlines() if re.match(r"\| `.+` (\| [\d.]+ ){5}", line)]
    assert [row[0].strip("`") for row in rows] == [*sources()]
    for name, *numbers in rows:
        one = oil(name.strip("`"), 40)
        hot = one.viscosity_at(np.array([373.15]))[0][0]
        heat = one.heat_capacity.heat(np.array([313.15]), 300.0)[1][0]
        values = (1e3 * one.viscosity, 1e3 * hot, one.density, heat, one.conductivity)
        assert [float(number) for number in numbers] == pytest.approx(values, rel=6e-3)
