"""Stress and pressure on the sliding wall from layers of any thickness, on columns that lean."""

import numpy as np
import pytest

from roughfilm.foamcases.conformal.cells import centres
from roughfilm.foamcases.conformal.channel import Channel


@pytest.fixture
def channel():
    """Plane shear u = y with the pressure 3 + 2 y, on leaning columns and layers that get thinner upwards."""
    x, layer = np.meshgrid(np.linspace(0, 4, 9), np.linspace(0, 1, 6), indexing="ij")
    vertices = np.stack([x + 0.3 * layer, 1 - (1 + 0.2 * np.sin(x)) * (1 - layer) ** 1.5], axis=-1)
    y = centres(vertices)[..., 1]
    return Channel(vertices=vertices, velocity=np.stack([y, 0 * y], axis=-1), pressure=3 + 2 * y)


def test_plane_shear_has_shear_stress_1_and_a_linear_pressure_is_extrapolated_exactly(channel):
    assert channel.wall_shear == pytest.approx(np.ones(8))
    assert channel.wall_pressure == pytest.approx(np.full(8, 5.0))
    assert channel.mean(channel.wall_pressure) == pytest.approx(5.0)
    assert channel.position == pytest.approx(0.3 + np.arange(0.25, 4, 0.5))
