"""Closed forms against each other and against integrals, and the cell problems in the plane against closed forms."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.homogenization.cell import solve_cell
from roughfilm.rom.homogenization.conductance import FaceRule, faces
from roughfilm.rom.homogenization.exact import nearly_smooth, self_dual, sinusoid
from roughfilm.rom.homogenization.flow_factors import flow_factors
from roughfilm.rom.homogenization.paths import sealed

PARTS = ("pressure", "shear", "couette", "shear_couette")


def plane(n, m=None):
    return np.meshgrid(np.arange(n) / n, np.arange(m or n) / (m or n), indexing="ij")


def solved(gap, spacing=(1.0, 1.0), **options):
    return flow_factors(gap, spacing, **({"tolerance": 1e-13} | options)).factors


def differences(one, other):
    return {name: np.abs(np.asarray(getattr(one, name)) - getattr(other, name)) for name in PARTS}


def smooth_gap(seed, n, waves=3, least=0.25):
    """Waves with random amplitudes; the same gap on every grid, ``least`` its thinnest on 256 nodes."""
    random = np.random.default_rng(seed)
    amplitudes, phases = random.normal(size=(waves + 1, 2 * waves + 1)), random.uniform(0, 2 * np.pi, (4, 7))

    def sums(count):
        x, y = plane(count)
        return sum(
            amplitudes[j, k + waves] * np.cos(2 * np.pi * (j * x + k * y) + phases[j, k + waves])
            for j in range(waves + 1)
            for k in range(-waves, waves + 1)
            if j or k > 0
        )

    return 1 - (1 - least) * sums(n) / sums(256).min()


# closed forms


def test_a_sinusoid_by_integrals():
    a = 0.6

    def mean(power):
        return quad(lambda t: (1 + a * math.cos(t)) ** power, 0, math.pi, epsabs=1e-12)[0] / math.pi

    across = sinusoid(a, mean_gap=2e-6)
    assert across.pressure == pytest.approx(8e-18 * np.diag([1 / mean(-3), mean(3)]), rel=1e-9)
    assert across.shear == pytest.approx([2e-6 * mean(-2) / mean(-3), 0], rel=1e-9, abs=0)
    assert across.couette == pytest.approx(mean(-1) / 2e-6, rel=1e-9)
    assert across.shear_couette == pytest.approx((mean(-1) - mean(-2) ** 2 / mean(-3)) / 2e-6, rel=1e-9)
    along = sinusoid(a, direction=math.pi / 2)
    assert along.pressure == pytest.approx(np.diag([mean(3), 1 / mean(-3)]), abs=1e-9)
    assert along.shear == pytest.approx([1, 0], abs=1e-15)
    assert along.shear_couette == pytest.approx(0, abs=1e-15)


@pytest.mark.parametrize("direction", [0.0, 0.4, math.pi / 4, 1.2])
def test_a_low_sinusoid_is_nearly_smooth(direction):
    """Third order is absent, so that twice the amplitude brings at least 2⁴ times the difference."""
    x, y = plane(32)
    waves = np.cos(2 * np.pi * (x + (y if direction else 0)))
    spacing = (1.0, 1 / math.tan(direction) if direction else 1.0)
    low, high = (
        differences(sinusoid(a, direction=direction), nearly_smooth(1 + a * waves, spacing)) for a in (0.02, 0.04)
    )
    for name in PARTS:
        assert np.max(high[name]) < 4 * 0.04**4
        assert np.max(high[name]) > 15 * np.max(low[name]) or np.max(high[name]) < 1e-14


@pytest.mark.parametrize(
    ("wave", "slope"),
    [
        (lambda x, y: np.cos(2 * np.pi * x) * np.cos(2 * np.pi * y), -1.5),
        (lambda x, _: np.cos(2 * np.pi * x), -6.0),
        (lambda _, y: np.cos(2 * np.pi * y), 3.0),
    ],
)
def test_what_low_roughness_does_in_the_plane(wave, slope):
    """(A₁₁ - 1)/s² by the cell problems, extrapolated to vanishing cells; small amplitudes leave a hundredth."""
    found = []
    for n in (32, 64):
        rough = wave(*plane(n))
        rough /= rough.std()
        found.append((solved(1 + 0.03 * rough, tolerance=1e-12).pressure[0, 0] - 1) / 0.03**2)
    assert (4 * found[1] - found[0]) / 3 == pytest.approx(slope, rel=0.015)


def test_roughness_of_any_shape_is_nearly_smooth():
    n, spacing = 64, (1.0, 0.5)
    for seed in (211, 212):
        rough = smooth_gap(seed, n) - 1
        scaled = 1 + 0.01 * rough / rough.std()
        found, low = solved(scaled, spacing, tolerance=1e-12), nearly_smooth(scaled, spacing)
        for name, apart in differences(found, low).items():
            assert np.max(apart) < 0.05 * 0.01**2 * (9 if name == "pressure" else 3), name
        assert abs(low.pressure[0, 1]) > 1e-6


# the plane against closed forms


@pytest.mark.parametrize(("along", "across"), [(1, 0), (1, 2), (2, -1)])
def test_second_order_on_a_sinusoid_at_any_angle(along, across):
    exact, sizes = sinusoid(0.5, direction=math.atan2(across, along)), (32, 64, 128)
    errors = {name: [] for name in PARTS}
    for n in sizes:
        x, y = plane(n)
        apart = differences(solved(1 + 0.5 * np.cos(2 * np.pi * (along * x + across * y)), tolerance=1e-10), exact)
        for name in PARTS:
            errors[name].append(np.max(apart[name]))
    for name, seen in errors.items():
        assert -np.polyfit(np.log(sizes), np.log(seen), 1)[0] == pytest.approx(2, abs=0.25), name


def test_the_harmonic_rule_is_exact_across_ridges():
    """Sums over evenly spaced nodes of a period converge faster than any power: 64 are enough for a = 0.5."""
    x, _ = plane(64, 4)
    found = solved(1 + 0.5 * np.cos(2 * np.pi * x), rule=FaceRule.HARMONIC, tolerance=1e-13)
    for name, apart in differences(found, sinusoid(0.5)).items():
        assert np.max(apart) < 1e-12, name


@pytest.mark.parametrize("height", [0.5, 1.5])
def test_a_gap_like_its_own_inverse(height):
    seen = []
    for n in (32, 64, 128):
        x, y = plane(n)
        gap = 3e-6 * np.exp(height * np.cos(2 * np.pi * x) * np.cos(2 * np.pi * y))
        assert self_dual(gap) == pytest.approx(27e-18, rel=1e-12)
        found = solved(gap, (1e-6, 1e-6), tolerance=1e-10)
        assert abs(found.pressure[0, 1]) < 1e-9 * found.pressure[0, 0]
        seen.append(np.abs(np.diag(found.pressure) / 27e-18 - 1).max())
    assert seen[-1] < 0.01
    assert np.log2(seen[0] / seen[1]) == pytest.approx(2, abs=0.3)
    assert np.log2(seen[1] / seen[2]) == pytest.approx(2, abs=0.3)


def test_the_error_bar_covers_the_truth_of_smooth_gaps():
    """The truth is the same sum of waves on a grid four times as fine, whose own error is a sixteenth."""
    inside = []
    for seed in range(301, 311):
        found = flow_factors(smooth_gap(seed, 32), (1.0, 1.0))
        truth = solved(smooth_gap(seed, 128), (0.25, 0.25))
        for name, apart in differences(found.factors, truth).items():
            inside.append(np.ravel(apart <= getattr(found.uncertainty, name) + 1e-9))
            assert np.all(np.asarray(getattr(found.uncertainty, name)) < 0.05), name
    assert np.concatenate(inside).mean() >= 0.95


# identities


@pytest.fixture(scope="module", params=[(401, 0.25), (402, 0.05), (403, -0.4)])
def gap(request):
    """Smooth, thin in places, and in contact on some of its nodes; no symmetry."""
    seed, least = request.param
    return np.maximum(smooth_gap(seed, 48, least=least), 0.0)[:, :40]


def closely(one, other, relative=2e-7):
    for name, apart in differences(one, other).items():
        assert np.max(apart) <= relative * np.max(np.abs(getattr(other, name))), name
    assert one.sealed == other.sealed


def test_symmetric_and_never_below_nothing(gap):
    pressure = solved(gap).pressure
    assert pressure[0, 1] == pytest.approx(pressure[1, 0], abs=1e-7 * pressure.max())
    assert np.linalg.eigvalsh(pressure).min() >= -1e-9 * pressure.max()


def test_between_the_means(gap):
    """Of the conductances of faces: 1/<1/k> <= A <= <k> in either direction (Wiener), if all flow took one face."""
    parts, pressure = faces(gap), solved(gap).pressure
    for i, k in enumerate((parts.east, parts.north)):
        with np.errstate(divide="ignore"):
            least = 1 / (1 / k).mean()
        assert least * (1 - 1e-9) <= pressure[i, i] <= k.mean() * (1 + 1e-9)
    assert 0 < pressure[0, 0] < (gap**3).mean()
    if gap.all():
        assert pressure[0, 0] > 1 / (gap**-3.0).mean()


def test_scales(gap):
    closely(solved(2.5e-6 * gap), solved(gap).scaled(2.5e-6))
    closely(solved(gap, (3e-6, 3e-6)), solved(gap))


def test_does_not_care_where_the_cell_begins(gap):
    closely(solved(np.roll(gap, (7, 13), axis=(0, 1))), solved(gap))


def test_half_a_turn_changes_nothing(gap):
    closely(solved(gap[::-1, ::-1]), solved(gap))


def test_mirrored_in_the_sliding_direction(gap):
    """Sliding goes on along x: what mirroring in y turns are the parts with one index y."""
    found, mirrored = solved(gap, (1.0, 1.2)), solved(gap[:, ::-1], (1.0, 1.2))
    assert mirrored.pressure == pytest.approx(found.pressure * [[1, -1], [-1, 1]], abs=1e-7 * found.pressure.max())
    assert mirrored.shear == pytest.approx(found.shear * [1, -1], abs=1e-7)
    assert mirrored.shear_couette == pytest.approx(found.shear_couette, rel=1e-6)


def test_transposed_and_turned_by_a_right_angle(gap):
    """A turns with the wall. B does not, as sliding stays: B of the turned wall is that of the transposed, mirrored."""
    found = solved(gap, (1.0, 1.2))
    transposed, turned = solved(gap.T, (1.2, 1.0)), solved(np.rot90(gap), (1.2, 1.0))
    swap, turn = np.array([[0, 1], [1, 0]]), np.array([[0, -1], [1, 0]])
    largest = found.pressure.max()
    assert transposed.pressure == pytest.approx(swap @ found.pressure @ swap, abs=1e-7 * largest)
    assert turned.pressure == pytest.approx(turn @ found.pressure @ turn.T, abs=1e-7 * largest)
    assert turned.shear == pytest.approx(transposed.shear * [1, -1], abs=1e-7)
    assert turned.shear_couette == pytest.approx(transposed.shear_couette, rel=1e-6)


def test_what_sliding_drags_along_directly(gap):
    """<h δ_i1 - h³ ∂_i χ₃>, summed over faces, is <h (δ_1i + ∂₁ χ_i)>: the cell problems are symmetric."""
    spacing = (1.0, 1.2)
    cell, parts = solve_cell(gap, spacing, tolerance=1e-13), faces(gap)
    sliding = cell.correctors[2]
    east = parts.drag - parts.east * (np.roll(sliding, -1, axis=0) - sliding) / spacing[0]
    north = -parts.north * (np.roll(sliding, -1, axis=1) - sliding) / spacing[1]
    assert cell.factors.shear == pytest.approx([east.mean(), north.mean()], abs=1e-11)
    assert np.abs(east - np.roll(east, 1, axis=0) + (north - np.roll(north, 1, axis=1)) / 1.2).max() < 1e-10


# contact


def test_a_wall_across_seals_one_direction():
    """Beside it the film is a channel, whose factor along the wall is the part of the nodes that is open."""
    gap = np.full((32, 24), 2.0)
    gap[10:16] = 0.0
    found = solved(gap)
    assert found.sealed == (True, False)
    assert (found.pressure[0] == 0).all()
    assert (found.pressure[:, 0] == 0).all()
    assert found.shear[0] == 0
    assert found.pressure[1, 1] == pytest.approx(8 * 26 / 32, rel=1e-9)
    turned = solved(gap.T)
    assert turned.sealed == (False, True)
    assert turned.pressure[0, 0] == pytest.approx(8 * 26 / 32, rel=1e-9)
    assert turned.shear == pytest.approx([2 * 26 / 32, 0], rel=1e-9, abs=0)


def test_an_oblique_groove_opens_both_directions_at_once():
    """A staircase one node wide: any pressure drives the flow along it, and A is of rank one."""
    gap = np.eye(32) + np.roll(np.eye(32), 1, axis=1)
    assert sealed(gap) == (False, False)
    found = solved(gap, tolerance=1e-12)
    assert found.sealed == (False, False)
    # once round, 64 faces of conductance 1 share a drop of 32: a flow of 1/2 crosses every row of 32 nodes
    assert found.pressure == pytest.approx(np.full((2, 2), 0.5 / 32), rel=1e-8)


def test_corners_let_nothing_through():
    assert sealed(np.eye(16)) == (True, True)
    found = solved(np.eye(16))
    assert found.sealed == (True, True)
    assert not found.pressure.any()
    assert not found.shear.any()


def test_isolated_pockets_let_nothing_through_and_do_not_disturb():
    pockets = np.zeros((24, 24))
    pockets[3:8, 4:9] = 1.0
    pockets[22:, 15:20] = pockets[:2, 15:20] = 2.0
    found = solved(pockets)
    assert found.sealed == (True, True)
    assert not found.pressure.any()
    assert np.isfinite([found.couette, found.shear_couette]).all()
    channel = np.zeros((24, 24))
    channel[:, 11:14] = 1.5
    both = solved(np.where(channel > 0, channel, pockets))
    assert both.sealed == (False, True)
    assert both.pressure == pytest.approx(solved(channel).pressure, abs=1e-9)


@pytest.mark.parametrize(
    ("gap", "word"),
    [
        (np.ones(8), "shape"),
        (np.ones((1, 8)), "shape"),
        (np.ones((0, 8)), "shape"),
        (np.ones((4, 4, 4)), "shape"),
        (np.full((4, 4), "wide"), "numbers"),
        (np.ones((4, 4), dtype=complex), "numbers"),
        (np.where(np.eye(4) > 0, np.nan, 1), "nan"),
        (np.where(np.eye(4) > 0, np.inf, 1), "inf"),
        (np.where(np.eye(4) > 0, -1e-9, 1), "-1e-09"),
        (np.zeros((4, 4)), "closed"),
    ],
)
def test_bad_gaps_are_refused_in_one_line(gap, word):
    with pytest.raises(InputError, match=word) as raised:
        flow_factors(gap, (1.0, 1.0))
    assert "\n" not in str(raised.value)


@pytest.mark.parametrize("spacing", [(1.0, 0.0), (1.0, -1.0), (math.nan, 1.0), (math.inf, 1.0), (1.0,)])
def test_bad_spacings_are_refused_in_one_line(spacing):
    with pytest.raises(InputError, match="spacing") as raised:
        flow_factors(np.ones((4, 4)), spacing)
    assert "\n" not in str(raised.value)
