"""What a search begins from: bounds and load are kept, and nodes of the coarser grid."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from roughfilm.contact.foundation.errors import ConvergenceError
from roughfilm.contact.mechanics.press import Press
from roughfilm.contact.mechanics.starts import refined, shifted, signed
from roughfilm.contact.synthetic.self_affine import self_affine

MODULUS = 2e11


@settings(max_examples=200, deadline=None)
@given(seed=st.integers(2, 10**6), scale=st.floats(-12, 12), part=st.floats(1e-6, 1), bounded=st.booleans())
def test_a_shifted_pressure_keeps_its_bounds_and_carries_the_load(seed, scale, part, bounded):
    field = np.random.default_rng(seed).standard_normal((7, 9)) * 10.0**scale
    most = 1.0 if bounded else np.inf
    found = shifted(field, part, most)
    assert found.mean() == pytest.approx(part, rel=1e-12, abs=1e-14 * np.abs(field).max())
    assert found.min() >= 0
    assert found.max() <= most
    inside = (found > 0) & (found < most)
    moves = (found - field)[inside]
    assert np.ptp(moves) <= 1e-12 * (np.abs(field).max() + 1) if moves.size else True


def test_of_all_pressures_that_carry_the_load_the_shifted_is_nearest():
    rng = np.random.default_rng(20073)
    field = rng.standard_normal(50)
    found = shifted(field, 0.4, 1.0)
    for _ in range(100):
        other = rng.uniform(0, 1, 50)
        other = np.clip(other, 0, 1) if abs(other.mean() - 0.4) < 1e-12 else shifted(other, 0.4, 1.0)
        assert np.sum((other - field) ** 2) >= np.sum((found - field) ** 2) - 1e-12


def test_a_finer_grid_keeps_the_nodes_and_is_linear_between_them():
    field = np.random.default_rng(20074).standard_normal((4, 6))
    fine = refined(field)
    assert fine.shape == (8, 12)
    assert np.array_equal(fine[::2, ::2], field)
    assert fine[1, 0] == pytest.approx((field[0, 0] + field[1, 0]) / 2)
    assert fine[7, 11] == pytest.approx((field[3, 5] + field[0, 5] + field[3, 0] + field[0, 0]) / 4)


def rough(shape):
    return self_affine(
        size=(1e-3, 1e-3),
        points=shape,
        seed=20071,
        hurst=0.8,
        roll_off=2.5e-4,
        cut_off=8e-3 / min(shape),
        rms_slope=0.1,
    ).heights


def test_the_signed_field_is_pressure_in_contact_and_negative_off_it():
    heights = rough((64, 64))
    contact = Press(heights, (1e-3 / 64,) * 2, MODULUS).at(1e8)
    field = signed(contact, MODULUS)
    assert np.array_equal(field[contact.in_contact], contact.pressure[contact.in_contact])
    assert (field[contact.gap > 0] < 0).all()


@pytest.mark.parametrize("hardness", [np.inf, 0.05 * MODULUS])
def test_coarser_grids_change_nothing_but_the_work(hardness, monkeypatch):
    shape = (256, 300)
    press = Press(rough(shape), (1e-3 / shape[0], 1e-3 / shape[1]), MODULUS, hardness=hardness)
    nested = press.at(0.008 * MODULUS)
    monkeypatch.setattr("roughfilm.contact.mechanics.press.COARSEST_GRID_POINTS", 10**6)
    alone = press.at(0.008 * MODULUS)
    assert nested.mean_gap == pytest.approx(alone.mean_gap, abs=1e-7 * press.heights.std())
    assert (nested.in_contact == alone.in_contact).mean() > 0.9999
    assert nested.iterations < alone.iterations


def test_where_the_coarser_grid_does_not_converge_the_search_begins_from_the_load(monkeypatch):
    press = Press(rough((256, 256)), (1e-3 / 256,) * 2, MODULUS)
    solve = Press.at

    def fails_when_coarse(self, load, **options):
        if self is not press:
            raise ConvergenceError("contact: stalled")
        return solve(self, load, **options)

    monkeypatch.setattr(Press, "at", fails_when_coarse)
    assert press.at(0.008 * MODULUS).complementarity <= 1e-8
