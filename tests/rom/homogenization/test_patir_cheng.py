"""Patir and Cheng's box against closed forms, a dense solution of its own equations, and what symmetry asks."""

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.homogenization.flow_factors import flow_factors
from roughfilm.rom.homogenization.lay import box_factors
from roughfilm.rom.homogenization.patir_cheng import patir_cheng


def plane(nx, ny):
    return np.meshgrid(np.arange(nx) / nx, np.arange(ny) / ny, indexing="ij")


def grooves(n, m_x, m_y, part=0.7):
    x, y = plane(n, n)
    return 1 + part * np.cos(2 * np.pi * (m_x * x + m_y * y))


def even(nx, ny, seed):
    """A gap that is even about the first node in both directions."""
    x, y = plane(nx, ny)
    random = np.random.default_rng(seed)
    waves = [
        random.normal() * np.cos(2 * np.pi * k * x) * np.cos(2 * np.pi * m * y) for k in range(4) for m in range(4)
    ]
    return 1 + 0.4 * sum(waves) / np.std(sum(waves))


def dense(gap, spacing):
    """φ₁ĥ³ and ĥ + σφ_s by elimination: both problems on all nodes, and the flow through every section of the box."""
    h = np.pad(gap, ((0, 1), (0, 1)), mode="wrap")
    (n, m), (dx, dy) = h.shape, spacing
    matrix = np.zeros((n * m, n * m))
    sheared, driven = np.zeros(n * m), np.zeros(n * m)
    weights = np.full(m, dy)
    weights[[0, -1]] /= 2
    depths = np.full(n, dx)
    depths[[0, -1]] /= 2

    def mean(a, b, power):
        """<h^power> of a gap that goes straight from a to b."""
        return a**power if a == b else (b ** (power + 1) - a ** (power + 1)) / ((power + 1) * (b - a))

    east = np.zeros((n - 1, m))
    drag = np.zeros((n - 1, m))
    for i in range(n):
        for j in range(m):
            here = i * m + j
            if i < n - 1 and h[i, j] * h[i + 1, j] > 0:
                east[i, j] = 1 / mean(h[i, j], h[i + 1, j], -3)
                drag[i, j] = -(1 / h[i + 1, j] - 1 / h[i, j]) / (h[i + 1, j] - h[i, j]) * east[i, j]
                link = east[i, j] * weights[j] / dx
                matrix[[here, here + m], [here, here + m]] += link
                matrix[[here, here + m], [here + m, here]] -= link
                sheared[here] -= drag[i, j] * weights[j]
                sheared[here + m] += drag[i, j] * weights[j]
            if j < m - 1 and h[i, j] * h[i, j + 1] > 0:
                link = depths[i] / dy / mean(h[i, j], h[i, j + 1], -3)
                matrix[[here, here + 1], [here, here + 1]] += link
                matrix[[here, here + 1], [here + 1, here]] -= link
    ends = np.r_[0:m, (n - 1) * m : n * m]
    matrix[ends] = 0
    matrix[ends, ends] = 1
    sheared[ends] = 0
    driven[(n - 1) * m :] = (n - 1) * dx
    p, psi = (np.linalg.lstsq(matrix, b, rcond=1e-13)[0].reshape(n, m) for b in (sheared, driven))
    flow = (east * np.diff(psi, axis=0) / dx) @ weights / weights.sum()
    drift = (drag - east * np.diff(p, axis=0) / dx) @ weights / weights.sum()
    assert np.ptp(flow) < 1e-9 * abs(flow).max()
    assert np.ptp(drift) < 1e-9 * abs(drift).max()
    return flow.mean(), drift.mean()


@pytest.mark.parametrize(("shape", "spacing"), [((9, 7), (1.0, 1.0)), ((6, 11), (3.0, 0.4)), ((2, 5), (0.3, 1.0))])
def test_dense_elimination_finds_the_same_factors(shape, spacing):
    gap = np.exp(np.random.default_rng(3107).normal(size=shape) / 2)
    found = patir_cheng(gap, spacing, tolerance=1e-12)
    first, shear = dense(gap, spacing)
    second, _ = dense(gap.T, spacing[::-1])
    assert found.pressure == pytest.approx([first, second], rel=1e-8)
    assert found.shear == pytest.approx(shear, rel=1e-8)


