"""Films in time: fronts of plates that part, conservation of mass, masses on films, and the steady state in the end."""

import math

import numpy as np
import pytest
from moving_films import CLEARANCE, RADIUS, SPEED, course, drive, full, journal, order, plates, steady, stored
from scipy.integrate import solve_ivp
from scipy.linalg import expm
from scipy.optimize import brentq, minimize_scalar

from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.rom.cavitation.balance import CAVITY
from roughfilm.rom.cavitation.motion.coefficients import coefficients
from roughfilm.rom.cavitation.motion.coupled import settled
from roughfilm.rom.cavitation.motion.march import begun, march
from roughfilm.rom.cavitation.solve import solve
from roughfilm.rom.lubricants.compressibility import ConstantBulkModulus

AMBIENT = 0.025


def gap(time):
    return 0.125 * math.cos(4 * math.pi * time) + 0.375


def opening(time):
    return -0.5 * math.pi * math.sin(4 * math.pi * time)


def cavity_edge():
    """Where the cavity between plates that part begins, from x = 0, after Ausas, Jai and Buscaglia 2009.

    (h³/2) p'' = ∂(θh)/∂t with p = 0.025 at both ends. The film ruptures where p = p' = 0, with p'' = 2h'/h³ in it, and
    is filled again by what flows in: a front that moves into the cavity has (1 - θ) h dΣ/dt = -h³/2 p', and θh there is
    h at the time of the rupture.
    """

    def ruptured(time):
        return math.sqrt(AMBIENT * gap(time) ** 3 / opening(time))

    begins = brentq(lambda time: ruptured(time) - 0.5, 0.25 + 1e-9, 0.3)
    turns = minimize_scalar(ruptured, bounds=(begins, 0.45), method="bounded", options={"xatol": 1e-12}).x

    def held(x):
        return gap(brentq(lambda time: ruptured(time) - x, begins, turns)) if x > ruptured(turns) else gap(turns)

    def moves(time, edge):
        slope = opening(time) * edge[0] / gap(time) ** 3 - AMBIENT / edge[0]
        return [-(gap(time) ** 3) / 2 * slope / (gap(time) - held(edge[0]))]

    back = solve_ivp(moves, (turns + 1e-6, 0.5), [ruptured(turns) + 1e-9], rtol=1e-9, atol=1e-12, dense_output=True)
    return lambda time: ruptured(time) if time <= turns else float(back.sol(time)[0])


def edges(nodes, steps):
    """Times and positions of the beginning of the cavity, from the first node in it and how full it is."""
    film = plates(nodes, viscosity=1 / 6, ambient=AMBIENT)
    start = begun(film, full(film, [gap(0.0)], pressure=AMBIENT))
    found = []
    moves = course(film, place=lambda time: np.array([gap(time)]))
    for moving in march(film, moves, start, 0.5, largest_step=0.5 / steps, error=None):
        if 0.28 < moving.now.time < 0.48:
            fill = moving.instant.state.fill[:, 0]
            first = int(np.argmax(moving.instant.kind[:, 0] == CAVITY))
            part = (fill[first] - fill[first + 1]) / (1 - fill[first + 1])
            found.append((moving.now.time, film.grid.x[first] - (0.5 - part) / nodes))
    return np.array(found)


def test_plates_that_part_rupture_the_film_where_the_exact_front_is():
    exact = cavity_edge()
    ours = edges(200, 100)
    assert len(ours) > 35
    np.testing.assert_allclose(ours[:, 1], [exact(time) for time in ours[:, 0]], atol=0.5 / 200)


def test_fronts_move_with_second_order_in_time():
    exact, steps = cavity_edge(), np.array([16, 32, 64])
    errors = []
    for count in steps:
        ours = edges(800, count)
        late = ours[ours[:, 0] > 0.42]
        errors.append(np.sqrt(np.mean([(edge - exact(time)) ** 2 for time, edge in late])))
    assert order(1 / steps, errors) == pytest.approx(2.0, abs=0.35)


