"""A pocket says where its film would rupture, and no advice is given on it as if it did not."""

import pytest
from places import SCENES

from roughfilm import rom
from roughfilm.contact.foundation.errors import InputError
from roughfilm.ladder import find, models
from roughfilm.rom.advice.advise import Verdict, advise, shortfall
from roughfilm.rom.advice.expected import expected_errors
from roughfilm.rom.ladder.kind import kind_of_name
from roughfilm.rom.ladder.model import Effect, best_for, ladder
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import load_scene, read_scene, scene_entries

MODELS = tuple(model for model in ladder(rom, kind="pocket") if Effect.CAVITATION not in model.keeps)


def ruptured(speed="50 m/s", lubricant=(), **tables):
    """A film whose lowest pressure is 641 kPa below ambient by an independent solution."""
    return read_scene(
        {
            "name": "ruptured",
            "kind": "pocket",
            "geometry": {"length": "2 mm", "film": "20 um", "width": "0.8 mm", "depth": "15 um"},
            "lubricant": {"viscosity": "0.02 Pa*s", "density": "870 kg/m^3", **dict(lubricant)},
            "motion": {"speed": speed},
            **tables,
        }
    )


def warnings_of(model, scene):
    return [warning for warning in model.solve(scene).warnings if warning.startswith("pressure: falls")]


@pytest.mark.parametrize("model", MODELS, ids=lambda model: model.name)
def test_every_model_without_cavitation_states_the_lowest_pressure_below_that_of_cavitation(model):
    (warning,) = warnings_of(model, ruptured())
    lowest = float(warning.split()[3])
    assert lowest == pytest.approx(-641, rel=0.02)
    assert "cavitation pressure of -101.3 kPa (ambient pressure 101.3 kPa)" in warning
    assert not warnings_of(model, ruptured("5 m/s"))


@pytest.mark.parametrize("model", MODELS, ids=lambda model: model.name)
def test_the_ambient_pressure_and_the_liquid_decide(model):
    assert not warnings_of(model, ruptured(boundary={"ambient_pressure": "0.7 MPa"}))
    slow = ruptured("5 m/s", [("cavitation_pressure", "-20 kPa")])
    assert "cavitation pressure of -20 kPa" in warnings_of(model, slow)[0]


@pytest.mark.parametrize("pressure", ["2 kPa", "-102 kPa"])
def test_a_cavitation_pressure_above_ambient_or_below_vacuum_is_refused(pressure):
    with pytest.raises(InputError, match=r"lubricant\.cavitation_pressure: got .* it counts from ambient and must be"):
        ruptured(lubricant=[("cavitation_pressure", pressure)])


def test_the_default_is_written_into_the_scene():
    scene = ruptured()
    assert scene_entries(scene)["boundary"] == {"ambient_pressure": "101325.0 Pa"}
    assert scene.cavitation_pressure == -101325.0
    assert read_scene(scene_entries(scene)) == scene


@pytest.mark.parametrize("quantity", ["load_plus", "friction_plus"])
def test_where_both_effects_count_no_model_is_chosen(quantity):
    found = advise(ruptured(), models("pocket"), quantity=quantity, within=0.05)
    assert found.chosen is None
    assert "ruptures, which this model leaves out" in shortfall(found) or "leaves out, change the" in shortfall(found)


def test_a_slow_film_that_ruptures_is_solved_with_cavitation():
    found = advise(slow_and_ruptured(), models("pocket"), quantity="load_plus", within=0.05)
    assert found.chosen.model == "reynolds_cavitating"
    assert found.chosen.stated.source == "estimated from each effect by itself"
    others = [one for one in found.considered if one.model != "reynolds_cavitating"]
    assert {one.verdict for one in others} == {Verdict.NOT_ENOUGH}


def slow_and_ruptured():
    """A film at Re = 0.4, in which inertia changes the pressure by less than 1 %."""
    return ruptured("0.5 m/s", boundary={"ambient_pressure": "3 kPa"})


def test_without_cavitation_the_error_is_at_least_the_effect_of_cavitation():
    scene = slow_and_ruptured()
    with_it, without = (find("pocket", name).solve(scene)["load"].value for name in ("reynolds_cavitating", "reynolds"))
    omitted = kind_of_name("pocket").omitted
    for model in MODELS:
        assert omitted(scene, model, "load_plus").part == pytest.approx(abs(without - with_it) / abs(with_it), rel=0.05)
        assert omitted(scene, model, "backflow").part == float("inf")


def test_a_film_that_stays_whole_lacks_nothing_but_inertia():
    scene, omitted = ruptured(boundary={"ambient_pressure": "0.7 MPa"}), kind_of_name("pocket").omitted
    assert not any(omitted(scene, model, "load_plus") for model in MODELS)
    own = omitted(scene, find("pocket", "reynolds_cavitating"), "friction_plus")
    assert own.part == pytest.approx(expected(scene)["friction_plus"].error, rel=1e-9)
    assert own.source == "expected by the laws"


def test_a_slow_cell_in_plan_that_ruptures_is_solved_with_cavitation():
    slow = load_scene(SCENES / "dimple.toml", ["boundary.ambient_pressure=0.1kPa", "motion.reynolds_number=2"])
    found = advise(slow, models("pocket"), quantity="load_plus", within=0.25)
    assert found.chosen.model == "reynolds_cavitating"
    omitted = kind_of_name("pocket").omitted
    assert omitted(slow, find("pocket", "reynolds"), "load_plus").part > 1


