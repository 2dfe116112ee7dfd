"""Direct leakage against closed forms, a dense network of its own, and what the cell problem bounds it by."""

import numpy as np
import pytest
from scipy import ndimage

from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.homogenization.conductance import FaceRule
from roughfilm.rom.homogenization.exact import sinusoid
from roughfilm.rom.homogenization.flow_factors import flow_factors
from roughfilm.rom.homogenization.paths import sealed, sealed_between_ends
from roughfilm.rom.homogenization.solvers import SOLVERS
from roughfilm.rom.seal.leakage.direct import direct_flow, direct_leakage
from roughfilm.rom.seal.leakage.homogenized import homogenized_leakage


def waves(nx, ny, seed):
    """Depths of the same waves in both directions, whatever the grid."""
    x, y = np.meshgrid(np.arange(nx) / nx, np.arange(ny) / ny, indexing="ij")
    random = np.random.default_rng(seed)
    found = sum(
        random.normal() * np.cos(2 * np.pi * (k * x + m * y + random.random())) / np.hypot(k, m)
        for k in range(1, 5)
        for m in range(-4, 5)
    )
    return found / 2


def rough(nx, ny, seed, contact=0.0):
    """A gap of such waves, of which the nearest part is in contact."""
    found = waves(nx, ny, seed)
    return np.maximum(found - (np.quantile(found, contact) if contact else 1.2 * found.min()), 0.0)


def dense(gap, spacing):
    """K in x from a network of conductances between all nodes, ends given, sides joined; h straight on each link."""
    h = np.concatenate([gap, gap[:1]])
    (n, m), (dx, dy) = h.shape, spacing
    matrix = np.zeros((n * m, n * m))

    def link(one, two, size):
        a, b = h[one], h[two]
        if a * b == 0:
            return 0.0
        own = 1 / ((a + b) / (2 * a**2 * b**2)) * size
        first, second = np.ravel_multi_index(one, h.shape), np.ravel_multi_index(two, h.shape)
        matrix[[first, second], [first, second]] += own
        matrix[[first, second], [second, first]] -= own
        return own

    ends = 0.0
    for i in range(n):
        for j in range(m):
            if i < n - 1:
                link((i, j), (i + 1, j), dy / dx)
            if 0 < i < n - 1:
                link((i, j), (i, (j + 1) % m), dx / dy)
    pressure = np.zeros(n * m)
    pressure[:m] = 1.0
    inside = np.arange(m, (n - 1) * m)
    block = matrix[np.ix_(inside, inside)]
    pressure[inside] = np.linalg.lstsq(block, -matrix[np.ix_(inside, np.arange(m))].sum(axis=1), rcond=None)[0]
    ends = float((matrix @ pressure)[:m].sum())
    return ends * (n - 1) * dx / (m * dy)


def test_a_smooth_gap_lets_its_cube_through():
    found = direct_leakage(np.full((16, 12), 3e-7), (1e-6, 2e-6))
    assert found.permeability == pytest.approx([27e-21] * 2, rel=1e-14)
    assert (found.uncertainty < 1e-12 * 27e-21).all()
    assert found.sealed == (False, False)


@pytest.mark.parametrize("amplitude", [0.3, 0.8])
def test_ridges_are_resistances_in_series_across_and_in_parallel_along(amplitude):
    gap = np.repeat(1 + amplitude * np.cos(2 * np.pi * np.arange(128) / 128)[:, None], 8, axis=1)
    own = sinusoid(amplitude).pressure
    across = direct_flow(gap, (1.0, 1.0), 0, rule=FaceRule.HARMONIC, tolerance=1e-13)
    along = direct_flow(gap, (1.0, 1.0), 1, rule=FaceRule.HARMONIC, tolerance=1e-13)
    assert across.permeability == pytest.approx(own[0, 0], rel=1e-12)
    assert along.permeability == pytest.approx(own[1, 1], rel=1e-12)


def test_lines_between_the_nodes_of_ridges_are_followed_exactly():
    heights = np.array([1.0, 0.2, 3.0, 0.7, 0.7])
    after = np.roll(heights, -1)
    resistance = np.mean((heights + after) / (2 * heights**2 * after**2))
    found = direct_flow(np.repeat(heights[:, None], 3, axis=1), (2.0, 1.0), 0)
    assert found.permeability == pytest.approx(1 / resistance, rel=1e-12)


@pytest.mark.parametrize("direction", [0, 1])
def test_gaps_that_do_not_change_across_the_flow_have_their_cells_factor(direction):
    gap = np.repeat(rough(48, 1, 97), 6, axis=1) + 0.2
    if direction == 1:
        gap = np.ascontiguousarray(gap.T)
    cell = flow_factors(gap, (1.0, 1.0), tolerance=1e-10).factors.pressure
    found = direct_leakage(gap, (1.0, 1.0)).permeability
    assert found == pytest.approx(np.diag(cell), rel=1e-8)


