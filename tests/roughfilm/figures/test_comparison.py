"""Figures of a comparison: a front through its points, one picture of the reference and differences from it."""

import numpy as np
import pytest

from roughfilm.figures.base import FRONT, speed_against_accuracy
from roughfilm.figures.differences import SIGNED, differences, on_points
from roughfilm.figures.view import views
from roughfilm.rom.studies.comparison import Point, pareto_front
from roughfilm.words.scales import Scale

MPA = Scale(factor=1e6, unit="MPa")

RUNS = {
    "reynolds": ((24, 1e-3, 0.9), (48, 2e-3, 0.9)),
    "film": ((50, 0.01, 0.02), (100, 0.02, 0.006), (200, 0.04, 0.007)),
    "stokes": ((60, 3.0, 0.5),),
}


@pytest.fixture(scope="module")
def chart():
    return [
        Point(model=model, resolution=grid, cpu_s=cpu, error={"load_plus": error})
        for model, runs in RUNS.items()
        for grid, cpu, error in runs
    ]


def test_the_pareto_front_is_drawn_straight_through_the_points_that_it_is_made_of(chart):
    figure = speed_against_accuracy(chart, {"load_plus": 0.001}, {"load_plus": "load", "x": "y"}, views()["pocket"])
    lines = {line.get_label(): line for line in figure.axes[0].lines}
    assert lines[FRONT].get_drawstyle() == "default"
    vertices = {tuple(vertex) for vertex in lines[FRONT].get_xydata()}
    drawn = {tuple(mark) for line in figure.axes[0].lines if line.get_marker() != "None" for mark in line.get_xydata()}
    assert vertices == {(1e-3, 90.0), (0.01, 2.0), (0.02, 0.6)}
    assert vertices <= drawn
    assert len(vertices) == len(pareto_front(chart, "load_plus", 0.001))


def test_errors_far_below_the_uncertainty_of_the_reference_do_not_stretch_the_axis(chart):
    zero = [*chart, Point(model="film", resolution=400, cpu_s=0.1, error={"load_plus": 1e-12})]
    figure = speed_against_accuracy(zero, {"load_plus": 0.01}, {"load_plus": "load", "x": "y"}, views()["pocket"])
    assert figure.axes[0].get_ylim()[0] > 0.01


def test_differences_have_one_scale_that_is_white_at_zero():
    fields = {"a": np.zeros((20, 20)), "b": np.full((20, 20), -3e6), "c": np.full((20, 20), 1e6)}
    found = differences(fields, "a", "pressure", MPA, 1e5)
    assert set(found.drawn) == {"b", "c"}
    assert found.colours == {"cmap": SIGNED, "vmin": -3.0, "vmax": 3.0}
    assert found.words == ()


def test_a_difference_below_the_uncertainty_is_said_in_words():
    top = np.full((10, 10), 2e6)
    found = differences({"a": top, "b": top + 4e4, "c": top + 1e3, "d": top}, "a", "pressure", MPA, 5e4)
    assert not found.drawn
    (words,) = found.words
    assert words.startswith("The pressure by b, c and d differs from that by a by at most 2 % of its largest value")
    (same,) = differences({"a": top, "d": top}, "a", "pressure", MPA, None).words
    assert same == "The pressure by d is that by a."


def test_values_on_other_points_are_linear_between_their_own():
    x, y = np.linspace(0, 1, 5), np.linspace(0, 2, 4)
    there = np.linspace(0, 1, 9), np.linspace(0, 2, 3)
    plane = 1 + 2 * x[:, None] - y
    assert on_points((x, y), plane, there) == pytest.approx(1 + 2 * there[0][:, None] - there[1])
