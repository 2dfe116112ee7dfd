"""Films and free walls solved together: squeezed plates, equilibria, and half of a symmetric film."""

import math

import numpy as np
import pytest
from moving_films import CLEARANCE, SPEED, VISCOSITY, drive, flat, full, journal, plates, steady

from roughfilm.rom.cavitation.discretise import Ends
from roughfilm.rom.cavitation.grid import grid
from roughfilm.rom.cavitation.motion.coefficients import coefficients
from roughfilm.rom.cavitation.motion.coupled import settled
from roughfilm.rom.cavitation.motion.film import MovingFilm
from roughfilm.rom.cavitation.problem import Problem
from roughfilm.rom.cavitation.shape import Shape
from roughfilm.rom.cavitation.solve import solve


def test_a_squeezed_line_has_the_parabola_of_the_closed_form():
    film, height, speed = plates(20, length=0.1, viscosity=0.02), 5e-5, 1e-3
    at = steady(film, [height], storage=(0.0, speed))
    exact = 6 * 0.02 * speed * film.grid.x * (0.1 - film.grid.x) / height**3
    np.testing.assert_allclose(at.state.pressure[:, 0], exact, rtol=1e-9, atol=1e-9 * exact.max())


def squeezed_rectangle(length, width, height, viscosity, speed):
    """The force on a rectangular plate that closes, by the Fourier series along x of the pressure."""
    force = 0.0
    for n in range(1, 200, 2):
        k = n * math.pi / length
        force += 1 / n**4 * (1 - math.tanh(k * width / 2) / (k * width / 2))
    return 12 * viscosity * speed / height**3 * 8 * length**3 * width / math.pi**4 * force


def test_a_squeezed_plate_has_the_force_of_the_series_with_second_order():
    length, width, height, viscosity, speed = 0.08, 0.05, 4e-5, 0.03, 1e-3
    shape = Shape(thickness=lambda x, y: 0 * x + 0 * y, breaks=(0.0, length), across=(0.0, width), wide=False)
    problem = Problem(shape=shape, ends=Ends(inlet=0.0, sides=(0.0, 0.0)), speed=0.0, viscosity=viscosity)
    exact = squeezed_rectangle(length, width, height, viscosity, speed)
    errors, sizes = [], np.array([8, 16, 32])
    for size in sizes:
        film = MovingFilm(problem=problem, grid=grid(shape, (size, size)), normals=(flat,))
        errors.append(film.force(steady(film, [height], storage=(0.0, speed)).state.pressure)[0] / exact - 1)
    assert abs(errors[-1]) < 5e-3
    assert np.polyfit(np.log(1 / sizes), np.log(np.abs(errors)), 1)[0] == pytest.approx(2.0, abs=0.1)


def test_the_film_at_given_coordinates_is_that_of_the_steady_solver():
    film = journal((32, 12))
    place = np.array([0.6, 0.1]) * CLEARANCE
    at = steady(film, place)
    shape = film.shape(place)
    # a groove at cavitation pressure at x = 0 is the inlet and the outlet of the same film, cut open there
    cut = Problem(
        shape=Shape(thickness=shape.thickness, breaks=shape.breaks, across=shape.across, wide=False),
        ends=Ends(inlet=0.0, outlet=0.0, sides=(0.0, 0.0)),
        speed=SPEED,
        viscosity=VISCOSITY,
    )
    found = solve(cut, (32, 12))
    np.testing.assert_allclose(
        at.state.pressure, found.state.pressure[:-1], rtol=1e-6, atol=1e-6 * at.state.pressure.max()
    )


def test_a_free_shaft_rests_where_the_film_carries_its_load():
    film = journal((32, 12))
    place = np.array([0.5, 0.1]) * CLEARANCE
    force = film.force(steady(film, place, tolerance=1e-12).state.pressure)
    near = steady(film, place + np.array([-0.03, 0.05]) * CLEARANCE)
    at = settled(film, near, drive(film, force=-force), tolerance=1e-11)
    np.testing.assert_allclose(at.place, place, rtol=1e-6)
    assert at.residual <= 1e-9
    assert at.force_residual <= 1e-9
    np.testing.assert_allclose(film.force(at.state.pressure), force, rtol=1e-8)


def test_half_of_a_symmetric_film_is_the_whole_one():
    whole, half = journal((32, 12)), journal((32, 6), halved=True)
    place = np.array([0.4, 0.3]) * CLEARANCE
    full_width, one_half = (steady(film, place, tolerance=1e-12) for film in (whole, half))
    np.testing.assert_allclose(
        full_width.state.pressure[:, 6:], one_half.state.pressure, rtol=1e-7, atol=1e-9 * one_half.state.pressure.max()
    )
    np.testing.assert_allclose(whole.force(full_width.state.pressure), half.force(one_half.state.pressure), rtol=1e-8)
    ours, theirs = (coefficients(film, at, speed=SPEED) for film, at in ((whole, full_width), (half, one_half)))
    np.testing.assert_allclose(ours.stiffness, theirs.stiffness, rtol=1e-6)
    np.testing.assert_allclose(ours.damping, theirs.damping, rtol=1e-6)


@pytest.mark.parametrize("factor", [1e-3, 1.0, 1e4])
def test_forces_scale_with_viscosity_and_speed(factor):
    """p ∝ η U at one place, whatever the sizes are."""
    place = np.array([0.5, -0.2]) * CLEARANCE
    films = [journal((24, 4), halved=True, speed=SPEED * scale) for scale in (1.0, factor)]
    forces = [
        film.force(settled(film, full(film, place), drive(film), tolerance=1e-11).state.pressure) for film in films
    ]
    np.testing.assert_allclose(forces[1], factor * forces[0], rtol=1e-7)
