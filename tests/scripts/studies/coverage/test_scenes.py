"""Random scenes of the study: what they promise to contain, and that a seed is one scene."""

from collections import Counter

import pytest

from roughfilm.rom.bearing.numbers import bearing_numbers
from roughfilm.rom.ladder.kind import kind_of_scene
from roughfilm.rom.ladder.scene import scene_entries
from scripts.studies.coverage.drawing import drawn
from scripts.studies.coverage.scenes.bearing import SHAPES
from scripts.studies.coverage.scenes.dimples import SHAPES as DIMPLES

COUNT = 60


@pytest.fixture(scope="module")
def bearings():
    return [drawn("bearing", seed) for seed in range(20000, 20000 + COUNT)]


def test_bearings_have_every_shape_texture_and_feed(bearings):
    assert Counter(one.geometry.shape for one in bearings).keys() == set(SHAPES)
    textured = [one.geometry.texture for one in bearings if getattr(one.geometry, "texture", None)]
    assert {one.profile for one in textured} == {"box", "cylindrical", "ellipsoidal"}
    thetas = [one.boundary.inlet.theta for one in bearings if one.boundary.inlet.theta is not None]
    assert min(thetas) < 0.5
    assert max(one.geometry.eccentricity for one in bearings if one.geometry.shape == "journal") > 0.9
    assert {one.roughness.kind for one in bearings if one.roughness} == {"sinusoid", "surface"}
    assert any(one.motion.speed < 0 for one in bearings)


@pytest.mark.parametrize(
    "kind",
    [
        "bearing",
        "free_bearing",
        "placed_bearing",
        "heated_bearing",
        "dry_contact",
        "seal",
        "rough_gap",
        "dimples",
        "deep_dimples",
        "plane_grooves",
        "small_surface",
    ],
)
def test_a_seed_is_one_scene(kind):
    first, again, other = (scene_entries(drawn(kind, seed)) for seed in (20003, 20003, 20004))
    assert first == again
    assert first != other


def test_heated_bearings_heat_little_and_much_between_walls_of_every_kind():
    heated = [drawn("heated_bearing", seed) for seed in range(20000, 20000 + COUNT)]
    assert {kind_of_scene(one).name_of_laws for one in heated} == {"bearing"}
    assert all(not one.lubricant.lacking and one.load is None for one in heated)
    numbers = [bearing_numbers(one)["heating_number"] for one in heated]
    assert min(numbers) < 0.03
    assert max(numbers) > 3
    assert {one.heat.fixed_wall.kind for one in heated} == {"adiabatic", "temperature", "conducting"}
    walls = {one.heat.sliding_wall.kind for one in heated}
    assert walls >= {"adiabatic", "temperature", "half_space"}
    assert {one.lubricant.thermoviscosity.law for one in heated} == {"exponential", "iso_vg"}


def test_hot_wedges_are_slow_and_fast_and_heat_little_and_much():
    wedges = [drawn("hot_wedge", seed) for seed in range(20000, 20000 + COUNT)]
    numbers = [bearing_numbers(one) for one in wedges]
    for name, low, high in (("thermal_peclet_number", 0.3, 50.0), ("nahme_number", 0.1, 10.0)):
        assert min(one[name] for one in numbers) < low
        assert max(one[name] for one in numbers) > high
    assert {one.heat is None for one in wedges} == {True, False}


@pytest.mark.parametrize(("kind", "loaded"), [("free_bearing", True), ("placed_bearing", False)])
def test_walls_that_move_freely_have_every_shape_supply_and_wall(kind, loaded):
    moving = [drawn(kind, seed) for seed in range(20000, 20000 + COUNT)]
    assert {kind_of_scene(one).name_of_laws for one in moving} == {kind}
    assert all(kind_of_scene(one).lawful and (one.load is not None) == loaded for one in moving)
    assert {one.geometry.shape for one in moving} == {"lobes", "pivoted", "pivoted_sector"}
    bores = [one.geometry for one in moving if one.geometry.shape == "lobes"]
    assert {one.single for one in bores} == {one.joined for one in bores} == {True, False}
    assert {one.pivot is None for one in bores} == {one.symmetric for one in bores} == {True, False}
    assert {one.lobes for one in bores} >= {1, 2, 3, 4, 5, 6}
    assert any(one.supply for one in moving)
    assert any(one.lubricant.cavitation_pressure < 0 for one in moving)
    assert {one.roughness.kind for one in moving if one.roughness} == {"sinusoid", "surface"}


def test_rough_gaps_are_between_ridges_or_surfaces_and_open_or_pressed():
    gaps = [drawn("rough_gap", seed) for seed in range(20000, 20040)]
    assert {one.load is None for one in gaps} == {True, False}
    assert {one.geometry.upper is None for one in gaps} == {True, False}
    assert {one.surface().shape for one in gaps} == {(128, 2), (48, 48)}


def test_cells_in_plan_have_every_shape_and_arrangement():
    cells = [drawn("dimples", seed) for seed in range(20000, 20040)]
    assert {kind_of_scene(one).name_of_laws for one in cells} == {"dimples"}
    assert {one.shape for cell in cells for one in cell.geometry.dimples} == set(DIMPLES)
    assert {cell.geometry.arrangement for cell in cells} == {"aligned", "staggered"}
    assert {len(cell.geometry.dimples) for cell in cells} == {1, 2}
    assert min(cell.reynolds_number for cell in cells) == 1e-3
    assert max(cell.reynolds_number for cell in cells) > 100
    assert max(cell.slope for cell in cells) <= 1 + 1e-9


def test_deep_dimples_are_about_as_deep_as_the_film_and_have_inertia():
    cells = [drawn("deep_dimples", seed) for seed in range(20000, 20040)]
    assert {kind_of_scene(one).name_of_laws for one in cells} == {"dimples"}
    assert {one.shape for cell in cells for one in cell.geometry.dimples} == set(DIMPLES)
    assert all(0.25 <= cell.depth <= 1 and cell.reynolds_number >= 5 for cell in cells)
    assert {cell.reynolds_number > 40 for cell in cells} == {cell.slope > 0.3 for cell in cells} == {True, False}


def test_plane_grooves_are_on_and_off_the_middle():
    cells = [drawn("plane_grooves", seed) for seed in range(20000, 20040)]
    assert {kind_of_scene(one).name_of_laws for one in cells} == {"dimples"}
    assert {one.shape for cell in cells for one in cell.geometry.dimples} == {"groove"}
    assert all(0.25 <= cell.depth <= 1 and cell.reynolds_number >= 5 and cell.slope <= 1 for cell in cells)
    assert {cell.geometry.dimples[0].position == 0 for cell in cells} == {True, False}


def test_small_surfaces_are_periods_or_parts_with_and_without_holes():
    maps = [drawn("small_surface", seed).surface().source for seed in range(20000, 20040)]
    assert {one["prepared_from"]["whole"] for one in maps} == {True, False}
    points = [count for one in maps for count in one["prepared_from"]["points"]]
    assert 16 <= min(points) < 20 < 50 < max(points) <= 64
    filled = [one["record"]["invalid"]["fraction"] for one in maps]
    assert min(filled) == 0
    assert max(filled) > 0.5
