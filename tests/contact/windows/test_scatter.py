"""Intervals from few windows cover the truth of synthetic ensembles in 90 to 98 of 100 cases, or are not given."""

import math

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.windows.scatter import Distribution, binomial_interval, scatter, windows_needed

TRIES = 500


def coverage(draw, truth, count, *, positive, independent=None):
    """Fractions of the confidence intervals that contain the mean, and of the predictions that contain a further one.

    The mean ± its uncertainty is counted too; draw(size) gives windows of which the last one is the further one.
    """
    inside, further, around = [], [], []
    for values in draw((TRIES, count + 1)):
        found = scatter(values[:-1], independent, positive)
        inside.append(found.mean_interval[0] <= truth <= found.mean_interval[1])
        further.append(found.interval[0] <= values[-1] <= found.interval[1])
        around.append(abs(found.mean - truth) <= found.mean_uncertainty)
    return np.mean(inside), np.mean(further), np.mean(around)


@pytest.mark.parametrize("count", [4, 12, 60])
def test_normal_values_are_covered(count):
    rng = np.random.default_rng(1)
    for rate in coverage(lambda size: rng.normal(5, 1, size), 5, count, positive=False):
        assert 0.92 <= rate <= 0.98


@pytest.mark.parametrize("spread", [0.1, 0.5, 1.0])
@pytest.mark.parametrize("count", [6, 40])
def test_lognormal_values_are_covered(spread, count):
    rng = np.random.default_rng(2)
    truth = math.exp(spread**2 / 2)
    for rate in coverage(lambda size: np.exp(spread * rng.normal(size=size)), truth, count, positive=True):
        assert 0.9 <= rate <= 0.98


@pytest.mark.parametrize("spread", [0.15, 0.5])
@pytest.mark.parametrize("count", [6, 40])
def test_cubes_of_normal_gaps_are_covered(spread, count):
    """Leakage through gaps of a normal distribution, 2 % of which are closed at a spread of 0.5."""
    rng = np.random.default_rng(6)
    truth = 1 + 3 * spread**2  # <h³> of open gaps; closed ones add less than 1 %
    for rate in coverage(lambda size: np.maximum(rng.normal(1, spread, size), 0) ** 3, truth, count, positive=True):
        assert 0.9 <= rate <= 0.98


@pytest.mark.parametrize("unit", [1e-20, 1.0, 1e9])
def test_the_distribution_is_chosen_by_likelihood_whatever_the_unit(unit):
    rng = np.random.default_rng(7)
    logarithms, roots = np.exp(rng.normal(size=200)), rng.normal(1, 0.25, size=200) ** 3
    assert scatter(unit * logarithms, positive=True).distribution is Distribution.LOGARITHMS
    assert scatter(unit * roots, positive=True).distribution is Distribution.CUBE_ROOTS


def test_values_of_which_a_fifth_is_sealed_are_covered():
    rng = np.random.default_rng(3)
    truth = 0.8 * math.exp(0.5**2 / 2)

    def draw(size):
        return np.exp(0.5 * rng.normal(size=size)) * (rng.random(size) > 0.2)

    inside, further, around = coverage(draw, truth, 30, positive=True)
    assert 0.9 <= inside <= 0.98
    assert 0.92 <= further <= 0.99
    assert 0.9 <= around <= 0.98


def test_windows_that_overlap_are_covered():
    """Values that are moving averages over three terms: nₑ = n²/Σρ with ρ = 2/3 and 1/3 at the distances 1 and 2."""
    rng = np.random.default_rng(4)
    count = 20
    worth = count**2 / (count + 2 * (count - 1) * 2 / 3 + 2 * (count - 2) / 3)

    def draw(size):
        terms = rng.normal(size=(size[0], size[1] + 3))
        moving = (terms[:, :-2] + terms[:, 1:-1] + terms[:, 2:]) / math.sqrt(3)
        return np.column_stack([moving[:, :count], rng.normal(size=size[0])])

    for rate in coverage(draw, 0, count, positive=False, independent=worth):
        assert 0.92 <= rate <= 0.99


def test_intervals_are_those_of_student():
    """t(4, 0.975) = 2.776445 (tables); mean 3, s² = 2.5."""
    found = scatter([1.0, 2.0, 3.0, 4.0, 5.0])
    assert found.deviation == pytest.approx(math.sqrt(2.5))
    assert found.mean_uncertainty == pytest.approx(2.776445 * math.sqrt(2.5 / 5), rel=1e-6)
    assert found.interval[1] - 3 == pytest.approx(2.776445 * math.sqrt(2.5 * 1.2), rel=1e-6)


def test_fewer_than_three_independent_windows_give_no_interval():
    for found in (
        scatter([1.0, 2.0]),
        scatter([1.0, 2.0, 3.0, 4.0], 2.9),
        scatter([1.0, 0.0, 0.0, 2.0], positive=True),
    ):
        assert found.mean_interval is None
        assert found.interval is None
        assert found.mean_uncertainty is None
        assert windows_needed(found, 0.05) is None


def test_sealed_windows_are_a_fraction_with_a_binomial_interval():
    """The interval of 2 of 10 is 0.0252 to 0.5561 (Clopper and Pearson, Biometrika 26 (1934))."""
    found = scatter([0.0, 0.0, *np.linspace(1, 2, 8)], positive=True)
    assert found.zeros == pytest.approx(0.2)
    assert found.zeros_interval == pytest.approx((0.0252, 0.5561), abs=1e-4)
    assert found.interval[0] == 0
    closed = scatter(np.zeros(10), positive=True)
    assert closed.interval is None
    assert binomial_interval(1.0, 10) == pytest.approx((0.6915, 1.0), abs=1e-4)


@pytest.mark.parametrize("positive", [False, True])
def test_the_windows_needed_reach_the_tolerance(positive):
    rng = np.random.default_rng(5)
    few = scatter(np.exp(0.3 * rng.normal(size=12)), positive=positive)
    needed = windows_needed(few, 0.05)
    same = np.resize(few.values, needed * 12)  # of the same mean and deviation
    whole = scatter(same, needed, positive)
    assert whole.relative == pytest.approx(0.05, rel=0.1)
    assert windows_needed(few, 0.1) < needed / 3


def test_values_that_differ_by_rounding_have_no_scatter():
    found = scatter([1.0, 1.0 + 2e-16, 1.0, 1.0 - 1e-16], positive=True)
    assert (found.deviation, found.interval, found.mean_uncertainty) == (0, (1, 1), 0)
    assert windows_needed(found, 0.05) == 3


def test_values_that_are_no_numbers_or_below_zero_are_refused():
    with pytest.raises(InputError, match="1 of 3 are not finite"):
        scatter([1.0, math.nan, 2.0])
    with pytest.raises(InputError, match="a positive quantity is 0 or more"):
        scatter([1.0, -1.0, 2.0], positive=True)
    with pytest.raises(InputError, match="must be 1 to the number of windows, 3"):
        scatter([1.0, 1.0, 2.0], 4.0)
