"""What a page reads from a figure is where it was drawn, and is the value that was drawn."""

import json
import re

import numpy as np
import pytest
from boxes import overlaps
from matplotlib.figure import Figure

from roughfilm.figures.base import new_figure, svg
from roughfilm.figures.readings import MAX_POINTS, name_and_unit


def read(figure):
    return json.loads(re.search(r'<metadata class="readings">(.*)</metadata>', svg(figure)).group(1))


def points_of(series):
    return np.array(series["points"], float).reshape(-1, 5)


@pytest.mark.parametrize("scale", ["linear", "log"])
def test_points_are_where_they_are_drawn_with_their_values_and_uncertainty(scale):
    figure, axes = new_figure((5, 4))
    x, y, bars = np.array([1.0, 10.0, 100.0]), np.array([2.0, 5.0, 3.0]), np.array([0.1, 0.2, 0.3])
    axes.errorbar(x, y, bars, label="computed")
    axes.set(xscale=scale, xlim=(1, 100), ylim=(2, 5), xlabel="load, MPa (dotted: sealed)", ylabel="gap, µm")
    (panel,) = read(figure)
    assert (panel["x"]["name"], panel["x"]["unit"], panel["y"]["unit"]) == ("load", "MPa", "µm")
    (series,) = panel["series"]
    assert (series["label"], series["of"]) == ("computed", "y")
    points, (left, top, width, height) = points_of(series), panel["box"]
    part = (x - 1) / 99 if scale == "linear" else np.log10(x) / 2
    assert points[:, 0] == pytest.approx(left + part * width, abs=0.11)
    assert points[:, 1] == pytest.approx(top + (5 - y) / 3 * height, abs=0.11)
    np.testing.assert_allclose(points[:, 2:], np.stack([x, y, bars], axis=1))


def test_a_point_with_an_infinite_uncertainty_has_no_bar():
    figure, axes = new_figure((5, 4))
    axes.errorbar([1.0, 2.0], [3.0, 4.0], [0.1, np.inf], label="computed")
    axes.set(xlabel="load, MPa", ylabel="gap, µm")
    (panel,) = read(figure)
    points = points_of(panel["series"][0])
    np.testing.assert_allclose(points[:, 2:], [[1.0, 3.0, 0.1], [2.0, 4.0, 0.0]])


def test_a_long_series_is_thinned_and_keeps_its_extreme_values():
    figure, axes = new_figure((5, 4))
    x = np.linspace(0, 1, 100_000)
    y = np.sin(40 * x)
    y[31_234], y[81_111] = 7.0, -9.0
    axes.plot(x, y)
    points = points_of(read(figure)[0]["series"][0])
    assert len(points) <= MAX_POINTS
    assert (points[:, 3].max(), points[:, 3].min()) == (7.0, -9.0)


@pytest.mark.parametrize("kind", ["picture", "mesh", "leaning mesh"])
def test_the_cells_of_a_map_have_the_values_of_a_linear_field(kind):
    figure, axes = new_figure((6, 4))
    x, y = np.meshgrid(np.linspace(0, 4, 161), np.linspace(0, 2, 81), indexing="ij")
    if kind == "picture":
        middle = [(one[1:, 1:] + one[:-1, :-1]) / 2 for one in (x, y)]
        image = axes.imshow((middle[0] + 10 * middle[1]).T, origin="lower", extent=(0, 4, 0, 2), aspect="auto")
    else:
        x = x + (0.3 * y if kind == "leaning mesh" else 0.0)
        middle = [(one[1:, 1:] + one[:-1, :-1]) / 2 for one in (x, y)]
        image = axes.pcolormesh(x, y, middle[0] + 10 * middle[1])
        axes.set(xlim=(0, 4), ylim=(0, 2))
    figure.colorbar(image, label="pressure, kPa")
    (panel,) = read(figure)
    held = panel["map"]
    assert (held["name"], held["unit"]) == ("pressure", "kPa")
    found = np.array(held["values"], float).reshape(held["rows"], held["columns"])
    across = (np.arange(held["columns"]) + 0.5) / held["columns"] * 4
    up = (1 - (np.arange(held["rows"]) + 0.5) / held["rows"]) * 2
    wanted = across + 10 * up[:, None]
    there = np.isfinite(found)
    assert there.mean() == pytest.approx(1.0 if kind != "leaning mesh" else 1 - 0.3 * 2 * 2 / 2 / 8, abs=0.03)
    np.testing.assert_allclose(found[there], wanted[there], atol=0.3)


def test_bars_have_the_names_of_their_places():
    figure, axes = new_figure((5, 4))
    axes.barh([0, 1], [3.0, 4.0], left=[1.0, 0.0], label="part")
    axes.set_yticks([0, 1], ["texture", "cavitation"])
    (panel,) = read(figure)
    assert panel["y"]["places"] == [[0, "texture"], [1, "cavitation"]]
    assert points_of(panel["series"][0])[:, 2] == pytest.approx([4.0, 4.0])


def test_lines_across_all_of_the_axes_are_no_series():
    figure, axes = new_figure((5, 4))
    axes.axhline(1.0)
    axes.axvline(2.0)
    assert read(figure) == []


def test_two_figures_on_a_page_share_no_identifier():
    texts = []
    for top in (1.0, 2.0):
        figure, axes = new_figure((5, 4))
        axes.plot([0, 1], [0, top], "o-")
        texts.append(svg(figure))
    first, second = (set(re.findall(r'\bid="([^"]+)"', text)) for text in texts)
    assert not first & second
    for text, own in zip(texts, (first, second), strict=True):
        assert set(re.findall(r'(?:href="|url\()#([^")]+)', text)) <= own


@pytest.mark.parametrize(
    ("label", "name", "unit"),
    [
        ("flow per width, mm²/s", "flow per width", "mm²/s"),
        ("x, µm, along the joint across y", "x", "µm"),
        ("load: difference from\nthe extrapolated value, %", "load: difference from the extrapolated value", "%"),
        ("rms slope", "rms slope", ""),
    ],
)
def test_a_label_has_a_name_and_a_unit(label, name, unit):
    assert name_and_unit(label) == (name, unit)


def test_overlapping_texts_are_found_and_separate_ones_are_not():
    figure = Figure(figsize=(4, 3))
    axes = figure.add_axes((0.2, 0.2, 0.7, 0.7))
    axes.text(0.2, 0.5, "here")
    axes.text(0.7, 0.5, "there")
    assert overlaps(figure) == []
    axes.text(0.22, 0.5, "again")
    figure.text(0.98, 0.5, "outside")
    assert overlaps(figure) == ["text 'outside' leaves the figure", "text 'here' overlaps text 'again'"]
