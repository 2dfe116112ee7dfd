"""The effects heating and shear thinning of a bearing: models of the ladder, loads, walls that move freely, words."""

import pytest

from roughfilm.ladder import find
from roughfilm.rom.bearing.effects.analysis import analyse_effects
from roughfilm.rom.bearing.kind import composed
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene

CELLS = 24
JOURNAL = {"shape": "journal", "radius": "25 mm", "clearance": "40 um", "eccentricity": 0.6, "width": "30 mm"}
FULL = {"shape": "lobes", "radius": "25 mm", "clearance": "40 um", "width": "30 mm", "lobes": 1, "arc": "300 deg"}
HOT = {
    "viscosity": "0.03 Pa*s",
    "temperature": "40 degC",
    "density": "870 kg/m^3",
    "heat_capacity": "2000 J/(kg*K)",
    "conductivity": "0.13 W/(m*K)",
    "thermoviscosity": {"law": "exponential", "temperature_coefficient": "0.03 1/K"},
}
THIN = {"shear_thinning": {"law": "carreau_yasuda", "index": 0.6, "critical_stress": "2 kPa"}}
NAMES = ("load", "friction", "side_leakage")


def scene_of(geometry, lubricant, **tables):
    motion = {"speed": "5 m/s"}
    entries = {"geometry": geometry, "lubricant": lubricant, "motion": motion, **tables}
    return read_scene({"name": "hot", "kind": "bearing", **entries})


def by_model(name, scene):
    return find("bearing", name).solve(scene, Request(resolution=CELLS))


@pytest.fixture(scope="module")
def given():
    return analyse_effects(scene_of(JOURNAL, {**HOT, **THIN}), CELLS, ())


@pytest.fixture(scope="module")
def loaded():
    unplaced = {name: value for name, value in JOURNAL.items() if name != "eccentricity"}
    return analyse_effects(scene_of(unplaced, HOT, load={"force": "2 kN"}), CELLS, ())


def test_with_all_effects_the_film_is_that_of_the_heat_balance(given):
    model = by_model("heat_balance", given.scene)
    for name in (*NAMES, "effective_temperature"):
        assert given.at_film.full[name].value == pytest.approx(model[name].value, rel=1e-6), name


def test_without_heating_it_is_that_of_the_isothermal_model(given):
    heating = given.at_film.contributions[-1]
    assert [one.name for one in given.at_film.contributions[-2:]] == ["shear thinning", "heating"]
    model = by_model("shear_thinning", given.scene)
    for name in NAMES:
        assert heating.off[name].value == pytest.approx(model[name].value, rel=1e-6), name
    assert "effective_temperature" not in heating.off
    newtonian, plain = given.at_film.contributions[-3].after, by_model("reynolds_cavitating", given.scene)
    for name in NAMES:
        assert newtonian[name].value == pytest.approx(plain[name].value, rel=1e-6), name


def test_heating_and_thinning_lower_load_and_friction(given):
    for one in given.at_film.contributions[-2:]:
        assert one.on["load"].value < -3 * one.on["load"].uncertainty, one.name
        assert one.on["friction"].value < -3 * one.on["friction"].uncertainty, one.name


def test_under_a_load_heating_thins_the_film_to_that_of_the_heat_balance(loaded):
    model = by_model("heat_balance", loaded.scene)
    study = loaded.under_load
    assert study.full["film"].value == pytest.approx(model["film_min"].value, rel=1e-4)
    assert study.full["effective_temperature"].value == pytest.approx(model["effective_temperature"].value, abs=1e-3)
    assert study.contributions[-1].name == "heating"
    assert study.contributions[-1].on["film"].value < 0
    assert loaded.film == study.full["film"].value
    assert loaded.at_film.full["load"].value == pytest.approx(2000, rel=1e-4)


def test_inertia_moves_the_warm_film_by_its_steepness(loaded):
    """The film under the load grows by ΔW/W over the exponent n of W ~ h⁻ⁿ, about 1 to 3."""
    change = loaded.loaded_inertia.amounts["load"].value / 2000
    growth = loaded.thicker.value / loaded.film
    assert 1 < change / growth < 3


def test_a_wall_that_moves_freely_is_that_of_the_heat_balance():
    analysis = analyse_effects(scene_of(FULL, HOT, load={"force": "2 kN"}), CELLS, ())
    model = by_model("heat_balance", analysis.scene)
    for name in ("film_min", "friction", "effective_temperature"):
        assert analysis.under_load.full[name].value == pytest.approx(model[name].value, rel=1e-4), name


def test_the_words_say_what_one_temperature_leaves_out(given, loaded):
    for analysis in (given, loaded):
        (words,) = [one for one in analysis.treated if one.effect == "heating"]
        assert words.model == "heat_balance"
        assert "friction heats the film by about" in words.why
        assert "one temperature for the whole film" in words.why
    assert sum(line.startswith("heating: ") for line in composed(given.scene)) == 1


def test_without_a_law_of_temperature_there_is_no_heating():
    cold = {name: value for name, value in HOT.items() if name != "thermoviscosity"}
    analysis = analyse_effects(scene_of(JOURNAL, cold), 16, ())
    assert {"heating", "shear thinning"} <= {*analysis.left_out}
    assert "effective_temperature" not in analysis.at_film.full


def test_heating_that_a_missing_key_leaves_out_is_no_absent_effect():
    unknown = {name: value for name, value in HOT.items() if name != "heat_capacity"}
    analysis = analyse_effects(scene_of(JOURNAL, unknown), 16, ())
    assert "heating" not in analysis.left_out
    assert analysis.not_switched["heating"].startswith("lubricant.heat_capacity: missing, so that all films have")


@pytest.mark.parametrize(("supply", "beyond"), [("-20 degC", True), ("40 degC", False)])
def test_a_lubricant_outside_of_its_range_is_said(supply, beyond):
    """By hand: the law of ISO VG 46 is valid from -15 °C to 185 °C, and the supply is 5 K below."""
    scene = scene_of(JOURNAL, {"oil": "ISO VG 46", "temperature": supply}, load={"force": "2 kN"})
    analysis = analyse_effects(scene, 16, ())
    for study in (analysis.at_film, analysis.under_load):
        assert any("-20 °C" in one and "valid from -15 °C to 185 °C" in one for one in study.outside) == beyond
        assert bool(study.outside) == beyond
