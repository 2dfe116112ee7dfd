"""Films that change with time: mass, plates that are squeezed and torn apart, and the steady state in the end."""

import math

import numpy as np
import pytest
from roughfilm.rom.cavitation.transient import march
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, minimize_scalar

from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.cavitation.balance import CAVITY
from roughfilm.rom.cavitation.discretise import Ends
from roughfilm.rom.cavitation.network import State
from roughfilm.rom.cavitation.problem import Problem
from roughfilm.rom.cavitation.shape import Shape
from roughfilm.rom.cavitation.solve import solve

AMBIENT = 0.025


def gap(time):
    return 0.125 * math.cos(4 * math.pi * time) + 0.375


def opening(time):
    return -0.5 * math.pi * math.sin(4 * math.pi * time)


def plates(time):
    """(h³/2) p'' = ∂(θh)/∂t between parallel plates, p = 0.025 at both ends; after Ausas, Jai and Buscaglia 2009."""
    shape = Shape(thickness=lambda x, y: gap(time) + 0 * x + 0 * y, breaks=(0.0, 1.0))
    return Problem(shape=shape, ends=Ends(inlet=AMBIENT, outlet=AMBIENT), speed=0.0, viscosity=1 / 6)


def cavity_edge():
    """Where the cavity begins, from x = 0: it tears open where p = p' = 0, and is filled again by what flows in.

    In the film p'' = 2h'/h³; a front that moves into the cavity has (1 - θ) h dΣ/dt = -h³/2 p', and θh there is h as it
    was when the film tore.
    """

    def torn(time):
        return math.sqrt(AMBIENT * gap(time) ** 3 / opening(time))

    begins = brentq(lambda time: torn(time) - 0.5, 0.25 + 1e-9, 0.3)
    turns = minimize_scalar(torn, bounds=(begins, 0.45), method="bounded", options={"xatol": 1e-12}).x

    def held(x):
        return gap(brentq(lambda time: torn(time) - x, begins, turns)) if x > torn(turns) else gap(turns)

    def moves(time, edge):
        slope = opening(time) * edge[0] / gap(time) ** 3 - AMBIENT / edge[0]
        return [-(gap(time) ** 3) / 2 * slope / (gap(time) - held(edge[0]))]

    back = solve_ivp(moves, (turns + 1e-6, 0.5), [torn(turns) + 1e-9], rtol=1e-9, atol=1e-12, dense_output=True)
    return lambda time: torn(time) if time <= turns else float(back.sol(time)[0])


def edges(nodes, steps, times):
    """Where ours begins at some times: the first node that is torn, and how full it is."""
    found = {}
    for now, solution in march(plates, (nodes, 1), np.linspace(0, 0.5, steps + 1)):
        near = next((time for time in times if abs(now - time) < 1e-9), None)
        if near is not None:
            first = int(np.argmax(solution.kind[:, 0] == CAVITY))
            part = solution.state.fill[first, 0] - solution.state.fill[first + 1, 0]
            empty = 1 - solution.state.fill[first + 1, 0]
            found[near] = solution.grid.x[first] - (0.5 - part / empty) / nodes
    return found


def test_a_film_torn_by_opening_plates_closes_again_when_it_should():
    exact = cavity_edge()
    times = (0.28, 0.30, 0.35, 0.40, 0.45)
    ours = edges(800, 1000, times)
    for time in times:
        assert ours[time] == pytest.approx(exact(time), abs=0.5 / 800)


def test_the_front_of_a_film_is_of_first_order_in_the_step():
    exact = cavity_edge()
    errors = [abs(edges(3000, steps, (0.42,))[0.42] - exact(0.42)) for steps in (50, 200)]
    assert errors[1] < 0.4 * errors[0]


def test_what_a_film_gains_is_what_flows_in_less_what_flows_out():
    def closing(time):
        shape = Shape(thickness=lambda x, y: (1 - 0.3 * time) * (1.5 - x) + 0 * y, breaks=(0.0, 1.0))
        return Problem(shape=shape, ends=Ends(theta=0.5), speed=1.0, viscosity=1e-3)

    start = State(pressure=np.zeros((201, 1)), fill=np.full((201, 1), 0.8))
    times = np.linspace(0, 0.5, 21)
    held = 0.8 * closing(0).shape.thickness(np.linspace(0, 1, 201), 0.0)
    share = np.append(np.full(200, 1 / 200), 0.0)  # the outlet node holds what it will
    share[0] /= 2
    for now, found in march(closing, (200, 1), times, start=start):
        assert found.kind[0, 0] == CAVITY  # or the inlet turned some of it away
        film = closing(now).shape.thickness(found.grid.x, 0.0)
        entered = 0.5 * 0.5 * film[0]
        left = 0.5 * found.faces.mean[-2, 0] * found.state.fill[-2, 0]
        left += found.faces.east[-2, 0] / 12e-3 * 200 * found.state.pressure[-2, 0]
        gained = (share * (found.state.fill[:, 0] * film - held)).sum() / (times[1] - times[0])
        assert gained == pytest.approx(entered - left, abs=1e-8)
        held = found.state.fill[:, 0] * film
    assert found.state.pressure.max() > 0


def test_in_the_end_a_film_is_steady():
    shape = Shape(thickness=lambda x, y: 20e-6 * (1 + (2 * x / 0.05 - 1) ** 2) + 0 * y, breaks=(0.0, 0.05))
    problem = Problem(shape=shape, ends=Ends(theta=0.7), speed=3.0, viscosity=0.03)
    empty = State(pressure=np.zeros((201, 1)), fill=np.full((201, 1), 0.01))
    *_, (_, last) = march(lambda _time: problem, (200, 1), np.linspace(0, 0.5, 101), start=empty)
    steady = solve(problem, (200, 1))
    assert last.state.pressure == pytest.approx(steady.state.pressure, rel=1e-6, abs=1e-3)


def test_times_must_increase_and_the_wall_slide_ahead():
    with pytest.raises(InputError, match="two or more, finite and increasing"):
        list(march(plates, (20, 1), [0.0]))
    with pytest.raises(InputError, match="two or more, finite and increasing"):
        list(march(plates, (20, 1), [0.0, 0.2, 0.1]))
    shape = Shape(thickness=lambda x, y: 1 + 0 * x + 0 * y, breaks=(0.0, 1.0))
    with pytest.raises(InputError, match="mirror the film"):
        list(march(lambda _t: Problem(shape=shape, ends=Ends(), speed=-1.0, viscosity=1.0), (20, 1), [0.0, 1.0]))
