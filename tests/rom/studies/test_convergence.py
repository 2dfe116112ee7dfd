"""The order, limit and uncertainty of sequences whose limit is known: manufactured, published, summed and flowing."""

import math

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.studies.convergence import ConvergenceKind, converge

RATIOS = [(60, 120, 240), (40, 60, 90), (50, 60, 110), (12, 97, 101)]


def manufactured(grids, *terms, limit=-3.7):
    return [limit + sum(constant / n**order for constant, order in terms) for n in grids]


@pytest.mark.parametrize("grids", RATIOS)
@pytest.mark.parametrize("order", [0.6, 1.0, 1.5, 1.9, 2.0])
@pytest.mark.parametrize("constant", [-40.0, 0.3])
def test_a_power_law_is_recovered(grids, order, constant):
    found = converge(grids, manufactured(grids, (constant, order)), formal_order=2)
    assert found.kind is ConvergenceKind.MONOTONE
    assert found.order == pytest.approx(order, rel=1e-6)
    assert found.value == pytest.approx(-3.7, rel=1e-9)
    safety = 1.25 if order >= 1.8 else 3
    assert found.uncertainty == pytest.approx(safety * abs(constant) / grids[-1] ** order, rel=1e-5)


def test_the_published_example():
    """Celik et al. 2008, Table 1, first column: 18000, 8000 and 4500 cells in two dimensions."""
    found = converge((3, 4, 6), (5.863, 5.972, 6.063), formal_order=2)
    assert found.order == pytest.approx(1.53, abs=0.005)
    assert found.value == pytest.approx(6.1685, abs=5e-5)
    published = 0.022 * 6.063  # with a factor of 1.25, which is for an order nearer to the formal one here
    assert found.uncertainty / 3 * 1.25 == pytest.approx(published, rel=0.02)


@pytest.mark.parametrize("grids", RATIOS[:3])
def test_a_higher_order_than_the_formal_one_is_stated_but_not_trusted(grids):
    values = manufactured(grids, (30.0, 3.5))
    found = converge(grids, values, formal_order=2)
    assert (found.order, found.order_used, found.order_text) == (pytest.approx(3.5), 2, "3.50 → 2")
    assert abs(values[-1] + 3.7) < found.uncertainty
    assert abs(found.value + 3.7) < found.uncertainty


def test_cancelling_errors_do_not_make_a_small_uncertainty():
    """Two error terms that agree on the finest two grids by chance leave a fine step of almost nothing."""
    grids = (30, 60, 120)
    square, cube = 1 / 60**2 - 1 / 120**2, 1 / 60**3 - 1 / 120**3
    values = manufactured(grids, (50.0, 2), (-50.0 * square / cube * 0.999, 3))
    found = converge(grids, values, formal_order=2)
    assert abs(values[-1] - values[-2]) < 0.01 * abs(values[-1] + 3.7)
    assert abs(found.value + 3.7) < found.uncertainty


@pytest.mark.parametrize("grids", RATIOS[:3])
def test_the_next_term_stays_within_the_uncertainty(grids):
    found = converge(grids, manufactured(grids, (50.0, 2), (300.0, 3)), formal_order=2)
    assert abs(found.value + 3.7) < found.uncertainty


def test_oscillating_values_are_not_extrapolated():
    values = [-3.7 + sign / n for sign, n in ((1, 40), (-1, 60), (1, 90))]
    found = converge((40, 60, 90), values, formal_order=2)
    assert (found.kind, found.order, found.value) == (ConvergenceKind.OSCILLATORY, None, values[-1])
    assert abs(values[-1] + 3.7) < found.uncertainty
    assert found.uncertainty == pytest.approx(3 * (1 / 40 + 1 / 60))


@pytest.mark.parametrize("values", [(1.0, 1.1, 1.3), (1.0, 1.1, 1.2), (1.0, 1.0, 1.2)])
def test_steps_that_do_not_shrink_are_divergence(values):
    found = converge((60, 120, 240), values, formal_order=2)
    assert (found.kind, found.order, found.value) == (ConvergenceKind.DIVERGENT, None, values[-1])
    assert found.uncertainty == pytest.approx(3 * (values[-1] - 1))


