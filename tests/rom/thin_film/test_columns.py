"""Columns stand at every corner of a gap, crowd where its walls bend, and change their distance gently."""

import numpy as np
import pytest

from roughfilm.rom.pocket.groove import channel, cylindrical, monotone, polygonal, splined
from roughfilm.rom.thin_film.columns import columns

FILM, LENGTH = 3e-5, 1e-3


def gap_of(*grooves):
    return channel(length=LENGTH, film=FILM, grooves=grooves)


ARC = cylindrical(width=3e-4, depth=2.25e-5)
SMOOTH = splined(width=1.5e-4, depth=1.5e-5, shift=-4e-5)
MANY = monotone(points=[(2e-6 * n, 1e-5 * np.sin(np.pi * n / 150) if n % 150 else 0.0) for n in range(151)])


TRAPEZOID = polygonal(points=[(-2e-4, 0.0), (-1.6e-4, 1e-5), (0.1e-4, 1e-5), (2e-4, 0.0)])


@pytest.mark.parametrize("resolution", [12, 61, 240])
@pytest.mark.parametrize(
    "gap",
    [
        gap_of((0.0, ARC)),
        gap_of((-0.3e-3, ARC), (0.1e-3, SMOOTH), (0.35e-3, ARC)),
        gap_of((0.1e-3, MANY)),
        gap_of((0.0, TRAPEZOID)),
    ],
)
def test_every_corner_is_a_column_and_about_as_many_stand_there_as_asked_for(gap, resolution):
    x = columns(gap, resolution)
    assert np.all(np.diff(x) > 0)
    assert (x[0], x[-1]) == pytest.approx((gap.breaks[0] / FILM, gap.breaks[-1] / FILM))
    for place in gap.corners:
        assert np.abs(x - place / FILM).min() < 1e-9
    assert abs(x.size - 1 - resolution) <= 2 * (len(gap.corners) + 1)


@pytest.mark.parametrize("resolution", [12, 61, 240])
@pytest.mark.parametrize("shape", [ARC, splined(width=1.5e-4, depth=1.5e-5, shift=0.0)])
def test_columns_of_a_symmetric_gap_are_symmetric(shape, resolution):
    x = columns(gap_of((0.0, shape)), resolution)
    assert x + x[::-1] == pytest.approx(np.zeros(x.size), abs=1e-3 * np.diff(x).min())


@pytest.mark.parametrize(("shape", "ratio"), [(ARC, 4.0), (SMOOTH, 2.5), (MANY, 2.5)])
def test_columns_stand_closer_at_the_edges_of_a_groove_than_far_from_it(shape, ratio):
    gap = gap_of((0.0, shape))
    x = columns(gap, 240)
    steps = np.diff(x)
    edge = np.abs(x[:-1] - gap.breaks[1] / FILM).argmin()
    assert steps[edge] < steps.max() / ratio
    assert np.abs(np.diff(np.log(steps))).max() < 0.35


def test_many_points_crowd_no_more_than_few():
    """Bumps of neighbouring points do not add up: four times as many leave the columns where they are."""
    few, many = (
        monotone(points=[(3e-4 * n / count, 1e-5 * np.sin(np.pi * n / count)) for n in range(count)] + [(3e-4, 0.0)])
        for count in (40, 160)
    )
    x = [columns(gap_of((-0.15e-3, shape)), 240) for shape in (few, many)]
    shared = np.linspace(0, 1, 101)
    one, other = (np.interp(shared, np.linspace(0, 1, places.size), places) for places in x)
    assert np.abs(one - other).max() < 0.1


@pytest.mark.parametrize("resolution", [50, 100, 200, 400])
def test_rows_of_corners_take_no_more_than_twice_the_columns_asked_for(resolution):
    depths = np.random.default_rng(5).uniform(5e-6, 1.5e-5, 199)
    rough = polygonal(points=[(0.0, 0.0), *((1.5e-6 * n, depth) for n, depth in enumerate(depths, 1)), (3e-4, 0.0)])
    gap = gap_of((-0.15e-3, rough))
    assert len(gap.corners) > 150
    x = columns(gap, resolution)
    assert resolution <= x.size - 1 <= 2 * resolution
    assert np.diff(x).min() > 0.05 / resolution


def test_a_groove_across_the_end_of_the_period_gets_the_columns_of_one_in_its_middle():
    """The corner where two grooves meet crowds columns alike, whether the period is cut there or not."""
    wide = cylindrical(width=5e-4, depth=2.25e-5)
    cut = columns(gap_of((-0.25e-3, wide), (0.25e-3, wide)), 200)
    assert np.diff(cut)[0] == pytest.approx(np.diff(cut)[-1], rel=1e-2)
    middle = np.abs(cut).argmin()
    assert np.diff(cut)[0] == pytest.approx(np.diff(cut)[middle], rel=1e-2)


@pytest.mark.parametrize("gap_width", [1e-12, 1e-9, 2.5e-8])
def test_a_sliver_of_land_makes_no_sliver_of_a_cell(gap_width):
    """Thirds written with six digits leave half a nanometre at the ends of the period."""
    width = LENGTH / 3 - gap_width
    shape = cylindrical(width=width, depth=7.5e-6)
    x = columns(gap_of(*((n * (width + gap_width / 2), shape) for n in (-1, 0, 1))), 240)
    assert np.diff(x).min() > 0.01
