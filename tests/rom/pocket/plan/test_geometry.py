"""Cells in plan: every shape of a dimple has its depth and outline, and every fault is one line that names the key."""

import math

import numpy as np
import pytest
from places import SCENES

from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.ladder.scene import load_scene, read_scene, scene_entries

ROUND = {"width": "0.3 mm", "depth": "7.5 um"}
FLAT = {"width": "0.2 mm", "breadth": "0.4 mm", "depth": "10 um", "edge": "20 um"}
PYRAMID = [[0, 0, 0, 0, 0], [0, 5e-6, 5e-6, 5e-6, 0], [0, 5e-6, 1e-5, 5e-6, 0], [0, 5e-6, 5e-6, 5e-6, 0], [0] * 5]
DIMPLES = {
    "spherical": ROUND,
    "ellipsoidal": {**ROUND, "breadth": "0.5 mm"},
    "conical": ROUND,
    "box": FLAT,
    "chevron": {**FLAT, "angle": "30 deg"},
    "groove": ROUND,
    "points": {"width": "0.3 mm", "breadth": "0.2 mm", "points": PYRAMID},
}


def entries_of(*dimples, **geometry):
    return {
        "name": "dimples",
        "kind": "pocket",
        "geometry": {"length": "1 mm", "breadth": "0.8 mm", "film": "30 um", "dimples": [*dimples], **geometry},
        "lubricant": {"viscosity": "0.01 Pa*s", "density": "1000 kg/m^3"},
        "motion": {"reynolds_number": 40},
    }


def cell_of(shape, arrangement="aligned", **changes):
    return read_scene(entries_of({"shape": shape, **DIMPLES[shape], **changes}, arrangement=arrangement))


def volume(scene, number=800):
    plan = scene.plan()
    x, y = (((np.arange(number) + 0.5) / number - 0.5) * side for side in (plan.length, plan.breadth))
    return (plan.thickness(x[:, None], y) - plan.film).mean() * plan.length * plan.breadth


CAP = math.pi * 7.5e-6 / 6 * (3 * 0.15e-3**2 + 7.5e-6**2)
VOLUMES = {
    "spherical": CAP,
    "ellipsoidal": CAP * 5 / 3,
    "conical": math.pi / 12 * 0.3e-3**2 * 7.5e-6,
    # A frustum of a pyramid with the rectangles 0.2 x 0.4 and 0.16 x 0.36 mm.
    "box": 10e-6 / 3 * (0.08 + 0.0576 + math.sqrt(0.08 * 0.0576)) * 1e-6,
    "points": 1e-5 * 0.075e-3 * 0.05e-3 * (8 * 0.5 + 1),
}


@pytest.mark.parametrize("shape", VOLUMES)
def test_a_dimple_has_the_volume_of_its_shape(shape):
    expected = VOLUMES[shape]
    assert volume(cell_of(shape)) == pytest.approx(expected, rel=4e-3 if shape == "box" else 1e-3)


def test_a_groove_in_plan_is_the_groove_of_two_dimensions():
    plan = cell_of("groove").plan()
    entries = entries_of()
    flat = {"length": "1 mm", "film": "30 um", **ROUND}
    gap = read_scene({**entries, "geometry": flat}).gap()
    x = np.linspace(-1e-3, 1e-3, 401)
    assert plan.thickness(x[:, None], np.array([-3e-4, 0.0])) == pytest.approx(np.tile(gap.thickness(x), (2, 1)).T)


@pytest.mark.parametrize("shape", DIMPLES)
@pytest.mark.parametrize("arrangement", ["aligned", "staggered"])
def test_the_thickness_is_periodic_and_its_entries_are_written_back(shape, arrangement):
    scene = cell_of(shape, arrangement, **({} if shape == "groove" else {"rotation": "20 deg"}))
    assert read_scene(scene_entries(scene)) == scene
    plan = scene.plan()
    rng = np.random.default_rng(1)
    x, y = (rng.uniform(-1, 1, 200) * side for side in (plan.length, plan.breadth))
    here = plan.thickness(x, y)
    assert plan.thickness(x + plan.length, y - 2 * plan.breadth) == pytest.approx(here)
    if arrangement == "staggered":
        assert plan.thickness(x + plan.length / 2, y + plan.breadth / 2) == pytest.approx(here)
    assert here.min() >= plan.film
    assert here.max() <= plan.film * (1 + scene.depth) * (1 + 1e-12)


def test_a_turned_ellipse_lies_along_the_other_axis():
    turned, other = cell_of("ellipsoidal", rotation="90 deg"), cell_of("ellipsoidal", width="0.5 mm", breadth="0.3 mm")
    x, y = np.linspace(-4e-4, 4e-4, 81)[:, None], np.linspace(-4e-4, 4e-4, 77)
    assert turned.plan().thickness(x, y) == pytest.approx(other.plan().thickness(x, y))
    assert turned.plan().breaks_x == pytest.approx(other.plan().breaks_x)


@pytest.mark.parametrize(
    ("shape", "changes", "mirrored"),
    [
        ("chevron", {}, True),
        ("chevron", {"rotation": "90 deg"}, False),
        ("chevron", {"rotation": "180 deg"}, True),
        ("spherical", {"position_across": "0.1 mm"}, False),
        ("spherical", {"position_across": "0.4 mm", "position": "0.1 mm"}, True),
        ("ellipsoidal", {"rotation": "20 deg"}, False),
    ],
)
def test_a_cell_is_mirrored_only_if_its_dimples_are(shape, changes, mirrored):
    assert cell_of(shape, **changes).plan().mirrored is mirrored