def expected(scene):
    """The errors of ``reynolds`` by the fitted laws."""
    reynolds = find("pocket", "reynolds")
    return expected_errors(scene, reynolds, reynolds.solve(scene), models("pocket"))


DEEP_CAP = -91.5
"""Lowest pressure of ``deep_cap``, kPa above ambient: -15.45 ηu L/(100 h²), solved apart."""

GROOVE = -5.93
"""Lowest pressure of ``pocket.toml`` in units of p+, by finite elements."""


def deep_cap(ambient):
    """A cap over which inertia lowers the pressure; to first order in Re it falls to -112 kPa, without it to -70."""
    return read_scene(
        {
            "name": "deep cap",
            "kind": "pocket",
            "geometry": {
                "length": "1 mm",
                "breadth": "1 mm",
                "film": "30 um",
                "dimples": [{"shape": "spherical", "width": "0.6 mm", "depth": "15 um"}],
            },
            "lubricant": {"viscosity": "0.01 Pa*s", "density": "1000 kg/m^3"},
            "motion": {"reynolds_number": 160},
            "boundary": {"ambient_pressure": f"{ambient} kPa"},
        }
    )


def groove(limit):
    """The groove of ``pocket.toml`` with a cavitation pressure in units of p+; inertia raises its lowest pressure."""
    scene = load_scene(SCENES / "pocket.toml")
    ambient = -limit * scene.pressure_unit / scene.plus_factor
    return load_scene(SCENES / "pocket.toml", [f"boundary.ambient_pressure={ambient} Pa"])


STAYS_WHOLE = {"deep cap": deep_cap(101.325), "groove": groove(1.35 * GROOVE)}
RUPTURES = {"deep cap": deep_cap(80), "groove": groove(0.8 * GROOVE)}
MAY_RUPTURE = {"deep cap": deep_cap(-DEEP_CAP), "groove": groove(GROOVE)}


def omitted(scene, quantity="pressure_min_plus"):
    return {model.name: kind_of_name("pocket").omitted(scene, model, quantity) for model in models("pocket")}


@pytest.mark.parametrize("scene", STAYS_WHOLE.values(), ids=STAYS_WHOLE)
def test_the_best_model_decides_that_a_film_stays_whole(scene):
    found = omitted(scene)
    cavitating = found.pop("reynolds_cavitating")
    assert not any(found.values())
    own, best = (find("pocket", name).solve(scene) for name in ("reynolds_cavitating", "film_slope"))
    lowest, true = (one["pressure_min_plus"].value for one in (own, best))
    assert cavitating.part >= abs(lowest - true) / abs(true)
    assert best_for(scene, [find("pocket", name) for name in ("reynolds_cavitating", "film")]).name == "film"


def test_the_lowest_pressure_of_a_film_that_stays_whole_is_that_of_full_inertia():
    scene = deep_cap(101.325)
    found = advise(scene, models("pocket"), quantity="pressure_min_plus", within=0.05)
    assert found.chosen.model == "film_slope"
    lowest = found.result["pressure_min_plus"].value * scene.pressure_unit / scene.plus_factor
    assert lowest == pytest.approx(1e3 * DEEP_CAP, rel=0.02)


@pytest.mark.parametrize("scene", RUPTURES.values(), ids=RUPTURES)
def test_a_film_that_ruptures_by_inertia_has_the_cavitation_pressure(scene):
    found = omitted(scene)
    cavitating = find("pocket", "reynolds_cavitating").solve(scene)["pressure_min_plus"].value
    limit = scene.cavitation_pressure / scene.pressure_unit * scene.plus_factor
    assert found.pop("reynolds_cavitating").part == pytest.approx(abs(cavitating - limit) / abs(cavitating), abs=0.01)
    assert all("the film ruptures, which this model leaves out" in one.reason for one in found.values())


@pytest.mark.parametrize("scene", MAY_RUPTURE.values(), ids=MAY_RUPTURE)
def test_a_film_within_the_error_of_the_cavitation_pressure_may_rupture_or_not(scene):
    found = omitted(scene)
    found.pop("reynolds_cavitating")
    assert all("the film may rupture or stay whole" in one.reason for one in found.values())
    assert advise(scene, models("pocket"), quantity="load_plus", within=0.01).chosen is None


def test_a_model_with_a_large_error_says_that_its_film_may_rupture():
    (warning,) = warnings_of(find("pocket", "inertial_reynolds"), deep_cap(101.325))
    assert "may rupture or stay whole" in warning
    assert not warnings_of(find("pocket", "film_slope"), deep_cap(101.325))


@pytest.mark.parametrize(("width", "columns"), [("25 um", 64), ("12 um", 128)])
def test_a_film_whose_dimples_are_narrower_than_columns_of_other_models_is_solved(width, columns):
    dimples = [{"shape": "spherical", "width": width, "depth": "5 um"}]
    cell = ruptured(geometry={"length": "1 mm", "breadth": "1 mm", "film": "5 um", "dimples": dimples})
    result = find("pocket", "reynolds").solve(cell, Request(resolution=columns))
    expected = expected_errors(cell, find("pocket", "reynolds"), result, models("pocket"))
    assert "load_plus" not in expected, "no model with inertia is known to hold"
