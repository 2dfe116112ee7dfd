"""The uncertainty of values on a sequence of grids."""

import pytest

from roughfilm.rom.pocket.plan.refinement import (
    SAFETY_FACTOR,
    SINGLE_SAFETY_FACTOR,
    SPREAD_FACTOR,
    refinement_uncertainty,
)

COLUMNS = [64.0, 31.0, 16.0]


@pytest.mark.parametrize("order", [1.0, 2.0])
def test_it_is_the_safety_factor_times_an_error_that_decreases_at_the_order(order):
    errors = [5.0 * n**-order for n in COLUMNS]
    found = refinement_uncertainty(COLUMNS, [7 - error for error in errors], order=order)
    assert found == pytest.approx(SAFETY_FACTOR * errors[0])


def test_errors_that_disagree_add_their_range():
    assert refinement_uncertainty([64, 32, 16], [1.0, 1.0, 1.15]) == pytest.approx(
        (SAFETY_FACTOR + SPREAD_FACTOR) * 0.01
    )
    assert refinement_uncertainty([64, 32, 16], [1.0, 0.97, 1.15]) == pytest.approx(
        SAFETY_FACTOR * 0.01 + SPREAD_FACTOR * 0.02
    )


def test_a_single_difference_says_less():
    assert refinement_uncertainty([64, 32], [1.0, 1.03]) == pytest.approx(SINGLE_SAFETY_FACTOR * 0.01)
    assert refinement_uncertainty([64, 32], [1.0, 1.0]) == 0
