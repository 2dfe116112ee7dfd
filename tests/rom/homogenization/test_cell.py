"""The solvers of a cell, and what they say of their own error, against sparse elimination and closed forms."""

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.rom.homogenization.cell import solve_cell
from roughfilm.rom.homogenization.conductance import FaceRule, faces
from roughfilm.rom.homogenization.flow_factors import flow_factors
from roughfilm.rom.homogenization.flux import flux
from roughfilm.rom.homogenization.polar import in_polar
from roughfilm.rom.homogenization.richardson import sufficient
from roughfilm.rom.homogenization.solvers import SOLVERS


def rough(shape, seed, hurst=0.8, waves=4):
    """A self-affine periodic surface of rms 1, cut off at four nodes."""
    random = np.random.default_rng(seed)
    q = np.hypot(shape[0] * np.fft.fftfreq(shape[0])[:, None], shape[1] * np.fft.rfftfreq(shape[1]))
    spectrum = np.where((q > 0) & (q < min(shape) / 4), np.maximum(q, waves) ** (-1 - hurst), 0)
    height = np.fft.irfft2(np.fft.rfft2(random.normal(size=shape)) * spectrum, s=shape)
    return height / height.std()


def contact(shape, seed, part, **options):
    """A gap of which a part of the nodes is closed."""
    height = rough(shape, seed, **options)
    return np.maximum(height - np.quantile(height, part), 0)


GAPS = {
    "open": np.exp(rough((48, 48), 3)),
    "contact": contact((64, 64), 5, 0.2),
    "deep contact": contact((64, 64), 7, 0.42),
    "odd": contact((51, 37), 11, 0.15),
    "long pixels": contact((96, 24), 13, 0.1),
    "spans 1e12": contact((48, 48), 17, 0.1) ** 3 + 1e-4 * (contact((48, 48), 17, 0.1) > 0),
}
SPACINGS = {"long pixels": (0.05, 1.0)}


@pytest.fixture(scope="module")
def truth():
    return {
        name: solve_cell(gap, SPACINGS.get(name, (1.0, 1.0)), solvers=("elimination",)).factors
        for name, gap in GAPS.items()
    }


@pytest.mark.parametrize("solver", ["multigrid", "multigrid_double"])
@pytest.mark.parametrize("name", GAPS)
def test_every_solver_agrees_with_elimination(name, solver, truth):
    found = solve_cell(GAPS[name], SPACINGS.get(name, (1.0, 1.0)), solvers=(solver,), tolerance=1e-11).factors
    size = np.sqrt(np.outer(*[np.diag(truth[name].pressure)] * 2)) + 1e-30
    assert np.abs(found.pressure - truth[name].pressure).max() <= 1e-8 * size.max()
    assert np.abs(found.shear - truth[name].shear).max() <= 1e-7 * truth[name].mean_gap
    assert found.shear_couette == pytest.approx(truth[name].shear_couette, rel=1e-6)


@pytest.mark.parametrize("tolerance", [1e-2, 1e-4, 1e-6])
@pytest.mark.parametrize("name", GAPS)
def test_what_is_left_unsolved_is_stated(name, tolerance, truth):
    found = solve_cell(GAPS[name], SPACINGS.get(name, (1.0, 1.0)), tolerance=tolerance)
    exact = truth[name].relative
    own = found.factors.relative
    # An energy that is minimised comes down on A, and rises to e.
    for off, stated, size in (
        (own.pressure[0, 0] - exact.pressure[0, 0], found.unsolved[0], exact.pressure[0, 0]),
        (own.pressure[1, 1] - exact.pressure[1, 1], found.unsolved[1], exact.pressure[1, 1]),
        (exact.shear_couette - own.shear_couette, found.unsolved[2], exact.shear_couette),
    ):
        assert -1e-8 * size <= off <= 10 * stated + 1e-8 * size
        assert stated <= 1.01 * tolerance * size