@pytest.mark.parametrize("shape", [(9, 7), (8, 12), (2, 6), (13, 2)])
@pytest.mark.parametrize("contact", [0.0, 0.3])
@pytest.mark.parametrize("solver", list(SOLVERS))
def test_a_network_of_faces_solved_densely_has_the_same_flow(shape, contact, solver):
    gap, (dx, dy) = rough(*shape, 103, contact), (1.0, 1.7)
    along = direct_flow(gap, (dx, dy), 0, tolerance=1e-12, solvers=[solver])
    across = direct_flow(gap, (dx, dy), 1, tolerance=1e-12, solvers=[solver])
    assert along.permeability == pytest.approx(dense(gap, (dx, dy)), rel=1e-9, abs=1e-13)
    assert across.permeability == pytest.approx(dense(gap.T, (dy, dx)), rel=1e-9, abs=1e-13)


@pytest.mark.parametrize("contact", [0.0, 0.2, 0.35])
def test_ends_help_the_flow_and_less_so_the_more_periods_stand_in_series(contact):
    gap = rough(40, 32, 107, contact)
    cell = flow_factors(gap, (1.0, 1.0), tolerance=1e-10).factors.pressure
    for direction in (0, 1):
        own = [direct_flow(gap, (1.0, 1.0), direction, periods=n, tolerance=1e-10).permeability for n in (1, 2, 4, 8)]
        assert own[0] > own[1] > own[2] > own[3] > cell[direction, direction]
        less = 1 / cell[direction, direction] - 1 / np.array(own)
        assert less[2:] / less[1:-1] == pytest.approx([0.5, 0.5], abs=0.02)


def test_the_same_flows_through_every_section():
    gap = rough(40, 36, 109, 0.3)
    found = direct_flow(gap, (1.0, 1.5), 0, tolerance=1e-10)
    after = np.roll(gap, -1, axis=0)
    with np.errstate(divide="ignore", invalid="ignore"):
        faces = np.where(gap * after > 0, 2 * (gap * after) ** 2 / (gap + after), 0.0)
    through = (faces * (1 + np.roll(found.corrector, -1, axis=0) - found.corrector)).mean(axis=1)
    assert through == pytest.approx(found.permeability, rel=1e-4)
    assert (found.corrector[0] == 0).all()


def test_errors_are_within_their_bars():
    ratios = []
    for seed in (113, 127, 131, 137):
        for part in (-0.2, 0.05, 0.15):
            finest = waves(192, 192, seed)
            level = finest.min() - 0.1 if part < 0 else np.quantile(finest, part)
            own, fine, finer = (
                direct_leakage(np.maximum(waves(n, n, seed) - level, 0.0), (1 / n, 1 / n)) for n in (32, 96, 192)
            )
            truth = finer.permeability + (finer.permeability - fine.permeability) / 3
            ratios += [*(np.abs(own.permeability - truth) / own.uncertainty)]
    assert np.mean(np.array(ratios) <= 1) >= 0.9
    assert max(ratios) < 3
    assert np.median(ratios) > 0.1


def test_a_checkerboard_seals_by_its_corners():
    i, j = np.indices((32, 32)) // 4
    board = np.where((i + j) % 2 == 0, 1.0, 0.0)
    found = direct_leakage(board, (1.0, 1.0))
    assert found.sealed == (True, True)
    assert (found.permeability == 0.0).all()
    assert (found.uncertainty == 0.0).all()
    assert not found.along.corrector.any()
    overlapping = ndimage.grey_dilation(board, footprint=ndimage.generate_binary_structure(2, 1), mode="wrap")
    assert direct_leakage(overlapping, (1.0, 1.0)).sealed == (False, False)


def test_a_path_that_leaves_through_a_side_comes_in_at_the_other():
    gap = np.zeros((8, 8))
    gap[:4, 6] = gap[3, [6, 7, 0, 1]] = gap[3:, 1] = gap[0, 1] = 1.0
    assert not sealed_between_ends(gap, joined=True)
    assert sealed_between_ends(gap, joined=False)
    assert sealed_between_ends(gap.T, joined=True)
    found = direct_leakage(gap, (1.0, 1.0))
    assert found.sealed == (False, True)
    assert found.permeability[0] > 0
    assert found.permeability[1] == 0


def test_what_does_not_meet_itself_is_open_between_ends_and_sealed_on_and_on():
    gap = np.zeros((8, 8))
    gap[:4, 6] = gap[3, 1:7] = gap[3:, 1] = gap[0, 1] = 1.0
    assert sealed(gap) == (True, True)
    assert not direct_flow(gap, (1.0, 1.0), 0).sealed
    assert direct_flow(gap, (1.0, 1.0), 0, periods=2).permeability == 0


@pytest.mark.parametrize("leakage", [direct_leakage, homogenized_leakage])
def test_full_contact_is_sealed(leakage):
    found = leakage(np.zeros((4, 6)), (1.0, 1.0))
    assert found.sealed == (True, True)
    assert found.permeability.tolist() == found.uncertainty.tolist() == [0.0, 0.0]
    assert found.along.corrector.shape == (4, 6)


def test_what_is_no_gap_is_refused():
    with pytest.raises(InputError, match="walls cannot overlap"):
        direct_leakage(np.full((4, 4), -1.0), (1.0, 1.0))
    with pytest.raises(InputError, match="periods: got 0"):
        direct_flow(np.ones((4, 4)), (1.0, 1.0), 0, periods=0)
    with pytest.raises(InputError, match="tolerance: got 2"):
        direct_flow(np.ones((4, 4)), (1.0, 1.0), 0, tolerance=2.0)