def test_a_free_journal_stores_what_flows_in_less_what_flows_out():
    film = journal((32, 6), halved=True)
    start = steady(film, [0.3 * CLEARANCE, 0.2 * CLEARANCE])
    turn = 2 * np.pi * RADIUS / SPEED
    load = course(
        film,
        force=lambda time: np.array([2e4 * np.cos(2 * np.pi * time / turn), 1e4]),
        mass=20.0,
        scale=CLEARANCE * SPEED / RADIUS,
    )
    before, orders = begun(film, start), set()
    for moving in march(film, load, before, 0.5 * turn, largest_step=turn / 20, error=1e-2):
        entered = moving.instant.balance[moving.instant.network.fixed]
        excess = entered.sum() - stored(film, before, moving)
        assert abs(excess) <= 1e-9 * np.abs(entered).sum() / 2
        assert moving.instant.state.fill.min() >= -1e-9
        orders.add(moving.order)
        before = moving
    assert 2 in orders
    assert (before.instant.kind == CAVITY).any()


def test_a_line_stores_what_its_end_faces_carry():
    film = plates(100, viscosity=1 / 6, ambient=AMBIENT)
    before = begun(film, full(film, [gap(0.0)], pressure=AMBIENT))
    moves = course(film, place=lambda time: np.array([gap(time)]))
    for moving in march(film, moves, before, 0.4, largest_step=0.01, error=None):
        pressure, width = moving.instant.state.pressure[:, 0], gap(moving.now.time)
        inflow = width**3 / 2 * 100 * (pressure[0] - pressure[1] + pressure[-1] - pressure[-2])
        inner = stored(film, before, moving) - 0.01 * opening_of(moving)
        assert inner == pytest.approx(inflow, rel=1e-9, abs=1e-9)
        before = moving


def opening_of(moving):
    """∂h/∂t by the formula of the step, m/s."""
    return float(moving.now.velocity[0])


def test_in_the_end_a_film_is_steady():
    def thickness(x, y):
        return 20e-6 * (1 + (2 * x / 0.05 - 1) ** 2) + 0 * y

    film = plates(100, length=0.05, viscosity=0.03, thickness=thickness, theta=0.7, speed=3.0)
    empty = begun(film, full(film, [0.0], fill=0.01))
    *_, last = march(film, course(film, place=lambda _time: np.zeros(1)), empty, 0.5, largest_step=0.01)
    found = solve(film.problem, (100, 1))
    np.testing.assert_allclose(last.instant.state.pressure, found.state.pressure, rtol=1e-6, atol=1e-3)
    np.testing.assert_allclose(last.instant.state.fill, found.state.fill, atol=1e-8)


def test_a_cavity_that_runs_dry_is_never_less_than_empty():
    film = plates(100, thickness=lambda x, y: 1 + 0 * x + 0 * y, theta=0.0, speed=2.0)
    start = begun(film, full(film, [0.0], fill=np.where(film.grid.x < 0.5, 0.9, 0.3)[:, None]))
    rest = course(film, place=lambda _time: np.zeros(1))
    steps = list(march(film, rest, start, 0.8, largest_step=0.02, error=None))
    assert min(moving.instant.state.fill.min() for moving in steps) >= -1e-9
    assert {moving.order for moving in steps} == {1, 2}


def test_a_plate_that_closes_at_constant_speed_has_the_pressure_of_the_closed_form():
    film, speed = plates(50, length=0.1, viscosity=0.02), 1e-4
    moves = course(film, place=lambda time: np.array([1e-4 - speed * time]), scale=speed)
    *_, last = march(film, moves, begun(film, full(film, [1e-4])), 0.5, largest_step=0.1, error=None)
    exact = 6 * 0.02 * speed * film.grid.x * (0.1 - film.grid.x) / (0.5e-4) ** 3
    np.testing.assert_allclose(last.instant.state.pressure[:, 0], exact, rtol=1e-7, atol=1e-6 * exact.max())


