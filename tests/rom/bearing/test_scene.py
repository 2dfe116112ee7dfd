"""Scenes of bearings: what is in them, what is refused, and in which words."""

import math

import numpy as np
import pytest
from places import SCENES

from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.ladder.scene import load_entries, load_scene, read_scene, scene_entries

SLIDER = SCENES / "parabolic_slider.toml"


def film_of(scene, x, y=0.0):
    places = np.broadcast_arrays(np.asarray(x, dtype=float), np.asarray(y, dtype=float))
    return scene.geometry.film_shape().thickness(*places)


def changed(**geometry):
    entries = load_entries(SLIDER)
    entries["geometry"] = {"length": "10 mm", "film": "10 um", **geometry}
    return read_scene(entries)


@pytest.mark.parametrize("name", ["parabolic_slider", "journal", "textured_slider"])
def test_a_scene_is_read_back_from_its_entries(name):
    scene = load_scene(SCENES / f"{name}.toml")
    assert isinstance(scene, Bearing)
    assert read_scene(scene_entries(scene)) == scene


@pytest.mark.parametrize(
    ("geometry", "places", "expected"),
    [
        ({"shape": "parallel"}, [0, 5, 10], [10, 10, 10]),
        ({"shape": "linear", "rise": "4 um"}, [0, 5, 10], [14, 12, 10]),
        ({"shape": "step", "rise": "4 um", "step": "7 mm"}, [0, 6.99, 7.01, 10], [14, 14, 10, 10]),
        ({"shape": "parabolic", "rise": "4 um"}, [0, 2.5, 5, 10], [14, 11, 10, 14]),
        ({"shape": "parabolic", "rise": "4 um", "count": 2}, [0, 2.5, 5, 7.5, 10], [14, 10, 14, 10, 14]),
        (
            {"shape": "sinusoidal_inlet", "amplitude": "4 um", "wavelength": "1 mm"},
            [0, 0.25, 0.75, 4.25, 5.25, 10],
            [10, 14, 6, 14, 10, 10],
        ),
        (
            {"shape": "squared_cosine_inlet", "amplitude": "4 um", "wavelength": "1 mm", "extent": "3 mm"},
            [0, 0.25, 0.5, 2, 3.01],
            [14, 12, 10, 14, 10],
        ),
    ],
)
def test_shapes(geometry, places, expected):
    assert film_of(changed(**geometry), np.array(places) * 1e-3) == pytest.approx(np.array(expected) * 1e-6)


def test_a_journal_is_widest_where_it_begins():
    scene = load_scene(SCENES / "journal.toml")
    assert film_of(scene, [0, np.pi * 25e-3 / 2, np.pi * 25e-3]) == pytest.approx([35e-6, 25e-6, 15e-6])
    assert scene.geometry.length == pytest.approx(np.pi * 50e-3)


def test_a_sector_falls_along_the_angle():
    numbers = {"inner_radius": "40 mm", "outer_radius": "80 mm", "angle": "40 deg", "rise": "20 um", "taper": 0.75}
    entries = load_entries(SLIDER)
    entries["geometry"] = {"shape": "sector", "film": "10 um", **numbers}
    scene = read_scene(entries)
    angles = np.radians([0, 15, 30, 40])
    assert film_of(scene, angles, 0.05) == pytest.approx([30e-6, 20e-6, 10e-6, 10e-6])
    assert scene.problem().speed == pytest.approx(4.57 / 0.06)


def test_pockets_lie_where_they_are_put():
    pockets = {"profile": "ellipsoidal", "length": "1 mm", "width": "2 mm", "depth": "5 um", "start": "2 mm"}
    texture = pockets | {"pitch": "2 mm", "columns": 3, "pitch_across": "3 mm", "rows": 2}
    scene = changed(shape="parallel", width="8 mm", texture=texture)
    # rows are centred: middles at y = 2.5 and 5.5 mm; columns at x = 2.5, 4.5 and 6.5 mm
    result = film_of(scene, np.array([2.5, 2.5, 2.5, 4.5, 6.5, 6.75, 8.5, 3.5]) * 1e-3, np.array([2.5, 4, 5.5, 5.5, 5.5, 5.5, 5.5, 5.5]) * 1e-3)  # fmt: skip  # noqa: E501
    assert result == pytest.approx(np.array([15, 10, 15, 15, 15, 13.75, 10, 10]) * 1e-6)
    assert scene.geometry.film_shape().breaks == pytest.approx(np.array([0, 2, 3, 4, 5, 6, 7, 10]) * 1e-3)


