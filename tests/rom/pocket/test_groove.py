"""Grooves have the shape they say, and a channel is the sum of its grooves, period after period."""

import numpy as np
import pytest

from roughfilm.rom.pocket.groove import channel, cylindrical, monotone, polygonal, splined

WIDTH, DEPTH = 3e-4, 1.5e-5
SHIFTS = [-0.45 * WIDTH, -0.3 * WIDTH, 0.0, 0.2 * WIDTH]


def slopes(groove, place, step=1e-9):
    """One-sided slopes to the left and to the right of a place, second order."""
    f = groove.depth(place + step * np.arange(-2, 3))
    return (3 * f[2] - 4 * f[1] + f[0]) / (2 * step), (-3 * f[2] + 4 * f[3] - f[4]) / (2 * step)


def test_the_arc_is_a_circle_through_edges_and_bottom():
    groove = cylindrical(width=WIDTH, depth=DEPTH)
    s = np.linspace(-WIDTH / 2, WIDTH / 2, 101)
    radius = (WIDTH**2 / 4 + DEPTH**2) / (2 * DEPTH)
    centre = DEPTH - radius
    assert np.hypot(s, groove.depth(s) - centre) == pytest.approx(np.full(s.size, radius), rel=1e-12)
    assert groove.corners == groove.breaks == (-WIDTH / 2, WIDTH / 2)


@pytest.mark.parametrize("shift", SHIFTS)
def test_the_spline_is_level_at_edges_and_bottom_and_cubic_between(shift):
    groove = splined(width=WIDTH, depth=DEPTH, shift=shift)
    assert groove.depth(np.array([-WIDTH / 2, shift, WIDTH / 2])) == pytest.approx([0, DEPTH, 0], abs=1e-18)
    for place in groove.breaks:
        assert np.abs(slopes(groove, place)).max() < 1e-4 * DEPTH / WIDTH
    for left, right in ((-WIDTH / 2, shift), (shift, WIDTH / 2)):
        inside = groove.depth(np.linspace(left, right, 9))
        assert np.abs(np.diff(inside, 4)).max() < 1e-12 * DEPTH
        assert np.abs(np.diff(inside, 3)).min() > 1e-3 * DEPTH
    assert groove.corners == ()


def test_the_spline_lies_downstream_for_a_positive_shift():
    s = np.linspace(-WIDTH / 2, WIDTH / 2, 1001)
    assert s[splined(width=WIDTH, depth=DEPTH, shift=0.2 * WIDTH).depth(s).argmax()] == pytest.approx(0.2 * WIDTH)


def test_points_are_joined_by_straight_lines_with_corners_where_the_slope_jumps():
    places, depths = [-2e-4, -1e-4, 0.0, 1.5e-4, 2e-4], [0.0, 1e-5, 2e-5, 5e-6, 0.0]
    groove = polygonal(points=list(zip(places, depths, strict=True)))
    s = np.array([-2.5e-4, -1.25e-4, 0.75e-4, 1.75e-4, 2e-4])
    assert groove.depth(s) == pytest.approx([0, 7.5e-6, 1.25e-5, 2.5e-6, 0], abs=1e-20)
    assert groove.breaks == (-2e-4, 0.0, 2e-4)
    assert groove.corners == groove.breaks


def test_the_joints_of_a_finely_sampled_arc_are_no_corners():
    s = np.linspace(-WIDTH / 2, WIDTH / 2, 101)
    depths = cylindrical(width=WIDTH, depth=DEPTH).depth(s)
    groove = polygonal(points=list(zip(s, depths, strict=True)))
    assert groove.breaks == tuple(s)
    assert groove.corners == (-WIDTH / 2, WIDTH / 2)


def test_monotone_cubics_make_a_parabola_of_a_v():
    groove = monotone(points=[(-WIDTH / 2, 0.0), (0.0, DEPTH), (WIDTH / 2, 0.0)])
    s = np.linspace(-WIDTH / 2, WIDTH / 2, 21)
    assert groove.depth(s) == pytest.approx(DEPTH * (1 - (2 * s / WIDTH) ** 2), abs=1e-18)


def test_points_are_met_and_nothing_is_deeper_than_the_points_around_it():
    rng = np.random.default_rng(7)
    places = np.cumsum(rng.uniform(1e-6, 2e-5, 30))
    depths = np.concatenate([[0], rng.uniform(0, DEPTH, 28), [0]])
    groove = monotone(points=list(zip(places, depths, strict=True)))
    assert groove.depth(places) == pytest.approx(depths, abs=1e-20)
    for n in range(29):
        between = groove.depth(np.linspace(places[n], places[n + 1], 50))
        low, high = sorted(depths[n : n + 2])
        assert low - 1e-18 <= between.min()
        assert between.max() <= high + 1e-18
    for place in places[1:-1]:
        left, right = slopes(groove, place, step=1e-10)
        assert left == pytest.approx(right, abs=1e-3)
    assert groove.corners == (places[0], places[-1])
    assert np.all(groove.depth(np.array([places[0] - 1e-6, places[-1] + 1e-6])) == 0)


def test_a_level_edge_through_points_is_no_corner():
    s = np.linspace(-WIDTH / 2, WIDTH / 2, 9)
    flat = np.array([0, 0, 1, 2, 3, 2, 1, 1, 0]) * 1e-6
    assert monotone(points=list(zip(s, flat, strict=True))).corners == (WIDTH / 2,)


@pytest.mark.parametrize("join", [monotone, polygonal])
def test_many_points_of_an_arc_are_the_arc(join):
    arc, s = cylindrical(width=WIDTH, depth=DEPTH), np.linspace(-WIDTH / 2, WIDTH / 2, 2001)
    errors = []
    for count in (20, 40, 80):
        places = np.linspace(-WIDTH / 2, WIDTH / 2, count + 1)
        depths = arc.depth(places)
        errors.append(np.abs(join(points=list(zip(places, depths, strict=True))).depth(s) - arc.depth(s)).max())
    assert errors[-1] < 1e-3 * DEPTH
    assert np.log2(errors[0] / errors[-1]) / 2 > 1.8


def test_a_channel_adds_its_grooves_and_repeats():
    one, other = cylindrical(width=WIDTH, depth=DEPTH), splined(width=WIDTH, depth=DEPTH / 3, shift=0.0)
    gap = channel(length=1e-3, film=3e-5, grooves=[(-0.3e-3, one), (0.25e-3, other)])
    x = np.linspace(-0.5e-3, 0.5e-3, 777)
    expected = 3e-5 + one.depth(x + 0.3e-3) + other.depth(x - 0.25e-3)
    for periods in (-2, 0, 1):
        assert gap.thickness(x[1:-1] + periods * 1e-3) == pytest.approx(expected[1:-1], rel=1e-9)
    assert gap.breaks == pytest.approx((-5e-4, -4.5e-4, -1.5e-4, 1e-4, 2.5e-4, 4e-4, 5e-4), rel=1e-12)
    assert gap.corners == gap.breaks[1:3]


def test_grooves_that_touch_share_a_break_and_the_ends_of_the_period_are_one_corner():
    third = cylindrical(width=1e-3 / 3, depth=DEPTH)
    gap = channel(length=1e-3, film=3e-5, grooves=[(-1e-3 / 3, third), (0.0, third), (1e-3 / 3, third)])
    assert gap.breaks == pytest.approx((-5e-4, -1e-3 / 6, 1e-3 / 6, 5e-4), rel=1e-9)
    assert gap.corners == gap.breaks[:-1]
