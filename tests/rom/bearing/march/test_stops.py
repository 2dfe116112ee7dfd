"""Marches that cannot go on stop early, in one line that names the coordinate, the time and the remedy."""

import numpy as np
import pytest
from moving_films import CLEARANCE, RADIUS, SPEED, course, journal, steady

from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.rom.bearing.march.solve import march_bearing
from roughfilm.rom.cavitation.motion import march as marches
from roughfilm.rom.ladder.scene import read_scene

PAD = {"shape": "pivoted", "length": "40 mm", "width": "40 mm", "pivot": [0.6, 0.45]}
WIDENING = {"time": ["0 s", "1 ms", "2 ms", "5 ms"], "film": ["20 um", "20 um", "60 um", "30 um"]}


def marched(geometry=PAD, *, speed="10 m/s", over_time=None, cavitation="0 Pa", **tables):
    motion = {"speed": speed} | ({} if over_time is None else {"over_time": over_time})
    lubricant = {"viscosity": "20 mPa*s", "cavitation_pressure": cavitation}
    scene = {"name": "pad", "kind": "bearing", "geometry": geometry, "lubricant": lubricant, "motion": motion}
    return march_bearing(read_scene(scene | tables), cells=(12, 8), uncertain=False)


@pytest.mark.parametrize(
    ("line", "slopes"), [(False, "slope_x or slope_y"), (True, "slope_x")], ids=["about a point", "about a line"]
)
def test_a_film_without_pressure_names_the_slopes_that_it_does_not_resist(line, slopes):
    words = rf"at the time 0.001\d* s the film loses its pressure and does not resist {slopes}; give body.inertia"
    with pytest.raises(ConvergenceError, match=words):
        marched(PAD | {"line": line}, over_time=WIDENING)


def test_a_film_that_keeps_its_pressure_follows_walls_that_part():
    slowly = {"time": ["0 s", "1 ms", "50 ms"], "film": ["20 um", "20 um", "30 um"]}
    march = marched(over_time=slowly, cavitation="-1 MPa")
    assert march.time[-1] == pytest.approx(0.05)
    assert np.abs(march["flow_imbalance"]).max() < 1e-9


def test_a_pad_whose_moments_no_tilt_balances_closes_and_its_pivot_is_named():
    start = {"start": {"film": "60 um"}}
    with pytest.raises(
        ConvergenceError, match=r"the walls touch, mainly by the motion of .*; move the pivot .* any load"
    ):
        marched(PAD | {"pivot": 0.35}, load={"force": "500 N"}, body=start)


def test_walls_that_meet_between_the_nodes_of_the_grid_end_the_march():
    """A shaft at rest for half of each period sinks through its film; the nodes of the grid keep a film for longer."""
    over_time = {"time": ["0 s", "0.25 s", "0.5 s", "0.75 s"], "period": "1 s"}
    over_time["speed"] = ["0 m/s", "0 m/s", "0.05 m/s", "0.9 m/s"]
    tables = {
        "geometry": {"shape": "lobes", "radius": "40 mm", "clearance": "17 um", "width": "80 mm"},
        "lubricant": {"viscosity": "20 mPa*s", "cavitation_pressure": "-50 kPa"},
        "motion": {"speed": "1 m/s", "over_time": over_time},
        "load": {"pressure": "7 MPa"},
        "body": {"mass": "1 kg"},
    }
    shaft = read_scene({"name": "at rest", "kind": "bearing"} | tables)
    with pytest.raises(ConvergenceError, match="the walls touch"):
        march_bearing(shaft, steps=4, cells=(16, 8), uncertain=False)


WEDGE = {"shape": "linear", "length": "20 mm", "width": "20 mm", "film": "20 um", "rise": "100 um"}


@pytest.mark.parametrize(
    ("speed", "load", "words"),
    [("-1 m/s", "300 N", "no film carries a load at this speed"), ("1 m/s", "1 GN", "lower the load|does not settle")],
    ids=["widening", "overloaded"],
)
def test_a_pad_under_a_load_that_no_film_carries_is_refused(speed, load, words):
    over_time = {"time": ["0 s", "10 ms", "20 ms"], "load": [load] * 3}
    with pytest.raises(InputError, match=rf"body.start.film: is missing, .* \(load: .*({words})"):
        marched(WEDGE, speed=speed, over_time=over_time, cavitation="-0.1 MPa", body={"mass": "10 kg"})


@pytest.mark.parametrize("cavitation", ["-0.1 MPa", "-1 MPa"])
def test_a_parallel_pad_at_rest_stays_parallel(cavitation):
    """Nothing flows at rest: pressures are ambient up to round-off, which is neither a force nor an imbalance."""
    film = {"time": ["0 s", "1 ms"], "film": ["50 um", "50 um"]}
    march = marched(speed="0 m/s", over_time=film, cavitation=cavitation)
    assert np.abs(march["slope_x"]).max() < 1e-12
    assert (march["flow_imbalance"] == 0).all()


def test_a_march_whose_steps_stay_short_stops(monkeypatch):
    monkeypatch.setattr(marches, "MAX_SHORT_STEPS", 20)
    film = journal((12, 4), halved=True)
    start = marches.begun(film, steady(film, [0.3 * CLEARANCE, 0.2 * CLEARANCE]))
    turning = course(
        film,
        force=lambda time: 1e4 * np.array([np.cos(1e3 * time), np.sin(1e3 * time)]),
        mass=1.0,
        scale=CLEARANCE * SPEED / RADIUS,
    )
    words = r"more than 20 steps in a row are shorter than 1e-05 .* coordinate \d, which moves fast; give a larger mass"
    with pytest.raises(ConvergenceError, match=words):
        list(marches.march(film, turning, start, 1e3, largest_step=1e2, error=1e-7))
