"""The lubricant of a bearing over temperature: what laws determine, what is stored, and its heat."""

import numpy as np
import pytest

import roughfilm as rf
from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.bearing.lubricant import BearingLubricant
from roughfilm.rom.ladder.scene import scene_entries

ANCHORED = {
    "viscosity": "30 mPa*s",
    "temperature": "40 degC",
    "thermoviscosity": {"law": "exponential", "temperature_coefficient": "0.03 1/K"},
}
GRADE = {
    "temperature": "50 degC",
    "density": "870 kg/m^3",
    "heat_capacity": "1.95 kJ/(kg*K)",
    "thermoviscosity": {"law": "iso_vg", "grade": 32},
}
TABLE = [["0 degC", "1850 J/(kg*K)"], ["50 degC", "2050 J/(kg*K)"], ["150 degC", "2450 J/(kg*K)"]]


def scene(**lubricant):
    geometry = {"shape": "linear", "length": "20 mm", "width": "20 mm", "film": "10 um", "rise": "10 um"}
    entries = {"name": "pad", "kind": "bearing", "geometry": geometry, "motion": {"speed": "5 m/s"}}
    return rf.read_scene({**entries, "lubricant": lubricant})


def lubricant(**entries):
    return BearingLubricant.model_validate(entries)


@pytest.mark.parametrize("entries", [ANCHORED, GRADE, {**GRADE, "heat_capacity": {"table": TABLE}}])
def test_a_stored_scene_reads_back_the_same(entries):
    first = scene(**entries)
    second = rf.read_scene(scene_entries(first))
    assert second == first
    assert second.lubricant.viscosity == first.lubricant.viscosity
    assert scene_entries(second) == scene_entries(first)


def test_a_law_determines_the_viscosity_with_the_density():
    one = lubricant(**GRADE)
    kinematic = one.thermoviscosity.viscosity(np.array([323.15]))[0][0]
    assert one.viscosity == pytest.approx(870 * kinematic, rel=1e-14)
    warm = one.viscosity_at(np.array([353.15]))[0][0]
    shrunk = 870 * np.exp(-0.6278 / 870 * 30)
    assert warm == pytest.approx(shrunk * one.thermoviscosity.viscosity(np.array([353.15]))[0][0], rel=1e-12)


def test_a_given_viscosity_must_agree_with_the_law():
    agreed = lubricant(**GRADE, viscosity=f"{lubricant(**GRADE).viscosity * 1.0002!r} Pa*s")
    assert agreed == lubricant(**GRADE)
    with pytest.raises(InputError, match=r"viscosity: got 0\.03 Pa s, but the law iso_vg has 0\.0185932 Pa s at 50"):
        scene(**GRADE, viscosity="30 mPa*s")


@pytest.mark.parametrize("entries", [ANCHORED, GRADE])
def test_the_slope_of_the_viscosity(entries):
    one, places, step = lubricant(**entries), np.array([300.0, 331.0, 362.0]), 1e-3
    rise = (one.viscosity_at(places + step)[0] - one.viscosity_at(places - step)[0]) / (2 * step)
    assert one.viscosity_at(places)[1] == pytest.approx(rise, rel=1e-6)


@pytest.mark.parametrize("entries", [ANCHORED, GRADE])
def test_at_another_temperature_the_laws_are_the_same(entries):
    one, places = lubricant(**entries), np.array([310.0, 340.0])
    assert one.at(one.temperature) is one
    warm = one.at(345.0)
    assert warm.temperature == 345.0
    assert warm.viscosity == one.viscosity_at(np.array([345.0]))[0][0]
    assert warm.viscosity_at(places)[0] == pytest.approx(one.viscosity_at(places)[0], rel=1e-12)


@pytest.mark.parametrize("capacity", ["1.95 kJ/(kg*K)", {"table": TABLE}])
def test_the_heat_is_the_integral_of_the_capacity(capacity):
    liquid = lubricant(**{**GRADE, "heat_capacity": capacity}).liquid
    places, step = np.array([260.0, 301.0, 340.0, 399.0, 450.0]), 1e-2
    heat, volumetric = liquid.heat(places)
    rise = (liquid.heat(places + step)[0] - liquid.heat(places - step)[0]) / (2 * step)
    assert volumetric == pytest.approx(rise, rel=1e-7)
    assert liquid.heat(np.array([liquid.temperature]))[0][0] == 0
    assert liquid.temperature_of(heat) == pytest.approx(places, rel=1e-14)


def test_the_heat_of_a_table_that_is_a_line():
    liquid = lubricant(**{**GRADE, "heat_capacity": {"table": TABLE}}).liquid
    assert liquid.heat(np.array([363.15]))[0][0] == pytest.approx(870 * (2050 * 40 + 4 * 40**2 / 2), rel=1e-12)


