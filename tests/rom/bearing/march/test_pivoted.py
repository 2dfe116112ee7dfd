"""Marches of pads about a pivot: equilibria, a plate that rocks at rest against quadrature, inertia, and faults."""

import numpy as np
import pytest
from scipy.integrate import cumulative_trapezoid, solve_ivp

from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.bearing.free.equilibrium import equilibrium
from roughfilm.rom.bearing.free.film import free_film
from roughfilm.rom.bearing.free.solve import solve_free
from roughfilm.rom.bearing.march.course import Duty
from roughfilm.rom.bearing.march.in_time import steady
from roughfilm.rom.bearing.march.quasi_static import quasi_static
from roughfilm.rom.bearing.march.solve import march_bearing
from roughfilm.rom.ladder.scene import read_scene

LENGTH, VISCOSITY, CELLS = 0.04, 0.03, (12, 8)
WIDE = {"shape": "pivoted", "length": "40 mm", "pivot": 0.6}
PAD = WIDE | {"width": "40 mm"}
SECTOR = {
    "shape": "pivoted_sector",
    "inner_radius": "40 mm",
    "outer_radius": "80 mm",
    "angle": "40 deg",
    "pivot": [0.4, 0.52],
    "pads": 6,
}
LOAD = {"pressure": "2 MPa"}
STEP = ["0 ms", "2 ms", "4 ms", "80 ms"]


def scene(geometry=PAD, *, over_time=None, **tables):
    motion = {"speed": "10 m/s"} | tables.pop("motion", {}) | ({} if over_time is None else {"over_time": over_time})
    lubricant = {"viscosity": "30 mPa*s"} | tables.pop("lubricant", {})
    return read_scene(
        {"name": "pad", "kind": "bearing", "geometry": geometry, "lubricant": lubricant, "motion": motion, **tables}
    )


def marched(bearing, **options):
    return march_bearing(bearing, **({"cells": CELLS, "uncertain": False} | options))


def steady_place(bearing):
    film = free_film(bearing, CELLS)
    return film.wall.names, equilibrium(film, None, tolerance=1e-10).place


def last(march, names):
    return [float(march[name][-1]) for name in names]


def test_a_march_from_a_parallel_pad_ends_in_the_equilibrium_of_solve():
    bearing = scene(load=LOAD, body={"start": {"film": "60 um"}})
    march = marched(bearing, end=0.05, cells=(16, 8))
    found = solve_free(bearing, 16, tolerance=1e-10)
    assert march["pivot_film"][0] == pytest.approx(60e-6)
    assert last(march, ("pivot_film", "slope_x")) == pytest.approx(found.instants[0].place, rel=1e-4)
    assert march.settled
    assert np.abs(march["flow_imbalance"]).max() < 1e-9


def test_a_sector_that_slides_backwards_ends_in_its_equilibrium():
    bearing = scene(SECTOR, motion={"speed": "-3000 rpm"}, load={"force": "20 kN"})
    names, place = steady_place(bearing)
    march = marched(bearing, end=0.05, steps=60)
    assert names == ("pivot_film", "slope_x", "slope_y")
    assert last(march, names) == pytest.approx(place, rel=1e-4)


@pytest.mark.parametrize("axis", ["x", "y"])
def test_after_a_step_of_a_moment_the_pad_rests_in_the_equilibrium_of_that_moment(axis):
    table = {"time": STEP, f"moment_{axis}": ["0 N*m", "0 N*m", "3 N*m", "3 N*m"]}
    march = marched(scene(load=LOAD, over_time=table), steps=80)
    names, place = steady_place(scene(load=LOAD | {f"moment_{axis}": "3 N*m"}))
    assert last(march, names) == pytest.approx(place, rel=1e-4)
    assert march[f"load_moment_{axis}"][-1] == 3
    for force in ("force", "moment_y"):
        assert np.abs(march[f"film_{force}"] + march[f"load_{force}"]).max() < 1e-6


def test_a_moment_that_the_table_lacks_is_that_of_the_load():
    table = {"time": ["0 ms", "1 ms"], "load": ["3200 N", "3200 N"]}
    moved = scene(over_time=table)
    assert Duty(scene=moved).moments(0.5e-3) == (0.0, 0.0)
    table = {"time": ["0 ms", "1 ms"], "moment_y": ["1 N*m", "3 N*m"]}
    duty = Duty(scene=scene(load=LOAD | {"moment_x": "2 N*m"}, over_time=table))
    assert duty.moments(0.5e-3) == pytest.approx((2, 2))
    assert duty.force(0.5e-3) == pytest.approx([-3200, -2, 2])


def test_given_films_at_the_pivot_leave_the_slopes_to_the_moments():
    """A flat pad whose films are all half as thick carries four times the load at half of the slope."""
    table = {"time": ["0 ms", "1 ms", "20 ms", "60 ms"], "film": ["40 um", "40 um", "20 um", "20 um"]}
    march = marched(scene(over_time=table), steps=60)
    assert march["pivot_film"][[0, -1]] == pytest.approx([40e-6, 20e-6])
    assert march["slope_x"][0] < 0
    assert march["slope_x"][-1] / march["slope_x"][0] == pytest.approx(0.5, rel=1e-5)
    assert march["film_force"][-1] / march["film_force"][0] == pytest.approx(4, rel=1e-5)


