"""Edges joined along seams: measured heights beside them, as rough as the interior, and nothing changed elsewhere."""

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.preparation.edges.blending import blend_edges
from roughfilm.contact.preparation.edges.joined import seam_pixels
from roughfilm.contact.preparation.edges.seams import join_by_seams, largest_width
from roughfilm.contact.preparation.window import Window, cut_window
from roughfilm.contact.surfaces.periodicity import MISMATCH_THRESHOLD, mismatches, periodicity_mismatch
from roughfilm.contact.surfaces.surface import Surface

WIDTH = (3.0, 3.0)
WINDOW = Window(start=(60, 70), shape=(160, 144))


def rough(seed, wave=16.0, n=512, spacing=(1.0, 1.0)):
    """A large periodic random surface of unit variance without waves below ``wave`` pixels."""
    random = np.random.default_rng(seed).normal(size=(n, n))
    q = np.hypot(np.fft.fftfreq(n)[:, None], np.fft.rfftfreq(n)[None, :])
    heights = np.fft.irfft2(np.fft.rfft2(random) * (q < 1 / wave), s=(n, n))
    return Surface(heights=heights / heights.std(), spacing=spacing)


def joined(surface, window=WINDOW, direction="both", width=WIDTH, filled=None):
    filled = np.zeros(surface.shape, bool) if filled is None else filled
    return join_by_seams(surface, window, direction, width=width, filled=filled)


def mismatch(cell):
    return periodicity_mismatch(cell.surface, seam_pixels(cell.seams, cell.surface))


@pytest.mark.parametrize("direction", ["x", "y", "both"])
def test_points_away_from_the_overlap_keep_their_heights_to_the_last_bit(direction):
    given = rough(911)
    cell, window = joined(given, direction=direction)
    reach = [13 if direction in (axis, "both") else 0 for axis in "xy"]
    inner = tuple(slice(r, n - r) for r, n in zip(reach, window.shape, strict=True))
    assert window == WINDOW
    assert cell.surface.periodic
    assert np.array_equal(cell.surface.heights[inner], given.heights[WINDOW.slices][inner])
    assert cell.weight[inner].max() == 0


def test_every_point_without_weight_is_a_measured_one():
    """In front of the seam it comes from beyond the end of the window, behind it from before its start."""
    given = rough(912)
    cell, _ = joined(given, direction="x")
    rows = np.arange(WINDOW.shape[0])
    i, j = WINDOW.start
    places = [i + rows, i + rows + WINDOW.shape[0], i + rows - WINDOW.shape[0]]
    copies = np.stack([given.heights[place % 512, j : j + WINDOW.shape[1]] for place in places])
    measured = (copies == cell.surface.heights).any(axis=0)
    assert measured[cell.weight == 0].all()
    assert 0 < cell.blended < 0.1
    assert 0 < cell.mean_weight < 0.5 * cell.blended


def margin_over_interior(heights, margin):
    """Variances of heights and of differences of neighbours, without the pairs across the edges of the array."""
    steps = [np.diff(heights, axis=axis, append=np.nan) ** 2 for axis in (0, 1)]
    return [np.nanmean(one[margin]) / np.nanmean(one[~margin]) for one in ((heights - heights.mean()) ** 2, sum(steps))]


@pytest.mark.parametrize("wave", [10.0, 20.0])
def test_edges_fit_and_the_margin_is_as_rough_as_measured(wave):
    """Means over windows, where blended edges lose a tenth of the rms height of the margin and more."""
    margin = np.ones(WINDOW.shape, bool)
    margin[13:-13, 13:-13] = False
    before, found, ratios = [], [], []
    for seed in range(8):
        given = rough(920 + seed, wave)
        raw, (cell, _) = cut_window(given, WINDOW), joined(given)
        before.append(periodicity_mismatch(raw))
        found.append(mismatch(cell))
        three = raw, cell.surface, blend_edges(raw, "both", width=WIDTH).surface
        ratios.append([margin_over_interior(one.heights, margin) for one in three])
    assert min(before) > 0.5
    assert max(found) < MISMATCH_THRESHOLD
    measured, by_seams, by_blending = np.sqrt(np.mean(ratios, axis=0))
    assert by_seams == pytest.approx(measured, abs=0.07)
    assert (by_blending < measured - 0.09).all()


def test_no_height_is_outside_of_those_measured():
    plateaus = rough(931)
    plateaus = plateaus.with_heights(np.minimum(plateaus.heights, 0.0))
    cell, _ = joined(plateaus)
    assert cell.surface.heights.max() == 0
    assert cell.surface.heights.min() >= plateaus.heights.min()


