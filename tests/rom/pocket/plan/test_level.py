"""Uncertainties of films in plan against finer grids, and numbers of a cell to first order in Re."""

import pytest
from places import SCENES

from roughfilm.contact.foundation.errors import InputError
from roughfilm.ladder import find
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.result import NO_COARSER_GRID
from roughfilm.rom.ladder.scene import load_scene, read_scene, scene_entries
from roughfilm.rom.pocket.plan import level as levels
from roughfilm.rom.pocket.validity.numbers import numbers

INERTIAL = find("pocket", "inertial_reynolds")
COMMON = {"width": "0.3 mm", "depth": "20 um", "position": "0.06 mm"}
DIMPLES = {
    "spherical": {},
    "ellipsoidal": {"breadth": "0.5 mm", "rotation": "40 deg"},
    "conical": {"edge": "0.05 mm"},
    "box": {"breadth": "0.4 mm", "edge": "0.04 mm"},
    "chevron": {"breadth": "0.4 mm", "edge": "0.04 mm", "angle": "30 deg"},
    "groove": {},
}
NAMES = ("load_plus", "friction_plus", "pressure_max_plus", "pressure_min_plus", "load_from_corner_plus")


def scene_of(shape, **geometry):
    entries = scene_entries(load_scene(SCENES / "dimple.toml"))
    own = {"shape": shape, **COMMON, **DIMPLES[shape]}
    return read_scene({**entries, "geometry": {**entries["geometry"], **geometry, "dimples": [own]}})


def test_uncertainties_cover_the_difference_from_a_finer_grid():
    """95 of 100 are asked; random cells are in the study ``coverage``."""
    kept = []
    for shape in DIMPLES:
        scene = scene_of(shape)
        found, fine = (INERTIAL.solve(scene, Request(resolution=n)) for n in (32, 128))
        kept += [abs(found[name].value - fine[name].value) <= found[name].uncertainty for name in NAMES]
    assert sum(kept) >= 0.95 * len(kept)


def test_a_grid_without_a_coarser_one_has_no_uncertainty():
    scene = scene_of("groove")
    level = levels.level_of(scene.plan(), (6, 16), with_inertia=False)
    found = levels.quantities_of([level], scene, 0.0)
    assert found["load_plus"].uncertainty is None
    assert NO_COARSER_GRID not in INERTIAL.solve(scene, Request(resolution=8)).warnings


def test_a_cell_that_is_too_broad_is_refused():
    with pytest.raises(InputError, match=r"columns along a cell .* need 64000 across it"):
        INERTIAL.solve(scene_of("spherical", breadth="1 m"))


@pytest.mark.parametrize("model", ["reynolds", "film", "reynolds_cavitating"])
def test_a_dimple_that_is_narrower_than_a_column_is_refused(model):
    entries = scene_entries(load_scene(SCENES / "dimple.toml"))
    own = {"shape": "spherical", "width": "9 um", "depth": "1 um"}
    narrow = read_scene({**entries, "geometry": {**entries["geometry"], "film": "3 um", "dimples": [own]}})
    with pytest.raises(InputError, match=r"got 64 columns .* narrowest dimple, 9e-06 m; take at least 112"):
        find("pocket", model).solve(narrow, Request(resolution=64))


def test_few_columns_over_a_dimple_are_warned_of():
    few, enough = (INERTIAL.solve(scene_of("spherical"), Request(resolution=n)).warnings for n in (16, 32))
    assert any("the narrowest dimple has 4.8 columns" in one for one in few)
    assert not any("columns" in one for one in enough)


def test_the_load_over_the_pressure_is_that_to_first_order_in_the_reynolds_number():
    scene = scene_of("spherical")
    found = INERTIAL.solve(scene, Request(resolution=64))
    largest = max(abs(found[name].value) for name in ("pressure_max_plus", "pressure_min_plus"))
    assert numbers(scene)["loaded"] == pytest.approx(abs(found["load_plus"].value) / largest)
