"""The errors of models in temperatures and powers: asked for by name, stated by every command, and large enough."""

import pytest

import roughfilm as rf
from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.advice.advise import wanted
from roughfilm.rom.advice.expected import error_lines
from roughfilm.rom.bearing.totals.reported import REPORTED
from roughfilm.rom.ladder.kind import kind_of
from roughfilm.rom.ladder.scene import read_scene

SUPPLIED = 40.0
OIL = {
    "viscosity": "90 mPa*s",
    "density": "870 kg/m^3",
    "heat_capacity": "2 kJ/(kg*K)",
    "conductivity": "0.13 W/(m*K)",
    "temperature": f"{SUPPLIED} degC",
    "thermoviscosity": {
        "law": "exponential",
        "temperature_coefficient": "0.05 1/K",
        "valid_from": "0 degC",
        "valid_to": "200 degC",
    },
}


@pytest.fixture(scope="module")
def wedge():
    """A wedge between insulated walls at a Péclet number of 84; a finite-difference program gives 31.09 kN/m."""
    geometry = {"shape": "linear", "length": "50 mm", "film": "102 um", "rise": "48 um"}
    entries = {"name": "wedge", "kind": "bearing", "geometry": geometry, "lubricant": OIL}
    return read_scene({**entries, "motion": {"speed": "30 m/s"}})


@pytest.fixture(scope="module")
def results(wedge):
    return {model: rf.solve(wedge, model=model) for model in ("heat_balance", "adiabatic", "across")}


@pytest.mark.parametrize(("quantity", "title"), REPORTED.items())
def test_every_quantity_that_a_result_may_show_can_be_named(wedge, quantity, title):
    per_width = f"{quantity}_per_width"
    assert wanted(wedge, title) == wanted(wedge, quantity) == (per_width if per_width in REPORTED else quantity)


def test_a_name_that_no_quantity_has_is_refused(wedge):
    with pytest.raises(InputError, match=r"'highest temperature'.*another one that a result shows"):
        wanted(wedge, "heat of the day")


@pytest.mark.parametrize("quantity", ["load_per_width", "temperature_max", "temperature_mean"])
def test_a_given_model_states_an_error_that_contains_the_difference_to_the_complete_one(results, quantity):
    true = results["across"]
    size = abs(true[quantity].value - (SUPPLIED if "temperature" in quantity else 0.0))
    assert kind_of(true).scale_of(true, quantity) == pytest.approx(size)
    for model in ("heat_balance", "adiabatic"):
        if quantity in results[model].quantities:
            error = abs(results[model][quantity].value - true[quantity].value) / size
            assert error <= results[model].expected_error[quantity] < 1.5 * error + 0.02


def test_the_load_of_the_independent_program_is_within_the_errors(results):
    for model, result in results.items():
        assert abs(result["load_per_width"].value - 31.09e3) <= 31.1e3 * result.expected_error["load_per_width"], model


def test_a_large_error_of_a_given_model_is_a_warning(results):
    for model in ("heat_balance", "adiabatic"):
        assert [one for one in results[model].warnings if one.startswith(f"{model} has a large error here: load above")]


def test_the_power_loss_of_a_wide_film_is_that_per_width(wedge, results):
    assert wanted(wedge, "power loss") == "power_loss_per_width"
    found = rf.solve(wedge, quantity="power loss")
    true = results["across"]["power_loss_per_width"].value
    size = found.expected_error["power_loss_per_width"] * true
    assert abs(found["power_loss_per_width"].value - true) <= size + 1e-3 * true


def test_the_advice_on_a_given_quantity_states_the_same_error(wedge, results):
    advice = rf.advise(wedge, quantity="highest temperature")
    stated = {one.model: one.error for one in advice.considered}
    assert advice.chosen.model == "across"
    assert results["adiabatic"].expected_error["temperature_max"] == pytest.approx(stated["adiabatic"], rel=0.05)


def test_the_power_loss_of_a_heated_film_has_the_error_of_its_friction(results):
    for result in results.values():
        lines = error_lines(kind_of(result), result)
        assert sum("friction and power loss" in line for line in lines) == 1
        assert kind_of(result).alike == {"friction_per_width": "power loss"}
