"""Figures of shafts in lobes: angles on the axis, gaps and load marked, and the drawing around the shaft."""

import numpy as np
import pytest

from roughfilm.figures.shafts.angles import along_of
from roughfilm.figures.views.bearing import VIEW
from roughfilm.ladder import find
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene

BORE = {"shape": "lobes", "radius": "50 mm", "clearance": "50 um", "width": "50 mm"}


@pytest.fixture(scope="module")
def drawn():
    entries = {
        "name": "lobes",
        "kind": "bearing",
        "geometry": BORE | {"lobes": 3, "arc": "100 deg", "preload": 0.4},
        "lubricant": {"viscosity": "20 mPa*s"},
        "motion": {"speed": "3000 rpm"},
        "load": {"force": "2 kN", "angle": "200 deg"},
    }
    scene = read_scene(entries)
    model = find("bearing", "reynolds_cavitating")
    return scene, {"reynolds_cavitating": model.solve(scene, Request(resolution=32))}


def test_positions_are_angles_from_the_x_axis_and_the_load_stands_at_its_own(drawn):
    axis = along_of(*drawn)
    assert axis(np.array([0.0, 0.05 * np.pi])) == pytest.approx([-140.0, 40.0])
    assert axis.load == pytest.approx(200.0)
    assert [end - begin for begin, end in axis.gaps] == pytest.approx([20.0] * 3)
    inside = axis.lobes_only(np.array([-130.0, -30.0, 0.0]), np.ones(3))
    assert np.isnan(inside).tolist() == [False, True, False]


def test_a_comparison_draws_the_film_over_the_angle_and_around_the_shaft(drawn):
    plots = VIEW.plots(*drawn, "reynolds_cavitating")
    assert set(plots) == {"along", "around", "over"}
    assert all(plot.svg.startswith("<svg") for plot in plots.values())
