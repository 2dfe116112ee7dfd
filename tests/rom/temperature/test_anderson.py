"""Anderson's method against direct solutions of affine maps."""

import numpy as np
import pytest

from roughfilm.rom.temperature.anderson import AndersonAcceleration, factors


def iterated(matrix, constant, steps):
    memory, point = AndersonAcceleration(remembered=8), np.zeros(constant.size)
    for _ in range(steps):
        image = matrix @ point + constant
        point = memory.following(image - point, image)
    return point


@pytest.mark.parametrize("slow", [[0.99], [0.999, -2.0], [0.9, 0.99, 3.0]])
def test_slow_modes_are_gone_after_as_many_steps(slow):
    """An affine map of 40 numbers with few modes that converge slowly, or diverge, beside constant ones."""
    numbers = np.random.default_rng(5)
    modes = np.linalg.qr(numbers.normal(size=(40, 40)))[0]
    matrix = modes[:, : len(slow)] @ np.diag(slow) @ modes[:, : len(slow)].T
    constant = numbers.normal(size=40)
    exact = np.linalg.solve(np.eye(40) - matrix, constant)
    np.testing.assert_allclose(iterated(matrix, constant, len(slow) + 2), exact, rtol=1e-7, atol=1e-7)


def test_factors_are_those_of_least_squares_whatever_the_sizes_of_the_changes():
    numbers = np.random.default_rng(6)
    rests = [10.0**-k * numbers.normal(size=30) for k in range(8)]
    changes = np.diff(rests, axis=0)
    expected = np.linalg.lstsq(changes.T, rests[-1], rcond=None)[0]
    np.testing.assert_allclose(factors(rests), expected, rtol=1e-9)


def test_a_point_that_comes_again_has_no_effect():
    rests = [np.array([1.0, 2.0]), np.array([1.0, 2.0]), np.array([0.5, 1.0])]
    found = factors(rests)
    assert np.isfinite(found).all()
    assert found[0] == 0
    np.testing.assert_allclose(found[1] * (rests[2] - rests[1]), rests[2], rtol=1e-12)