def quadrature(film, slope, pivot):
    """The forces and moments of an infinitely wide plate about its pivot per rate of its film and of its slope.

    With (h³ p'/12η)' = ∂h/∂t and p = 0 at both ends, by the trapezoidal rule.
    """
    x = np.linspace(-pivot * LENGTH, (1 - pivot) * LENGTH, 2001)
    resistance = 12 * VISCOSITY / (film + slope * x) ** 3
    columns = []
    for rate in (np.ones_like(x), x):
        flow = cumulative_trapezoid(rate, x, initial=0)
        forced, free = (cumulative_trapezoid(part, x, initial=0) for part in (resistance * flow, resistance))
        pressure = forced - forced[-1] / free[-1] * free
        columns.append([np.trapezoid(pressure, x), np.trapezoid(pressure * x, x)])
    return np.array(columns).T


def test_a_plate_at_rest_rocks_as_the_integral_of_the_reynolds_equation_says():
    """A load beside the middle of parallel plates tilts them at dα/dt = -60 h³ M/(η L⁵), M about the middle."""
    film, force = 50e-6, 2e4
    first = quadrature(film, 0.0, 0.5)[1, 1]
    assert first == pytest.approx(-VISCOSITY * LENGTH**5 / (60 * film**3), rel=1e-5)
    bearing = scene(
        WIDE,
        lubricant={"cavitation_pressure": "-1 GPa"},
        motion={"speed": "0 m/s"},
        load={"force_per_width": f"{force} N/m"},
        body={"start": {"film": f"{film} m"}},
    )
    march = marched(bearing, cells=(96, 8), end=2e-3, error=1e-4)
    moment = 0.1 * LENGTH * force
    assert march["slope_x_velocity"][1] == pytest.approx(-60 * film**3 * moment / (VISCOSITY * LENGTH**5), rel=3e-3)
    exact = solve_ivp(
        lambda _time, place: np.linalg.solve(quadrature(*place, 0.6), [force, 0.0]),
        (0, 2e-3),
        [film, 0.0],
        rtol=1e-7,
        atol=1e-12,
        t_eval=march.time,
    ).y
    assert march["pivot_film"] == pytest.approx(exact[0], rel=1e-4)
    assert march["slope_x"] == pytest.approx(exact[1], abs=1e-3 * np.abs(exact[1]).max())


def test_a_pad_with_inertia_alone_turns_at_the_rate_of_its_moment():
    """Between plates 1 mm apart the film resists little: α = M t²/2I about the axis along y."""
    table = {"time": ["0 ms", "1 ms"], "moment_y": ["-1 N*m", "-1 N*m"]}
    bearing = scene(
        PAD | {"pivot": 0.5},
        lubricant={"viscosity": "1e-4 Pa*s", "cavitation_pressure": "-1 GPa"},
        motion={"speed": "0 m/s"},
        load={"pressure": "1 Pa"},
        over_time=table,
        body={"mass": "100 kg", "inertia": ["1 kg*m^2", "0.1 kg*m^2"], "start": {"film": "1 mm"}},
    )
    march = marched(bearing)
    assert march["slope_x"][-1] == pytest.approx(1 * 1e-3**2 / 2 / 0.1, rel=1e-2)


def test_moments_over_time_are_advised_on_and_steady_bearings_have_them():
    table = {"time": STEP, "moment_x": ["0 N*m", "0 N*m", "3 N*m", "3 N*m"], "load": ["3 kN", "3 kN", "4 kN", "4 kN"]}
    bearing = scene(over_time=table)
    found = quasi_static(Duty(scene=bearing), cells=(12, 6), times=8)
    assert found.film_min[-1] < found.film_min[0]
    at = steady(bearing)
    assert (at.load.moment_x, at.load_pressure * at.nominal_area) == pytest.approx((3, 4000))


@pytest.mark.parametrize(
    ("geometry", "tables", "words"),
    [
        ({"shape": "linear", "length": "4 cm", "width": "4 cm", "rise": "2 um"}, {}, "pivoted pads with a width"),
        (WIDE, {}, "infinitely wide shape 'pivoted'; pivoted pads with a width"),
        (PAD | {"line": True}, {}, "moment_x: got it for a pivot with line = true"),
        (PAD | {"slopes": ["-0.1 mrad", "0 rad"]}, {}, "moment_x: got it beside geometry.slopes"),
        (PAD, {"body": {"start": {"slopes": ["0 rad", "0 rad"]}}}, "body.start.film: is missing beside slopes"),
        (PAD, {"body": {"start": {"film": "1 mm", "eccentricity": [0, 0]}}}, "body.start.eccentricity: got it"),
    ],
)
def test_faults_are_one_line(geometry, tables, words):
    table = {"time": ["0 s", "1 s"], "moment_x": ["0 N*m", "1 N*m"]}
    with pytest.raises(InputError, match=words):
        scene(geometry, load=LOAD, over_time=table, **tables)


@pytest.mark.parametrize(
    ("geometry", "body", "words"),
    [
        ({"shape": "linear", "length": "4 cm", "width": "4 cm", "rise": "2 um"}, {"inertia": "1 kg*m^2"}, "inertia"),
        (PAD | {"slopes": ["-0.1 mrad", "0 rad"]}, {"inertia": "1 kg*m^2"}, "body.inertia: got one for given slopes"),
        (PAD, {"inertia": "1 kg"}, "body.inertia"),
        (
            PAD | {"line": True},
            {"start": {"film": "1 mm", "slopes": ["0 rad", "1 mrad"]}},
            "body.start.slopes: got 0.001 rad across",
        ),
    ],
)
def test_faults_of_bodies_are_one_line(geometry, body, words):
    with pytest.raises(InputError, match=words):
        scene(geometry, load=LOAD, body=body)
