"""Viscosity over temperature: laws against published numbers, their definitions and their derivatives."""

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.lubricants.laws import THERMAL_LAWS
from roughfilm.rom.lubricants.thermal.index import kinematic_viscosity_100, reference_viscosities, viscosity_index
from roughfilm.rom.lubricants.thermal.law import AnchoredLaw, Supplied
from roughfilm.rom.lubricants.thermal.viscosity import RoelandsTemperature
from roughfilm.rom.lubricants.thermal.walther import GRADES, IsoGrade
from roughfilm.rom.lubricants.viscosity import Roelands

CELSIUS = 273.15
SUPPLIED = Supplied(temperature=40 + CELSIUS, viscosity=0.028)
ROWS = [["20 degC", "70 mPa*s"], ["40 degC", "28 mPa*s"], ["70 degC", "9.8 mPa*s"], ["100 degC", "4.6 mPa*s"]]
THIN = [["20 degC", "1.0034 mm^2/s"], ["100 degC", "0.2938 mm^2/s"]]
ENTRIES = {
    "exponential": {"temperature_coefficient": "0.03 1/K"},
    "roelands": {"index": 1.1},
    "vogel": {"points": ROWS[1:]},
    "vogel by constants": {"a": "0.05 mPa*s", "b": "900 K", "c": "170 K"},
    "walther": {"points": [["40 degC", "32 cSt"], ["100 degC", "5.4 cSt"]]},
    "walther of a thin liquid": {"points": THIN},
    "iso_vg": {"grade": 46},
    "tabulated": {"table": ROWS},
}


def law(name, entries=None):
    key = name.split()[0]
    return THERMAL_LAWS[key].model_validate({"law": key, **(entries or ENTRIES[name])})


def viscosity(one, temperature):
    return one.viscosity(temperature, SUPPLIED) if isinstance(one, AnchoredLaw) else one.viscosity(temperature)


@pytest.mark.parametrize("name", ENTRIES)
def test_the_slope_is_that_of_the_viscosity_and_the_shape_that_of_the_temperatures(name):
    temperature, step = np.array([[15.0, 33.0, 41.0], [58.0, 83.0, 104.0]]) + CELSIUS, 1e-3
    value, slope = viscosity(law(name), temperature)
    rise = (viscosity(law(name), temperature + step)[0] - viscosity(law(name), temperature - step)[0]) / (2 * step)
    assert value.shape == slope.shape == temperature.shape
    assert slope == pytest.approx(rise, rel=1e-6)
    assert (slope < 0).all()


@pytest.mark.parametrize("name", ENTRIES)
def test_a_law_leads_back_from_what_is_stored(name):
    one = law(name)
    assert type(one).model_validate(one.model_dump(mode="json", exclude_none=True)) == one


@pytest.mark.parametrize("name", ["exponential", "roelands"])
def test_at_the_temperature_of_the_supply_the_viscosity_is_the_given_one_to_the_last_digit(name):
    assert law(name).viscosity(np.array([SUPPLIED.temperature]), SUPPLIED)[0][0] == SUPPLIED.viscosity


@pytest.mark.parametrize("name", ["exponential", "roelands"])
def test_a_law_may_be_given_at_any_of_its_temperatures(name):
    there = Supplied(temperature=350.0, viscosity=float(law(name).viscosity(np.array([350.0]), SUPPLIED)[0][0]))
    places = np.array([310.0, 330.0, 390.0])
    assert law(name).viscosity(places, there)[0] == pytest.approx(law(name).viscosity(places, SUPPLIED)[0], rel=1e-12)


def test_both_laws_of_roelands_are_one():
    pressure, temperature = np.array([0.0, 1e7, 3e8]), np.array([320.0, 340.0, 380.0])
    thin, index, slope = 0.04, 0.62, 1.15
    supplied = Supplied(temperature=313.0, viscosity=thin)
    warm = RoelandsTemperature.model_validate({"law": "roelands", "index": slope}).viscosity(temperature, supplied)[0]
    found = warm / Roelands.model_validate({"law": "roelands", "index": index}).fluidity(pressure, warm)[0]
    bent = (1 + pressure / 1.96078e8) ** index * ((313 - 138) / (temperature - 138)) ** slope
    assert found == pytest.approx(np.exp((np.log(thin) + 9.67) * bent - 9.67), rel=1e-5)


def test_vogel_goes_through_its_points_and_by_its_constants():
    points = np.array([[313.15, 0.028], [343.15, 0.0098], [373.15, 0.0046]])
    assert law("vogel").viscosity(points[:, 0])[0] == pytest.approx(points[:, 1], rel=1e-12)
    warm = law("vogel by constants").viscosity(np.array([330.0]))[0][0]
    assert warm == pytest.approx(5e-5 * np.exp(900 / (330 - 170)), rel=1e-12)


def test_walther_goes_through_its_points():
    for name in ("walther", "walther of a thin liquid"):
        one = law(name)
        temperature, value = np.array(one.points).T
        assert one.viscosity(temperature)[0] == pytest.approx(value, rel=1e-10)


