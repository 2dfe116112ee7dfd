"""The stream function of a known flow on columns that lean."""

import numpy as np
import pytest

from roughfilm.figures.streamlines import stream_function


def exact(x, y):
    """ψ = d² (2 + cos x) with d the distance to the wall y = sin(x) / 4, and its velocity ∂ψ/∂y, -∂ψ/∂x."""
    d, slope = y - np.sin(x) / 4, np.cos(x) / 4
    velocity = np.stack([2 * d * (2 + np.cos(x)), 2 * d * slope * (2 + np.cos(x)) + d**2 * np.sin(x)], axis=-1)
    return d**2 * (2 + np.cos(x)), velocity


def test_the_stream_function_is_of_second_order_where_columns_lean():
    errors = []
    for cells in (40, 80):
        start, up = np.meshgrid(np.linspace(0, 2 * np.pi, cells + 1), np.linspace(0, 1, cells // 4 + 1), indexing="ij")
        x = start + 0.5 * up
        low = np.sin(start) / 4
        vertices = np.stack([x, low + (1 - low) * up], axis=-1)
        middle = (vertices[:-1, :-1] + vertices[1:, :-1] + vertices[1:, 1:] + vertices[:-1, 1:]) / 4
        found = stream_function(vertices, exact(middle[..., 0], middle[..., 1])[1])
        errors.append(np.abs(found - exact(x, vertices[..., 1])[0]).max())
    assert errors[0] < 0.05
    assert np.log2(errors[0] / errors[1]) == pytest.approx(2, abs=0.3)


def test_the_stream_function_of_a_film_with_ends_takes_the_columns_beside_them():
    """Shear between parallel walls, u = y, has ψ = y²/2 everywhere, and at the ends."""
    x, y = np.meshgrid(np.linspace(0, 3, 7), np.linspace(0, 1, 21), indexing="ij")
    middle = (y[:-1, 1:] + y[:-1, :-1]) / 2
    velocity = np.stack([middle, 0 * middle], axis=-1)
    found = stream_function(np.stack([x, y], axis=-1), velocity, periodic=False)
    assert found == pytest.approx(y**2 / 2, abs=1e-12)
