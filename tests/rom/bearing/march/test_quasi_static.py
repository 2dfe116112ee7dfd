"""Loads over time: what squeeze changes, and the scene by which models are judged."""

import math

import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.ladder import models
from roughfilm.rom.advice.advise import advise, wanted
from roughfilm.rom.bearing.kind import KIND
from roughfilm.rom.bearing.march.course import Duty
from roughfilm.rom.bearing.march.quasi_static import marched_change, quasi_static
from roughfilm.rom.ladder.scene import read_scene

CELLS = (32, 16)
ROWS = 25


def bearing(period, part=0.3, **tables):
    """Two grooves under 5 kN that change by a part of it in a period, s."""
    phases = [number / (ROWS - 1) for number in range(ROWS)]
    loads = [5e3 * (1 + part * math.sin(2 * math.pi * phase)) for phase in phases]
    over_time = {
        "time": [f"{phase * period!r} s" for phase in phases],
        "load": [f"{load!r} N" for load in loads],
        "period": f"{period!r} s",
    }
    geometry = {"shape": "lobes", "radius": "50 mm", "clearance": "50 um", "width": "50 mm", "lobes": 2}
    return read_scene(
        {
            "name": "over time",
            "kind": "bearing",
            "geometry": {**geometry, "arc": "160 deg"},
            "lubricant": {"viscosity": "20 mPa*s"},
            "motion": {"speed": "3000 rpm", "over_time": over_time},
            **tables,
        }
    )


def test_slow_loads_change_the_least_film_as_to_first_order():
    duty = Duty(scene=bearing(0.5))
    assert marched_change(duty, cells=CELLS) == pytest.approx(quasi_static(duty, cells=CELLS).change, abs=1e-3)


def test_the_coarse_march_finds_the_change_of_a_finer_one():
    duty = Duty(scene=bearing(0.02, part=0.5))
    coarse, fine = marched_change(duty, cells=(24, 12)), marched_change(duty, cells=(40, 20), error=1e-3)
    assert abs(fine) > 0.01
    assert coarse == pytest.approx(fine, abs=5e-3)


def test_slower_loads_have_a_smaller_squeeze_number_and_change():
    slow, fast = (quasi_static(Duty(scene=bearing(period)), cells=CELLS, times=32) for period in (1.0, 0.1))
    assert fast.squeeze_number == pytest.approx(10 * slow.squeeze_number, rel=1e-3)
    assert abs(fast.change) > 4 * abs(slow.change)


def test_a_time_at_rest_is_named_where_no_film_carries_the_load():
    over_time = {"time": ["0 s", "10 ms"], "period": "20 ms", "speed": ["0 m/s", "5 m/s"]}
    still = bearing(0.02, motion={"speed": "5 m/s", "over_time": over_time}, load={"force": "5 kN"})
    with pytest.raises(InputError, match=r"motion\.over_time: at 0 s, with 0 m/s, load: got 5000 N") as caught:
        wanted(still, None)
    assert "\n" not in str(caught.value)


def test_a_heavy_body_adds_its_inertia():
    light, heavy = (
        quasi_static(Duty(scene=bearing(0.02, body={"mass": mass})), cells=CELLS, times=32)
        for mass in ("1 kg", "20000 kg")
    )
    assert heavy.squeeze_number > 1.5 * light.squeeze_number


def test_models_are_judged_at_the_largest_load():
    scene = bearing(0.5)
    steady = KIND.steady(scene)
    assert steady.load_pressure * steady.nominal_area == pytest.approx(6500.0, rel=1e-4)
    assert wanted(scene, None) == "film_min"
    advice = advise(scene, models("bearing"), quantity="film_min", within=0.05)
    assert advice.chosen is not None
    first, verdict, judged = advice.in_time.lines
    assert "squeeze changes the least film by " in first
    assert "are enough for 5 %; up to about" in verdict
    assert judged == "load over time: models are judged at the largest load"


def test_fast_loads_need_a_march():
    in_time = KIND.in_time(bearing(0.005), 0.05)
    assert not in_time.entries["quasi_static"]["enough"]
    assert in_time.entries["quasi_static"]["marched"]
    assert "take roughfilm march; below about" in in_time.lines[1]


@pytest.mark.parametrize(
    ("limit", "enough", "words"),
    [(5, True, "takes more than 5 steps"), (None, False, "the walls touch")],
    ids=["too many steps", "walls that touch"],
)
def test_where_the_march_stops_the_estimate_to_first_order_is_stated(monkeypatch, limit, enough, words):
    if limit is None:
        monkeypatch.setattr("roughfilm.rom.bearing.march.series.CLOSEST", 0.9)
    else:
        monkeypatch.setattr("roughfilm.rom.bearing.march.quasi_static.MARCH_STEPS", limit)
    in_time = KIND.in_time(bearing(0.5), 0.05)
    assert in_time.entries["quasi_static"]["enough"] is enough
    assert not in_time.entries["quasi_static"]["marched"]
    assert words in in_time.lines[0]
