"""Loads over time: what squeeze changes, and the scene by which models are judged."""

import math

import pytest

from roughfilm.ladder import models
from roughfilm.rom.advice.advise import advise, wanted
from roughfilm.rom.bearing.kind import KIND
from roughfilm.rom.bearing.march.course import Duty
from roughfilm.rom.bearing.march.quasi_static import quasi_static
from roughfilm.rom.bearing.march.solve import march_bearing
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


@pytest.mark.parametrize("period", [0.05, 0.2])
def test_the_stated_change_covers_that_of_a_march(period):
    scene = bearing(period)
    found = quasi_static(Duty(scene=scene), cells=CELLS, times=48)
    march = march_bearing(scene, end=2 * period, cells=CELLS, error=2e-3, uncertain=False)
    inside = march.series.time >= period
    true = march.series["film_min"][inside].min() / found.film_min.min() - 1
    assert abs(true) <= abs(found.change) + 2e-3


def test_slower_loads_have_a_smaller_squeeze_number_and_change():
    slow, fast = (quasi_static(Duty(scene=bearing(period)), cells=CELLS, times=32) for period in (1.0, 0.1))
    assert fast.squeeze_number == pytest.approx(10 * slow.squeeze_number, rel=1e-3)
    assert abs(fast.change) > 4 * abs(slow.change)


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
    assert "squeeze changes the least film by up to about" in first
    assert "are enough for 5 %; up to" in verdict
    assert judged == "load over time: models are judged at the largest load"


def test_fast_loads_need_a_march():
    in_time = KIND.in_time(bearing(0.005), 0.05)
    assert not in_time.entries["quasi_static"]["enough"]
    assert "take roughfilm march; below" in in_time.lines[1]
