"""Paths, speeds and approaches: what squeeze changes, and the scene by which models are judged."""

import math

import numpy as np
import pytest

from roughfilm.rom.bearing.kind import KIND
from roughfilm.rom.bearing.march.course import Duty
from roughfilm.rom.bearing.march.on_path import loads_on_path
from roughfilm.rom.bearing.march.series import Series
from roughfilm.rom.bearing.march.summary import summary_of
from roughfilm.rom.bearing.quantities import bearing_quantities
from roughfilm.rom.cavitation.solve import solve
from roughfilm.rom.ladder.scene import read_scene

CELLS = (24, 12)
PAD = {"shape": "linear", "length": "20 mm", "width": "20 mm", "rise": "10 um"}
BORE = {"shape": "lobes", "radius": "50 mm", "clearance": "50 um", "width": "50 mm", "lobes": 2, "arc": "160 deg"}
OIL = {"viscosity": "20 mPa*s", "cavitation_pressure": "-0.1 MPa"}
ROWS = 13


def scene(geometry, motion, **tables):
    """A bearing that moves."""
    given = {"geometry": geometry, "lubricant": OIL, "motion": {"speed": "5 m/s", **motion}} | tables
    return read_scene({"name": "in time", "kind": "bearing", **given})


def waves(period, least, most, unit=""):
    """A table over a period, s, of a quantity that changes between two values."""
    phases = [number / (ROWS - 1) for number in range(ROWS)]
    values = [(least + most) / 2 + (most - least) / 2 * math.cos(2 * math.pi * phase) for phase in phases]
    times = [f"{phase * period!r} s" for phase in phases]
    return times, [f"{value!r} {unit}" for value in values] if unit else values


def on_path(period):
    """A pad whose least film changes between 10 and 14 µm in a period, s."""
    time, film = waves(period, 10.0, 14.0, "um")
    return scene(PAD, {"over_time": {"time": time, "film": film, "period": f"{period!r} s"}})


def test_loads_on_a_path_are_those_of_films_with_the_approach_at_each_time():
    bearing = on_path(2.0)
    found = loads_on_path(Duty(scene=bearing), cells=CELLS, times=16)
    motion = bearing.motion.model_copy(update={"over_time": None})
    for number in (3, 5, 11):
        approach = -float(found.velocity[number, 0])
        moving = bearing.at_film(float(found.place[number, 0]))
        moving = moving.model_copy(update={"motion": motion.model_copy(update={"approach": approach})})
        values = bearing_quantities(moving, solve(moving.problem(), CELLS))
        still = bearing_quantities(
            moving.model_copy(update={"motion": motion}),
            solve(moving.model_copy(update={"motion": motion}).problem(), CELLS),
        )
        change = values["load"].value - still["load"].value
        assert found.moved[number] - found.load[number] == pytest.approx(change, rel=0.02)


def test_the_change_on_a_path_grows_with_its_rate():
    slow, fast = (loads_on_path(Duty(scene=on_path(period)), cells=CELLS, times=16) for period in (1.0, 0.1))
    assert fast.squeeze_number == pytest.approx(10 * slow.squeeze_number, rel=1e-6)


def test_a_path_is_judged_at_its_largest_load_with_the_approach_there():
    bearing = on_path(0.1)
    steady = KIND.steady(bearing)
    assert steady.motion.over_time is None
    assert steady.geometry.film == pytest.approx(10e-6, rel=2e-3)
    assert abs(steady.motion.approach) < 5e-6
    first, verdict, judged = KIND.in_time(bearing, 0.05).lines
    assert first.startswith("path over time: squeeze changes the load by up to about")
    assert "films at rest at each place" in verdict
    assert judged == "path over time: models are judged at the largest load"


def test_a_fast_path_needs_a_march():
    in_time = KIND.in_time(on_path(1e-3), 0.05)
    assert not in_time.entries["quasi_static"]["enough"]
    assert "take roughfilm march; below" in in_time.lines[1]