def test_equal_steps_converge_only_where_the_fine_one_is_the_longer_leap():
    assert converge((100, 110, 220), (1.0, 1.1, 1.2), formal_order=2).kind is ConvergenceKind.MONOTONE
    assert converge((100, 200, 220), (1.0, 1.1, 1.2), formal_order=2).kind is ConvergenceKind.DIVERGENT


def test_constants_and_noise_are_at_round_off():
    exact = converge((60, 120, 240), (2.5, 2.5, 2.5), formal_order=2)
    assert (exact.kind, exact.value, exact.uncertainty) == (ConvergenceKind.ROUND_OFF, 2.5, 0)
    noisy = converge((60, 120, 240), (2.5, 2.5 + 1e-9, 2.5 - 1e-9), formal_order=2, noise=1e-8)
    assert noisy.kind is ConvergenceKind.ROUND_OFF
    assert noisy.uncertainty >= 1e-8
    assert (
        converge((60, 120, 240), (2.5, 2.5 + 1e-7, 2.5), formal_order=2, noise=1e-8).kind is ConvergenceKind.OSCILLATORY
    )


def test_two_grids_take_the_formal_order_and_the_greater_factor():
    found = converge((80, 120), manufactured((80, 120), (9.0, 2)), formal_order=2)
    assert (found.kind, found.order, found.order_used) == (ConvergenceKind.TWO_GRIDS, None, 2)
    assert found.value == pytest.approx(-3.7, rel=1e-12)
    assert found.uncertainty == pytest.approx(3 * 9 / 120**2)


def test_without_a_formal_order_the_last_step_is_uncertain():
    found = converge((8, 12, 16), (1.0, 1.5, 1.49), formal_order=None)
    assert (found.kind, found.value, found.uncertainty) == (ConvergenceKind.NO_FORMAL_ORDER, 1.49, pytest.approx(0.01))


def test_only_the_finest_three_grids_count():
    grids = (10, 40, 60, 90)
    values = [99.0, *manufactured(grids[1:], (5.0, 2))]
    found = converge(grids, values, formal_order=2)
    assert found.grids == (40, 60, 90)
    assert found.value == pytest.approx(-3.7)


@pytest.mark.parametrize(("function", "integral", "order"), [(np.sqrt, 2 / 3, 1.5), (np.exp, math.e - 1, 2)])
def test_the_midpoint_rule_has_its_known_order(function, integral, order):
    grids = (70, 110, 240)
    sums = [float(function((np.arange(n) + 0.5) / n).mean()) for n in grids]
    found = converge(grids, sums, formal_order=2)
    assert found.order == pytest.approx(order, abs=0.05)
    assert abs(found.value - integral) < abs(sums[-1] - integral) / 5
    assert abs(found.value - integral) < found.uncertainty


def test_the_flow_between_parallel_walls():
    """Layers at their mid height carry y (1 - y) / 2 dp/dx; together they tend to the cubic law's 1/12."""
    grids = (20, 32, 48)
    heights = [(np.arange(n) + 0.5) / n for n in grids]
    found = converge(grids, [float((y * (1 - y) / 2).mean()) for y in heights], formal_order=2)
    assert found.order == pytest.approx(2, abs=1e-3)
    assert found.value == pytest.approx(1 / 12, rel=1e-9)


@pytest.mark.parametrize(
    ("grids", "values"),
    [((60,), (1.0,)), ((60, 60), (1.0, 2.0)), ((60, 30), (1.0, 2.0)), ((30, 60), (1.0, math.nan)), ((30, 60), (1.0,))],
)
def test_what_is_no_sequence_is_refused_in_one_line(grids, values):
    with pytest.raises(InputError, match=r"^grids: got .*; give two or more, ever finer, with finite values$"):
        converge(grids, values, formal_order=2)