def test_an_oil_thinner_than_2_cst_by_the_equations_of_astm_d341():
    """Z from ν and ν from Z by the two equations of the standard, which are not exact inverses of each other."""
    one, places = law("walther of a thin liquid"), np.array([20.0, 45.0, 70.0, 100.0]) + CELSIUS

    def z(v):
        return v + 0.7 + np.exp(-1.47 - 1.84 * v - 0.51 * v**2)

    low, high = (np.log10(np.log10(z(v))) for v in (1.0034, 0.2938))
    b = (low - high) / np.log10(373.15 / 293.15)
    rest = 10**10 ** (low - b * np.log10(places / 293.15)) - 0.7
    expected = rest - np.exp(-0.7487 - 3.295 * rest + 0.6119 * rest**2 - 0.3193 * rest**3)
    assert 1e6 * one.viscosity(places)[0] == pytest.approx(expected, rel=5e-3)


@pytest.mark.parametrize(
    ("warm", "hot", "low", "high", "index"),
    [(73.30, 8.86, 119.94, 69.48, 92.43), (22.83, 5.05, None, 28.97, 156.37), (53.47, 7.80, None, 57.31, 110.98)],
)
def test_the_viscosity_index_of_the_examples_of_astm_d2270(warm, hot, low, high, index):
    found = reference_viscosities(hot)
    assert found[1] == pytest.approx(high, rel=1e-3)
    assert low is None or found[0] == pytest.approx(low, rel=1e-3)
    assert viscosity_index(warm, hot) == pytest.approx(index, abs=0.5)
    assert kinematic_viscosity_100(warm, index) == pytest.approx(hot, rel=2e-3)


def test_the_references_of_the_index_are_those_of_table_1_of_astm_d2270():
    rows = [
        (2.0, 7.994, 6.394),
        (3.0, 15.49, 12.15),
        (4.2, 27.75, 21.21),
        (4.7, 35.13, 25.63),
        (6.0, 57.97, 38.19),
        (6.7, 71.29, 45.33),
        (7.5, 88.85, 53.98),
        (8.5, 111.5, 65.32),
        (10.0, 147.7, 82.87),
        (13.0, 231.9, 121.5),
        (17.0, 369.4, 180.2),
        (20.0, 493.2, 229.5),
        (25.0, 736.5, 320.9),
        (30.0, 1023.0, 421.7),
        (50.0, 2618.0, 919.6),
        (60.0, 3676.0, 1222.0),
        (70.0, 4905.0, 1558.0),
    ]
    for hot, low, high in rows:
        assert reference_viscosities(hot) == pytest.approx((low, high), rel=1e-3)


@pytest.mark.parametrize("index", [0, 50, 95, 100, 140, 250])
@pytest.mark.parametrize("warm", [10.0, 32.0, 100.0, 680.0, 3200.0])
def test_the_viscosity_at_100_degrees_has_the_index(warm, index):
    hot = kinematic_viscosity_100(warm, index)
    if hot is not None:
        assert viscosity_index(warm, hot) == pytest.approx(index, abs=0.2)


def test_the_references_of_the_index_join_where_their_quadratics_meet():
    for hot in (3.8, 4.4, 5, 6.4, 7, 7.7, 9, 12, 15, 18, 22, 28, 40, 55, 70):
        assert reference_viscosities(hot) == pytest.approx(reference_viscosities(hot - 1e-9), rel=2e-3)


def test_an_iso_grade_has_its_midpoint_and_its_index():
    for grade, warm in GRADES.items():
        if grade >= 7:
            one = IsoGrade.model_validate({"law": "iso_vg", "grade": grade})
            found = 1e6 * one.viscosity(np.array([40, 100]) + CELSIUS)[0]
            assert found[0] == pytest.approx(warm, rel=1e-9)
            assert viscosity_index(*found) == pytest.approx(95, abs=0.2)


def test_a_table_goes_through_its_rows_and_is_straight_in_the_logarithm_beyond():
    one = law("tabulated")
    temperature, value = np.array(one.table).T
    assert one.viscosity(temperature)[0] == pytest.approx(value, rel=1e-12)
    beyond = np.log(one.viscosity(np.array([400.0, 410.0, 420.0]))[0])
    assert np.diff(beyond, 2) == pytest.approx(0, abs=1e-12)
    assert (np.diff(one.viscosity(np.linspace(280, 420, 300))[0]) < 0).all()


def test_a_table_may_be_a_file(tmp_path):
    path = tmp_path / "oil.csv"
    path.write_text("temperature (degC), viscosity (cP)\n20, 70\n40, 28\n70, 9.8\n100, 4.6\n", encoding="utf-8")
    found = law("tabulated", {"table": str(path)})
    assert np.array(found.table) == pytest.approx(np.array(law("tabulated").table), rel=1e-12)