LOAD, LENGTH, OIL, FIRST = 1000.0, 0.1, 0.02, 1e-4
"""A plate that sinks: force per width, N/m; length, m; viscosity, Pa s; first film, m."""


def sinking(time, nodes):
    """h by ηL³/h³ dh/dt = -W, thus 1/h² = 1/h₀² + 2Wt/(ηL³).

    The sum of the exact pressures at the nodes is smaller by 1 - 1/N² than their integral.
    """
    return (FIRST**-2 + 2 * LOAD * time / (OIL * LENGTH**3 * (1 - nodes**-2))) ** -0.5


def sunk(end, **numbers):
    """The films of a plate without mass that sinks under its load."""
    film = plates(40, length=LENGTH, viscosity=OIL)
    speed = LOAD * FIRST**3 / (OIL * LENGTH**3)
    start = begun(film, steady(film, [FIRST]), velocity=np.array([-speed]))
    load = course(film, force=lambda _time: np.array([-LOAD]), scale=speed)
    return list(march(film, load, start, end, **numbers))


def test_a_plate_without_mass_sinks_as_in_closed_form_with_second_order():
    end, steps = 0.3, np.array([20, 40, 80])
    errors = [sunk(end, largest_step=end / n, error=None)[-1].now.place[0] / sinking(end, 40) - 1 for n in steps]
    assert order(1 / steps, errors) == pytest.approx(2.0, abs=0.2)
    assert abs(errors[-1]) < 1e-3


@pytest.mark.parametrize("error", [1e-2, 1e-3])
def test_steps_of_a_sinking_plate_meet_their_error(error):
    film = sunk(0.3, largest_step=0.1, error=error)
    worst = max(abs(moving.now.place[0] / sinking(moving.now.time, 40) - 1) for moving in film)
    assert worst < error
    assert film[-1].now.time == pytest.approx(0.3, rel=1e-12)
    assert all(moving.error <= error for moving in film)


def test_a_mass_on_a_film_swings_as_its_stiffness_and_damping_let_it():
    film = journal((24, 4), halved=True, ruptures=False)
    rate = SPEED / RADIUS
    at = steady(film, [0.5 * CLEARANCE, 0.0], tolerance=1e-12)
    force = -film.force(at.state.pressure)
    small = coefficients(film, at, speed=SPEED)
    mass = 0.5 * float(np.abs(small.stiffness).max()) / rate**2
    system = np.block(
        [[np.zeros((2, 2)), np.eye(2)], [-small.stiffness / mass, -small.damping / mass]],
    )
    first = np.array([1e-4 * CLEARANCE, 0.0])
    start = steady(film, at.place + first, tolerance=1e-12)
    load = course(film, force=lambda _time: force, mass=mass, scale=rate * 1e-4 * CLEARANCE)
    worst = 0.0
    for moving in march(film, load, begun(film, start), 2 * np.pi / rate, largest_step=0.02 / rate, error=1e-3):
        exact = expm(system * moving.now.time) @ np.append(first, [0.0, 0.0])
        worst = max(worst, float(np.abs(moving.now.place - at.place - exact[:2]).max()) / first[0])
    assert worst < 3e-3


def test_pressures_of_a_compressible_film_at_rest_decay_as_heat_does():
    """With small p/β, ∂p/∂t = h²β/(12η) ∂²p/∂x²: a sine decays by exp(-π²h²βt/(12ηL²))."""
    bulk, first = 1e9, 1e5
    law = ConstantBulkModulus.model_validate({"law": "constant_bulk_modulus", "bulk_modulus": f"{bulk!r} Pa"})
    film = plates(64, length=0.1, viscosity=0.1, compressibility=law)
    height = 1e-4
    start = full(film, [height], pressure=first * np.sin(np.pi * film.grid.x / 0.1)[:, None])
    rate = np.pi**2 * height**2 * bulk / (12 * 0.1 * 0.1**2)
    rest = course(film, place=lambda _time: np.array([height]))
    errors, steps = [], np.array([10, 20, 40])
    for count in steps:
        *_, last = march(film, rest, begun(film, start), 1 / rate, largest_step=1 / rate / count, error=None)
        errors.append(last.instant.state.pressure.max() / (first * np.exp(-1.0)) - 1)
    assert abs(errors[-1]) < 2e-3
    assert order(1 / steps, errors) > 1.6


