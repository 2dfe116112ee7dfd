"""Periodic pressures against a dense solution of the same equations."""

import numpy as np
import pytest

from roughfilm.rom.pocket.plan.balance import Balance, outflow

RNG = np.random.default_rng(3)


@pytest.mark.parametrize("decades", [1, 6])
@pytest.mark.parametrize("shape", [(6, 4), (5, 7)])
def test_flows_balance_and_pressures_are_those_of_elimination(shape, decades):
    east, north = 10 ** RNG.uniform(-decades, 0, (2, *shape))
    into = RNG.normal(size=shape)
    into -= into.mean()
    pressure, _ = Balance(east, north).pressure(into)

    def image(values):
        along, across = (np.roll(values, -1, axis=axis) - values for axis in range(2))
        return -outflow(east * along, north * across) * -1

    units = np.eye(into.size).reshape(-1, *shape)
    matrix = -np.stack([image(unit).ravel() for unit in units], axis=1)
    exact = np.linalg.lstsq(matrix, into.ravel(), rcond=None)[0].reshape(shape)
    assert np.abs(-image(pressure) - into).max() < 1e-9 * np.abs(into).max()
    assert pressure - pressure.mean() == pytest.approx(exact - exact.mean(), abs=1e-8 * np.abs(exact).max())


def test_a_flow_of_nothing_has_no_pressure():
    east, north = np.ones((2, 4, 4))
    pressure, iterations = Balance(east, north).pressure(np.zeros((4, 4)))
    assert iterations == 0
    assert not pressure.any()
