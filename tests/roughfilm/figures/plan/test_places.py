"""Lines through a cell in plan: through a dimple, over the periodic edge, and where they cross rims."""

import numpy as np
import pytest
from places import SCENES

from roughfilm.figures.plan.places import between, edges_on, middle_line
from roughfilm.rom.ladder.scene import load_scene


def scene(*changes):
    return load_scene(SCENES / "dimple.toml", changes)


@pytest.mark.parametrize(
    ("changes", "line"),
    [
        ((), 0.0),
        (("geometry.arrangement=staggered",), 0.0),
        (("geometry.dimples.0.position_across=0.2 mm",), 0.2e-3),
        (("geometry.dimples.0.position_across=0.9 mm",), -0.1e-3),
        (("geometry.dimples.0.position_across=0.4 mm", "geometry.arrangement=staggered"), -0.1e-3),
    ],
)
def test_the_line_goes_through_the_deepest_dimple_nearest_to_the_middle(changes, line):
    assert middle_line(scene(*changes)) == pytest.approx(line, abs=1e-12)


def test_the_edges_are_those_of_the_outline_on_the_line():
    """A chord of a circle of radius R at the distance c has half the length sqrt(R² - c²)."""
    radius, length = 0.15e-3, 1e-3
    for distance in (0.0, 0.1e-3):
        half = np.sqrt(radius**2 - distance**2)
        assert edges_on(scene(), distance) == pytest.approx([-half, half], abs=2e-3 * length)
    assert edges_on(scene(), 0.3e-3) == ()


def test_values_between_columns_are_linear_also_over_the_periodic_edge():
    places = np.array([-0.4, 0.0, 0.3])
    values = np.array([[1.0, 3.0, 9.0], [0.0, 2.0, 4.0]])
    assert between(places, values, 0.15, 1.0) == pytest.approx([6.0, 3.0])
    assert between(places, values, 0.4, 1.0) == pytest.approx([9 - 8 / 3, 4 - 4 / 3])
    assert between(places, values, -0.5, 1.0) == pytest.approx(between(places, values, 0.5, 1.0))
