"""The part of a quantity that heating and shear thinning change, measured on a coarse grid."""

import math
from dataclasses import replace

import pytest

from roughfilm.contact.foundation.errors import ConvergenceError
from roughfilm.ladder import find, models
from roughfilm.rom.advice.advise import advise
from roughfilm.rom.advice.laws import Grid, Law, Term, on_grid, table
from roughfilm.rom.bearing.effects.viscosity import MARGIN, CoarseFilms, coarse_films, viscosity_omitted
from roughfilm.rom.bearing.effects.waves import waves_omitted
from roughfilm.rom.bearing.omission import omission
from roughfilm.rom.bearing.roughness import Sinusoid
from roughfilm.rom.ladder.kind import kind_of_scene
from roughfilm.rom.ladder.model import Effect, best_for
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene
from roughfilm.rom.temperature.closed_forms.slider import adiabatic_slider
from roughfilm.words.headline import included, left_out

ISOTHERMAL = find("bearing", "reynolds_cavitating")
BALANCE = find("bearing", "heat_balance")
MODELS = models("bearing")
WEDGE = {"film": 20e-6, "rise": 20e-6, "length": 50e-3, "speed": 2.0, "viscosity": 0.05}
COEFFICIENT, HEAT = 0.04, 1.74e6


def wedge(speed=2.0, **lubricant):
    """An infinitely wide wedge whose lubricant heats."""
    geometry = {"shape": "linear", "length": "50 mm", "film": "20 um", "rise": "20 um"}
    oil = {
        "viscosity": "0.05 Pa*s",
        "temperature": "40 degC",
        "density": "870 kg/m^3",
        "heat_capacity": "2000 J/(kg*K)",
        "conductivity": "100 W/(m*K)",  # so large that the temperature is uniform across the film
        "thermoviscosity": {"law": "exponential", "temperature_coefficient": "0.04 1/K"},
    }
    entries = {"geometry": geometry, "lubricant": {**oil, **lubricant}, "motion": {"speed": f"{speed} m/s"}}
    return read_scene({"name": "wedge", "kind": "bearing", **entries})


def exact(speed, coefficient):
    liquid = {"temperature": 0.0, "temperature_coefficient": coefficient, "heat_per_volume": HEAT}
    return adiabatic_slider(**{**WEDGE, "speed": speed}, **liquid)


@pytest.mark.parametrize("speed", [0.2, 2.0, 10.0])
def test_the_part_of_an_isothermal_model_is_that_of_the_exact_adiabatic_film(speed):
    cold, warm = exact(speed, 1e-9), exact(speed, COEFFICIENT)
    omitted = viscosity_omitted(wedge(speed), ISOTHERMAL, "load_per_width")
    assert omitted.reason.startswith("heating changes the load by about")
    assert "heat_balance gives it to" in omitted.reason
    assert omitted.part == pytest.approx(MARGIN * (cold.load - warm.load) / warm.load, rel=0.03)


def test_of_the_best_model_nothing_is_left_out():
    scene = wedge()
    top = best_for(scene, [model for model in MODELS if model.applies(scene).applies])
    assert coarse_films(scene).models[-1] == top
    assert viscosity_omitted(scene, top, "load_per_width") is None


def test_the_part_of_the_heat_balance_is_smaller_and_names_the_field():
    omitted, isothermal = (viscosity_omitted(wedge(), model, "load_per_width") for model in (BALANCE, ISOTHERMAL))
    assert 0 < omitted.part < isothermal.part / 2
    assert omitted.reason.startswith("the temperature over the film")


def test_isothermal_scenes_are_left_alone():
    scene = wedge(thermoviscosity=None)
    assert coarse_films(scene) is None
    assert viscosity_omitted(scene, ISOTHERMAL, "load_per_width") is None
    assert not any("heating" in model.keeps for model in MODELS if model.applies(scene).applies)


def test_a_failure_of_the_best_model_makes_the_part_unknown(monkeypatch):
    def compute(*_):
        raise ConvergenceError("thermal runaway")

    top = coarse_films(wedge()).models[-1]
    ladder = (ISOTHERMAL, BALANCE, replace(top, compute=compute))
    monkeypatch.setattr("roughfilm.rom.bearing.effects.viscosity.ladder", lambda *_, **__: ladder)
    for model in (ISOTHERMAL, BALANCE):
        omitted = viscosity_omitted(wedge(2.5), model, "load_per_width")
        assert omitted.part == math.inf
        assert omitted.reason.endswith(": thermal runaway")


@pytest.mark.parametrize("name", ["heat_balance", "adiabatic", "across"])
def test_the_law_of_the_grid_bounds_the_error_on_a_coarse_grid(name):
    """Beside one on 16 times as many cells; without the law no grid is expected to be too coarse."""
    scene, model = wedge(), find("bearing", name)
    coarse, fine = (model.solve(scene, Request(resolution=cells))["load_per_width"].value for cells in (64, 1024))
    advice = advise(scene, MODELS, quantity="load_per_width", within=0.05)
    law = table().grid(kind_of_scene(scene).laws_of_grids(name), name, "load_per_width")
    bounds = [law.error(on_grid(advice.numbers, cells)) for cells in (64, 1024)]
    assert abs(coarse - fine) / fine < bounds[0]
    assert bounds[1] < bounds[0] / 2


def test_advice_expects_the_error_of_a_grid_by_its_law():
    advice = advise(wedge(), MODELS, quantity="load_per_width", within=0.05)
    found = {one.model: one.a_priori for one in advice.considered}
    assert "error by the resolution of" in found["adiabatic"].reasons[0]
    assert found["adiabatic"].error > 0


