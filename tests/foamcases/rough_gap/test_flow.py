"""Stokes flow between rough walls against exact limits, a perturbation of its own, symmetry and conservation."""

import numpy as np
import pytest

from roughfilm.foamcases.rough_gap.balance import imbalance
from roughfilm.foamcases.rough_gap.dictionaries import DRIVES
from roughfilm.rom.homogenization.exact import sinusoid
from roughfilm.rom.rough_gap.walls import Walls

pytestmark = pytest.mark.openfoam


def ridges(amplitude, length, points):
    """Ridges along y, one of them in a period of this length; mean gaps."""
    wave = amplitude * np.cos(2 * np.pi * np.arange(points) / points)
    return Walls(lower=np.stack([wave] * 2, axis=1), upper=np.ones((points, 2)), spacing=(length / points,) * 2)


def turned(walls):
    return Walls(lower=walls.lower.T.copy(), upper=walls.upper.T.copy(), spacing=walls.spacing[::-1])


def bumps(points, length=4.0):
    """Two crossed waves and one oblique: no symmetry that makes a coefficient vanish."""
    x = 2 * np.pi * np.arange(points) / points
    lower = 0.15 * np.cos(x)[:, None] + 0.1 * np.sin(x) + 0.15 * np.cos(np.add.outer(x, -x) + 1)
    return Walls(lower=lower, upper=np.ones(lower.shape), spacing=(length / points,) * 2)


def open_gap(points=12, spacing=0.5):
    return np.ones((points, points)), (spacing, spacing)


def between(gap, spacing):
    return Walls(lower=1 - gap, upper=np.ones(gap.shape), spacing=spacing)


@pytest.mark.parametrize("layers", [4, 9])
def test_a_flat_gap_is_exact_once_the_known_error_is_divided_out(flow_between, layers):
    flat = flow_between(between(*open_gap(4, 1.0)), layers)
    for number, name in enumerate(("along", "across")):
        assert flat.flows[name].flow[number] == pytest.approx(1 + 2 / layers**2, rel=1e-6)
    assert flat.found.pressure == pytest.approx(np.eye(2), abs=1e-6)
    assert flat.found.shear == pytest.approx([1.0, 0.0], abs=1e-6)
    assert flat.found.friction == pytest.approx(1.0, abs=1e-6)


def test_long_waves_are_those_of_the_reynolds_equation(flow_between):
    found = flow_between(ridges(0.3, 300.0, 32), 6).found
    exact = sinusoid(0.3)
    assert found.pressure.diagonal() == pytest.approx(exact.pressure.diagonal(), rel=4e-3)
    assert found.shear == pytest.approx(exact.shear, rel=4e-3, abs=1e-9)
    assert found.friction == pytest.approx(exact.couette + 3 * exact.shear_couette, rel=4e-3)


def test_the_lowest_pressures_are_those_of_the_reynolds_equation(flow_between):
    """Sliding at 2: dp/dx = 12 (h - c)/h³. Under a gradient the pressure falls everywhere, and is lowest at the end."""
    flows = flow_between(ridges(0.3, 300.0, 32), 8).flows
    x = (np.arange(100_000) + 0.5) / 100_000 * 300.0
    h = 1 - 0.3 * np.cos(2 * np.pi * x / 300.0)
    pressure = np.cumsum(12 * (h - (h**-2).mean() / (h**-3).mean()) / h**3) * 300.0 / x.size
    lost = 1 + 2 / 8**2  # of the pressure, as of the flow of any parabola
    expected = (pressure.min() - pressure.mean()) / lost
    assert flows["sliding"].lowest_pressure(None) == pytest.approx(expected, rel=0.02)
    assert flows["along"].lowest_pressure(0) == 0
    assert flows["across"].lowest_pressure(1) == pytest.approx(0, abs=1e-6)


def second_order(wave_number):
    """(A11 - 1)/a² of shallow ridges under a flat wall in Stokes flow, mean gap 1.

    With u = 6z(1 - z) + a u₁ cos kx, u₁(0) = -6, u₁ = -6g' where g'''' - 2k²g'' + k⁴g = 0, g(0) = g(1) = g'(1) = 0 and
    g'(0) = 1. At the second order a mean slip 3(1 + g''(0)) drags the gap along, and 3/2 flows below z = 0.
    """
    k = wave_number
    s, c = np.sinh(k), np.cosh(k)
    equations = [[s, c, s], [k * c, c + k * s, s + k * c], [k, 1, 0]]  # of sinh kz, z cosh kz, z sinh kz
    curvature = 2 * k * np.linalg.solve(equations, [0, 0, 1])[2]
    return 3 + 1.5 * curvature


def test_the_perturbation_is_that_of_reynolds_for_long_waves():
    assert second_order(1e-2) == pytest.approx(-3, rel=1e-3)