def test_dense_elimination_finds_the_same_around_contact():
    random = np.random.default_rng(911)
    gap = np.exp(random.normal(size=(10, 9)) / 2) * (random.uniform(size=(10, 9)) > 0.25)
    found = patir_cheng(gap, (1.0, 2.0), tolerance=1e-12)
    assert not any(found.sealed)
    first, shear = dense(gap, (1.0, 2.0))
    second, _ = dense(gap.T, (2.0, 1.0))
    assert found.pressure == pytest.approx([first, second], rel=1e-8)
    assert found.shear == pytest.approx(shear, rel=1e-8)


@pytest.mark.parametrize("part", [0.2, 0.8])
def test_straight_grooves_have_their_closed_forms(part):
    """h = 1 + a cos: <h⁻³>⁻¹ = (1 − a²)^(5/2)/(1 + a²/2), <h³> = 1 + 3a²/2, <h⁻²>/<h⁻³> = (1 − a²)/(1 + a²/2)."""
    across = (1 - part**2) ** 2.5 / (1 + part**2 / 2)
    errors = []
    for n in (32, 64, 128):
        found = patir_cheng(grooves(n, 1, 0, part), (1 / n, 1 / n))
        assert found.pressure[1] == pytest.approx(1 + 1.5 * part**2, rel=1e-12)
        errors.append(abs(found.pressure[0] / across - 1))
        along = patir_cheng(grooves(n, 0, 1, part), (1 / n, 1 / n))
        assert along.shear == pytest.approx(1, rel=1e-12)
    assert errors[-1] < 2e-3
    assert np.log2(errors[0] / errors[2]) / 2 == pytest.approx(2, abs=0.2)
    assert found.shear == pytest.approx((1 - part**2) / (1 + part**2 / 2), rel=2e-3)


@pytest.mark.parametrize("least", [0.1, -0.4])
@pytest.mark.parametrize(("shape", "spacing"), [((24, 24), (1.0, 1.0)), ((21, 34), (2.0, 0.7))])
def test_a_gap_that_is_even_both_ways_has_the_factors_of_the_cell(least, shape, spacing):
    gap = even(*shape, seed=577)
    gap = np.maximum(gap - gap.min() + least, 0)
    cell = flow_factors(gap, spacing, tolerance=1e-10).factors
    box = patir_cheng(gap, spacing, tolerance=1e-10)
    assert box.pressure == pytest.approx(np.diag(cell.pressure), rel=1e-7)
    assert box.shear == pytest.approx(cell.shear[0], rel=1e-7)
    assert np.abs(cell.pressure[0, 1]) < 1e-7 * cell.pressure[0, 0]


def test_a_smooth_box_converges_at_second_order():
    found = []
    for n in (24, 48, 96):
        x, y = plane(n, n)
        gap = 1 + 0.4 * np.cos(2 * np.pi * (x + 2 * y) + 0.7) * np.cos(2 * np.pi * (2 * x - y) + 1.1)
        box = patir_cheng(gap, (1 / n, 1 / n), tolerance=1e-11)
        found.append([*box.pressure, box.shear])
    steps = np.abs(np.diff(found, axis=0))
    assert np.log2(steps[0] / steps[1]) == pytest.approx(2, abs=0.25)


def test_oblique_grooves_approach_the_box_of_their_own_tensor():
    """Grooves of slope 3/4 in a square box: what is left shrinks with their wavelength; φ₁φ₂ goes to det A."""
    apart, product = [], []
    for waves in (1, 2, 4):
        gap = grooves(64 * waves, 3 * waves, -4 * waves)
        cell = flow_factors(gap, (1.0, 1.0)).factors.pressure
        box = patir_cheng(gap, (1.0, 1.0))
        apart.append(np.abs(box.pressure / box_factors(cell, (1, 1)) - 1).max())
        product.append(abs(box.pressure.prod() / np.linalg.det(cell) - 1))
        assert box.pressure[0] < 0.75 * cell[0, 0]
    for errors in (apart, product):
        assert errors[2] < 0.06
        assert np.log2(errors[0] / errors[2]) / 2 == pytest.approx(1, abs=0.35)


