"""The numbers of a pocket on which error laws depend."""

import numpy as np
import pytest

from roughfilm.rom.ladder.scene import read_scene
from roughfilm.rom.pocket.validity.numbers import MAX_SHORTNESS, numbers


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
