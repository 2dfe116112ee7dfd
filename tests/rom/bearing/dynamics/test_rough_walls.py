"""Stiffness and damping of shafts on rough walls: against differences of equilibria and slow marches, into contact."""

import math
from dataclasses import replace

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.bearing.dynamics.balance import Equilibrium
from roughfilm.rom.bearing.dynamics.point import grid_point
from roughfilm.rom.bearing.dynamics.sweep import at_operation, dynamics
from roughfilm.rom.bearing.dynamics.wall_errors import wall_errors
from roughfilm.rom.bearing.free.equilibrium import equilibrium
from roughfilm.rom.bearing.free.film import free_film
from roughfilm.rom.bearing.march.rough_walls import Walls, walls_of
from roughfilm.rom.cavitation.motion.coefficients import coefficients
from roughfilm.rom.ladder.scene import read_scene

GROOVED = {"shape": "lobes", "lobes": 2, "arc": "160 deg", "radius": "10 mm", "width": "10 mm", "clearance": "10 um"}
RIDGES = {"kind": "sinusoid", "amplitude": "2 um", "wavelength": "100 um"}
PRESSURE, CELLS = 5e6, 32
SPEEDS = 0.05, 0.2, 2.0
SHIFT = 2e-8


@pytest.fixture
def touching(tips):
    return tips.scene(GROOVED, load={"pressure": "5 MPa"})


def ridged(**tables):
    entries = {"lubricant": {"viscosity": "0.1 Pa*s"}, "motion": {"speed": "2 m/s"}, "load": {"pressure": "5 MPa"}}
    return read_scene(
        {"name": "ridges", "kind": "bearing", "geometry": GROOVED, "roughness": RIDGES} | entries | tables
    )


class Uncertain(Walls):
    """Walls whose contact pressures are those at a separation that is uncertain by ``SHIFT``."""

    def of_contact(self, _film):
        return 0.01, SHIFT