@pytest.mark.parametrize(
    ("override", "words"),
    [
        ("geometry.shape=oval", "scene.geometry.shape: got 'oval'; it must be 'parallel'"),
        ("geometry.rises=3 um", "scene.geometry.rises: unknown key; did you mean 'rise'"),
        ("geometry.film=1 m", "scene.geometry.film: got 1.0 m, more than the length of the bearing"),
        ("geometry.count=0", "scene.geometry.count: got 0; it must be at least 1"),
        ("lubricant.viscosity=0", "scene.lubricant.viscosity: got 0, a number without a unit"),
        ("lubricant.compressibility.law=stiff", "law: got 'stiff'; it must be one of 'incompressible'"),
        ("lubricant.compressibility.law=dowson", "must be one of"),
        (
            "lubricant.compressibility.c1=1 GPa",
            "scene.lubricant.compressibility.c1: unknown key; known here: law",
        ),
        ("lubricant.compressibility.bulk_modulus=-1 GPa", "must be above zero"),
        ("boundary.inlet.theta=-1", "must be above zero"),
        ("boundary.inlet.thetta=1", "scene.boundary.inlet.thetta: unknown key; did you mean 'theta'"),
        (
            "boundary.inlet.pressure=-1 MPa",
            "scene.boundary.inlet.pressure: got -1000000.0 Pa; it must be at least",
        ),
        ("boundary.inlet.ram_factor=1 bar", "scene.boundary.inlet.ram_factor: got '1 bar'; write a plain number"),
        ("boundary.inlet.ram_factor=1", "scene.boundary.inlet.ram_factor: got 1 without lubricant.density, by which"),
        ('boundary.inlet={"theta": 1, "ram_factor": 1}', "got theta, which determines the pressure, and ram_factor"),
        ("boundary.outlet.pressure=-1 MPa", "scene.boundary.outlet.pressure: got -1000000.0 Pa; it must be at least"),
        ("lubricant.cavitation_pressure=1 MPa", "it must be at least the cavitation pressure"),
        ("motion.speed=nan m/s", "write a number and a unit"),
        ("geometry.shape=[1]", "scene.geometry.shape: got [1]; it must be"),
        ("geometry.shape={}", "scene.geometry.shape: got {}; it must be"),
        ("geometry.rise=1 m", "scene.geometry.rise: got 1.0 m, more than the length of the bearing"),
        ("geometry.width=1 nm", "scene.geometry.width: got 1e-09 m, less than the film thickness"),
        ('boundary.sides={"low": "1 bar"}', "boundary.sides: got pressures for an infinitely wide bearing"),
        ('geometry.texture={"length": "1 mm", "depth": "1 um", "columns": 3}', "geometry.texture.pitch: is missing"),
        (
            'geometry.texture={"length": "1 mm", "depth": "1 um", "start": "76 mm"}',
            "geometry.texture: extends from",
        ),
    ],
)
def test_errors_are_reported_in_one_line(override, words):
    with pytest.raises(InputError) as caught:
        load_scene(SLIDER, [override])
    assert words in str(caught.value)
    assert "\n" not in str(caught.value)


def test_an_incompressible_lubricant_cannot_be_pressurised_by_its_density():
    with pytest.raises(InputError, match=r"boundary\.inlet\.theta: got 1\.1 for an incompressible"):
        load_scene(SLIDER, ["lubricant.compressibility.law=incompressible", "boundary.inlet.theta=1.1"])


def test_a_law_takes_the_numbers_of_another_away():
    scene = load_scene(SLIDER, ["lubricant.compressibility.law=dowson_higginson", "lubricant.compressibility.c2=1.66"])
    assert scene.lubricant.compressibility.c2 == 1.66
    other = load_scene(SLIDER, ["boundary.inlet.pressure=2 bar"])
    assert other.ends.inlet == pytest.approx(2e5)


def test_density_and_pressure_at_the_inlet_are_the_same_thing():
    scene = load_scene(SLIDER, ["boundary.inlet.theta=1.001"])
    assert scene.ends.inlet == pytest.approx(0.069e9 * np.log(1.001))
    starved = load_scene(SLIDER, ["boundary.inlet.theta=0.55"])
    assert (starved.ends.inlet, starved.ends.theta) == (None, 0.55)


