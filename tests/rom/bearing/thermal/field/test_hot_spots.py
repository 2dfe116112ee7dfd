"""The uncertainty of the largest temperature by places that become warmer on finer grids."""

import numpy as np
import pytest

from roughfilm.rom.bearing.thermal.field.hot_spots import warmer_elsewhere

CELLS = (64.0, 32.0, 16.0)


def fields(order, rise):
    """A converged node at 80 K, and one at 79 K that approaches 79 + ``rise`` K with an order."""
    return [np.array([[80.0, 79.0 + rise * (1 - (64.0 / cells) ** order)]]) for cells in CELLS]


@pytest.mark.parametrize("order", [1.0, 1.5, 2.0])
def test_a_node_that_rises_bounds_the_largest_temperature(order):
    """It comes to 79 + rise; the bound is 1.5 times the rise that is left."""
    found = fields(order, 4.0)
    assert warmer_elsewhere(found, CELLS) == pytest.approx(1.5 * 4.0 - 1.0, rel=1e-9)


def test_two_grids_are_extrapolated_with_the_lowest_order():
    assert warmer_elsewhere(fields(1.0, 4.0)[:2], CELLS[:2]) == pytest.approx(5.0, rel=1e-9)


def test_nodes_that_cool_and_the_warmest_node_itself_add_nothing():
    assert warmer_elsewhere(fields(1.0, -4.0), CELLS) == 0.0
    assert warmer_elsewhere([np.array([[82.0, 79.0]]), np.array([[80.0, 79.0]])], CELLS[:2]) == 0.0
