"""Closed forms: by quadrature of Reynolds' equation, and what the default solver makes of them."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.bearing.closed_forms.journal import sommerfeld
from roughfilm.rom.bearing.closed_forms.sliding import barus_pressure, linear_slider, rayleigh_step
from roughfilm.rom.bearing.geometry.journal import Journal
from roughfilm.rom.bearing.geometry.shapes import Linear, Step
from roughfilm.rom.bearing.quantities import journal_load
from roughfilm.rom.cavitation.discretise import Ends
from roughfilm.rom.cavitation.evaluation.friction import friction
from roughfilm.rom.cavitation.problem import Problem
from roughfilm.rom.cavitation.solve import solve
from roughfilm.rom.lubricants.viscosity import Barus

FILM, RISE, LENGTH, SPEED, VISCOSITY = 20e-6, 24e-6, 0.05, 3.1, 0.021
LINEAR = Linear(shape="linear", length="50 mm", film="20 um", rise="24 um").film_shape()


def film(shape, **given):
    return Problem(shape=shape, ends=Ends(inlet=0.0), speed=SPEED, viscosity=VISCOSITY, **given)


def test_the_linear_slider_is_the_integral_of_its_own_equation():
    solution = linear_slider(film=FILM, rise=RISE, length=LENGTH, speed=SPEED, viscosity=VISCOSITY)

    def h(x):
        return FILM + RISE * (1 - x / LENGTH)

    full = quad(lambda x: h(x) ** -2, 0, LENGTH)[0] / quad(lambda x: h(x) ** -3, 0, LENGTH)[0]

    def slope(x):
        return 6 * VISCOSITY * SPEED * (h(x) - full) / h(x) ** 3

    assert solution.load == pytest.approx(quad(lambda x: -x * slope(x), 0, LENGTH)[0], rel=1e-10)
    friction = quad(lambda x: VISCOSITY * SPEED / h(x) + h(x) / 2 * slope(x), 0, LENGTH)[0]
    assert solution.friction == pytest.approx(friction, rel=1e-10)
    peak = LENGTH * (1 - (full - FILM) / RISE)
    assert solution.pressure_max == pytest.approx(quad(slope, 0, peak)[0], rel=1e-10)


def test_the_default_solver_makes_the_linear_slider():
    known = linear_slider(film=FILM, rise=RISE, length=LENGTH, speed=SPEED, viscosity=VISCOSITY)
    solution = solve(film(LINEAR), (1000, 1))
    assert solution.levels[-1].load == pytest.approx(known.load, rel=1e-5)
    assert friction(solution) == pytest.approx(known.friction, rel=1e-6)
    assert solution.state.pressure.max() == pytest.approx(known.pressure_max, rel=1e-5)


@pytest.mark.parametrize("jump", [2, 100])
def test_the_default_solver_makes_rayleighs_step(jump):
    """Pressure falls evenly to both sides: trapezoids of any grid with a node at the step are exact."""
    rise = (jump - 1) * FILM
    shape = Step(shape="step", length="50 mm", film="20 um", rise=f"{rise} m", step="35 mm").film_shape()
    known = rayleigh_step(film=FILM, rise=rise, length=LENGTH, step=0.035, speed=SPEED, viscosity=VISCOSITY)
    solution = solve(film(shape), (20, 1))
    assert solution.levels[-1].load == pytest.approx(known.load, rel=1e-10)
    assert solution.state.pressure.max() == pytest.approx(known.pressure_max, rel=1e-10)
    assert friction(solution) == pytest.approx(known.friction, rel=1e-10)


@pytest.mark.parametrize("eccentricity", [0.2, 0.9])
def test_the_default_solver_makes_sommerfelds_bearing(eccentricity):
    geometry = Journal(shape="journal", radius="30 mm", clearance="40 um", eccentricity=eccentricity)
    solution = solve(film(geometry.film_shape()), (2000, 1), ruptures=False)
    known = sommerfeld(radius=0.03, clearance=40e-6, eccentricity=eccentricity, speed=SPEED, viscosity=VISCOSITY)
    angle, load = journal_load(geometry, solution.grid.x, solution.grid.areas * solution.state.pressure)
    assert load == pytest.approx(known.load, rel=1e-8)
    assert angle == pytest.approx(known.attitude_angle, abs=1e-6)


def test_barus_pressure_undoes_the_integral_of_the_fluidity():
    pressure = barus_pressure(3e7, 2e-8)
    assert quad(lambda p: math.exp(-2e-8 * p), 0, pressure)[0] == pytest.approx(3e7, rel=1e-12)
    assert barus_pressure(3e7, 0.0) == 3e7
    assert barus_pressure(3e7, 1e-20) == pytest.approx(3e7, rel=1e-12)


@pytest.mark.parametrize("part", [0.3, 0.8])
def test_the_default_solver_makes_barus_pressure(part):
    reduced = linear_slider(film=FILM, rise=RISE, length=LENGTH, speed=SPEED, viscosity=VISCOSITY).pressure_max
    law = Barus(law="barus", pressure_coefficient=f"{part / reduced} Pa^-1")
    solution = solve(film(LINEAR, piezoviscosity=law), (1000, 1))
    plain = solve(film(LINEAR), (1000, 1))
    assert solution.state.pressure.max() == pytest.approx(barus_pressure(reduced, part / reduced), rel=1e-4)
    everywhere = [barus_pressure(float(p), part / reduced) for p in plain.state.pressure[::100, 0]]
    assert np.allclose(solution.state.pressure[::100, 0], everywhere, rtol=1e-4, atol=0)


@pytest.mark.parametrize(
    ("ask", "match"),
    [
        (lambda: linear_slider(film=1.0, rise=0.0, length=1.0, speed=1.0, viscosity=1.0), "rise"),
        (lambda: rayleigh_step(film=1.0, rise=1.0, length=1.0, step=1.0, speed=1.0, viscosity=1.0), "step"),
        (lambda: sommerfeld(radius=1.0, clearance=0.1, eccentricity=1.0, speed=1.0, viscosity=1.0), "eccentricity"),
        (lambda: barus_pressure(1e8, 1e-8), "reduced"),
    ],
)
def test_what_has_no_closed_form_is_refused(ask, match):
    with pytest.raises(InputError, match=match):
        ask()