def test_the_pads_of_a_path_of_a_shaft_stay_in_equilibrium():
    time, along = waves(0.1, 0.0, 0.2)
    path = {"time": time, "eccentricity_x": along, "eccentricity_y": [-0.3] * ROWS}
    pads = {**BORE, "lobes": 4, "arc": "80 deg", "first": "-45 deg", "pivot": 0.5, "preload": 0.3}
    bearing = scene(pads, {"over_time": path}, lubricant={"viscosity": "20 mPa*s"})
    found = loads_on_path(Duty(scene=bearing), cells=CELLS, times=4)
    assert found.place.shape == (5, 6)
    assert abs(found.place[:, 2:]).max() > 0


def test_without_sliding_an_approach_gives_the_film_its_pressure():
    shape = {"shape": "parallel", "length": "20 mm", "width": "20 mm", "film": "10 um"}
    (line,) = KIND.in_time(scene(shape, {"speed": "0 m/s", "approach": "1 mm/s"}), 0.05).lines
    assert line.startswith("approach: squeeze alone gives the film its pressure")


def test_plates_that_sink_without_a_wedge_are_judged_where_they_approach():
    """Parallel walls that slide carry nothing but by squeeze, which presses them apart only while they approach."""
    time, film = waves(1.0, 10.0, 14.0, "um")
    plates = {"shape": "parallel", "length": "20 mm", "width": "20 mm"}
    path = scene(plates, {"over_time": {"time": time, "film": film}})
    line, _judged = KIND.in_time(path, 0.05).lines
    assert line.startswith("path over time: squeeze alone gives the film its load")
    assert KIND.steady(path).motion.approach > 0
    (line,) = KIND.in_time(scene({**plates, "film": "10 um"}, {"approach": "1 mm/s"}), 0.05).lines
    assert line.startswith("approach: without it the film carries no load")


def test_an_approach_may_be_left_out_below_a_rate():
    shape = {**PAD, "film": "10 um"}
    in_time = KIND.in_time(scene(shape, {"approach": "1 mm/s"}), 0.05)
    entries = in_time.entries["quasi_static"]
    assert not entries["enough"]
    slow = KIND.in_time(scene(shape, {"approach": f"{0.9 * entries['largest_approach']!r} m/s"}), 0.05)
    assert slow.entries["quasi_static"]["enough"]
    assert slow.lines[1].startswith("approach: it may be left out for 5 %; up to about")


def test_speeds_over_time_are_judged_at_the_least_film():
    time, speed = waves(1.0, 5.0, 15.0, "m/s")
    moving = scene(BORE, {"over_time": {"time": time, "speed": speed}}, load={"force": "5 kN"})
    assert KIND.steady(moving).motion.speed == pytest.approx(5.0, rel=0.02)


def test_a_speed_over_time_at_a_given_film_moves_no_wall():
    time, speed = waves(1.0, 5.0, 15.0, "m/s")
    assert KIND.in_time(scene({**PAD, "film": "10 um"}, {"over_time": {"time": time, "speed": speed}}), 0.05) is None


def test_an_extreme_at_the_start_is_inside_a_window_that_begins_there_but_for_rounding():
    end, period = 3 * 0.1, 0.3
    assert 0 < end - period < 1e-15
    columns = {"time": "s", "film": "m", "film_min": "m", "pressure_max": "Pa", "cavitated_fraction": "1"}
    columns["film_force"] = "N"
    time = np.linspace(0, end, 4)
    film = 10e-6 + 1e-6 * time
    rows = np.stack([time, film, film, np.ones(4), np.zeros(4), np.ones(4)], axis=1)
    series = Series(units=columns, rows=rows, snapshots=(), grid={}, known=0)
    found = summary_of(Duty(scene=on_path(period)), series)
    assert found.quantities["film_min"].value == pytest.approx(10e-6, rel=1e-12)
    assert found.between["film_min"] == 0
