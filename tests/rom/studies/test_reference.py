"""A reference ranks two models only where its uncertainty allows it; the truth of these sweeps is known."""

import numpy as np
import pytest

from roughfilm.ladder import models
from roughfilm.rom.studies.reference import Order, interval, ranking, reference_of
from roughfilm.rom.studies.sweep import Sweep

CASES = 200
QUANTITIES = ("load_plus", "friction_plus", "pressure_max_plus", "pressure_min_plus", "backflow")
PAIR = ("film", "film_slope")


def sweep(errors, *, uncertainty=None, expected=None, resolution=None):
    """A sweep of pockets whose true load is 3; ``errors`` are the relative errors of each setting in every case."""
    unknown = np.full(CASES, np.nan)

    def spread(values):
        return dict.fromkeys(QUANTITIES, unknown) | (
            {} if values is None else {"load_plus": np.broadcast_to(values, CASES)}
        )

    return Sweep(
        kind="pocket",
        names=tuple(map(str, range(CASES))),
        given={},
        found={
            name: dict.fromkeys(QUANTITIES, np.ones(CASES)) | {"load_plus": 3 * (1 + np.broadcast_to(error, CASES))}
            for name, error in errors.items()
        },
        cpu_s=dict.fromkeys(errors, np.ones(CASES)),
        failures=(),
        uncertainty={name: spread((uncertainty or {}).get(name)) for name in errors},
        expected_error={name: spread((expected or {}).get(name)) for name in errors},
        resolution={name: np.full(CASES, float((resolution or {}).get(name, 100))) for name in errors},
        residual=dict.fromkeys(errors, np.full(CASES, 1e-9)),
    )


def random(least, largest):
    return np.random.default_rng(1828067).uniform(least, largest, CASES)


def order(of):
    found = ranking(of, PAIR, reference_of(of, models("pocket")), "load_plus")
    assert found is not None
    return found.order


COARSE = {"navier_stokes": random(-0.016, 0.011), "film": -0.008, "film_slope": 0.002}
"""A reference of 60 columns is off by -1.6 to +1.1 %; film_slope is nearer to the truth than film."""


def test_a_coarse_reference_ranks_neither_of_two_models_that_it_does_not_separate():
    of = sweep(COARSE, uncertainty={"navier_stokes": 0.016 * 3})
    reference = reference_of(of, models("pocket"))
    assert reference.setting == "navier_stokes"
    median = {
        name: np.median(np.abs(of.found[name]["load_plus"] / of.found["navier_stokes"]["load_plus"] - 1))
        for name in PAIR
    }
    assert median["film"] < 0.01
    assert order(of) is Order.UNDECIDED
    for name, error in (("film", 0.008), ("film_slope", 0.002)):
        least, largest = interval(of, name, reference, "load_plus")
        assert np.mean((least <= error) & (error <= largest * 1.02)) > 0.95


def test_a_fine_reference_ranks_them():
    fine = {**COARSE, "navier_stokes": random(-1e-4, 1e-4)}
    assert order(sweep(fine, uncertainty={"navier_stokes": 3e-4})) is Order.SECOND


def test_a_reference_of_unknown_uncertainty_ranks_nothing():
    of = sweep({**COARSE, "film": 0.5})
    reference = reference_of(of, models("pocket"))
    assert np.isnan(reference.uncertainty["load_plus"]).all()
    assert order(of) is Order.UNDECIDED
    assert np.isinf(interval(of, "film", reference, "load_plus")[1]).all()


def test_a_law_states_the_uncertainty_of_one_grid():
    of = sweep(COARSE, expected={"navier_stokes": 0.02})
    assert reference_of(of, models("pocket")).uncertainty["load_plus"] == pytest.approx(0.02)
    stated = sweep(COARSE, expected={"navier_stokes": 0.02}, uncertainty={"navier_stokes": 0.03})
    assert reference_of(stated, models("pocket")).uncertainty["load_plus"] == pytest.approx(0.01, rel=0.02)


def test_the_grids_of_a_study_state_it_and_the_finest_one_is_the_reference():
    """Errors of 8 (10/n)², so that the one at n = 80 is 12.5 % of the truth, which its uncertainty covers."""
    grids = {n: f"navier_stokes-{n}" for n in (80, 20, 40)}
    of = sweep(
        {**{name: 8 * (10 / n) ** 2 for n, name in grids.items()}, **dict.fromkeys(PAIR, 0.0)},
        resolution={name: n for n, name in grids.items()},
    )
    reference = reference_of(of, models("pocket"))
    assert reference.setting == "navier_stokes-80"
    assert reference.uncertainty["load_plus"] == pytest.approx(1.25 * 0.125 / 1.125)


def test_an_incomplete_reference_adds_what_it_leaves_out():
    of = sweep({"film": 0.01, "film_slope": 0.0}, uncertainty={"film_slope": 3e-4}, expected={"film_slope": 0.02})
    reference = reference_of(of, models("pocket"))
    assert (reference.setting, reference.uncertainty["load_plus"][0]) == ("film_slope", pytest.approx(0.02))


def test_where_either_is_nearer_in_many_cases_it_depends_on_the_case():
    half = np.arange(CASES) < CASES // 2
    errors = {"navier_stokes": 0.0, "film": np.where(half, 0.1, 0.0), "film_slope": np.where(half, 0.0, 0.1)}
    assert order(sweep(errors, uncertainty={"navier_stokes": 0.03})) is Order.MIXED
