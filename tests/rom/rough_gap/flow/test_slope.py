"""Thin films corrected for slope: against exact ridges, low waves of any length, and bounds."""

from dataclasses import replace

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.homogenization.lay import turned
from roughfilm.rom.rough_gap.flow.corrected import SlopeCorrected, slope_corrected
from roughfilm.rom.rough_gap.flow.exact import sinusoidal_ridge_flow
from roughfilm.rom.rough_gap.flow.range_of_validity import (
    MAX_ADDED_DISSIPATION,
    allowed_rms_slope,
    expected_excess,
)
from roughfilm.rom.rough_gap.flow.ritz import ritz_flow
from roughfilm.rom.rough_gap.flow.waves import nearly_smooth_flow
from roughfilm.rom.rough_gap.walls import Walls

SEED = 6011


def ridges(amplitude, wavelength, nodes=128, *, along=False):
    """A gap of mean 1 over ridges across x, or along it."""
    wave = -amplitude * np.cos(2 * np.pi * np.arange(nodes) / nodes)
    lower, spacing = np.tile(wave[:, None], (1, 2)), (wavelength / nodes, 1.0)
    if along:
        lower, spacing = lower.T, spacing[::-1]
    return Walls(lower=lower, upper=np.ones_like(lower), spacing=spacing)


def random_waves(nodes, rms, longest=3, *, shape=None):
    """Periodic, smooth, no more than ``longest`` waves in a side, without symmetries."""
    rng = np.random.default_rng(SEED)
    x, y = np.meshgrid(*(np.arange(n) / n for n in shape or (nodes, nodes)), indexing="ij")
    waves = [(p, q) for p in range(-longest, longest + 1) for q in range(longest + 1) if (p, q) > (0, 0) or q > 0]
    total = sum(rng.normal() * np.cos(2 * np.pi * (p * x + q * y) + rng.uniform(0, 6)) for p, q in waves)
    return rms * total / total.std()


def values(factors):
    return np.array([*factors.pressure.ravel(), *factors.shear, factors.friction])


@pytest.mark.parametrize("along", [False, True])
def test_what_is_left_out_is_of_fourth_order_in_slope(along):
    lengths, off = (12.0, 24.0), []
    for length in lengths:
        exact = sinusoidal_ridge_flow(0.4, length)
        found = slope_corrected(ridges(0.4, length, 384, along=along), tolerance=1e-10)
        if along:
            pairs = [(found.corrected.pressure[0, 0], found.thin.pressure[0, 0], exact.along, 1 + 1.5 * 0.4**2)]
        else:
            thin = (1 - 0.4**2) ** 2.5 / (1 + 0.4**2 / 2)
            pairs = [(found.corrected.pressure[0, 0], found.thin.pressure[0, 0], exact.across, thin)]
        off.append([(corrected - own) - (true - thin) for corrected, own, true, thin in pairs])
    orders = np.log2(np.abs(np.array(off[0]) / np.array(off[1])))
    assert np.all((orders > 3.7) & (orders < 4.5)), (off, orders)


@pytest.mark.parametrize(("amplitude", "length"), [(0.1, 1.25), (0.3, 2.5), (0.3, 5.0), (0.5, 10.0), (0.8, 2.5)])
def test_exact_ridges_lie_between_the_bounds_and_within_the_error_bar(amplitude, length):
    exact = sinusoidal_ridge_flow(amplitude, length, tolerance=1e-5)
    across, along = (slope_corrected(ridges(amplitude, length, 256, along=way)) for way in (False, True))
    for stated, own in (
        (np.array([exact.across, exact.along]), across),
        (np.array([exact.along, exact.across]), along),
    ):
        thin, least, best, bar = (
            np.diag(part.pressure) for part in (own.thin, own.bound, own.corrected, own.uncertainty)
        )
        assert np.all(least < stated * (1 + 1e-3))
        assert np.all(stated < thin * (1 + 1e-3))
        assert np.all(np.abs(best - stated) < bar + 1e-4)
        assert np.all(np.abs(best - stated) < np.abs(thin - stated))
    for drag, friction, own in (
        (exact.drag, exact.friction, across),
        (exact.drag_along, exact.friction_along, along),
    ):
        assert own.thin.friction * 0.999 < friction < own.bound.friction * 1.001
        assert abs(own.corrected.friction - friction) < own.uncertainty.friction + 1e-4
        assert abs(own.corrected.shear[0] - drag) < own.uncertainty.shear[0] + 1e-4


def test_ridges_askew_are_ridges_turned():
    nodes, amplitude, length = 96, 0.4, 6.0
    i, j = np.indices((nodes, nodes))
    lower = -amplitude * np.cos(2 * np.pi * (i + j) / nodes)
    step = length * np.sqrt(2) / nodes
    found = slope_corrected(Walls(lower=lower, upper=np.ones_like(lower), spacing=(step, step)))
    exact = sinusoidal_ridge_flow(amplitude, length)
    corrected, thin = found.corrected, found.thin
    a = turned([exact.across, exact.along], -np.pi / 4)
    b = turned([exact.drag, exact.drag_along], -np.pi / 4)[:, 0]
    assert np.abs(corrected.pressure - a).max() < 0.1 * np.abs(thin.pressure - a).max()
    assert np.abs(corrected.shear - b).max() < 0.2 * np.abs(thin.shear - b).max()
    friction = (exact.friction + exact.friction_along) / 2
    assert abs(corrected.friction - friction) < 0.1 * abs(thin.friction - friction)