@pytest.mark.parametrize("length", [2.5, 6.0])
def test_short_waves_are_those_of_a_perturbation(flow_between, length):
    """Terms of fourth order are below 1 % of those of second; the Reynolds equation would miss by a tenth at least."""
    amplitude = 0.04
    found = flow_between(ridges(amplitude, length, 24), 12, only="along", tolerance=1e-7).found
    expected = second_order(2 * np.pi / length)
    assert (found.pressure[0, 0] - 1) / amplitude**2 == pytest.approx(expected, rel=0.03)
    assert abs(expected / -3 - 1) > 0.1


@pytest.fixture
def rough(flow_between):
    return flow_between(bumps(12), 6, tolerance=1e-6)


def test_a_turned_gap_has_the_turned_permeability(flow_between, rough):
    other = flow_between(turned(bumps(12)), 6, tolerance=1e-6)
    assert pytest.approx(rough.found.pressure.T, abs=2e-6) == other.found.pressure[::-1, ::-1].T


def test_rough_walls_are_reciprocal_and_balanced(rough):
    a = rough.found.pressure
    assert abs(a[0, 1]) > 0.02
    assert a[0, 1] == pytest.approx(a[1, 0], abs=1e-3 * a[0, 0])
    assert rough.pulled["B1"] == pytest.approx(rough.found.shear[0], rel=2e-3)
    assert rough.pulled["B2"] == pytest.approx(rough.found.shear[1], abs=2e-3)
    for drive in DRIVES:
        assert imbalance(rough.flows[drive.name], drive) < 3e-3
    along = rough.flows["along"].flow_per_width[..., 0].mean(axis=1)
    assert along == pytest.approx(along.mean(), rel=1e-2)
    across = rough.flows["across"].flow_per_width[..., 1].mean(axis=0)
    assert across == pytest.approx(across.mean(), rel=1e-2)


def test_a_turned_gap_lets_through_along_what_the_other_does_across(flow_between):
    across = flow_between(bumps(8), 4, only="across", tolerance=1e-6).found.pressure[:, 1]
    along = flow_between(turned(bumps(8)), 4, only="along", tolerance=1e-6).found.pressure[:, 0]
    assert along[::-1] == pytest.approx(across, abs=5e-6)


def test_a_flow_states_how_far_from_settled_it_is(flow_between):
    loose, tight = (flow_between(bumps(8), 4, only="along", tolerance=t) for t in (1e-3, 1e-7))
    change = abs(loose.flows["along"].flow[0] / tight.flows["along"].flow[0] - 1)
    assert 1e-7 < change < 3 * loose.run.unsettled["along"] < 6e-3


def test_between_straight_edges_of_contact_flows_what_flows_through_a_duct(flow_between):
    """Through a rectangular duct of width w over height flows 1 - 0.6302/w per width of it; nothing flows across."""
    gap, _ = open_gap(20)
    gap[:, 9:13] = 0  # five rows of columns less
    found = flow_between(between(gap[:4], (1.0, 0.25)), 8, only="along")
    width = 15 * 0.25
    expected = np.diag([(1 - 0.6302 / width) * 15 / 20, 0.0])
    assert found.found.pressure == pytest.approx(expected, rel=2e-2, abs=1e-6)


def test_what_is_sealed_is_not_run(flow_between):
    gap, spacing = open_gap(8)
    gap[:, 4] = 0
    found = flow_between(between(gap, spacing), 4)
    assert set(found.run.flows) == set(found.flows) == {"along", "sliding"}
    assert not found.found.pressure[:, 1].any()
    assert found.found.shear[0] == pytest.approx(found.pulled["B1"], rel=1e-3)


def test_pools_change_nothing(flow_between):
    gap, spacing = open_gap(8)
    gap[2:7, 2:7] = 0
    solid = flow_between(between(gap, spacing), 4, only="along").found
    gap[3:6, 3:6] = 1
    pool = flow_between(between(gap, spacing), 4, only="along")
    assert pool.columns.closed_in > 0
    assert pool.found.pressure == pytest.approx(solid.pressure, abs=1e-5)


def test_without_inertia_navier_stokes_is_stokes(flow_between):
    flows = [
        flow_between(bumps(8), 4, only="along", tolerance=1e-7, reynolds_number=re, scheme=scheme).found.pressure
        for re, scheme in ((1e-6, ""), (1e-3, "linear_upwind"), (20.0, "linear_upwind"))
    ]
    assert flows[1] == pytest.approx(flows[0], abs=1e-5)
    assert np.abs(flows[2] - flows[0]).max() > 1e-3


@pytest.mark.slow
def test_two_processes_find_what_one_finds(flow_between):
    gap, spacing = open_gap()
    gap[3:8, 4:7] = 0
    alone, together = (
        flow_between(between(gap, spacing), 4, only="along", tolerance=1e-7, processes=n).found for n in (1, 2)
    )
    assert together.pressure == pytest.approx(alone.pressure, abs=1e-6)
