"""The mesh has the gap's shape, and cells that fill the gap exactly."""

import numpy as np
import pytest

from roughfilm.foamcases.openfoam.block_mesh import layered
from roughfilm.rom.pocket.groove import channel, cylindrical


@pytest.fixture
def gap():
    return channel(length=1e-3, film=3e-5, grooves=[(0.0, cylindrical(width=3e-4, depth=2.25e-5))])


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