@pytest.mark.parametrize("both", [False, True])
@pytest.mark.parametrize("size", [40.0, 6.0, 2.0])
def test_low_waves_of_any_length_are_as_perturbation_theory_has_them(size, both):
    """In what is added, by which thin-film theory's third order drops out; the grid's error is extrapolated."""
    rms, got = 1e-3, []
    for nodes in (48, 96):
        lower = random_waves(nodes, rms)
        upper = 1 + (np.roll(lower.T[::-1], nodes // 8, axis=0) * 0.7 if both else 0 * lower)
        walls = Walls(lower=lower, upper=upper, spacing=(size / nodes, 1.3 * size / nodes))
        found = slope_corrected(walls, tolerance=1e-12)
        got.append(values(found.corrected) - values(found.thin))
    stokes, thin = (nearly_smooth_flow(walls, stokes=way) for way in (True, False))
    used = slice(4) if both else slice(None)
    wanted, extrapolated = (values(stokes) - values(thin))[used], ((4 * got[1] - got[0]) / 3)[used]
    assert np.abs(extrapolated - wanted).max() < 5e-3 * np.abs(wanted).max()


def turned_by_90(walls):
    return Walls(lower=walls.lower.T[:, ::-1], upper=walls.upper.T[:, ::-1], spacing=walls.spacing[::-1])


def test_symmetries():
    nodes = 32
    lower = random_waves(nodes, 0.2)
    walls = Walls(lower=lower, upper=np.full_like(lower, 1.0), spacing=(0.2, 0.25))
    own = slope_corrected(walls, tolerance=1e-10)
    a, b, f = own.corrected.pressure, own.corrected.shear, own.corrected.friction
    assert a[0, 1] == pytest.approx(a[1, 0], rel=1e-6)

    shifted = Walls(lower=np.roll(lower, (3, 7), (0, 1)), upper=walls.upper, spacing=walls.spacing)
    assert values(slope_corrected(shifted, tolerance=1e-10).corrected) == pytest.approx(values(own.corrected), abs=1e-7)

    mirrored = slope_corrected(replace(walls, lower=lower[:, ::-1]), tolerance=1e-10).corrected
    sign = np.array([[1, -1], [-1, 1]])
    assert mirrored.pressure == pytest.approx(a * sign, abs=1e-7)
    assert mirrored.shear == pytest.approx(b * sign[0], abs=1e-7)
    assert mirrored.friction == pytest.approx(f, abs=1e-7)

    quarter = slope_corrected(turned_by_90(walls), tolerance=1e-10).corrected
    assert quarter.pressure == pytest.approx(a[::-1, ::-1] * sign, abs=1e-7)

    upside_down = slope_corrected(replace(walls, lower=-walls.upper, upper=-lower), tolerance=1e-10)
    assert upside_down.corrected.pressure == pytest.approx(a, abs=1e-7)
    assert np.isnan(upside_down.corrected.friction)


def test_units_do_not_matter():
    lower = random_waves(16, 0.2)
    walls = Walls(lower=lower, upper=np.ones_like(lower), spacing=(0.3, 0.3))
    small = Walls(lower=lower * 1e-6, upper=walls.upper * 1e-6, spacing=(3e-7, 3e-7))
    one, other = slope_corrected(walls), slope_corrected(small)
    for name in ("thin", "corrected", "bound", "uncertainty"):
        assert values(getattr(other, name).relative) == pytest.approx(values(getattr(one, name).relative), rel=1e-6)


def test_a_channel_that_winds_and_does_not_swell_has_its_own_closed_form():
    """A gap h = 1 along the height everywhere: 12 <1 + z'²> / 1 and what shear across takes, (1/5) of it, or none.

    Of u = 6 s(1-s) with z₁' = a: ∂u/∂x = -6 a (1-2s), whose square has the mean 12 a², twice with the divergence.
    """
    nodes, amplitude, length = 128, 0.3, 6.0
    wave = amplitude * np.sin(2 * np.pi * np.arange(nodes) / nodes)[:, None] * np.ones(2)
    found = slope_corrected(Walls(lower=wave, upper=wave + 1, spacing=(length / nodes, 1.0)))
    slope = (2 * np.pi * amplitude / length) ** 2 / 2
    assert found.added == pytest.approx([2 * slope, slope], rel=5e-3)


def test_contact_neither_blows_up_nor_lets_anything_through():
    lower = random_waves(64, 0.45)
    walls = Walls(lower=np.minimum(lower, 1.0), upper=np.ones_like(lower), spacing=(0.2, 0.2)).closed_below(0.02)
    assert 0 < (walls.gap == 0).mean() < 0.2
    found = slope_corrected(walls)
    assert_ordered(found)
    sealed = np.minimum(lower, 1.0)
    sealed[10] = 1.0
    shut = slope_corrected(replace(walls, lower=sealed))
    assert shut.corrected.pressure[0].tolist() == [0, 0]
    assert shut.corrected.pressure[:, 0].tolist() == [0, 0]
    assert shut.corrected.shear[0] == 0
    assert 0 < shut.corrected.pressure[1, 1] < shut.thin.pressure[1, 1]


def test_around_contact_what_slope_takes_from_the_flow_converges():
    taken = []
    for nodes in (32, 64, 128):
        x, y = np.meshgrid(*[2 * np.pi * np.arange(nodes) / nodes] * 2, indexing="ij")
        lower = np.minimum(0.9 * np.cos(x) * np.cos(y) + 0.5 * np.sin(x + 0.4), 1.0)
        found = slope_corrected(Walls(lower=lower, upper=np.ones_like(lower), spacing=(8 / nodes, 8 / nodes)))
        assert found.contact > 0.03
        taken.append([np.diag(found.thin.pressure - part.pressure) for part in (found.corrected, found.bound)])
    taken = np.array(taken)
    assert np.all(np.abs(taken[2] / taken[1] - 1) < 0.01)
    assert np.all(np.abs(taken[2] - taken[1]) < 0.5 * np.abs(taken[1] - taken[0]))


def assert_ordered(found: SlopeCorrected):
    assert np.isfinite(values(found.corrected)).all()
    assert np.isfinite(values(found.uncertainty)).all()
    for low, high in ((found.bound, found.corrected), (found.corrected, found.thin)):
        assert np.linalg.eigvalsh(high.pressure - low.pressure).min() > 0
    assert found.thin.friction < found.corrected.friction


def test_the_grid_error_falls_with_the_square_of_the_spacing():
    found = [slope_corrected(ridges(0.5, 4.0, nodes), tolerance=1e-11).corrected for nodes in (24, 48, 96)]
    first, second = np.diff([values(one)[[0, 3, 4, 6]] for one in found], axis=0)
    orders = np.log2(np.abs(first / second))
    assert np.all((orders > 1.7) & (orders < 2.4)), orders


@pytest.mark.parametrize("both", [False, True])
def test_a_cell_without_symmetries_lies_between_the_bounds_and_within_the_error_bar(both):
    def walls(nodes):
        x, y = np.meshgrid(*[2 * np.pi * np.arange(nodes) / nodes] * 2, indexing="ij")
        lower = 0.25 * np.cos(x + 0.3) + 0.2 * np.sin(y) * np.cos(x) + 0.15 * np.cos(x - y + 1.0)
        upper = 1 + (0.1 * np.cos(y + 2.0) + 0.08 * np.sin(x + y) if both else 0 * x)
        return Walls(lower=lower, upper=upper, spacing=(5.0 / nodes, 6.0 / nodes))

    exact, found = ritz_flow(walls(8), tolerance=3e-3), slope_corrected(walls(96))
    used = slice(4) if both else slice(None)
    true, thin, best, bar = (values(one)[used] for one in (exact, found.thin, found.corrected, found.uncertainty))
    assert np.all(np.abs(best - true) < bar)
    assert np.abs(best - true).max() < 0.1 * np.abs(thin - true).max()
    for low, high in ((found.bound.pressure, exact.pressure), (exact.pressure, found.thin.pressure)):
        assert np.linalg.eigvalsh(high - low).min() > -1e-3
    assert found.added.max() <= MAX_ADDED_DISSIPATION
    assert np.all(found.excess < found.greatest_excess)
    truth = np.diag(found.thin.pressure) / np.diag(exact.pressure) - 1
    assert found.excess == pytest.approx(truth, rel=0.1)


def test_what_is_expected_of_low_surfaces_is_what_slope_has_them():
    lower = random_waves(64, 0.05)
    walls = Walls(lower=lower, upper=np.ones_like(lower), spacing=(0.2, 0.2))
    found = slope_corrected(walls)
    assert expected_excess(walls) == pytest.approx(found.excess, rel=0.15)
    long = Walls(lower=lower, upper=np.ones_like(lower), spacing=(2.0, 2.0))
    along, across = (np.roll(lower, -1, axis=i) - np.roll(lower, 1, axis=i) for i in (0, 1))
    squared = ((along**2).mean() + (across**2).mean()) / 16
    assert expected_excess(long).mean() == pytest.approx(0.9 * squared, rel=0.05)
    assert allowed_rms_slope(0.9 * squared) == pytest.approx(np.sqrt(squared))


def test_rough_walls_are_outside_the_range_of_the_estimate():
    assert slope_corrected(ridges(0.5, 2.0)).added.max() > MAX_ADDED_DISSIPATION
    with pytest.raises(InputError, match="excess"):
        allowed_rms_slope(0.0)
    with pytest.raises(InputError, match="take slope_corrected"):
        expected_excess(ridges(0.5, 2.0))