def test_the_ram_pressure_adds_to_the_pressure_at_the_inlet_and_grows_with_the_square_of_speed():
    given = ["lubricant.density=900 kg/m^3", "boundary.inlet.ram_factor=0.5", "boundary.inlet.pressure=1 bar"]
    scene = load_scene(SLIDER, [*given, "lubricant.cavitation_pressure=-0.5 bar", "motion.speed=10 m/s"])
    assert scene.inlet_pressure == pytest.approx(1e5 + 0.5 * 900 * 10**2 / 2)
    assert scene.ends.inlet == pytest.approx(scene.inlet_pressure + 0.5e5)
    assert scene.at_speed(20.0).inlet_pressure == pytest.approx(1e5 + 0.5 * 900 * 20**2 / 2)
    assert scene.at_speed(-10.0).inlet_pressure == scene.inlet_pressure
    with pytest.raises(InputError, match=r"inlet\.pressure: got -45000\.0 Pa with the ram pressure; it must be at"):
        load_scene(SLIDER, [given[0], "boundary.inlet.ram_factor=-1", "motion.speed=10 m/s"])


def test_pressures_count_from_ambient():
    scene = load_scene(SLIDER, ["lubricant.cavitation_pressure=-0.5 bar", "boundary.inlet.pressure=1 bar"])
    assert (scene.ends.inlet, scene.ends.outlet) == (pytest.approx(1.5e5), pytest.approx(0.5e5))


def sector(**more):
    entries = load_entries(SLIDER)
    numbers = {"inner_radius": "40 mm", "outer_radius": "80 mm", "angle": "40 deg", "rise": "20 um", "taper": 0.75}
    entries["geometry"] = {"shape": "sector", "film": "10 um", "joined": True, **numbers}
    entries["boundary"] = {"sides": {"low": "1 bar"}, **more}
    return read_scene(entries)


def test_a_ring_of_pads_that_nothing_feeds_is_refused():
    assert sector().geometry.joined
    with pytest.raises(InputError, match=r"boundary\.sides: got no pressure above the cavitation pressure of 0\.0 Pa"):
        sector(sides={})
    for ends in ({"inlet": {"theta": 0.5}}, {"inlet": {"pressure": "1 bar"}}, {"outlet": {"pressure": "1 bar"}}):
        with pytest.raises(InputError, match="boundary: got an inlet or outlet, but joined pads"):
            sector(**ends)


def test_joined_pads_follow_one_another_without_a_gap():
    assert film_of(sector(), np.radians([-1, 39, 41, 1]), 0.05) == pytest.approx([10e-6, 10e-6, 30e-6 - 20e-6 / 30, 30e-6 - 20e-6 / 30])  # fmt: skip  # noqa: E501


def test_a_tabulated_lubricant_may_be_starved():
    entries = load_entries(SLIDER)
    entries["lubricant"]["compressibility"] = {"law": "tabulated", "table": [[0, 850], [1e7, 860], [2e7, 869]]}
    entries["boundary"]["inlet"] = {"theta": 0.55}
    assert read_scene(entries).ends.theta == 0.55


def test_liquids_that_roelands_law_would_thin_are_refused():
    law = ["lubricant.piezoviscosity.law=roelands", "lubricant.piezoviscosity.index=0.6"]
    with pytest.raises(InputError, match="got roelands for 1e-05 Pa s"):
        load_scene(SLIDER, [*law, "lubricant.viscosity=1e-5 Pa*s"])


def test_inlet_and_outlet_of_a_journal_are_one_groove():
    scene = load_scene(SCENES / "journal.toml", ["boundary.inlet.pressure=1 bar"])
    assert (scene.ends.inlet, scene.ends.outlet) == (1e5, 1e5)


@pytest.mark.parametrize("speed", ["3000 rpm", "50 Hz", "50 rev/s", "3000 1/min", "314.1592653589793 rad/s"])
@pytest.mark.parametrize(("name", "radius"), [("journal", 0.025), ("washer", 0.165)])
def test_a_rotational_speed_is_that_of_the_wall_at_the_radius(name, radius, speed):
    scene = load_scene(SCENES / f"{name}.toml", [f"motion.speed={speed}"])
    assert scene.turning_radius == pytest.approx(radius)
    assert scene.motion.speed == pytest.approx(2 * math.pi * 50 * radius)


def test_nothing_rotates_in_a_pad():
    with pytest.raises(InputError, match=r"scene\.motion\.speed: got '3000 rpm'.* no wall rotates here"):
        load_scene(SCENES / "pad.toml", ["motion.speed=3000 rpm"])


def test_a_kinematic_viscosity_needs_the_density():
    scene = load_scene(SCENES / "journal.toml", ["lubricant.viscosity=46 cSt", "lubricant.density=870 kg/m3"])
    assert scene.lubricant.viscosity == pytest.approx(46e-6 * 870)
    with pytest.raises(InputError, match=r"scene\.lubricant\.viscosity: got '46 cSt'.* add the key density"):
        load_scene(SCENES / "journal.toml", ["lubricant.viscosity=46 cSt"])
