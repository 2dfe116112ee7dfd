"""The mesh has the gap's shape, a column at every break, and cells that fill the gap exactly."""

import numpy as np
import pytest

from foamcases.mesh import layered
from rom.grid import columns
from rom.groove import channel, cylindrical


@pytest.fixture
def gap():
    return channel(length=1e-3, film=3e-5, grooves=[(0.0, cylindrical(width=3e-4, depth=2.25e-5))])


@pytest.mark.parametrize("resolution", [12, 61, 240])
def test_every_break_is_a_column_and_the_columns_are_symmetric(gap, resolution):
    x = columns(gap, resolution)
    assert np.all(np.diff(x) > 0)
    for place in gap.breaks:
        assert np.abs(x - place / gap.film).min() < 1e-9
    assert x + x[::-1] == pytest.approx(np.zeros(x.size), abs=1e-6)
    assert abs(x.size - 1 - resolution) <= 3


def test_columns_stand_closer_at_the_edges_of_the_groove(gap):
    x = columns(gap, 240)
    steps = np.diff(x)
    edge = np.abs(x[:-1] - gap.breaks[2] / gap.film).argmin()
    assert steps[edge] < steps.max() / 4
    assert np.abs(np.diff(np.log(steps))).max() < 0.35


def test_vertices_lie_on_the_walls_and_fill_the_gap(gap):
    vertices = layered(gap, 240)
    x = vertices[:, 0, 0, 0]
    lower = 1 - gap.thickness(x * gap.film) / gap.film
    assert vertices[:, 0, 0, 1] == pytest.approx(lower, abs=1e-12)
    assert np.all(vertices[:, -1, :, 1] == 1)
    assert vertices.shape[1] == 49
    radius = (5.0**2 + 0.75**2) / 1.5
    angle = np.arcsin(5.0 / radius)
    segment = radius**2 * (angle - np.sin(angle) * np.cos(angle))
    area = np.trapezoid(vertices[:, -1, 0, 1] - vertices[:, 0, 0, 1], x)
    assert area == pytest.approx(1000 / 30 + segment, rel=1e-4)
