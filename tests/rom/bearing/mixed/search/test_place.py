"""Stribeck curves of shafts in lobes: the model at the same load, lift-off, files, and walls that never touch."""

import pytest

from roughfilm.ladder import find
from roughfilm.rom.bearing.mixed.stribeck import stribeck
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene

GROOVED = {
    "shape": "lobes",
    "radius": "10 mm",
    "width": "10 mm",
    "clearance": "10 um",
    "lobes": 2,
    "arc": "160 deg",
    "eccentricity": [0.0, -0.5],
}
PRESSURE = 5e6
CELLS = 24
SPEEDS = (0.0, 0.05, 0.1, 0.5)


FOUND = []
"""The curve, which is solved once: the fixture of its asperities is one of each test."""


@pytest.fixture
def curve(tips):
    if not FOUND:
        FOUND.extend(stribeck(tips.scene(GROOVED), SPEEDS, [PRESSURE], resolution=CELLS))
    return FOUND[0]


def test_points_are_those_of_the_model_from_rest_to_a_full_film(tips, curve):
    shares = [point.contact_share for point in curve.points]
    assert shares[0] == pytest.approx(1, rel=1e-9)
    assert sorted(shares, reverse=True) == shares
    assert shares[-1] == 0
    point = curve.points[1]
    loaded = tips.scene(GROOVED, load={"pressure": "5 MPa"}, motion={"speed": "0.05 m/s"})
    model = find("bearing", "mixed").solve(loaded, Request(resolution=CELLS))
    for name in ("contact_share", "friction_coefficient", "pressure_max", "contact_area", "contact_load"):
        assert getattr(point, name) == pytest.approx(model[name].value, rel=1e-6), name
    assert point.separation == pytest.approx(model["film_min"].value, rel=1e-4)
    assert max(one.balance for one in curve.points) < 1e-6


def test_the_uncertainty_covers_a_finer_grid(tips, curve):
    (fine,) = stribeck(tips.scene(GROOVED), SPEEDS[1:3], [PRESSURE], resolution=64)
    point, finer = curve.points[1], fine.points[0]
    assert point.uncertainty
    for name, bar in point.uncertainty.items():
        assert abs(getattr(point, name) - getattr(finer, name)) <= bar + finer.uncertainty[name], name


def test_at_lift_off_the_film_just_carries_the_load_without_contact(tips, curve):
    speed = curve.lift_off.speed
    assert 0.1 < speed < 0.5
    near = [0.9 * speed, speed * (1 - 1e-3), speed * (1 + 1e-3)]
    (found,) = stribeck(tips.scene(GROOVED), near, [PRESSURE], resolution=CELLS)
    touching, slow, fast = found.points
    assert slow.separation < tips.touching < fast.separation
    assert touching.contact_load > 0 == fast.contact_load


def test_known_points_are_not_solved_again(tips, curve):
    kept = []
    (again,) = stribeck(tips.scene(GROOVED), SPEEDS, [PRESSURE], resolution=CELLS, known=curve.points, keep=kept.append)
    assert again.points == curve.points
    assert not kept


def test_without_asperities_friction_and_film_scale_with_the_number_of_hersey():
    """A film without pressure around it depends on ηu/p alone: the curves of two loads are one."""
    scene = read_scene(
        {
            "name": "smooth",
            "kind": "bearing",
            "geometry": GROOVED,
            "lubricant": {"viscosity": "0.1 Pa*s"},
            "motion": {"speed": "1 m/s"},
        }
    )
    one, other = stribeck(scene, [0.1, 0.5, 1.0, 5.0], [1e6, 5e6], resolution=CELLS)
    by_speed = {point.speed: point for point in other.points}
    for point in one.points[:3:2]:
        same = by_speed[5 * point.speed]
        assert same.separation == pytest.approx(point.separation, rel=1e-5)
        assert same.friction_coefficient == pytest.approx(point.friction_coefficient, rel=1e-5)
        assert point.contact_share == same.contact_share == 0


def test_the_film_of_a_pad_grows_with_the_square_root_of_the_speed():
    scene = read_scene(
        {
            "name": "a pad about its pivot",
            "kind": "bearing",
            "geometry": {"shape": "pivoted", "length": "40 mm", "width": "40 mm", "pivot": [0.6, 0.5]},
            "lubricant": {"viscosity": "30 mPa*s"},
            "motion": {"speed": "10 m/s"},
            "load": {"pressure": "2 MPa"},
        }
    )
    speeds = (0.01, 0.1, 1.0, 10.0)
    (found,) = stribeck(scene, speeds, [2e6], resolution=CELLS)
    first, *others = found.points
    for speed, point in zip(speeds[1:], others, strict=True):
        ratio = (speed / speeds[0]) ** 0.5
        assert point.separation == pytest.approx(ratio * first.separation, rel=1e-6)
        assert point.friction == pytest.approx(ratio * first.friction, rel=1e-6)
        assert point.uncertainty["friction"] < 0.1 * point.friction