def test_heat_that_changes_strongly_is_inverted_too():
    steep = [["0 degC", "1000 J/(kg*K)"], ["40 degC", "1000 J/(kg*K)"], ["41 degC", "60 kJ/(kg*K)"]]
    liquid = lubricant(**{**GRADE, "heat_capacity": {"table": steep}}).liquid
    places = np.linspace(250.0, 400.0, 31)
    assert liquid.temperature_of(liquid.heat(places)[0]) == pytest.approx(places, rel=1e-13)


def test_without_a_law_there_is_no_temperature():
    one = lubricant(viscosity="30 mPa*s")
    assert one.lacking == ("thermoviscosity", "temperature", "density", "heat_capacity")
    with pytest.raises(InputError, match=r"^lubricant.thermoviscosity: missing; add it and lubricant.temperature, "):
        _ = one.liquid
    with pytest.raises(InputError, match=r"^lubricant.thermoviscosity: missing; add a law"):
        one.at(330.0)
    with pytest.raises(InputError, match=r"^lubricant.density: missing; add it for the density"):
        lubricant(**ANCHORED).density_at(np.array([320.0]))
    with pytest.raises(InputError, match=r"^lubricant.density: missing; add it for models"):
        lubricant(**ANCHORED).heat_at(np.array([320.0]))
    assert np.isnan(lubricant(**GRADE).liquid.conductivity)


def test_temperatures_outside_of_a_range_have_a_warning():
    one = lubricant(**ANCHORED)
    assert one.beyond(300.0, 340.0) == []
    assert one.beyond(300.0, 353.15) == [
        "temperature: 26.85 °C to 80 °C; the law exponential of the viscosity is valid from 10 °C to 70 °C"
    ]
    assert lubricant(viscosity="30 mPa*s").beyond(0.0, 1e4) == []


@pytest.mark.parametrize(("lowest", "highest"), [(300.0, 753.15), (170.0, 300.0)])
def test_temperatures_far_outside_of_a_range_are_no_answer(lowest, highest):
    (warning,) = lubricant(**ANCHORED).beyond(lowest, highest)
    assert "valid from 10 °C to 70 °C: this is no answer, as it is more than 100 K beyond; change the scene" in warning
    assert "no answer" not in lubricant(**ANCHORED).beyond(183.2, 443.1)[0]


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"temperature": None}, r"lubricant\.temperature: missing; with thermoviscosity give"),
        ({"density": None}, r"lubricant\.density: missing; a law of the kinematic viscosity"),
        ({"thermoviscosity": ANCHORED["thermoviscosity"]}, r"viscosity: missing; add it, as the law exponential"),
        ({"thermoviscosity": {"law": "iso"}}, r"thermoviscosity\.law: got 'iso'; it must be one of 'exponential', "),
        ({"thermoviscosity": {"law": "iso_vg", "grad": 32}}, r"thermoviscosity\.grad: .*did you mean 'grade'"),
        ({"heat_capacity": {"tabel": TABLE}}, r"heat_capacity\.tabel: unknown key; did you mean 'table'"),
        ({"heat_capacity": {}}, r"heat_capacity: got neither of constant and table; give"),
        ({"heat_capacity": "2 kW"}, r"heat_capacity: got '2 kW', which has the wrong dimension"),
        ({"heat_capacity": {"table": TABLE[::-1]}}, r"heat_capacity\.table: got 50 °C at row 2 after 150 °C"),
        ({"temperature": "-250 degC"}, r"lubricant\.temperature: got -250 °C; the law iso_vg has no viscosity up to"),
        ({"temperature": "50"}, r"lubricant\.temperature: got '50', a number without a unit"),
    ],
)
def test_wrong_input_is_refused_in_one_line(changes, words):
    entries = {key: value for key, value in {**GRADE, **changes}.items() if value is not None}
    with pytest.raises(InputError, match=words) as refused:
        scene(**entries)
    assert "\n" not in str(refused.value)


def test_roelands_needs_a_liquid_above_its_limit():
    law = {"law": "roelands", "index": 1.1}
    with pytest.raises(InputError, match=r"thermoviscosity: got roelands for 1e-05 Pa s; that law needs more than"):
        scene(viscosity="1e-5 Pa*s", temperature="40 degC", thermoviscosity=law)
    with pytest.raises(InputError, match=r"lubricant\.temperature: got -140 °C; the law roelands has no viscosity up"):
        scene(viscosity="1 Pa*s", temperature="-140 degC", thermoviscosity=law)


def test_a_viscosity_given_as_a_temperature_has_a_remedy():
    with pytest.raises(InputError, match=r"\(a temperature\); write the viscosity at that temperature, in mPa\*s"):
        scene(viscosity="40 degC")
