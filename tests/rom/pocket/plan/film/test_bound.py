"""Errors over dimples are bounded by the corrections that models make, and not too widely."""

from pathlib import Path
from statistics import median

import pytest

from roughfilm.ladder import find, models
from roughfilm.rom.advice.advise import advise
from roughfilm.rom.advice.expected import with_errors
from roughfilm.rom.advice.stated import BY_CORRECTION, stated_errors
from roughfilm.rom.ladder.scene import read_scene
from roughfilm.rom.pocket.kind import KIND
from scripts.studies.coverage.store import path_of, read

CAP = {"shape": "spherical", "width": "0.3 mm", "depth": "15 um"}
ELLIPSE = {"shape": "ellipsoidal", "width": "0.3 mm", "breadth": "0.6 mm", "depth": "15 um"}
BOX = {"shape": "box", "width": "0.3 mm", "breadth": "0.3 mm", "depth": "15 um", "edge": "30 um"}
MODEL = find("pocket", "film_slope")


def cell(dimple, reynolds_number=160):
    return read_scene(
        {
            "name": "cell",
            "kind": "pocket",
            "geometry": {"length": "1 mm", "breadth": "1 mm", "film": "30 um", "dimples": [dimple]},
            "lubricant": {"viscosity": "0.1 mPa*s", "density": "1000 kg/m^3"},
            "motion": {"reynolds_number": reynolds_number},
        }
    )


def stated(scene):
    result = with_errors(MODEL.solve(scene), scene, MODEL, models("pocket"))
    return result["load_plus"].value, stated_errors(result)["load_plus"]


@pytest.mark.parametrize(("dimple", "load"), [(CAP, 1.044), (ELLIPSE, 1.885), (BOX, 1.641)])
def test_the_error_against_navier_stokes_flow_is_within_what_is_stated_and_not_a_fifth_of_it(dimple, load):
    """The loads are extrapolated from OpenFOAM on 48 and 96 columns."""
    value, error = stated(cell(dimple))
    assert error.source == BY_CORRECTION
    assert abs(value / load - 1) <= error.error <= 5 * abs(value / load - 1)


def test_a_dimple_deeper_than_was_judged_has_the_error_of_the_laws():
    _, error = stated(cell({**CAP, "width": "0.6 mm", "depth": "36 um"}, 10))
    assert error.source != BY_CORRECTION


def test_advice_runs_a_model_that_bounds_its_own_error():
    found = advise(cell(CAP), models("pocket"), quantity="load_plus", within=0.02)
    assert (found.chosen.model, found.chosen.stated.source) == ("film_slope", BY_CORRECTION)


STORED = Path(__file__).parents[4] / "scripts/studies/coverage"
QUANTITIES = ("load_plus", "pressure_max_plus", "pressure_min_plus", "friction_plus")


@pytest.mark.parametrize("name", ["inertial_reynolds", "film", "film_slope"])
def test_what_is_stated_over_grooves_holds_and_is_not_far_too_wide(name):
    """The truths are plane flow by finite elements; before these bounds a load was stated 7 to 20 times too wide."""
    ratios = {quantity: [] for quantity in QUANTITIES}
    for one in read(path_of(STORED, "plane_grooves")).values():
        scene, model = read_scene(one.scene), find("pocket", name)
        result = with_errors(model.solve(scene), scene, model, models("pocket"))
        values = {quantity: value for quantity, (value, _) in one.truth.items()}
        for quantity, own in ratios.items():
            stated = stated_errors(result)[quantity].error * KIND.scale(values, quantity)
            own.append(stated / abs(result[quantity].value - values[quantity]))
    assert sum(ratio >= 1 for own in ratios.values() for ratio in own) >= 0.9 * sum(map(len, ratios.values()))
    assert median(ratio for own in ratios.values() for ratio in own) <= 6
