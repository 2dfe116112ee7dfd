"""A warning where effects cancel in the load of a pocket, whose relative error the fitted laws then underestimate."""

import pytest

import roughfilm as rf
from roughfilm.ladder import find, models
from roughfilm.rom.advice.advise import advise
from roughfilm.rom.advice.laws import on_grid, table
from roughfilm.rom.ladder.scene import read_scene
from roughfilm.rom.pocket.kind import KIND
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
    ],
)
def test_models_in_plan_warn_where_they_leave_their_range(model, scene, words):
    warnings = find("pocket", model).solve(scene).warnings
    assert warnings == () if words is None else any(words in one for one in warnings)


@pytest.mark.parametrize("model", models("pocket"), ids=lambda model: model.name)
def test_no_model_of_a_pocket_holds_beyond_the_laminar_limit(model):
    """Re = ρuh/η of the film, and in a long groove of the film in it, above 1440 (Tillmark and Alfredsson 1992)."""

    def scene(reynolds_number, width="0.3 mm"):
        groove = {"profile": "cylindrical", "width": width, "depth": "30 um"}
        geometry = {"length": "20 mm", "film": "30 um", **groove}
        return read_scene({**CANCELLING, "geometry": geometry, "motion": {"reynolds_number": reynolds_number}})

    for own, beyond in ((scene(1400), False), (scene(1500), True), (scene(700, "10 mm"), False)):
        assert bool(KIND.outside(own, model, None)) == beyond
    (reason,) = KIND.outside(scene(800, "10 mm"), model, None)
    assert "Re = ρuh/η = 1600 exceeds 1440" in reason
    assert advise(scene(1500), [model], quantity="load_plus", within=0.5).chosen is None


def test_a_pocket_of_a_gas_says_so():
    """Of air in place of a liquid; pressures of 0.1 p_a change its density by 0.1."""
    groove = {"length": "1 mm", "film": "3 um", "profile": "cylindrical", "width": "0.3 mm", "depth": "3 um"}
    air = {**CANCELLING, "geometry": groove, "lubricant": {"viscosity": "18.5 uPa*s", "density": "1.2 kg/m^3"}}
    fast = read_scene({**air, "motion": {"speed": "100 m/s"}})
    found = find("pocket", "reynolds").solve(fast)
    share = max(abs(found[name].value) for name in ("pressure_max_plus", "pressure_min_plus"))
    share *= fast.pressure_unit / fast.plus_factor / 101325
    assert [one for one in found.outside if f"pressures differ from ambient by {share:.2g} p_a" in one]
    assert not find("pocket", "reynolds").solve(read_scene({**air, "motion": {"speed": "0.01 m/s"}})).outside
