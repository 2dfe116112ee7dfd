"""Flow factors of profiles against integrals, closed forms and the cell problems in the plane; orders of the rules."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.synthetic.rearrangement import rearranged
from roughfilm.rom.homogenization.cell import solve_cell
from roughfilm.rom.homogenization.exact import sinusoid
from roughfilm.rom.homogenization.flow_factors import flow_factors
from roughfilm.rom.homogenization.line import line_factors, profile_over_gap
from roughfilm.rom.homogenization.node_sums import Rule, line_factors_on

PARTS = ("pressure", "shear", "couette", "shear_couette")
PROFILES = {
    "gentle": 1 + 0.3 * np.random.default_rng(511).uniform(-1, 1, 16),
    "steep": np.exp(np.random.default_rng(512).normal(size=24)),
    "thin": 1e-3 + np.random.default_rng(513).uniform(0, 2, 31) ** 2,
    "nearly flat": 1 + 1e-9 * np.random.default_rng(514).uniform(-1, 1, 12),
    "two points": np.array([1.0, 3.0]),
}


def apart(one, other):
    """Of each part, over the size of that part; of e, which may be nothing but rounding, over that of d."""
    sizes = {name: np.max(np.abs(getattr(other, name))) for name in PARTS} | {"shear_couette": other.couette}
    return {name: np.max(np.abs(np.asarray(getattr(one, name)) - getattr(other, name))) / sizes[name] for name in PARTS}


def on(gap, nodes, rule):
    return line_factors_on(gap, nodes, rule=rule).factors


@pytest.fixture(params=PROFILES)
def profile(request):
    return PROFILES[request.param]


def test_straight_lines_by_adaptive_integrals(profile):
    after = np.roll(profile, -1)

    def mean(power):
        pieces = [quad(lambda t: (a + (b - a) * t) ** power, 0, 1, epsrel=1e-12)[0] for a, b in zip(profile, after)]  # noqa: B023, B905
        return math.fsum(pieces) / profile.size

    found = line_factors(profile).factors
    assert found.mean_gap == pytest.approx(profile.mean(), rel=1e-14)
    assert found.pressure == pytest.approx(np.diag([1 / mean(-3), mean(3)]), rel=1e-11, abs=0)
    assert found.shear == pytest.approx([mean(-2) / mean(-3), 0], rel=1e-11, abs=0)
    assert found.couette == pytest.approx(mean(-1), rel=1e-11)
    expected = mean(-1) - mean(-2) ** 2 / mean(-3)
    assert found.shear_couette == pytest.approx(expected, rel=1e-9, abs=1e-12 * mean(-1))


def test_the_plane_has_the_same(profile):
    """Faces of the cell problem in the plane hold straight lines too, but for what flows along the ridges."""
    found = line_factors(profile).factors
    for columns in (2, 4):
        cell = solve_cell(np.repeat(profile[:, None], columns, axis=1), (1.0, 1.0), tolerance=1e-12).factors
        assert cell.pressure[0, 0] == pytest.approx(found.pressure[0, 0], rel=1e-9)
        assert cell.shear == pytest.approx(found.shear, rel=1e-9, abs=1e-12)
        assert cell.couette == pytest.approx(found.couette, rel=1e-12)
        assert cell.shear_couette == pytest.approx(found.shear_couette, rel=1e-7, abs=1e-12)


def test_second_order_on_a_sinusoid_and_the_bar_covers_it():
    sizes, seen = (32, 64, 128, 256), {name: [] for name in PARTS}
    for n in sizes:
        found = line_factors(2e-6 * (1 + 0.7 * np.cos(2 * np.pi * (np.arange(n) / n + 0.137))))
        exact = sinusoid(0.7, mean_gap=2e-6)
        for name, error in apart(found.factors, exact).items():
            seen[name].append(error)
            missed = np.abs(np.asarray(getattr(found.factors, name)) - getattr(exact, name))
            assert np.all(missed <= getattr(found.uncertainty, name)), (n, name)
            assert error < 0.2
    for name, errors in seen.items():
        assert -np.polyfit(np.log(sizes[1:]), np.log(errors[1:]), 1)[0] == pytest.approx(2, abs=0.15), name


@pytest.mark.parametrize(("rule", "order"), [(Rule.TRAPEZOID, 2), (Rule.DIFFERENCES, 2), (Rule.SIMPSON, 4)])
def test_orders_where_the_points_are_nodes(rule, order):
    gap = PROFILES["gentle"]
    exact, sizes = line_factors(gap).factors, [16 * 2**k for k in range(2, 6)]
    errors = [apart(on(gap, nodes, rule), exact) for nodes in sizes]
    for name in ("shear", "couette", "shear_couette"):
        slope = -np.polyfit(np.log(sizes), np.log([error[name] for error in errors]), 1)[0]
        assert slope == pytest.approx(order, abs=0.1), name
    bearing = [abs(on(gap, nodes, rule).pressure[0, 0] / exact.pressure[0, 0] - 1) for nodes in sizes]
    assert -np.polyfit(np.log(sizes), np.log(bearing), 1)[0] == pytest.approx(order, abs=0.1)


@pytest.mark.parametrize("rule", list(Rule))
def test_second_order_where_nodes_lie_beside_the_points(rule):
    """Simpson's rule too: with nodes at the same places of every third line its error falls by 3² per threefold."""
    gap = PROFILES["gentle"]
    exact, sizes = line_factors(gap).factors.pressure[0, 0], [8 * 3**k for k in range(3, 7)]
    errors = [abs(on(gap, nodes, rule).pressure[0, 0] / exact - 1) for nodes in sizes]
    assert -np.polyfit(np.log(sizes), np.log(errors), 1)[0] == pytest.approx(2, abs=0.1)


