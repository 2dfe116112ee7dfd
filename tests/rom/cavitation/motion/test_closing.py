"""Cavities that close in time: their last step and the next have no more pressure than a full film."""

import math
from dataclasses import replace

import numpy as np
import pytest
from moving_films import CLEARANCE, course, drive, full, journal, plates
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, minimize_scalar

from roughfilm.rom.cavitation.balance import CAVITY
from roughfilm.rom.cavitation.discretise import Ends
from roughfilm.rom.cavitation.grid import grid
from roughfilm.rom.cavitation.motion.coupled import settled
from roughfilm.rom.cavitation.motion.film import MovingFilm
from roughfilm.rom.cavitation.motion.march import begun, march
from roughfilm.rom.cavitation.problem import Problem
from roughfilm.rom.cavitation.shape import Shape

HALF, VISCOSITY, AMBIENT, PERIOD = 0.01, 0.05, 1e5, 0.2


def gap(time):
    return 10e-6 - 3.5e-6 * math.cos(2 * math.pi * time / PERIOD)


def opening(time):
    return 3.5e-6 * 2 * math.pi / PERIOD * math.sin(2 * math.pi * time / PERIOD)


def full_pressure(time):
    """The pressure in the middle of a full film above ambient, p = -6 η h' a²/h³."""
    return -6 * VISCOSITY * opening(time) * HALF**2 / gap(time) ** 3


def closing_time():
    """The time at which the cavity between oscillating plates closes, from its edge c by the balance of mass.

    The film ruptures where p = p' = 0, at a - c = √(p_a h³/(6 η h')); from the largest c on, the film fills it again
    by (h - h_c) c' = -h³ p'/(12 η), where h_c is the film thickness at the time of the rupture there.
    """

    def ruptured(time):
        return HALF - math.sqrt(AMBIENT * gap(time) ** 3 / (6 * VISCOSITY * opening(time)))

    begins = brentq(ruptured, 1e-6, 0.03)
    turns = minimize_scalar(
        lambda time: -ruptured(time), bounds=(begins, 0.0999), method="bounded", options={"xatol": 1e-13}
    ).x
    times = np.linspace(begins, turns, 4001)
    places = np.array([ruptured(time) for time in times])

    def moves(time, edge):
        wet = HALF - edge[0]
        slope = AMBIENT / wet - 6 * VISCOSITY * opening(time) / gap(time) ** 3 * wet
        lacks = gap(time) - gap(float(np.interp(edge[0], places, times)))
        return [-(gap(time) ** 3) / (12 * VISCOSITY) * slope / lacks]

    def closed(_time, edge):
        return edge[0] - 1e-8

    closed.terminal = True
    back = solve_ivp(moves, (turns + 1e-6, PERIOD), [places[-1] - 1e-9], rtol=1e-8, events=closed, max_step=2e-4)
    return float(back.t[-1])


def oscillating_plates(largest_step, error):
    """Times, pressure in the middle above ambient, and whether there is a cavity, of the march over a period."""
    film = plates(60, length=2 * HALF, viscosity=VISCOSITY, ambient=AMBIENT)
    moves = course(film, place=lambda time: np.array([gap(time)]), scale=3.5e-6 * 2 * math.pi / PERIOD)
    start = begun(film, full(film, [gap(0.0)], pressure=AMBIENT))
    steps = list(march(film, moves, start, PERIOD, largest_step=largest_step, error=error))
    times = np.array([moving.now.time for moving in steps])
    middle = np.array([moving.instant.state.pressure[30, 0] for moving in steps]) - AMBIENT
    return times, middle, np.array([(moving.instant.kind == CAVITY).any() for moving in steps])


@pytest.fixture(scope="module")
def closes():
    return closing_time()


@pytest.mark.parametrize("error", [1e-3, 3e-4, 1e-4])
def test_plates_whose_cavity_closes_have_the_pressure_of_a_full_film_from_then_on(closes, error):
    times, middle, cavity = oscillating_plates(PERIOD / 60, error)
    closed = np.flatnonzero(cavity)[-1] + 1
    assert times[closed - 1] < closes + 2e-4 < times[closed] + 4e-4
    peak = full_pressure(closes)
    assert middle.max() == pytest.approx(peak, rel=5e-3)
    late = times > times[closed]
    np.testing.assert_allclose(middle[late], [full_pressure(time) for time in times[late]], rtol=5e-3, atol=2e-3 * peak)


def test_the_peak_of_equal_steps_rises_to_that_of_the_exact_plates(closes):
    exact = full_pressure(closes)
    peaks = [oscillating_plates(PERIOD / count, None)[1].max() for count in (50, 200, 800)]
    errors = [1 - peak / exact for peak in peaks]
    assert errors[0] > errors[1] > errors[2]
    assert -1e-3 < errors[2] < 1e-2


def slider():
    """A wide plate of 24 by 10 cells that slides over an inclined one."""
    shape = Shape(
        thickness=lambda x, y: 2e-6 * (1 - x / 0.02) + 0 * y, breaks=(0.0, 0.02), across=(0.0, 0.015), wide=False
    )
    ends = Ends(inlet=AMBIENT, outlet=AMBIENT, sides=(AMBIENT, AMBIENT))
    return MovingFilm(
        problem=Problem(shape=shape, ends=ends, viscosity=VISCOSITY, speed=0.05),
        grid=grid(shape, (24, 10)),
        normals=(lambda x, y: 1 + 0 * x + 0 * y,),
        ambient=AMBIENT,
    )


def squeezed_journal():
    """A shaft that turns slowly in a bore between pressures at which its film is full at times."""
    film = journal((40, 6), groove=False, speed=0.2)
    ends = Ends(sides=(5 * AMBIENT, 5 * AMBIENT))
    return replace(film, problem=replace(film.problem, ends=ends), ambient=5 * AMBIENT)


def whirled(time):
    return CLEARANCE * np.array([0.3, 0.5 * math.sin(2 * math.pi * time / PERIOD)])


def lifted(time):
    return np.array([gap(time)])


LINE = {"length": 2 * HALF, "viscosity": VISCOSITY, "ambient": AMBIENT}
FILMS = {
    "plates": (lambda: plates(60, **LINE), lifted),
    "slider": (slider, lifted),
    "journal": (squeezed_journal, whirled),
}
"""Films whose cavities close, with the path of their wall."""


@pytest.mark.parametrize("name", FILMS)
@pytest.mark.parametrize("count", [40, 100, 300])
def test_a_film_without_cavities_remembers_none(name, count):
    """The pressure of an incompressible full film follows from its motion alone, and that of filling is lower."""
    make, path = FILMS[name]
    film = make()
    moves = course(film, place=path)
    start = begun(film, full(film, path(0.0), pressure=film.ambient))
    had, checked = True, 0
    for moving in march(film, moves, start, 2 * PERIOD, largest_step=PERIOD / count, error=None):
        has = bool((moving.instant.kind == CAVITY).any())
        if not has:
            squeezed = drive(film, storage=(0.0, -(film.at_nodes @ moving.now.velocity)))
            alone = settled(film, moving.instant, squeezed, tolerance=1e-10).state.pressure
            pressure = moving.instant.state.pressure
            assert (pressure <= alone * (1 + 1e-6) + 1e-6 * alone.max()).all()
            if not had:
                np.testing.assert_allclose(pressure, alone, atol=1e-6 * alone.max())
            else:
                checked += 1
        had = has
    assert checked
