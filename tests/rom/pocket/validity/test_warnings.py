"""A warning where effects cancel in the load of a pocket, whose relative error the fitted laws then underestimate."""

import pytest

import roughfilm as rf
from roughfilm.ladder import find
from roughfilm.rom.advice.laws import on_grid, table
from roughfilm.rom.ladder.scene import read_scene
from roughfilm.rom.pocket.validity.numbers import numbers
from roughfilm.rom.pocket.validity.warnings import cancellations

TRUE_LOAD, TRUE_LOAD_UNCERTAINTY = -0.02340, 0.00015
"""Load p+ of the scene ``CANCELLING`` by Taylor-Hood finite elements on two meshes."""

CANCELLING = {
    "name": "cancelling",
    "kind": "pocket",
    "geometry": {
        "length": "1 mm",
        "film": "0.17074041855236864 mm",
        "position": "-0.04525857271881324 mm",
        "profile": "points",
        "points": [
            [-0.0003118337846620451, 0.0],
            [0.00015985111327608217, 1.4045817253708411e-05],
            [0.0003118337846620451, 0.0],
        ],
    },
    "lubricant": {"viscosity": "0.1 mPa*s", "density": "1000 kg/m^3"},
    "motion": {"reynolds_number": 0.001},
}


def test_a_load_that_slope_nearly_cancels_has_a_warning():
    scene = read_scene(CANCELLING)
    result = rf.solve(scene, model="film_slope")
    error = abs(result["load_plus"].value - TRUE_LOAD)
    bound = table().promise("pocket", "film_slope").laws["load_plus"].error(on_grid(numbers(scene), 400))
    assert error - TRUE_LOAD_UNCERTAINTY > 3 * bound * abs(TRUE_LOAD), "the laws expect too little here"
    assert "load_plus" not in result.expected_error
    assert any("effects cancel" in warning for warning in result.warnings)


@pytest.mark.parametrize(("share", "warned"), [(1.0, False), (0.9, False), (0.5, True), (0.0, True)])
def test_the_load_of_a_result_is_compared_with_that_to_first_order(share, warned):
    scene = read_scene(CANCELLING)
    load = 2.0 * share * numbers(scene)["loaded"]
    assert bool(cancellations(scene, load=-load, lowest=-1.0, highest=2.0)) is warned


def test_a_film_without_load_in_any_model_has_no_warning():
    geometry = {"length": "1 mm", "film": "10 um", "width": "0.3 mm", "depth": "5 um"}
    scene = read_scene({**CANCELLING, "geometry": geometry})
    assert not cancellations(scene, load=1e-12, lowest=-1.0, highest=1.0)


def cell(reynolds_number, **dimple):
    dimple = {"shape": "conical", "width": "0.3 mm", "depth": "30 um", **dimple}
    geometry = {"length": "1 mm", "film": "30 um", "breadth": "0.5 mm", "dimples": [dimple]}
    return read_scene({**CANCELLING, "geometry": geometry, "motion": {"reynolds_number": reynolds_number}})


@pytest.mark.parametrize(
    ("model", "scene", "words"),
    [
        ("reynolds", cell(1), None),
        ("reynolds", cell(100), "which is left out"),
        ("inertial_reynolds", cell(1), None),
        ("inertial_reynolds", cell(150), "higher orders are left out"),
        ("inertial_reynolds", cell(0.001, width="0.1 mm", depth="60 um"), "the film over it is not thin"),
        ("reynolds", cell(1500), "turbulent"),
        ("inertial_reynolds", cell(1500), "turbulent"),
    ],
)
def test_models_in_plan_warn_where_they_leave_their_range(model, scene, words):
    warnings = find("pocket", model).solve(scene).warnings
    assert warnings == () if words is None else any(words in one for one in warnings)