def test_simpson_integrates_cubes_exactly(profile):
    """Of straight lines, h³ is a cubic."""
    nodes = 4 * profile.size
    expected = line_factors(profile).factors.pressure[1, 1]
    assert on(profile, nodes, Rule.SIMPSON).pressure[1, 1] == pytest.approx(expected, rel=1e-12)
    assert on(profile, nodes, Rule.TRAPEZOID).pressure[1, 1] >= expected * (1 - 1e-12)


def test_differences_are_the_midpoint_rule(profile):
    """In one dimension the flow is the same through all faces, which adds up what they resist."""
    nodes = 40 * profile.size
    found = on(profile, nodes, Rule.DIFFERENCES)
    places = (np.arange(nodes) + 0.5) * profile.size / nodes
    h = np.interp(places, np.arange(profile.size + 1), np.append(profile, profile[0]))
    assert found.pressure[0, 0] == pytest.approx(1 / (h**-3).mean(), rel=1e-8)
    assert found.shear[0] == pytest.approx((h**-2).mean() / (h**-3).mean(), rel=1e-8)
    assert found.shear_couette == pytest.approx(
        (1 / h).mean() - (h**-2).mean() ** 2 / (h**-3).mean(), rel=1e-6, abs=1e-9
    )


def test_sums_over_heights_are_exact_on_a_sinusoid():
    """Nodes of a smooth period: the trapezoid's error falls faster than any power."""
    gap = 1 + 0.5 * np.cos(2 * np.pi * np.arange(64) / 64)
    for name, error in apart(on(gap, 64, Rule.TRAPEZOID), sinusoid(0.5)).items():
        assert error < 1e-12, name


def test_the_order_of_heights_does_not_matter_to_their_sums():
    """The theorem of the bearing curve; straight lines between shuffled heights have another bearing curve."""
    heights = np.random.default_rng(515).normal(size=256)
    gap = 1.1 * heights.max() - np.convolve(np.tile(heights, 3), np.ones(9) / 9, "same")[256:512]
    sums, lines = on(gap, 256, Rule.TRAPEZOID), line_factors(gap).factors
    spread = []
    for seed in range(601, 607):
        shuffled = rearranged(gap, seed=seed, folds=0)
        assert (shuffled != gap).any()
        assert (np.sort(shuffled) == np.sort(gap)).all()
        for name, error in apart(on(shuffled, 256, Rule.TRAPEZOID), sums).items():
            assert error < 1e-10, name
        spread.append(apart(line_factors(shuffled).factors, lines)["pressure"])
    assert max(spread) > 1e-9


def test_scales_and_does_not_care_where_the_period_begins(profile):
    found = line_factors(profile).factors
    for other, scale in (
        (profile * 3e-6, 3e-6),
        (np.roll(profile, 5), 1.0),
        (profile[::-1], 1.0),
        (profile * 1e-90, 1e-90),
    ):
        for name, error in apart(line_factors(other).factors, found.scaled(scale)).items():
            assert error < 1e-9, name


def test_bounds_between_means(profile):
    found = line_factors(profile).factors.relative
    rounding = 1e-14
    assert 0 < found.pressure[0, 0] <= found.shear[0] + rounding <= 1 + 2 * rounding
    assert found.pressure[1, 1] >= 1 - rounding
    assert found.couette >= 1 - rounding
    assert -rounding <= found.shear_couette < found.couette


