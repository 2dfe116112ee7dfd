"""The tensor of turned grooves, and the box of a uniform tensor between bounds from finite elements."""

import math

import numpy as np
import pytest
from scipy.sparse import coo_array
from scipy.sparse.linalg import spsolve

from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.homogenization.flow_factors import flow_factors
from roughfilm.rom.homogenization.lay import box_factors, turned

GAUSS = np.array([-1, 1]) / np.sqrt(3)


def upper_bound(tensor, size, count):
    """The flow of least dissipation among bilinear pressures on count × count elements: never below φ₁."""
    (hx, hy), n = (side / count for side in size), count + 1
    element = np.zeros((4, 4))
    for s in GAUSS:
        for t in GAUSS:
            gradient = np.array(
                [
                    [-(1 - t) / hx, (1 - t) / hx, -(1 + t) / hx, (1 + t) / hx],
                    [-(1 - s) / hy, -(1 + s) / hy, (1 - s) / hy, (1 + s) / hy],
                ]
            )
            element += gradient.T @ tensor @ gradient * hx * hy / 16
    i, j = np.meshgrid(np.arange(count), np.arange(count), indexing="ij")
    corners = np.stack([i * n + j, (i + 1) * n + j, i * n + j + 1, (i + 1) * n + j + 1], axis=-1).reshape(-1, 4)
    rows, columns = (np.repeat(corners, 4, axis=1), np.tile(corners, (1, 4)))
    matrix = coo_array((np.tile(element.ravel(), len(corners)), (rows.ravel(), columns.ravel())), (n * n, n * n))
    matrix = matrix.tocsr()
    pressure = np.repeat(np.linspace(0, size[0], n), n)
    free = np.arange(n, n * n - n)
    pressure[free] -= spsolve(matrix[free][:, free].tocsc(), matrix[free] @ pressure)
    return float(pressure @ (matrix @ pressure)) / (size[0] * size[1])


@pytest.mark.parametrize("angle", [0.3, 1.0, 2.2])
@pytest.mark.parametrize("size", [(1, 1), (1, 3), (2.5, 1)])
def test_the_box_lies_between_bounds_from_both_sides(angle, size):
    """φ₁ from above, and det A/φ₂ from below, as the box of stream lines is the other box."""
    tensor = turned((0.3, 1.7), angle)
    above = upper_bound(tensor, size, 60)
    below = np.linalg.det(tensor) / upper_bound(tensor[::-1, ::-1], size[::-1], 60)
    first, second = box_factors(tensor, size)
    assert below < first < above
    assert above / below < 1.03
    assert first * second == pytest.approx(np.linalg.det(tensor), rel=1e-12)


def test_a_square_box_of_grooves_halfway_has_their_geometric_mean():
    assert box_factors(turned((0.15, 1.735), math.pi / 4), (1, 1)) == pytest.approx(math.sqrt(0.15 * 1.735), rel=1e-10)


def test_short_and_long_boxes():
    tensor = turned((0.2, 1.5), 0.5)
    harmonic = np.linalg.det(tensor) / np.diag(tensor)[::-1]
    assert box_factors(tensor, (1, 1e4)) == pytest.approx([tensor[0, 0], harmonic[1]], rel=1e-3)
    assert box_factors(tensor, (1e4, 1)) == pytest.approx([harmonic[0], tensor[1, 1]], rel=1e-3)
    assert box_factors(np.diag([0.3, 2.0]), (3, 1)) == pytest.approx([0.3, 2.0], rel=1e-10)


@pytest.mark.parametrize("angle", [0.1, 0.5, 0.7])
def test_closed_ridges_leave_the_grooves_that_cross_the_box(angle):
    """The part 1 − tan β of the width, in which the pressure falls over 1/cos β of the length."""
    first = box_factors(turned((1e-11, 1.4), angle), (1, 1))[0]
    assert first == pytest.approx(1.4 * math.cos(angle) ** 2 * (1 - math.tan(angle)), rel=1e-3)


def test_the_cell_turns_its_tensor():
    part, (p, q) = 0.6, (2, 3)
    x, y = np.meshgrid(*(np.arange(192) / 192,) * 2, indexing="ij")
    gap = 1 + part * np.cos(2 * np.pi * (q * x - p * y))
    angle = math.atan2(q, p)
    across, along = (1 - part**2) ** 2.5 / (1 + part**2 / 2), 1 + 1.5 * part**2
    found = flow_factors(gap, (1.0, 1.0)).factors
    assert found.pressure == pytest.approx(turned((across, along), angle), rel=6e-3)
    shear = turned(((1 - part**2) / (1 + part**2 / 2), 1.0), angle)[:, 0]
    assert found.shear == pytest.approx(shear, rel=6e-3)


@pytest.mark.parametrize(
    ("tensor", "size", "message"),
    [
        ([[1, 0.5], [0.2, 1]], (1, 1), "symmetric"),
        ([[1, 2], [2, 1]], (1, 1), "positive definite"),
        ([[1, np.nan], [np.nan, 1]], (1, 1), "symmetric"),
        (np.eye(3), (1, 1), "symmetric"),
        (np.eye(2), (1, 0), "lengths"),
    ],
)
def test_what_makes_no_sense_is_refused(tensor, size, message):
    with pytest.raises(InputError, match=message):
        box_factors(tensor, size)
