"""Powers that were put in are found again, and thresholds mean what they say."""

import numpy as np
import pytest

from roughfilm.rom.pocket.kind import product_text
from roughfilm.rom.studies.ordering import CERTAINTY, fitted_powers, ordering, threshold

RANDOM = np.random.default_rng(1828067)


@pytest.fixture
def features():
    return {name: np.exp(RANDOM.uniform(-2, 2, 400)) for name in ("reynolds_number", "depth", "slope")}


def test_the_powers_of_an_exact_law_are_found(features):
    error = 0.01 * features["reynolds_number"] ** 1.5 * features["slope"] ** 0.75
    powers = fitted_powers(features, error, step=0.25)
    assert powers == {"reynolds_number": 1.0, "slope": 0.5}


def test_noise_does_not_move_them(features):
    noise = np.exp(RANDOM.normal(0, 0.3, 400))
    error = 0.02 * features["depth"] ** 2 / features["slope"] * noise
    powers = fitted_powers(features, error, step=0.25)
    assert powers == {"depth": 1.0, "slope": -0.5}
    found = ordering(features, powers, error, (0.01,))
    wrong = ordering(features, {"reynolds_number": 1.0}, error, (0.01,))
    assert found.rank > 0.95 > 0.3 > abs(wrong.rank)


def test_a_threshold_is_the_last_number_up_to_which_nearly_all_keep_the_tolerance():
    number = np.arange(1.0, 101.0)
    error = np.where(number <= 60, 0.01, 0.5)
    error[10] = 0.5
    last = threshold(number, error, 0.05)
    kept = [np.mean(error[:n] <= 0.05) for n in range(1, 101)]
    assert last == max(n for n, part in enumerate(kept, 1) if part >= CERTAINTY)
    assert 60 < last < 64
    assert threshold(number, error, 0.001) is None


def test_products_are_written_as_people_write_them():
    assert product_text({"reynolds_number": 1, "aspect": 1}) == "Re · 2d/w"
    assert product_text({"reynolds_number": 1, "depth": -1, "aspect": 1}) == "Re · 2Ly/w"
    assert product_text({"depth": 0.75, "slope": -2}) == "(d/Ly)^0.75 · slope^-2"
