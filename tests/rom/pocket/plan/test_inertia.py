"""First-order inertia over a cell in plan against grooves, symmetries of Stokes flow, and the dissipation theorem."""

import pytest
from places import SCENES

from roughfilm.ladder import find
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import load_scene, read_scene, scene_entries

REYNOLDS, INERTIAL = (find("pocket", name) for name in ("reynolds", "inertial_reynolds"))


def solved(model, scene, resolution):
    return model.solve(scene, Request(resolution=resolution))


def with_dimples(*dimples, **geometry):
    entries = scene_entries(load_scene(SCENES / "dimple.toml"))
    return read_scene({**entries, "geometry": {**entries["geometry"], **geometry, "dimples": list(dimples)}})


CHEVRON = {
    "shape": "chevron",
    "width": "0.2 mm",
    "breadth": "0.5 mm",
    "depth": "20 um",
    "edge": "0.05 mm",
    "angle": "30 deg",
    "position": "0.08 mm",
}
ELLIPSOID = {"shape": "ellipsoidal", "width": "0.25 mm", "breadth": "0.5 mm", "depth": "20 um", "rotation": "30 deg"}

MAP = {
    "shape": "points",
    "width": "0.5 mm",
    "breadth": "0.4 mm",
    "points": [[0.0] * 4, [0.0, 2e-5, 1e-5, 0.0], [0.0, 1e-5, 3e-5, 0.0], [0.0, 5e-6, 1e-5, 0.0], [0.0] * 4],
}


def change(scene, name, resolution=32):
    """The part of a quantity by inertia."""
    return solved(INERTIAL, scene, resolution)[name].value - solved(REYNOLDS, scene, resolution)[name].value


def test_a_groove_in_plan_has_the_load_and_pressures_of_the_closed_form():
    groove = load_scene(SCENES / "pocket.toml")
    own = {key: value for key, value in scene_entries(groove)["geometry"].items() if key in ("width", "depth")}
    plan, exact = with_dimples({"shape": "groove", **own}, breadth="0.2 mm"), INERTIAL.solve(groove)
    assert plan.reynolds_number == pytest.approx(groove.reynolds_number, rel=1e-4)
    largest = exact["pressure_max_plus"].value
    for name in ("load_plus", "load_from_corner_plus", "pressure_max_plus", "pressure_min_plus"):
        of_groove = exact[name.replace("_from_corner", "")].value
        errors = [abs(solved(INERTIAL, plan, n)[name].value - of_groove) / largest for n in (32, 64)]
        assert errors[1] < 1e-3
        assert errors[1] < max(errors[0] / 2, 1e-4)


@pytest.mark.parametrize("dimple", [CHEVRON, ELLIPSOID], ids=["chevron", "ellipsoidal"])
def test_a_dimple_that_is_turned_by_half_a_turn_reverses_the_load_but_not_its_change_by_inertia(dimple):
    """Stokes flow is reversible, and inertia is of second order in the velocity."""
    scenes = [
        with_dimples({**dimple, "position": f"{sign}0.08 mm", "rotation": f"{angle} deg"})
        for sign, angle in (("", 30), ("-", 210))
    ]
    loads = [solved(REYNOLDS, scene, 32)["load_plus"].value for scene in scenes]
    assert loads[0] == pytest.approx(-loads[1], rel=1e-6)
    changes = [change(scene, "load_plus") for scene in scenes]
    assert changes[0] == pytest.approx(changes[1], rel=1e-6)
    assert abs(changes[0]) > 0.1


def test_a_mirrored_dimple_has_the_same_load():
    scenes = [with_dimples({**ELLIPSOID, "rotation": f"{sign}30 deg"}) for sign in ("", "-")]
    loads = [solved(INERTIAL, scene, 32)["load_plus"].value for scene in scenes]
    assert loads[0] == pytest.approx(loads[1], rel=1e-9)


@pytest.mark.parametrize("dimple", [CHEVRON, MAP], ids=["chevron", "points"])
def test_inertia_does_not_change_friction_to_first_order(dimple):
    """In a periodic cell the power of the wall is dissipated, and Stokes flow has the least dissipation (Helmholtz)."""
    scene = with_dimples(dimple)
    friction = solved(REYNOLDS, scene, 64)["friction_plus"].value
    changes = [abs(change(scene, "friction_plus", n)) / friction for n in (16, 64)]
    assert changes[1] < 2e-4
    assert changes[1] < changes[0] / 2


def test_shear_stress_and_pressure_include_the_change_by_inertia():
    scene = with_dimples(CHEVRON)
    with_inertia, without = solved(INERTIAL, scene, 16), solved(REYNOLDS, scene, 16)
    for name in ("pressure", "shear_stress"):
        difference = with_inertia.fields[name].values - without.fields[name].values
        assert abs(difference).max() > 0.05 * abs(without.fields[name].values).max()
    mean = with_inertia.fields["shear_stress"].values.mean()
    assert with_inertia["friction_per_area"].value == pytest.approx(mean)
