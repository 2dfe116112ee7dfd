"""Stiffness and damping of shafts in lobes: differences, scaling, symmetry, pads, and what is refused or left out."""

import math
import tomllib
from dataclasses import replace

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.bearing.dynamics.point import GridPoint, finished
from roughfilm.rom.bearing.dynamics.store import (
    dimensionless_of,
    known_points,
    point_inputs,
    resumed_dynamics,
    save_points,
    write_csv,
    write_ross,
)
from roughfilm.rom.bearing.dynamics.sweep import at_operation, dynamics, mass_of
from roughfilm.rom.bearing.dynamics.whirl import Whirl, rigid_whirl
from roughfilm.rom.bearing.free.equilibrium import equilibrium
from roughfilm.rom.bearing.free.film import free_film
from roughfilm.rom.bearing.moving.body import Body
from roughfilm.rom.ladder.model import silent
from roughfilm.rom.ladder.scene import read_scene
from roughfilm.words.dynamics import answer_of

GROOVED = {"shape": "lobes", "lobes": 2, "arc": "160 deg", "radius": "50 mm", "clearance": "50 um", "width": "100 mm"}
PADS = GROOVED | {"lobes": 4, "arc": "70 deg", "first": "-135 deg", "preload": 0.3, "pivot": 0.55, "offset": 0.55}
PRESSURE, CELLS = 2e6, 48


def scene(geometry=GROOVED, speed="3000 rpm", viscosity="20 mPa*s", **load):
    return read_scene(
        {
            "name": "bearing",
            "kind": "bearing",
            "geometry": geometry,
            "lubricant": {"viscosity": viscosity},
            "motion": {"speed": speed},
            "load": {"pressure": "2 MPa", **load},
        }
    )


def swept(bearing, *speeds, pressures=(PRESSURE,), **more):
    return dynamics(bearing, speeds or [abs(bearing.motion.speed)], pressures, resolution=CELLS, **more)


@pytest.fixture(scope="module")
def curve():
    (found,) = swept(scene(), 5.0, 10.0, 20.0, 60.0, mass=2000.0)
    return found


