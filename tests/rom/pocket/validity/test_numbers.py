"""The numbers of a pocket on which error laws depend."""

import numpy as np
import pytest

import roughfilm as rf
from roughfilm.ladder import find
from roughfilm.rom.advice.expected import error_lines
from roughfilm.rom.ladder.kind import kind_of_laws, kind_of_scene
from roughfilm.rom.ladder.scene import read_scene
from roughfilm.rom.pocket.kind import KIND
from roughfilm.rom.pocket.validity.numbers import MAX_SHORTNESS, SYMBOLS, numbers


def pocket(**groove):
    return read_scene(
        {
            "name": "numbers",
            "kind": "pocket",
            "geometry": {"length": "1 mm", "film": "30 um", **groove},
            "lubricant": {"viscosity": "0.1 Pa*s", "density": "1000 kg/m^3"},
            "motion": {"reynolds_number": 1},
        }
    )


ARC = [[float(x), float(15e-6 * (1 - (x / 1e-4) ** 2))] for x in np.linspace(-1e-4, 1e-4, 201)]
"""Points of a parabola 0.2 mm wide and 15 µm deep, m."""


@pytest.mark.parametrize(
    ("groove", "shortest"),
    [
        ({"width": "0.2 mm", "depth": "15 um"}, 0.1e-3),
        ({"width": "0.2 mm", "depth": "15 um", "profile": "splined", "shift": "60 um"}, 40e-6),
        ({"width": "0.2 mm", "depth": "15 um", "position": "0.39 mm"}, 10e-6),
        ({"width": "0.2 mm", "depth": "15 um", "position": "0.4 mm"}, 0.1e-3),
        ({"profile": "points", "points": [[-1e-4, 0.0], [-0.5e-4, 1e-5], [-0.2e-4, 1.5e-5], [1e-4, 0.0]]}, 30e-6),
        ({"profile": "points", "points": ARC}, 0.1e-3),
    ],
    ids=["half an arc", "steep side", "land to the end of the period", "no land", "between corners", "sampled curve"],
)
def test_shortness_is_the_film_over_the_shortest_piece_of_the_wall(groove, shortest):
    assert numbers(pocket(**groove))["shortness"] == pytest.approx(30e-6 / shortest, rel=1e-6)


def test_shortness_has_an_upper_end():
    assert numbers(pocket(width="0.2 mm", depth="15 um", position="0.3999 mm"))["shortness"] == MAX_SHORTNESS


CELL = {
    "breadth": "0.5 mm",
    "dimples": [
        {"shape": "spherical", "width": "0.2 mm", "depth": "15 um"},
        {"shape": "conical", "width": "0.1 mm", "depth": "30 um", "position": "0.3 mm", "edge": "20 um"},
    ],
}


def test_a_cell_in_plan_has_numbers_and_laws_of_its_own():
    scene = pocket(**CELL)
    found = numbers(scene)
    assert found["shortness"] == pytest.approx(30 / 20)
    assert (found["depth"], found["cell_breadth"]) == (1.0, 0.5)
    assert found["covered"] == pytest.approx(np.pi * (0.1**2 + 0.05**2) / 0.5, rel=0.1)
    assert 0 < found["loaded"] < 1
    assert set(found) <= set(SYMBOLS)
    own = kind_of_scene(scene)
    assert own.name_of_laws == "dimples" == kind_of_laws("dimples").name_of_laws
    assert kind_of_scene(pocket(width="0.2 mm", depth="15 um")).name_of_laws == "pocket"


@pytest.mark.parametrize("resolution", [32, 128])
def test_no_error_of_a_cell_in_plan_is_stated_by_the_laws_of_grooves(resolution):
    """On the finest usual grid neither: a model with an order of convergence is exact on none."""
    result = rf.solve(pocket(**CELL), model="reynolds", resolution=resolution)
    assert not result.expected_error
    assert "load, friction unknown" in error_lines(kind_of_scene(pocket(**CELL)), result)


def test_a_table_names_several_dimples_by_their_greatest_depth_and_least_extent():
    found = KIND.columns(pocket(**CELL))
    assert found["profile"] == "several dimples"
    assert {name: found[name].value for name in ("width_plus", "depth_plus", "film_plus", "cell_breadth")} == {
        "width_plus": 0.1,
        "depth_plus": 1.0,
        "film_plus": 0.03,
        "cell_breadth": 0.5,
    }


def test_reynolds_in_plan_has_an_order_and_over_grooves_none():
    model = find("pocket", "reynolds")
    assert [model.order_of(scene) for scene in (pocket(**CELL), pocket(width="0.2 mm", depth="15 um"))] == [2, None]
