"""Integration rules are exact for polynomials, and extrema converge at fourth order."""

import numpy as np
import pytest

from roughfilm.rom.pocket.piecewise import extrema, gauss_rule


@pytest.mark.parametrize("order", [2, 5, 8, 13])
def test_a_rule_is_exact_for_the_polynomials_it_should_be(order):
    rule = gauss_rule(order)
    for degree in range(order):
        f = rule.nodes**degree
        assert rule.primitive @ f == pytest.approx((rule.nodes ** (degree + 1) - (-1) ** (degree + 1)) / (degree + 1))
        assert rule.derivative @ f == pytest.approx(degree * rule.nodes ** max(degree - 1, 0), abs=1e-11)
        assert rule.check @ f == pytest.approx(rule.check_nodes**degree)
        assert rule.weights @ f == pytest.approx((1 - (-1) ** (degree + 1)) / (degree + 1), abs=1e-14)


def test_extrema_between_nodes_converge_at_fourth_order():
    counts = np.array([9, 17, 33, 65])
    errors = []
    for count in counts:
        x = np.linspace(0, 2 * np.pi, count) + 0.3
        low, high = extrema(x[None], np.sin(x)[None], np.cos(x)[None])
        errors.append(max(abs(low + 1), abs(high - 1)))
    order = -np.polyfit(np.log(counts - 1), np.log(errors), 1)[0]
    assert order > 3.7


def test_extrema_of_monotone_values_are_the_ends():
    x = np.linspace(0, 1, 5)[None]
    assert extrema(x, 2 * x, np.full_like(x, 2)) == (0.0, 2.0)