@pytest.mark.parametrize(("bound", "runs"), [(0.06, True), (0.3, False)])
def test_a_wide_law_does_not_make_the_grid_finer(bound, runs):
    """Up to five tolerances the run decides, by its own uncertainty; beyond, the grid is not tried."""
    wide = Law(terms=[Term(coefficient=bound)])
    models, known = ("heat_balance", "adiabatic", "across"), table()
    others = [grid for grid in known.grids if grid.kind != "heated_bearing"]
    grids = [Grid(kind="heated_bearing", model=name, laws={"load_per_width": wide}) for name in models]
    given = {"quantity": "load_per_width", "within": 0.05}
    bare, ruled = (
        advise(wedge(), MODELS, laws=replace(known, grids=all_), **given) for all_ in (others, [*others, *grids])
    )
    assert bare.chosen.model in models
    if runs:
        assert (ruled.chosen.model, ruled.chosen.resolution) == (bare.chosen.model, bare.chosen.resolution)
    else:
        assert ruled.chosen is None or ruled.chosen.model not in models


def test_heating_adds_to_inertia():
    scene = wedge()
    both, heating = (
        omission(scene, ISOTHERMAL, "load_per_width"),
        viscosity_omitted(scene, ISOTHERMAL, "load_per_width"),
    )
    assert both.part > heating.part
    assert both.reason.startswith(heating.reason)
    assert "inertia" in both.reason


def test_models_with_temperature_leave_out_the_length_of_ridges():
    """The difference between the film with all waves and the averaged one, of waves 1/20 of the length."""
    ridges = {"kind": "sinusoid", "amplitude": "8 um", "wavelength": "2.5 mm", "direction": "0 deg"}
    scene = wedge(conductivity=None).model_copy(update={"roughness": Sinusoid.model_validate(ridges)})
    isothermal = scene.isothermal()
    resolved, averaged = (
        find("bearing", name).solve(isothermal, Request(resolution=1024))["load_per_width"].value
        for name in ("direct", "homogenized")
    )
    omitted = waves_omitted(scene, BALANCE, "load_per_width")
    assert omitted.part == pytest.approx(abs(resolved - averaged) / resolved, rel=0.05)
    assert omitted.part > 0.01
    assert waves_omitted(scene, find("bearing", "homogenized"), "load_per_width") is None


def test_the_words_name_only_effects_that_the_scene_has():
    scene = wedge()
    assert included(scene, BALANCE, MODELS).endswith("includes cavitation, heating, pressure dependence and side flow")
    words = left_out(scene, ISOTHERMAL, MODELS)
    assert "heating" in words.partition(";")[0]
    assert "roughness" not in words
    assert "heat and deformation" not in words


@pytest.mark.parametrize(
    ("speed", "within", "enough"),
    [
        (0.2, 0.05, {"reynolds", "reynolds_incompressible", "reynolds_cavitating"}),
        (2.0, 0.05, {"heat_balance", "adiabatic"}),
        (10.0, 0.02, {"adiabatic", "across"}),
    ],
)
def test_the_cheapest_model_that_is_accurate_enough(speed, within, enough):
    """The more the film heats, the more of its temperature it takes; the exact solution judges the answer."""
    advice = advise(wedge(speed), MODELS, quantity="load_per_width", within=within)
    assert advice.chosen.model in enough
    load = exact(speed, COEFFICIENT).load
    assert abs(advice.result["load_per_width"].value - load) <= within * load


@pytest.mark.parametrize(
    ("kept", "words"),
    [
        ((), ["shear thinning", "heating"]),
        ((Effect.SHEAR_THINNING,), ["heating"]),
        ((Effect.HEATING,), ["shear thinning", "the temperature over the film and across it"]),
        ((Effect.HEATING, Effect.TEMPERATURE_FIELD), ["shear thinning", "the temperature across the film"]),
        ((Effect.SHEAR_THINNING, Effect.HEATING), ["the temperature over the film and across it"]),
    ],
)
def test_each_effect_that_is_left_out_is_named(kept, words):
    films = CoarseFilms(models=(), results={}, failures={}, smooth=False, absent=frozenset())
    assert films.left_out(find("bearing", "across"), replace(ISOTHERMAL, keeps=frozenset(kept))) == words


def test_where_the_film_without_an_effect_fails_no_other_is_solved(monkeypatch):
    solved = []

    def counting(model, compute):
        def counted(*args, **more):
            solved.append(model.name)
            return compute(*args, **more)

        return replace(model, compute=counted)

    def failing(*_, **__):
        raise ConvergenceError("no steady film was found")

    ladder = [counting(ISOTHERMAL, failing), counting(BALANCE, BALANCE.compute)]
    monkeypatch.setattr("roughfilm.rom.bearing.effects.viscosity.ladder", lambda *_, **__: ladder)
    assert viscosity_omitted(wedge(2.7), ISOTHERMAL, "load_per_width") is None
    assert set(solved) == {"reynolds_cavitating"}


def test_a_film_that_takes_too_much_work_leaves_the_part_unknown(monkeypatch):
    monkeypatch.setattr("roughfilm.rom.bearing.effects.viscosity.WORK", 6 * 129)
    scene = wedge(speed=1.9)
    films = coarse_films(scene)
    assert ISOTHERMAL.name in films.results
    assert not films.failures
    assert BALANCE.name not in films.results
    assert viscosity_omitted(scene, ISOTHERMAL, "load_per_width") is None