def test_a_march_that_goes_on_from_a_film_gives_the_same_films():
    film = journal((16, 4))
    start = begun(film, steady(film, [0.3 * CLEARANCE, 0.0]))
    load = course(film, force=lambda _time: np.array([1e4, 0.0]), mass=5.0, scale=CLEARANCE * SPEED / RADIUS)
    whole = list(march(film, load, start, 2e-3, largest_step=1e-3, error=0.03))
    half = len(whole) // 2
    rest = list(march(film, load, whole[half - 1], 2e-3, largest_step=1e-3, error=0.03))
    assert [moving.now.time for moving in rest] == [moving.now.time for moving in whole[half:]]
    np.testing.assert_array_equal(rest[-1].instant.state.pressure, whole[-1].instant.state.pressure)


def test_walls_that_touch_end_a_march_in_one_line():
    film = plates(20, length=LENGTH, viscosity=OIL)
    start = begun(film, steady(film, [FIRST]))
    load = course(film, force=lambda _time: np.array([-LOAD]), scale=1e-3)
    with pytest.raises(
        ConvergenceError, match=r"at the time \S+ s the film is \S+ m thick, and the walls touch"
    ) as one:
        list(march(film, load, start, 1e9, largest_step=1e8, closest=2e-6, error=0.1))
    assert "\n" not in str(one.value)
    closing = course(film, place=lambda time: np.array([FIRST * (1 - time)]))
    with pytest.raises(InputError, match=r"motion.place: got .* at the time 1 s.*keep the walls apart"):
        list(march(film, closing, start, 2.0, largest_step=0.25, error=None))


def test_an_iteration_that_does_not_converge_ends_in_one_line():
    film = journal((16, 4))
    far = full(film, [0.9 * CLEARANCE, 0.0])
    with pytest.raises(ConvergenceError, match=r"^motion: the residual is \S+ and .* after 1 steps; take more cells"):
        settled(film, far, drive(film), tolerance=1e-10, limit=1)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"end": -1.0}, "end: got -1.0 s; a march from 0.0 s needs a later, finite time"),
        ({"end": 0.0}, "end: got 0.0 s"),
        ({"end": math.nan}, "end: got nan s"),
        ({"end": math.inf}, "end: got inf s"),
        ({"largest_step": 0.0}, "largest_step: got 0.0 s"),
        ({"largest_step": math.nan}, "largest_step: got nan s"),
        ({"error": 0.0}, "error: got 0.0; give"),
        ({"error": math.nan}, "error: got nan; give"),
    ],
)
def test_times_and_errors_are_checked(changes, words):
    film = plates(8)
    numbers = {"end": 1.0, "largest_step": 0.1, "error": 1e-3} | changes
    with pytest.raises(InputError, match=words):
        list(march(film, course(film), begun(film, full(film, [1.0])), numbers.pop("end"), **numbers))


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"speed": math.inf}, "motion.speed: got inf m/s at the time 0.1 s; give a finite speed"),
        ({"speed": math.nan}, "motion.speed: got nan m/s"),
        ({"place": lambda _time: np.array([math.nan])}, "motion.place: got .nan. at the time 0.1 s"),
        ({"force": lambda _time: np.array([math.inf])}, "motion.force: got .inf."),
    ],
)
def test_courses_are_checked(changes, words):
    film = plates(8)
    with pytest.raises(InputError, match=words):
        list(march(film, course(film, **changes), begun(film, full(film, [1.0])), 1.0, largest_step=0.1, error=None))