@pytest.mark.parametrize("geometry", [GROOVED, PADS], ids=["grooves", "pads"])
def test_loads_that_differ_a_little_move_the_shaft_by_the_inverse_of_the_stiffness(geometry):
    """No derivative of the code takes part; pads that tilt follow, which is the stiffness of slow motions."""
    bearing = at_operation(scene(geometry), 10.0, PRESSURE)
    film = free_film(bearing, (CELLS, CELLS // 2))
    start = equilibrium(film, None, tolerance=1e-12)
    moved = []
    for axis in range(2):
        change = 1e-4 * np.linalg.norm(film.load) * np.eye(film.load.size)[axis]
        ends = [equilibrium(film, start, tolerance=1e-12, load=film.load + sign * change).place for sign in (1, -1)]
        moved.append((ends[0] - ends[1])[:2] / (2 * change[axis]))
    (found,) = swept(scene(geometry), 10.0, frequency_ratio=0.0)
    point = found.points[0]
    assert np.linalg.inv(np.transpose(moved)) == pytest.approx(point.stiffness, rel=1e-3, abs=1e-4 * point.load / 5e-5)


def test_damping_is_symmetric_and_whirl_is_near_half_of_the_rotation(curve):
    for point in curve.points:
        assert point.damping[0, 1] == pytest.approx(point.damping[1, 0], rel=1e-6)
        assert np.linalg.eigvalsh(point.damping).min() > 0
    assert curve.points[-1].numbers["whirl_ratio"] == pytest.approx(0.5, abs=0.01)
    assert np.all(np.diff([point.numbers["critical_mass"] for point in curve.points]) < 0)


def test_the_critical_mass_is_that_of_published_coefficients():
    """Lund and Thomsen 1978, S = 0.991, as read in the literature tests of ROSS; x points along the load there."""
    printed = rigid_whirl(np.array([[1.56, 7.29], [-2.16, 1.52]]), np.array([[14.66, 1.58], [1.58, 4.49]]))
    bearing = scene()
    pressure = 0.02 * 50 * 1e6 / 0.991
    (found,) = swept(bearing, pressures=[pressure])
    point = found.points[0]
    scale = 5e-5 * point.rotation**2 / point.load
    assert point.numbers["critical_mass"] * scale == pytest.approx(1 / printed.inverse_mass, rel=0.01)
    assert point.numbers["whirl_ratio"] == pytest.approx(math.sqrt(printed.frequency_squared), rel=5e-3)


def test_a_heavier_rotor_becomes_unstable_where_the_critical_mass_falls_to_its_own(curve):
    assert curve.points[2].rotation < curve.onset.rotation < curve.points[3].rotation
    (near,) = swept(scene(), curve.onset.rotation * 0.05)
    assert near.points[0].numbers["critical_mass"] == pytest.approx(2000.0, rel=2e-3)
    assert 0 < curve.onset.uncertainty < 0.1 * curve.onset.rotation
    (light,) = swept(scene(), 5.0, mass=1e-3)
    (heavy,) = swept(scene(), 5.0, mass=1e9)
    assert light.onset.rotation == math.inf
    assert math.isnan(heavy.onset.rotation)


def test_the_mass_is_that_of_the_body_of_the_scene_and_has_no_part_in_the_points():
    heavy = scene().model_copy(update={"body": Body(mass="40 kg")})
    assert (mass_of(scene()), mass_of(heavy)) == (None, 40.0)
    assert point_inputs(heavy, CELLS, 1.0).digest == point_inputs(scene(), CELLS, 1.0).digest


def test_a_pad_with_a_mass_has_stiffness_and_damping_and_no_onset_of_whirl():
    pad = scene({"shape": "pivoted", "length": "50 mm", "width": "50 mm", "pivot": 0.58}, speed="5 m/s")
    heavy = pad.model_copy(update={"body": Body(mass="40 kg")})
    assert mass_of(heavy) is None
    (found,) = dynamics(heavy, [5.0], [PRESSURE], resolution=32, mass=mass_of(heavy))
    assert found.onset is None
    assert found.points[0].numbers["stiffness"] > 0
    with pytest.raises(InputError, match="mass: got 40 kg for a pad, which does not whirl"):
        dynamics(heavy, [5.0], [PRESSURE], resolution=32, mass=40.0)


def test_a_point_is_the_same_to_the_last_bit_after_other_points_and_alone():
    """A sweep that was stopped goes on to the numbers that it would have found at once."""
    grooved = scene()
    (whole,) = dynamics(grooved, [5.0, 10.0, 20.0], [PRESSURE], resolution=CELLS)
    (rest,) = dynamics(grooved, [5.0, 10.0, 20.0], [PRESSURE], resolution=CELLS, known=whole.points[:2])
    assert rest.points[2].numbers == whole.points[2].numbers
    assert rest.points[2].spectrum == whole.points[2].spectrum
    assert rest.points[2].uncertainty == whole.points[2].uncertainty


def test_dimensionless_coefficients_depend_on_the_sommerfeld_number_alone(curve):
    """Twice the viscosity at half the speed, and another size of bearing at the same ratios."""
    one = dimensionless_of(scene(), curve.points[2])
    thick = scene(viscosity="40 mPa*s")
    (other,) = swept(thick, 10.0)
    assert dimensionless_of(thick, other.points[0]) == pytest.approx(one, rel=1e-6)
    small = scene(GROOVED | {"radius": "5 mm", "width": "10 mm", "clearance": "5 um"})
    (tiny,) = swept(small, 2.0)
    assert dimensionless_of(small, tiny.points[0]) == pytest.approx(one, rel=1e-6)


def test_a_shaft_that_turns_back_is_the_mirror_image_and_its_table_for_ross_is_the_same(curve, tmp_path):
    bearing = scene(speed="-3000 rpm")
    (back,) = swept(bearing, 5.0, 10.0, 20.0, 60.0)
    flip = np.diag([-1.0, 1.0])
    for one, other in zip(curve.points, back.points, strict=True):
        assert flip @ other.stiffness @ flip == pytest.approx(one.stiffness, rel=1e-6)
        assert other.numbers["attitude_angle"] == pytest.approx(one.numbers["attitude_angle"], rel=1e-6)
    write_ross(tmp_path / "forth.toml", scene(), curve)
    write_ross(tmp_path / "back.toml", bearing, back)
    forth, mirrored = (numbers_of(tmp_path / f"{name}.toml") for name in ("forth", "back"))
    assert np.shape(forth["kxy"]) == (len(forth["speed"]), len(forth["frequency"]))
    assert np.array(mirrored["kxy"]) == pytest.approx(np.array(forth["kxy"]), rel=1e-6)
    for name, version in (("old", 2), ("new", 3)):
        write_ross(tmp_path / f"{name}.toml", scene(), curve, version=version)
    old, new = (numbers_of(tmp_path / f"{name}.toml") for name in ("old", "new"))
    assert old.keys() == new.keys() - {"speed"}
    assert old["frequency"] == new["speed"]
    assert old["kxx"] == [point.numbers["stiffness_xx"] for point in curve.points]


def numbers_of(path):
    (element,) = tomllib.loads(path.read_text(encoding="utf-8")).values()
    return element


def test_pads_that_tilt_have_little_cross_stiffness_and_carry_any_mass():
    """Pads take no moment, so that no force turns round with the shaft; the load is between two pads."""
    (found,) = swept(scene(PADS))
    stiffness = found.points[0].stiffness
    assert stiffness[0, 1] == pytest.approx(stiffness[1, 0], rel=1e-3)
    assert abs(stiffness[0, 1]) < 0.05 * stiffness[1, 1]
    assert abs(found.points[0].numbers["attitude_angle"]) < 1
    assert found.points[0].numbers["critical_mass"] == math.inf


def test_the_film_of_a_pad_about_its_pivot_is_as_the_root_of_the_speed_and_its_stiffness_as_load_over_film():
    """W ∝ u/h² at the tilt over the film that the pivot sets."""
    pad = {"shape": "pivoted", "length": "50 mm", "width": "50 mm", "pivot": [0.58, 0.5]}
    (found,) = swept(scene(pad, speed="10 m/s"), 5.0, 10.0, 20.0, pressures=[8e5])
    films = [point.numbers["film_min"] for point in found.points]
    assert np.diff(np.log(films)) == pytest.approx(np.log(2) / 2, rel=1e-3)
    for point in found.points:
        ratio = point.numbers["stiffness"] * point.numbers["film_min"] / point.load
        assert ratio == pytest.approx(found.points[0].stiffness[0, 0] * films[0] / found.points[0].load, rel=1e-3)


def test_uncertainties_cover_the_numbers_on_a_finer_grid(curve):
    (fine,) = dynamics(scene(), [10.0], [PRESSURE], resolution=4 * CELLS)
    point = curve.points[1]
    for name, value in fine.points[0].numbers.items():
        assert abs(value - point.numbers[name]) <= point.uncertainty[name] + 1e-12 * abs(value), name


@pytest.mark.parametrize(
    ("speed", "viscosity", "force"), [("1500 rpm", "100 mPa*s", "20 N"), ("300 rpm", "20 mPa*s", "1 N")]
)
def test_a_full_film_has_no_direct_stiffness_whirls_at_half_of_the_speed_and_carries_no_mass(speed, viscosity, force):
    """The force of a full film is across the displacement: K has no symmetric part, B none but the diagonal."""
    bore = {"shape": "lobes", "radius": "50 mm", "clearance": "100 um", "width": "30 mm"}
    oil = {"viscosity": viscosity, "cavitation_pressure": "-100 MPa"}
    tables = {"geometry": bore, "lubricant": oil, "motion": {"speed": speed}, "load": {"force": force}}
    bearing = read_scene({"name": "full", "kind": "bearing", **tables})
    (curve,) = dynamics(bearing, [bearing.motion.speed], [bearing.load_pressure], resolution=32)
    numbers = curve.points[0].numbers
    cross = numbers["stiffness_xy"]
    assert abs(numbers["stiffness_xx"]) < 1e-8 * cross > 0
    assert numbers["stiffness_yx"] == pytest.approx(-cross, rel=0.05)
    assert numbers["critical_mass"] == 0
    assert numbers["whirl_ratio"] == pytest.approx(0.5, rel=0.03)
    assert answer_of(bearing, curve).startswith("a rigid rotor is stable at no mass at ")


def test_a_mass_whose_limit_is_not_known_has_no_uncertainty():
    def on(cells, inverse):
        return GridPoint(cells=cells, numbers={}, whirl=Whirl(inverse_mass=inverse, frequency_squared=inverse * 1e4))

    numbers, errors = finished([on(64, 1e-3), on(32, 1.01e-3), on(16, 1.05e-3)], 10.0)
    assert numbers["critical_mass"] == pytest.approx(1000.0)
    assert 0 < errors["critical_mass"] < 100
    numbers, errors = finished([on(64, -1e-3), on(32, -1.01e-3), on(16, -1.05e-3)], 10.0)
    assert numbers["critical_mass"] == math.inf
    assert errors == {"critical_mass": 0.0, "whirl_ratio": 0.0}
    numbers, errors = finished([on(64, -1e-4), on(32, 5e-4), on(16, 1e-3)], 10.0)
    assert (numbers["critical_mass"], errors["critical_mass"]) == (math.inf, math.inf)


def test_speeds_without_an_equilibrium_are_left_out_and_said():
    (found,) = swept(scene(), 1e-3, 5.0)
    assert [point.speed for point in found.points] == [5.0]
    assert found.omitted[0].speed == 1e-3
    assert "no film above" in found.omitted[0].reason


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"speeds": [0.0]}, "speeds: got 0.0"),
        ({"speeds": []}, "speeds: are missing"),
        ({"speeds": [1.0, 1.0]}, "speeds: got the same number twice"),
        ({"pressures": [math.inf]}, "loads: got inf"),
        ({"resolution": 8}, "resolution: got 8"),
        ({"frequency_ratio": -1.0}, "frequency_ratio: got -1.0"),
        ({"mass": 0.0}, "mass: got 0.0 kg"),
    ],
)
def test_numbers_out_of_range_are_refused(change, message):
    arguments = {"speeds": [1.0], "pressures": [1e6]} | change
    with pytest.raises(InputError, match=message):
        dynamics(scene(), arguments.pop("speeds"), arguments.pop("pressures"), **arguments)


