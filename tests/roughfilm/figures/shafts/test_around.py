"""Figures of shafts in lobes: angles on the axis, gaps and load marked, and the drawing around the shaft."""

import numpy as np
import pytest
from matplotlib.figure import Figure

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
    axis = along_of(drawn[0])
    assert axis(np.array([0.0, 0.05 * np.pi])) == pytest.approx([-140.0, 40.0])
    assert axis.load == pytest.approx(200.0)
    assert [end - begin for begin, end in axis.gaps] == pytest.approx([20.0] * 3)
    inside = axis.lobes_only(np.array([-130.0, -30.0, 0.0]), np.ones(3))
    assert np.isnan(inside).tolist() == [False, True, False]


def test_a_comparison_draws_the_film_over_the_angle_and_around_the_shaft(drawn):
    plots = VIEW.plots(*drawn, "reynolds_cavitating")
    assert set(plots) == {"along", "around", "over"}
    assert all(plot.svg.startswith("<svg") for plot in plots.values())


def scene_of(geometry, *supplies):
    speed = "3000 rpm" if geometry["shape"] == "lobes" else "10 m/s"
    tables = {"lubricant": {"viscosity": "20 mPa*s"}, "motion": {"speed": speed}, "load": {"force": "2 kN"}}
    return read_scene({"name": "fed", "kind": "bearing", "geometry": geometry, "supply": [*supplies]} | tables)


def drawn_on_a_map(scene, x, y):
    axes = Figure().subplots()
    axes.set(xlim=x, ylim=y)
    along_of(scene).outline(axes)
    frames = [(*one.get_xy(), one.get_width(), one.get_height()) for one in axes.patches]
    return frames, [text.get_text() for text in axes.texts], [line.get_xydata()[0] for line in axes.lines]


def test_a_map_of_lobes_has_a_frame_with_a_number_around_each_supply():
    groove = {"kind": "groove", "angle": "90 deg", "length": "10 mm", "extent": "30 mm", "pressure": "1 bar"}
    ring = {"kind": "groove", "extent": "4 mm", "y": "47 mm", "pressure": "1 bar"}
    frames, numbers, pivots = drawn_on_a_map(scene_of(BORE, groove, ring), (-270, 90), (0, 50))
    half = np.degrees(5 / 50)
    assert frames[0] == pytest.approx((-270 - half, 10, 2 * half, 30))  # a groove at both ends of the map
    assert frames[1] == pytest.approx((90 - half, 10, 2 * half, 30))
    assert frames[2] == pytest.approx((-270, 45, 360, 4))
    assert numbers == ["1", "1", "2"]
    assert pivots == []


@pytest.mark.parametrize(
    ("geometry", "place"),
    [
        ({"shape": "pivoted", "length": "40 mm", "width": "20 mm", "pivot": 0.6}, (24, 10)),
        (
            {
                "shape": "pivoted_sector",
                "inner_radius": "50 mm",
                "outer_radius": "90 mm",
                "angle": "40 deg",
                "pads": 8,
                "pivot": [0.6, 0.75],
            },
            (24, 80),
        ),
    ],
)
def test_a_map_of_a_pad_has_a_triangle_at_its_pivot(geometry, place):
    assert drawn_on_a_map(scene_of(geometry), (0, 40), (0, 90))[2] == [pytest.approx(place)]


def test_sections_are_shaded_where_they_pass_a_supply():
    hole = {"kind": "hole", "angle": "0 deg", "y": "10 mm", "diameter": "6 mm", "pressure": "1 bar"}
    axis = along_of(scene_of(BORE, hole))
    shaded = []
    for across in (0.010, 0.025):
        axes = Figure().subplots()
        axes.set_xlim(-270, 90)
        axis.mark(axes, at=across)
        shaded.append(len(axes.patches))
    assert shaded == [1, 0]