def test_a_narrow_box_forbids_cross_flow_and_a_wide_one_allows_all():
    gap = np.tile(grooves(32, 1, -1), (10, 1))
    for long, wide in ((gap, gap.T), (gap[::-1], gap.T[::-1])):
        a = flow_factors(long, (1.0, 1.0)).factors.pressure
        narrow, broad = patir_cheng(long, (1.0, 1.0)), patir_cheng(wide, (1.0, 1.0))
        assert narrow.pressure[0] == pytest.approx(np.linalg.det(a) / a[1, 1], rel=0.15)
        assert broad.pressure[0] == pytest.approx(a[1, 1], rel=0.15)
        assert broad.pressure[0] > 2.5 * narrow.pressure[0]


def test_the_smooth_gap_and_its_units():
    box = patir_cheng(np.full((5, 8), 2e-6), (1e-6, 3e-6))
    assert box.pressure == pytest.approx([8e-18, 8e-18], rel=1e-12)
    assert box.shear == pytest.approx(2e-6, rel=1e-12)
    assert box.relative.pressure == pytest.approx([1, 1], rel=1e-12)
    assert box.relative.shear == pytest.approx(1, rel=1e-12)


def test_scale_transposition_and_direction():
    gap = np.exp(np.random.default_rng(2027).normal(size=(12, 17)) / 2)
    one = patir_cheng(gap, (1.0, 0.5), tolerance=1e-11)
    thick = patir_cheng(3e-7 * gap, (7.0, 3.5), tolerance=1e-11)
    assert thick.pressure == pytest.approx(one.pressure * 27e-21, rel=1e-9)
    assert thick.shear == pytest.approx(one.shear * 3e-7, rel=1e-9)
    assert patir_cheng(gap.T, (0.5, 1.0), tolerance=1e-11).pressure == pytest.approx(one.pressure[::-1], rel=1e-8)
    backwards = patir_cheng(np.roll(gap[::-1], 1, axis=0), (1.0, 0.5), tolerance=1e-11)
    assert backwards.pressure == pytest.approx(one.pressure, rel=1e-8)
    assert backwards.shear == pytest.approx(one.shear, rel=1e-8)
    assert one.residual <= 1e-11
    assert one.iterations > 0


def test_a_box_is_sealed_where_its_cell_is_open_along_oblique_valleys():
    x, y = plane(32, 32)
    gap = np.maximum(np.cos(2 * np.pi * (2 * x + 3 * y)) - 0.2, 0)
    cell, box = flow_factors(gap, (1.0, 1.0), tolerance=1e-10).factors, patir_cheng(gap, (1.0, 1.0))
    assert cell.sealed == (False, False)
    assert box.sealed == (False, True)
    assert box.pressure[0] > 0
    assert box.pressure[1] == 0
    assert patir_cheng(gap.T, (1.0, 1.0)).shear == 0


def test_a_wall_through_the_box_seals_it():
    gap = np.ones((9, 9))
    gap[4] = 0
    gap[2, 2] = 0
    box = patir_cheng(gap, (1.0, 1.0))
    assert box.sealed == (True, False)
    assert box.pressure[0] == 0
    assert box.shear == 0
    assert box.pressure[1] > 0


def test_a_channel_along_a_side_is_inside_the_box():
    gap = np.zeros((8, 6))
    gap[:, 0] = 3.0
    box = patir_cheng(gap, (1.0, 1.0))
    assert box.sealed == (False, True)
    assert box.pressure == pytest.approx([27 / 6, 0])
    assert box.shear == pytest.approx(3 / 6)


@pytest.mark.parametrize(
    ("gap", "spacing", "message"),
    [
        (np.zeros((4, 4)), (1.0, 1.0), "closed everywhere"),
        (np.full((4, 4), -1.0), (1.0, 1.0), "overlap"),
        (np.full((4, 4), np.nan), (1.0, 1.0), "fill such nodes"),
        (np.ones((1, 9)), (1.0, 1.0), "at least 2 x 2"),
        (np.ones((4, 4)), (1.0, 0.0), "spacing"),
    ],
)
def test_what_makes_no_sense_is_refused(gap, spacing, message):
    with pytest.raises(InputError, match=message):
        patir_cheng(gap, spacing)