def test_other_shapes_are_refused():
    pad = {"shape": "linear", "length": "50 mm", "width": "50 mm", "film": "20 um", "rise": "20 um"}
    with pytest.raises(InputError, match=r"geometry\.shape: got 'linear'"):
        dynamics(scene(pad, speed="10 m/s"), [1.0], [1e6])


def test_points_are_kept_and_not_solved_again(curve, tmp_path):
    path, bearing = tmp_path / "dynamics.h5", scene()
    inputs = point_inputs(bearing, CELLS, 1.0)
    save_points(path, inputs, curve.points[:2])
    assert known_points(path, inputs) == curve.points[:2]
    options = {"resolution": CELLS, "frequency_ratio": 1.0, "mass": None, "progress": silent}
    (found,), known = resumed_dynamics(bearing, [5.0, 10.0], [PRESSURE], path, **options)
    assert known == 2
    assert found.points == curve.points[:2]
    with pytest.raises(InputError, match="holds another table"):
        resumed_dynamics(scene(PADS), [5.0], [PRESSURE], path, **options)
    never = replace(curve.points[0], numbers={**curve.points[0].numbers, "critical_mass": math.inf})
    save_points(path, inputs, [never])
    assert known_points(path, inputs) == (never,)


def test_tables_have_a_row_for_each_speed(curve, tmp_path):
    write_csv(tmp_path / "dynamics.csv", scene(), [curve])
    lines = (tmp_path / "dynamics.csv").read_text(encoding="utf-8").splitlines()
    assert lines[0].startswith("pressure (Pa), load (N), speed (m/s), rotation (rad/s), stiffness_xx (N/m)")
    assert len(lines) == 1 + len(curve.points)
    first, *others = curve.points
    known = replace(first, numbers=dict(reversed(first.numbers.items())))
    write_csv(tmp_path / "resumed.csv", scene(), [replace(curve, points=(known, *others))])
    assert (tmp_path / "resumed.csv").read_text(encoding="utf-8").splitlines() == lines
    write_ross(tmp_path / "ross.toml", scene(), curve)
    element = numbers_of(tmp_path / "ross.toml")
    assert element["speed"] == [point.rotation for point in curve.points]
    for column, entry in (("kxx", "stiffness_xx"), ("cyx", "damping_yx")):
        synchronous = [
            row[element["frequency"].index(at)] for row, at in zip(element[column], element["speed"], strict=True)
        ]
        assert synchronous == pytest.approx([point.numbers[entry] for point in curve.points], rel=1e-12)


def test_the_side_leakage_beside_grooves_of_another_pressure_is_unknown():
    fed = read_scene(
        {
            "name": "fed",
            "kind": "bearing",
            "geometry": GROOVED,
            "lubricant": {"viscosity": "20 mPa*s"},
            "motion": {"speed": "3000 rpm"},
            "boundary": {"inlet": {"pressure": "1 bar"}},
            "load": {"pressure": "2 MPa"},
        }
    )
    (found,) = swept(fed)
    (point,) = found.points
    assert math.isinf(point.uncertainty["side_leakage"])
    assert math.isfinite(point.uncertainty["stiffness_yy"])