def test_a_rounded_rim_has_a_continuous_slope_and_the_same_depth():
    sharp, rounded = cell_of("conical"), cell_of("conical", edge="60 um")
    x = np.linspace(-0.5e-3, 0.5e-3, 40001)
    slopes = [np.gradient(scene.plan().thickness(x, 0 * x), x) for scene in (sharp, rounded)]
    rim = np.abs(np.abs(x) - 0.15e-3) < 40e-6
    jumps = [np.abs(np.diff(slope))[rim[1:]].max() for slope in slopes]
    assert jumps[1] < jumps[0] / 100
    assert rounded.depth == sharp.depth == pytest.approx(0.25)


@pytest.mark.parametrize("depth", [0.02e-3, 0.1e-3, 0.14e-3])
def test_the_widest_rounding_of_a_cap_leaves_its_depth(depth):
    a = 0.15e-3
    widest = (a**2 - depth**2) / a
    scene = cell_of("spherical", depth=f"{depth} m", edge=f"{widest * 0.999} m")
    assert scene.plan().thickness(np.zeros(1), np.zeros(1)) == pytest.approx(scene.geometry.film + depth)
    with pytest.raises(InputError, match=r"dimples.0.edge: got .* it must be 0 to .* would make the dimple deeper"):
        cell_of("spherical", depth=f"{depth} m", edge=f"{widest * 1.001} m")


def test_a_rounding_that_reaches_over_the_border_goes_on_at_the_other_side():
    scene = cell_of("ellipsoidal", width="0.6 mm", breadth="0.79 mm", rotation="30 deg", edge="0.29 mm")
    plan = scene.plan()
    x = np.linspace(-0.5e-3, 0.5e-3, 41)
    sides = [plan.thickness(x, np.array(side * (0.4e-3 - 1e-12))) for side in (-1, 1)]
    assert sides[0].max() > plan.film * 1.001
    assert sides[0] == pytest.approx(sides[1], rel=1e-6)


def test_the_covered_part_is_the_area_of_the_outlines():
    assert cell_of("spherical").geometry.covered == pytest.approx(math.pi / 4 * 0.09 / 0.8, rel=1e-2)
    assert cell_of("spherical", "staggered").geometry.covered == pytest.approx(math.pi / 2 * 0.09 / 0.8, rel=1e-2)


def test_the_example_is_a_cell_in_plan():
    scene = load_scene(SCENES / "dimple.toml")
    assert scene.in_plan
    assert scene.plan().breaks_x == pytest.approx((-1.5e-4, 0, 1.5e-4))


FAULTS = [
    ({"dimples": []}, r"geometry\.dimples: got \[\]"),
    ({"dimples": [{**ROUND, "shape": "square"}]}, r"geometry\.dimples\.0\.shape: got 'square'"),
    ({"dimples": [{"shape": "box", **FLAT, "edge": "0.3 mm"}]}, r"geometry\.dimples\.0\.edge: got 0\.0003 m"),
    ({"dimples": [{"shape": "box", **FLAT, "edge": "1 nm"}]}, r"geometry\.dimples\.0\.edge: got 1e-09 m"),
    ({"dimples": [{"shape": "spherical", **ROUND, "depth": "0.2 mm"}]}, r"geometry\.dimples\.0\.depth: got 0\.0002 m"),
    ({"dimples": [{"shape": "spherical", **ROUND, "dept": "1 um"}]}, r"geometry\.dimples\.0\.dept: unknown key"),
    ({"dimples": [{"shape": "groove", **ROUND, "rotation": "3 deg"}]}, r"geometry\.dimples\.0\.rotation: no key of sh"),
    ({"dimples": [{"shape": "conical", **ROUND, "width": "0.9 mm"}]}, r"geometry\.dimples\.0\.width: got an extent"),
    ({"dimples": [{"shape": "spherical", **ROUND}], "profile": "box"}, r"geometry\.profile: unknown key"),
    ({"dimples": [{"shape": "points", **FLAT, "points": "none.npy"}]}, r"geometry\.dimples\.0\."),
]


@pytest.mark.parametrize(("geometry", "words"), FAULTS)
def test_every_fault_of_a_cell_is_one_line_that_names_the_key(geometry, words):
    entries = entries_of()
    with pytest.raises(InputError, match=r"^scene\." + words):
        read_scene({**entries, "geometry": {**entries["geometry"], **geometry}})


@pytest.mark.parametrize(
    ("rows", "words"),
    [
        ([[0, 0], [0, 0]], "got an array of shape"),
        ([[0, 0, 0], [0, -1e-6, 0], [0, 0, 0]], "never negative"),
        ([[0, 0, 0], [0, 1e-6, 1e-6], [0, 0, 0]], "on the border"),
        ([[0, 0, 0], [0, 1e-6], [0, 0, 0]], "all of one length"),
        ([[0, 0, 0], [0, 0, 0], [0, 0, 0]], "the greatest must be"),
    ],
)
def test_a_map_of_depths_is_checked(rows, words):
    with pytest.raises(InputError, match=words):
        cell_of("points", points=rows)
