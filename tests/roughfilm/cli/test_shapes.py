"""Report and pictures speak of every groove of a scene, whatever its shape."""

import html
import re

import numpy as np
import pytest

from roughfilm.cli.first_steps import compare
from roughfilm.figures.streamlines import shown
from roughfilm.figures.views.pocket import pressure
from roughfilm.foamcases.pocket.case import vertices_of
from roughfilm.ladder import find
from roughfilm.rom.ladder.scene import load_scene

ONE = ["geometry.profile=points", "geometry.points=[[-1e-4,0],[0,1e-5],[2e-4,0]]"]
FIVE = "geometry.grooves=[{}]".format(
    ", ".join(f'{{"width": "{40 + n} um", "depth": "3 um", "position": "{100 * n} um"}}' for n in range(5))
)
TURNED = "geometry.dimples=[{}]".format(
    '{"shape": "box", "width": "0.3 mm", "breadth": "0.5 mm", "depth": "9 um", "edge": "40 um", "rotation": "20 deg", '
    '"position": "-0.25 mm"}'
)


@pytest.fixture
def reynolds_only(monkeypatch):
    monkeypatch.setattr(compare, "models", lambda _: (find("pocket", "reynolds"),))


@pytest.mark.usefixtures("reynolds_only")
@pytest.mark.parametrize(
    ("name", "overrides", "words"),
    [
        ("pocket", [], "in the still wall a cylindrical groove 300 µm wide and 7.5 µm deep."),
        (
            "splined",
            [],
            "in the still wall a splined groove 500 µm wide and 7.5 µm deep, with its lowest point 150 µm upstream of "
            "its middle.",
        ),
        ("splined", ["geometry.shift=1 um"], "deep, with its lowest point 1 µm downstream of its middle."),
        ("splined", ["geometry.shift=0 m"], "a splined groove 500 µm wide and 7.5 µm deep."),
        ("pocket", ONE, "in the still wall a groove of straight lines through 3 points 300 µm wide and 10 µm deep."),
        ("pocket", ["geometry.position=-20 um"], "a cylindrical groove 300 µm wide and 7.5 µm deep, at −20 µm."),
        (
            "two_grooves",
            [],
            "in the still wall a cylindrical groove 300 µm wide and 7.5 µm deep, at −250 µm; a splined groove 400 µm "
            "wide and 15 µm deep, with its lowest point 100 µm upstream of its middle, at 200 µm.",
        ),
        ("two_grooves", [FIVE], "in the still wall 5 grooves, at most 44 µm wide and 3 µm deep."),
        (
            "dimple",
            [],
            "in the still wall a spherical dimple, 300 µm × 300 µm and 7.5 µm deep. Dimples cover 7.07 % of the cell. "
            "Pressures count from their mean over the edges x = ±L/2 of the cell on the sliding wall.",
        ),
        (
            "dimple",
            [TURNED, "geometry.arrangement=staggered"],
            "a box, 300 µm × 500 µm and 9 µm deep, turned by 20°, with its middle at x = −250 µm, y = 0, staggered: "
            "with a copy of each half a cell further along and across.",
        ),
    ],
)
def test_the_page_says_what_the_wall_looks_like(pocket_file, tmp_path, name, overrides, words):
    compare.command(pocket_file.parent / f"{name}.toml", out=tmp_path, set_=overrides)
    page = html.unescape((tmp_path / "report.html").read_text())
    assert words in re.sub(r"\s+", " ", page)


@pytest.mark.usefixtures("drawn")
def test_the_pressure_plot_marks_the_edges_of_every_groove_and_nothing_else(pocket_file):
    edges = []
    for name, overrides in (("pocket", []), ("pocket", ONE), ("two_grooves", [])):
        scene = load_scene(pocket_file.parent / f"{name}.toml", overrides)
        svg = pressure(scene, {"reynolds": find("pocket", "reynolds").solve(scene)}, "reynolds")
        edges.append(svg.count("stroke-dasharray: 3.2,2.4") - 1)  # that of the legend
    assert edges == [2, 2, 4]


@pytest.mark.parametrize(("name", "left", "right"), [("two_grooves", -0.5, 0.5), ("splined", -0.425, 0.425)])
def test_a_picture_shows_all_grooves_with_a_margin(pocket_file, name, left, right):
    scene = load_scene(pocket_file.parent / f"{name}.toml")
    vertices = vertices_of(scene, 240)[:, :, 0, :2] * scene.geometry.film
    x = vertices[shown(vertices), 0, 0]
    assert (x[0], x[-1]) == pytest.approx((left * 1e-3, right * 1e-3), abs=3e-5)


def test_a_picture_of_a_tiny_film_or_groove_shows_it_too(pocket_file):
    scene = load_scene(pocket_file, ["geometry.depth=1 pm"])
    vertices = vertices_of(scene, 240)[:, :, 0, :2] * scene.geometry.film
    for scale in (1.0, 1e-4):
        window = shown(vertices * scale)
        assert np.ptp(vertices[window, 0, 0]) == pytest.approx(1.7 * 0.3e-3, rel=0.05)
