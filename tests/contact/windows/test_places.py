"""Windows are spread evenly and deterministically, and their number counts less where they overlap or share a lay."""

from itertools import islice

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.preparation.window import Window
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.contact.windows.places import independent_windows, valid_places, window_places
from roughfilm.contact.windows.scatter import scatter


def overlaps(one, other):
    return all(abs(a - b) < n for a, b, n in zip(one.start, other.start, one.shape, strict=True))


@pytest.mark.parametrize("count", [1, 2, 3, 5, 9, 11, 12])
def test_windows_that_fit_do_not_overlap_and_lie_inside(count):
    places = window_places((103, 77), (25, 25), count)
    assert len(places) == count
    assert not any(overlaps(one, other) for i, one in enumerate(places) for other in places[:i])
    assert all(0 <= one.start[0] <= 103 - 25 and 0 <= one.start[1] <= 77 - 25 for one in places)
    assert independent_windows(places) == count
    assert places == window_places((103, 77), (25, 25), count)


def test_more_windows_than_fit_overlap_and_are_worth_less():
    places = window_places((100, 100), (50, 50), 25)
    assert len({one.start for one in places}) == 25
    assert 1 < independent_windows(places) < 5


def test_two_windows_that_share_half_are_worth_one_and_a_third():
    pair = [Window(start=(0, 0), shape=(10, 8)), Window(start=(5, 0), shape=(10, 8))]
    assert independent_windows(pair) == pytest.approx(4 / 3)


def test_places_with_many_invalid_points_are_replaced_where_others_overlap_by_half_at_most():
    invalid = np.ones((90, 60), dtype=bool)
    invalid[20:60, 10:40] = False
    places = window_places((90, 60), (20, 20), 12)
    found = valid_places(places, invalid, 0.25)
    kept = [one for one in places if invalid[one.slices].mean() <= 0.25]
    assert list(found[: len(kept)]) == kept
    assert len(kept) < len(found) < 12
    starts = np.array([one.start for one in found])
    covered = np.clip(1 - np.abs(starts[:, None] - starts) / 20, 0, None).prod(axis=2)
    assert covered[~np.eye(len(found), dtype=bool)].max() <= 0.5
    assert max(invalid[one.slices].mean() for one in found) <= 0.25
    assert valid_places(places, np.zeros_like(invalid), 0.25) == places
    assert valid_places(places, np.ones_like(invalid), 0.25) == ()


def test_windows_along_a_lay_are_one_window():
    rng = np.random.default_rng(3)
    ridges = Surface(heights=np.repeat(rng.normal(size=(120, 1)), 120, axis=1), spacing=(1.0, 1.0))
    along = [Window(start=(40, y), shape=(30, 30)) for y in (0, 30, 60, 90)]
    across = [Window(start=(x, 40), shape=(30, 30)) for x in (0, 30, 60, 90)]
    assert independent_windows(along, ridges) == pytest.approx(1.0, abs=1e-6)
    assert independent_windows(across, ridges) > 3.5
    assert independent_windows(along) == 4


def ensemble(rng, lengths, count=256):
    """Gaussian surfaces of rms height 1 with an autocorrelation exp(-2 t²/l²), one period each, cut to half of it."""
    kx, ky = np.fft.fftfreq(count)[:, None], np.fft.rfftfreq(count)[None]
    smooth = np.exp(-(np.pi**2) * ((kx * lengths[0]) ** 2 + (ky * lengths[1]) ** 2) / 4)
    scale = np.sqrt(np.fft.irfft2(smooth**2, s=(count, count))[0, 0])
    while True:
        waves = np.fft.rfft2(rng.normal(size=(count, count))) * smooth / scale
        yield np.fft.irfft2(waves, s=(count, count))[: count // 2, : count // 2]


@pytest.mark.parametrize(
    ("lengths", "size", "number"), [((3, 3), 32, 16), ((3, 3), 64, 9), ((3, 60), 32, 16), ((12, 12), 32, 16)]
)
def test_the_variance_of_a_mean_over_windows_is_that_of_the_independent_ones(lengths, size, number):
    """Var(mean) = Var(one)/nₑ for the area above a height, which is no square, over 300 surfaces."""
    rng = np.random.default_rng(7)
    places = window_places((128, 128), (size, size), number)
    surfaces = list(islice(ensemble(rng, lengths), 300))
    areas = np.array([[(heights[one.slices] > 1).mean() for one in places] for heights in surfaces])
    true = np.mean((areas - areas.mean()) ** 2) / areas.mean(axis=1).var()
    found = [independent_windows(places, Surface(heights=heights, spacing=(1.0, 1.0))) for heights in surfaces[:10]]
    assert np.median(found) == pytest.approx(true, rel=0.25)


@pytest.mark.parametrize(
    ("lengths", "size", "number"), [((3, 3), 32, 16), ((3, 3), 48, 9), ((3, 60), 32, 16), ((8, 8), 32, 8)]
)
def test_intervals_from_the_windows_of_one_surface_cover_the_ensemble(lengths, size, number):
    """The mean of all surfaces, and a window of another surface: rms height and area above a height, 300 surfaces."""
    rng = np.random.default_rng(11)
    places = window_places((128, 128), (size, size), number)
    surfaces = list(islice(ensemble(rng, lengths), 300))
    worth = independent_windows(places, Surface(heights=surfaces[0], spacing=(1.0, 1.0)))
    for quantity in (np.std, lambda heights: (heights > 1).mean()):
        values = np.array([[quantity(heights[one.slices]) for one in places] for heights in surfaces])
        truth, inside, further = values.mean(), [], []
        for own, other in zip(values, np.roll(values, 1, axis=0)[:, 0], strict=True):
            found = scatter(own, worth, positive=True)
            inside.append(found.mean_interval[0] <= truth <= found.mean_interval[1])
            further.append(found.interval[0] <= other <= found.interval[1])
        assert 0.9 <= np.mean(inside) <= 0.99
        assert 0.9 <= np.mean(further) <= 0.98


def test_windows_larger_than_the_measurement_or_of_two_shapes_are_refused():
    with pytest.raises(InputError, match=r"got 40 pixels along y, where the surface has 30; take fewer"):
        window_places((50, 30), (40, 40), 2)
    with pytest.raises(InputError, match="of 2 shapes"):
        independent_windows([Window(start=(0, 0), shape=(4, 4)), Window(start=(0, 0), shape=(5, 4))])
