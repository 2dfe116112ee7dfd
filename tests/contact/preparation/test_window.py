"""The window that repeats itself best is found, and is cut where it was found."""

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.preparation.window import Window, best_window, cut_window
from roughfilm.contact.surfaces.periodicity import periodicity_mismatch
from roughfilm.contact.surfaces.surface import Surface

X, Y = np.meshgrid(np.arange(157), np.arange(131), indexing="ij")
NOTHING = np.zeros(X.shape, bool)


@pytest.mark.parametrize("scale", [1.0, 1e-9])
def test_whole_periods_are_found(scale):
    waves = np.sin(2 * np.pi * X / 37) + np.sin(2 * np.pi * Y / 29 + 1) + 0.5 * np.cos(2 * np.pi * (X / 37 + Y / 29))
    found = best_window(Surface(heights=scale * waves, spacing=(1e-6, 2e-6)), (90, 60), NOTHING)
    assert (found.shape[0] % 37, found.shape[1] % 29) == (0, 0)
    assert found.shape[0] >= 90
    assert found.shape[1] >= 60


def test_a_found_window_repeats_itself_better_than_the_whole():
    rng = np.random.default_rng(816)
    smooth = np.fft.irfft2(np.fft.rfft2(rng.normal(size=(256, 256)))[:, :12], s=(256, 256), axes=(0, 1))
    low = np.abs(np.fft.fftfreq(256)) < 12 / 256
    smooth = np.fft.irfft2(np.fft.rfft2(smooth) * low[:, None], s=(256, 256))[:157, :131]
    whole = Surface(heights=smooth, spacing=(1.0, 1.0))
    part = cut_window(whole, best_window(whole, (90, 80), NOTHING))
    assert periodicity_mismatch(part) < 0.5 * periodicity_mismatch(whole)


def test_a_hole_that_was_filled_smoothly_is_no_window():
    rng = np.random.default_rng(817)
    guessed = np.zeros(X.shape, bool)
    guessed[20:90, 30:100] = True
    heights = np.where(guessed, 0.0, rng.normal(size=X.shape))
    surface = Surface(heights=heights, spacing=(1.0, 1.0))
    blind, seeing = (best_window(surface, (40, 40), mask) for mask in (NOTHING, guessed))
    assert guessed[blind.slices].mean() > 0.9
    assert guessed[seeing.slices].mean() < 0.1


def test_a_window_holds_its_pixels_and_their_mask():
    invalid = (X + Y) % 7 == 0
    given = Surface(heights=1.0 * X + 1000 * Y, spacing=(1.0, 1.0), invalid=invalid)
    part = cut_window(given, Window(start=(3, 11), shape=(20, 30)))
    assert np.array_equal(part.heights, given.heights[3:23, 11:41])
    assert np.array_equal(part.invalid, invalid[3:23, 11:41])


@pytest.mark.parametrize("window", [((-1, 0), (5, 5)), ((0, 0), (1, 5)), ((150, 0), (8, 5)), ((0, 130), (5, 2))])
def test_a_window_that_is_not_inside_is_refused(window):
    with pytest.raises(InputError, match=r"^window: got .* choose a window inside it$"):
        cut_window(Surface(heights=1.0 * X, spacing=(1.0, 1.0)), Window(start=window[0], shape=window[1]))


def test_a_least_window_as_large_as_the_surface_cannot_be_compared():
    with pytest.raises(
        InputError, match=r"^window: got at least 157 pixels along x, where the surface has 157; ask for"
    ):
        best_window(Surface(heights=1.0 * X, spacing=(1.0, 1.0)), (157, 50), NOTHING)
