"""The Reynolds equation over a cell in plan against the groove, and against symmetries."""

import pytest
from places import SCENES

from roughfilm.ladder import find
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import load_scene, read_scene, scene_entries

REYNOLDS = find("pocket", "reynolds")


def solved(scene, resolution):
    return REYNOLDS.solve(scene, Request(resolution=resolution))


def replaced(scene, **geometry):
    entries = scene_entries(scene)
    return read_scene({**entries, "geometry": {**entries["geometry"], **geometry}})


def test_a_groove_in_plan_has_the_pressures_and_friction_of_the_groove():
    groove = load_scene(SCENES / "pocket.toml")
    own = {key: value for key, value in scene_entries(groove)["geometry"].items() if key in ("width", "depth")}
    plan = replaced(load_scene(SCENES / "dimple.toml"), breadth="0.2 mm", dimples=[{"shape": "groove", **own}])
    exact = REYNOLDS.solve(groove)
    for name in ("friction_plus", "pressure_max_plus", "pressure_min_plus"):
        errors = [abs(solved(plan, n)[name].value / exact[name].value - 1) for n in (40, 160)]
        assert errors[1] < max(errors[0] / 4, 1e-6)
        assert errors[1] < 2e-3


def test_a_symmetric_dimple_carries_no_load_without_inertia():
    found = solved(load_scene(SCENES / "dimple.toml"), 32)
    assert found["load_plus"].value == pytest.approx(0, abs=1e-9)
    assert found["load_from_corner_plus"].value == pytest.approx(0, abs=1e-9)
    assert found["pressure_max_plus"].value == pytest.approx(-found["pressure_min_plus"].value)
    assert found.numerics.residual < 1e-12


def test_a_staggered_cell_of_two_has_the_forces_of_the_cell_of_one_that_is_turned_by_half_a_cell():
    scene = load_scene(SCENES / "dimple.toml")
    staggered = replaced(scene, arrangement="staggered")
    moved = [{**one, "position": "0.1 mm"} for one in scene_entries(scene)["geometry"]["dimples"]]
    friction = [solved(one, 40)["friction_plus"].value for one in (staggered, replaced(staggered, dimples=moved))]
    assert friction[0] == pytest.approx(friction[1], rel=1e-9)