def film_of(scene, cells=CELLS):
    walls = walls_of(scene)
    return free_film(scene, (cells, cells // 2), film=walls.film, contact=walls.contact, closest=walls.closest)


def test_contact_takes_over_the_load_as_the_shaft_slows_down(touching):
    """Uncertainties cover the numbers on a finer grid."""
    (curve,) = dynamics(touching, SPEEDS, [PRESSURE], resolution=CELLS)
    slow, mixed, fast = curve.points
    assert slow.numbers["contact_share"] > 0.5 > mixed.numbers["contact_share"] > 0.01
    assert (fast.numbers["contact_share"], fast.numbers["contact_load"]) == (0, 0)
    assert slow.stiffness[1, 1] > mixed.stiffness[1, 1] > fast.stiffness[1, 1]
    for point in curve.points:
        assert np.linalg.eigvalsh(point.damping + point.damping.T).min() > 0
    (fine,) = dynamics(touching, [mixed.speed], [PRESSURE], resolution=3 * CELLS)
    for name, value in fine.points[0].numbers.items():
        if math.isfinite(value):
            assert abs(value - mixed.numbers[name]) <= mixed.uncertainty[name] + 1e-12 * abs(value), name


def test_loads_that_differ_a_little_move_the_shaft_by_the_inverse_of_the_stiffness(touching):
    """No derivative of the code takes part: film, flow factors and contact pressures change with the separation."""
    for bearing, speed in ((touching, 0.05), (ridged(), 2.0)):
        film = film_of(at_operation(bearing, speed, PRESSURE))
        start = equilibrium(film, None, tolerance=1e-12)
        moved = []
        for change in 1e-4 * np.linalg.norm(film.load) * np.eye(2):
            ends = [equilibrium(film, start, tolerance=1e-12, load=film.load + sign * change).place for sign in (1, -1)]
            moved.append((ends[0] - ends[1]) / (2 * np.abs(change).max()))
        found = coefficients(film.solved, start, speed=speed).stiffness
        assert np.linalg.inv(np.transpose(moved)) == pytest.approx(found, rel=1e-4)


@pytest.mark.parametrize("seed", range(3))
def test_random_shafts_in_contact_are_mirrored_with_their_load_and_scale_with_the_viscosity(tips, seed):
    rng = np.random.default_rng(seed)
    speed, thin, angle = 10 ** rng.uniform(-1.5, -0.5), rng.uniform(2, 5), rng.uniform(-110, -70)

    def point(speed, viscosity, angle):
        lubricant, load = {"viscosity": f"{viscosity!r} Pa*s"}, {"pressure": "5 MPa", "angle": f"{angle!r} deg"}
        scene = tips.scene(GROOVED, lubricant=lubricant, motion={"speed": f"{speed!r} m/s"}, load=load)
        film = film_of(scene, 16)
        return grid_point(film, equilibrium(film, None, tolerance=1e-11), 1.0).numbers

    own, mirrored = point(speed, 0.1, angle), point(-speed, 0.1, -180 - angle)
    thinner = point(thin * speed, 0.1 / thin, angle)
    assert own["contact_share"] > 0
    for matrix, scale in (("stiffness", 1.0), ("damping", thin)):
        size = abs(own[f"{matrix}_yy"])
        for entry, sign in (("xx", 1), ("xy", -1), ("yx", -1), ("yy", 1)):
            name = f"{matrix}_{entry}"
            assert sign * mirrored[name] == pytest.approx(own[name], rel=1e-5, abs=1e-6 * size)
            assert scale * thinner[name] == pytest.approx(own[name], rel=1e-5, abs=1e-6 * size)


def test_thicker_oil_moves_the_shaft_as_pressures_of_an_uncertain_film_do():
    bearing = at_operation(ridged(), 2.0, PRESSURE)
    film, walls = film_of(bearing), replace(walls_of(bearing), of_factors=lambda _film: 0.02)
    instant = equilibrium(film, None, tolerance=1e-11)
    error = wall_errors(bearing, walls, Equilibrium(film=film, instant=instant, cells=film.whole.grid.shape), 1.0)
    thick = film_of(at_operation(ridged(lubricant={"viscosity": "0.102 Pa*s"}), 2.0, PRESSURE))
    own, other = grid_point(film, instant, 1.0), grid_point(thick, equilibrium(thick, None, tolerance=1e-11), 1.0)
    for name in ("film_min", "stiffness_xx", "damping_xy", "pressure_max"):
        assert error(name) == pytest.approx(abs(other.numbers[name] - own.numbers[name]), rel=1e-3), name
    assert error("inverse_mass") == pytest.approx(abs(other.whirl.inverse_mass - own.whirl.inverse_mass), rel=1e-3)


def test_a_shaft_that_rests_on_its_asperities_moves_with_their_uncertain_separation(touching):
    bearing = at_operation(touching, 1e-3, PRESSURE)
    film, own = film_of(bearing), walls_of(bearing)
    walls = Uncertain(film=own.film, contact=own.contact, factors=own.factors, of_factors=lambda _film: 0.0)
    found = Equilibrium(film=film, instant=equilibrium(film, None, tolerance=1e-10), cells=film.whole.grid.shape)
    error = wall_errors(bearing, walls, found, 1.0)
    assert error("film_min") == pytest.approx(SHIFT, rel=0.05)


def test_what_is_not_known_of_the_walls_is_not_known_of_the_numbers(touching):
    bearing = at_operation(touching, 0.05, PRESSURE)
    film, walls = film_of(bearing), replace(walls_of(bearing), of_factors=lambda _film: math.inf)
    found = Equilibrium(film=film, instant=film.first(film.wall.place), cells=film.whole.grid.shape)
    assert wall_errors(bearing, walls, found, 1.0)("stiffness_xx") == math.inf
    assert wall_errors(bearing, Walls(), found, 1.0)("stiffness_xx") == 0


def test_a_load_beyond_the_walls_is_one_line(touching):
    for bearing, speed, pressure, words in (
        (touching, 1e-4, 16e6, "larger loads"),
        (ridged(), 0.01, PRESSURE, "the thinnest of which flow factors are known"),
    ):
        film = film_of(at_operation(bearing, speed, pressure))
        with pytest.raises(InputError, match=words):
            equilibrium(film, None, tolerance=1e-8)