def test_the_next_solver_takes_over(monkeypatch):
    def fails(*_):
        raise ConvergenceError("no", outcome="stalled", iterations=3)

    monkeypatch.setitem(SOLVERS, "multigrid", fails)
    found = solve_cell(GAPS["contact"], (1.0, 1.0))
    assert found.solver == "multigrid_double"
    with pytest.raises(ConvergenceError, match="no"):
        solve_cell(GAPS["contact"], (1.0, 1.0), solvers=("multigrid",))


def test_a_start_from_the_answer_takes_next_to_nothing():
    cold = solve_cell(GAPS["contact"], (1.0, 1.0), tolerance=1e-9)
    warm = solve_cell(GAPS["contact"], (1.0, 1.0), tolerance=1e-9, start=cold.correctors)
    assert warm.iterations <= 12 < cold.iterations
    assert np.allclose(warm.factors.pressure, cold.factors.pressure, rtol=1e-8)


def test_the_flux_adds_up_to_the_factors_and_nothing_is_lost():
    gap, spacing = 1e-6 * contact((64, 48), 19, 0.2), (1e-6, 2e-6)
    cell = solve_cell(gap, spacing, tolerance=1e-13)
    for direction in (0, 1):
        q = flux(gap, spacing, cell.correctors[direction], direction)
        assert np.allclose(q.mean(axis=(1, 2)), cell.factors.pressure[:, direction], rtol=1e-5)
        assert not q[:, gap == 0].any()
        through = q[direction].sum(axis=1 - direction)
        assert np.ptp(through) < 1e-4 * through.mean()


def test_the_friction_of_a_wedge_shaped_gap_has_the_closed_form():
    # Straight between nodes is what the linear rule takes a gap for: a saw tooth of two nodes is exact.
    first, second = 1.0, 3.0
    gap = np.tile([[first], [second]], (1, 2)).astype(float)
    found = solve_cell(gap, (1.0, 1.0), tolerance=1e-14).factors
    inverse = np.log(second / first) / (second - first)
    square, cube = 1 / (first * second), (first + second) / (2 * first**2 * second**2)
    assert found.pressure[0, 0] == pytest.approx(1 / cube, rel=1e-12)
    assert found.shear[0] == pytest.approx(square / cube, rel=1e-12)
    assert found.couette == pytest.approx(inverse, rel=1e-12)
    assert found.shear_couette == pytest.approx(inverse - square**2 / cube, rel=1e-9)


def test_nearly_equal_gaps_do_not_cancel():
    gap = np.tile([[1.0], [1.0 + 3e-6]], (1, 2))
    assert faces(gap).inside == pytest.approx((1.5e-6) ** 2 / 3, rel=1e-5)


def test_an_offset_opens_contact_and_a_closed_gap_stays_sealed():
    gap = np.zeros((16, 16))
    gap[4:12, 4:12] = 1e-6
    closed = flow_factors(gap, (1e-6, 1e-6))
    assert closed.factors.sealed == (True, True)
    assert not closed.factors.pressure.any()
    assert not closed.factors.shear.any()
    opened = flow_factors(gap, (1e-6, 1e-6), offset=1e-8)
    assert opened.factors.sealed == (False, False)
    assert opened.factors.pressure[0, 0] > (1e-8) ** 3