def test_valid_ranges():
    assert law("exponential").valid(SUPPLIED) == pytest.approx((283.15, 343.15))
    assert law("vogel").valid() == pytest.approx((313.15, 373.15))
    given = {**ENTRIES["vogel by constants"], "valid_from": "10 degC", "valid_to": "120 degC"}
    assert law("vogel", given).valid() == pytest.approx((283.15, 393.15))
    assert law("tabulated").valid() == pytest.approx((293.15, 373.15))
    thin = law("walther of a thin liquid")
    assert 1e6 * thin.viscosity(np.array([thin.valid()[1]]))[0][0] == pytest.approx(0.21, rel=1e-9)
    assert law("vogel", ENTRIES["vogel by constants"]).valid() == pytest.approx((213.15, 523.15))
    assert law("roelands").valid(SUPPLIED) == pytest.approx((213.15, 523.15))


@pytest.mark.parametrize("name", ENTRIES)
def test_each_law_takes_a_given_range(name):
    given = {**ENTRIES[name], "valid_from": "41 degC", "valid_to": "62 degC"}
    one, before = law(name, given), law(name)
    state = (SUPPLIED,) if isinstance(one, AnchoredLaw) else ()
    assert one.valid(*state) == pytest.approx((314.15, 335.15))
    assert one.viscosity(np.array([320.0]), *state) == before.viscosity(np.array([320.0]), *state)
    with pytest.raises(ValueError, match=r"valid_to: got 40 °C; it must be above valid_from, 41 °C"):
        law(name, given | {"valid_to": "40 degC"})


@pytest.mark.parametrize(
    ("name", "entries", "words"),
    [
        (
            "vogel",
            {"a": "1 mPas", "b": "900 degC", "c": "-100 degC"},
            "got '900 degC', a temperature in degrees; it is",
        ),
        (
            "exponential",
            {"temperature_coefficient": "30 1/K"},
            "got 30 1/K; it must be at most 1 1/K in size",
        ),
        ("vogel", {}, "got no constant; give a, b and c, or three points"),
        ("vogel", {"a": "1 mPas", "b": "900 K"}, "got a and b; give a, b and c, or three points"),
        ("vogel", {"c": "170 K", "points": ROWS[1:]}, "points: got them and c"),
        ("vogel", {"points": [ROWS[0], ["40 degC", "50 mPas"], ROWS[3]]}, "must fall more slowly"),
        (
            "vogel",
            {"points": [ROWS[1], ROWS[0], ROWS[2]]},
            "points: got 20 °C, 0.07 Pa s at row 2 after 40 °C, 0.028 Pa s",
        ),
        (
            "vogel",
            {**ENTRIES["vogel by constants"], "valid_to": "-150 degC"},
            "valid_to: got -150 °C; it must",
        ),
        ("walther", {"points": [["40 degC", "32 cSt"], ["100 degC", "0.1 cSt"]]}, "needs at least 0.21 mm"),
        ("walther", {"points": [["40 degC", "32 cSt"], ["100 degC", "40 cSt"]]}, "the viscosity fall"),
        ("iso_vg", {"grade": 30}, "grade: got 30; it must be one of 2, 3, 5"),
        ("iso_vg", {"grade": 5}, "grade: got 5 with the viscosity index 95, which is not defined below 2"),
        ("iso_vg", {"grade": 32, "viscosity_index": 900}, "viscosity_index: got 900; it must be 0 to 500"),
        ("tabulated", {"table": [*ROWS[:1], ["40 degC", "28 cSt"]]}, "got '28 cSt', a kinematic viscosity; write mPa"),
        ("tabulated", {"table": ROWS[:1]}, "at least 2 items"),
        ("tabulated", {"table": [ROWS[1], ROWS[0]]}, "table: got 20 °C, 0.07 Pa s at row 2"),
        ("tabulated", {"table": "nowhere.csv"}, r"nowhere\.csv.*no such file"),
        ("exponential", {"temperature_coefficient": "30 K"}, "wrong dimension"),
    ],
)
def test_wrong_input_is_refused(name, entries, words):
    with pytest.raises(ValueError, match=words):
        THERMAL_LAWS[name].model_validate({"law": name, **entries})


def test_a_table_in_fahrenheit_is_refused(tmp_path):
    path = tmp_path / "viscosity.csv"
    path.write_text("temperature (degF), viscosity (cP)\n68, 70\n104, 28\n", encoding="utf-8")
    with pytest.raises(ValueError, match=r"line 1: got a temperature in 'degF'; convert it to degC or K"):
        law("tabulated", {"table": str(path)})


@pytest.mark.parametrize("name", ["vogel", "vogel by constants", "roelands", "walther"])
def test_temperatures_without_a_viscosity_are_refused(name):
    cold = np.array([350.0, 60.0])
    with pytest.raises(InputError, match=r"thermoviscosity: got -213\.\d °C; the law \w+ has no viscosity up to -"):
        viscosity(law(name), cold)