@pytest.mark.parametrize("rule", [None, *Rule])
def test_a_point_that_touches_seals(rule):
    gap = np.array([1.0, 2.0, 0.0, 1.0, 1.5, 2.0])
    found = line_factors(gap).factors if rule is None else on(gap, 48, rule)
    assert found.sealed == (True, False)
    assert (found.pressure[0] == 0).all()
    assert (found.shear == 0).all()
    assert found.pressure[1, 1] > 0
    assert found.shear_couette == found.couette
    assert np.isfinite(found.couette)


def test_a_film_near_contact_closes_by_its_thinnest_line():
    """A V of slope ±2 that comes within δ of the wall has <h⁻³> -> 1/(2 δ²): A = 2δ²."""
    for least in (1e-4, 1e-6):
        gap = least + 2 * np.abs(np.arange(64) - 32) / 64
        assert line_factors(gap).factors.pressure[0, 0] == pytest.approx(2 * least**2, rel=1e-3)


def test_a_profile_over_its_mean_gap():
    heights = np.random.default_rng(516).normal(size=40) + 7.0
    highest = heights.max() - heights.mean()
    mean_gap = highest * np.array([[1.02, 1.5], [4.0, 100.0]])
    found = profile_over_gap(heights)(mean_gap)
    for place in np.ndindex(2, 2):
        one = line_factors(mean_gap[place] - heights + heights.mean()).factors
        assert found.along[place] == pytest.approx(one.pressure[0, 0], rel=1e-9)
        assert found.across[place] == pytest.approx(one.pressure[1, 1], rel=1e-12)
        assert (found.drag[place], found.couette[place]) == pytest.approx((one.shear[0], one.couette), rel=1e-9)
        assert found.shear_couette[place] == pytest.approx(one.shear_couette, rel=1e-6)
    assert not found.cross.any()
    assert not found.drag_across.any()
    with pytest.raises(InputError, match="walls would touch"):
        profile_over_gap(heights)(np.array([0.99 * highest]))
    with pytest.raises(InputError, match="heights: got nan"):
        profile_over_gap([0.0, math.nan])


def test_few_points_have_no_bar():
    assert np.isinf(line_factors([1.0, 2.0, 1.5]).uncertainty.pressure[0, 0])


def test_the_change_from_half_as_many_nodes():
    gap = PROFILES["gentle"]
    for rule in Rule:
        fine, coarse = line_factors_on(gap, 64, rule=rule), on(gap, 32, rule)
        expected = abs(fine.factors.pressure - coarse.pressure)
        assert fine.uncertainty.pressure == pytest.approx(expected, rel=1e-12, abs=1e-18)


def test_the_plane_bounds_what_it_does_not_know_alike():
    """Cells of a profile in the plane have the same bar as the profile."""
    gap = PROFILES["steep"][:16]
    line, plane = line_factors(gap), flow_factors(np.repeat(gap[:, None], 4, axis=1), (1.0, 1.0), tolerance=1e-12)
    assert plane.uncertainty.pressure[0, 0] == pytest.approx(line.uncertainty.pressure[0, 0], rel=1e-6)


@pytest.mark.parametrize(
    ("gap", "word"),
    [
        ([1.0], "shape"),
        ([], "shape"),
        (np.ones((4, 4)), "shape"),
        (["wide", "thin"], "numbers"),
        ([1.0, 1j], "numbers"),
        ([1.0, math.nan, 2.0], "nan at"),
        ([1.0, math.inf], "inf at"),
        ([1.0, -1e-9, 2.0], "-1e-09 m at"),
        ([0.0, 0.0, 0.0], "closed"),
    ],
)
def test_bad_profiles_are_refused_in_one_line(gap, word):
    for call in (line_factors, lambda profile: line_factors_on(profile, 64)):
        with pytest.raises(InputError, match=word) as raised:
            call(gap)
        assert "\n" not in str(raised.value)


@pytest.mark.parametrize(
    ("nodes", "rule"),
    [(3, Rule.TRAPEZOID), (65, Rule.SIMPSON), (64.0, Rule.SIMPSON), (True, Rule.DIFFERENCES), (2**25, Rule.TRAPEZOID)],
)
def test_bad_numbers_of_nodes_are_refused_in_one_line(nodes, rule):
    with pytest.raises(InputError, match="nodes") as raised:
        line_factors_on([1.0, 2.0], nodes, rule=rule)
    assert "\n" not in str(raised.value)