@pytest.mark.parametrize("radius", [0.2, 1.0, 3.0])
def test_polar_factors_are_those_of_the_equation_in_angle_and_radius(radius):
    # K = diag(h³/r, r h³) on a cell of (θ, r): the same faces with other weights, by elimination of a made matrix.
    gap, (turn, step) = np.exp(0.6 * rough((24, 20), 23)), (0.03, 0.05)
    found = in_polar(solve_cell(gap, (radius * turn, step), tolerance=1e-13).factors, radius)
    part = faces(gap)
    count = gap.size
    nodes = np.arange(count).reshape(gap.shape)
    matrix, right = np.zeros((count, count)), np.zeros((count, 2))
    weights = (part.east / radius / turn**2, part.north * radius / step**2)
    for axis, (weight, length) in enumerate(zip(weights, (turn, step), strict=True)):
        ahead = np.roll(nodes, -1, axis=axis).ravel()
        for here, there, value in zip(nodes.ravel(), ahead, weight.ravel(), strict=True):
            matrix[here, here] += value
            matrix[there, there] += value
            matrix[here, there] -= value
            matrix[there, here] -= value
            right[here, axis] += value * length
            right[there, axis] -= value * length
    chi = np.linalg.lstsq(matrix, right, rcond=None)[0].T.reshape(2, *gap.shape)
    expected = np.zeros((2, 2))
    for axis, (conductance, length) in enumerate(
        zip((part.east / radius, part.north * radius), (turn, step), strict=True)
    ):
        for j in (0, 1):
            drop = (np.roll(chi[j], -1, axis=axis) - chi[j]) / length + (axis == j)
            expected[axis, j] = (conductance * drop).mean()
    assert np.allclose(found.pressure, expected, rtol=1e-6, atol=1e-7 * expected.max())
    # What ω carries across a radius: (ω r/2) B₁, from the drop of χ₁ along θ.
    drag = (part.drag * ((np.roll(chi[0], -1, axis=0) - chi[0]) / turn + 1)).mean()
    assert found.shear[0] == pytest.approx(radius * drag, rel=1e-6)


@pytest.mark.parametrize("rule", FaceRule)
def test_faces_next_to_contact_are_closed(rule):
    gap = np.ones((5, 4))
    gap[2, 1] = 0.0
    part = faces(gap, rule)
    assert part.east[2, 1] == part.east[1, 1] == part.north[2, 1] == part.north[2, 0] == 0
    assert (part.east > 0).sum() == (part.north > 0).sum() == 18


def test_each_value_has_a_solver_tolerance_of_its_own():
    grids = [np.array([1.0, 2.0, 5.0, 0.0]), np.array([1.0 + 4e-5, 2.002, 10.0, 0.0])]
    expected = [4e-5 / (1 + 4e-5) / 400, 2e-3 / 2.002 / 400, 1e-4, 1e-4]  # a hundredth of a fourth of the change
    assert sufficient(grids, 1e-4) == pytest.approx(expected, rel=1e-6)
    assert sufficient(grids[:1], 1e-4) == 1e-4


def test_friction_at_the_edges_of_contact_does_not_determine_the_effort():
    gap = np.maximum(contact((128, 128), 23, 0.5), 0.0) ** 3  # narrow everywhere around contact
    found, exact = flow_factors(gap, (1.0, 1.0)), flow_factors(gap, (1.0, 1.0), solvers=("elimination",))
    assert found.iterations <= 20
    error = abs(found.factors.shear_couette - exact.factors.shear_couette)
    assert error <= 0.1 * found.uncertainty.shear_couette


def test_a_tolerance_of_each_grid_follows_what_the_grids_leave():
    smooth = 1 + 0.3 * np.cos(2 * np.pi * np.arange(64) / 64)[:, None] + np.zeros((64, 16))
    loose, tight = flow_factors(smooth, (1.0, 4.0)), flow_factors(smooth, (1.0, 4.0), tolerance=1e-13)
    assert abs(loose.factors.pressure[0, 0] - tight.factors.pressure[0, 0]) < 0.05 * loose.uncertainty.pressure[0, 0]


def test_more_nodes_than_memory_are_not_eliminated(monkeypatch):
    monkeypatch.setattr("roughfilm.rom.homogenization.solvers.MAX_ELIMINATION_NODES", 100)
    with pytest.raises(ConvergenceError, match="too many to eliminate"):
        solve_cell(GAPS["contact"], (1.0, 1.0), solvers=("elimination",))


def test_an_offset_below_zero_is_refused():
    with pytest.raises(InputError, match="offset"):
        flow_factors(GAPS["open"], (1.0, 1.0), offset=-0.1)