def test_a_window_of_whole_periods_is_left_as_it_is():
    x, y = np.meshgrid(np.arange(320), np.arange(320), indexing="ij")
    waves = Surface(heights=np.cos(2 * np.pi * x / 40) + np.sin(2 * np.pi * y / 16), spacing=(1.0, 1.0))
    inside = Window(start=(80, 80), shape=(160, 160))
    cell, window = joined(waves, inside)
    assert window == inside
    assert np.allclose(cell.surface.heights, waves.heights[inside.slices], atol=1e-12)
    whole, window = joined(cut_window(waves, inside), Window(start=(0, 0), shape=(160, 160)))
    assert np.array_equal(whole.surface.heights, waves.heights[inside.slices])
    assert whole.surface.periodic
    assert window.shape == (160, 160)


def test_a_periodic_surface_is_left_as_it_is():
    given = rough(932, n=128)
    given = given.with_heights(given.heights, periodic=True)
    cell, _ = joined(given, Window(start=(0, 0), shape=(128, 128)))
    assert np.array_equal(cell.surface.heights, given.heights)
    assert (cell.blended, cell.seams) == (0, (None, None))


@pytest.mark.parametrize("start", [(0, 0), (0, 368), (352, 10)])
def test_at_the_end_of_the_measurement_the_other_side_provides_the_overlap(start):
    given = rough(933)
    cell, window = joined(given, Window(start=start, shape=WINDOW.shape))
    assert window.shape == WINDOW.shape
    assert mismatch(cell) < MISMATCH_THRESHOLD
    middle = (slice(25, -25), slice(25, -25))
    assert np.array_equal(cell.surface.heights[middle], given.heights[window.slices][middle])


def test_a_whole_measurement_gives_a_shorter_cell_that_fits_its_period():
    """A wave of 35 pixels: of the lengths that leave an overlap, that of whole periods fits best."""
    x = np.arange(200)
    noise = cut_window(rough(934), Window(start=(0, 0), shape=(200, 60))).heights
    ridges = Surface(heights=np.cos(2 * np.pi * x / 35)[:, None] + 0.05 * noise, spacing=(1.0, 1.0))
    cell, window = joined(ridges, Window(start=(0, 0), shape=(200, 60)), "x")
    assert abs(window.shape[0] - 5 * 35) <= 1
    assert window.start == (9, 0)
    assert cell.surface.shape == window.shape
    assert mismatch(cell) < MISMATCH_THRESHOLD


def test_transposed_turned_over_and_in_other_units_the_cell_is_the_same():
    given = rough(935, spacing=(1.0, 0.8))
    cell, _ = joined(given, width=(3.0, 2.4))
    turned = Surface(heights=given.heights.T, spacing=(0.8, 1.0))
    other, _ = joined(turned, Window(start=WINDOW.start[::-1], shape=WINDOW.shape[::-1]), width=(2.4, 3.0))
    assert np.allclose(other.surface.heights.T, cell.surface.heights, atol=1e-12)
    units = Surface(heights=-1e-6 * given.heights, spacing=(1e-6, 0.8e-6))
    opposite, _ = joined(units, width=(3e-6, 2.4e-6))
    assert np.allclose(opposite.surface.heights, -1e-6 * cell.surface.heights, atol=1e-17)
    assert np.array_equal(joined(given, width=(3.0, 2.4))[0].surface.heights, cell.surface.heights)


def test_filled_points_are_left_out_where_the_overlap_has_measured_ones():
    given, filled = rough(936), np.zeros((512, 512), bool)
    (i, j), hole = WINDOW.start, np.arange(-4, 4)
    filled[i - 4 : i + 4, j + 20 : j + 60] = True
    cell, _ = joined(given, direction="x", filled=filled)
    middle = (hole, slice(32, 48))
    assert not (cell.surface.heights[middle] == given.heights[i + hole, j + 32 : j + 48]).any()
    assert (joined(given, direction="x")[0].surface.heights[middle] == given.heights[i + hole, j + 32 : j + 48]).any()


def test_along_a_seam_the_mismatch_is_that_of_the_straightened_joint():
    given = rough(937, n=128)
    shifts = (10 * np.sin(2 * np.pi * np.arange(128) / 128)).astype(int)
    sheared = np.take_along_axis(given.heights, (np.arange(128)[:, None] - shifts) % 128, axis=0)
    assert mismatches(Surface(heights=sheared, spacing=(1.0, 1.0)), (shifts, None))[0] == pytest.approx(
        mismatches(given)[0], abs=1e-12
    )


@pytest.mark.parametrize("width", [0.0, 1.01 * largest_width(160)])
def test_a_width_out_of_range_is_refused(width):
    with pytest.raises(InputError, match=r"^edges: got a width of .* pixels along x; give at most 6.625 of the 160"):
        joined(rough(938), width=(width, 1.0))


def test_too_few_pixels_are_refused():
    with pytest.raises(InputError, match=r"^edges: got 11 pixels along y; joining edges needs 12 and more"):
        joined(rough(939), Window(start=(0, 0), shape=(160, 11)), width=(1.0, 0.1))
