"""A texture that is taken for spikes is not lost without a word; a few spikes of an instrument cause none."""

import numpy as np
import pytest

from roughfilm.contact.preparation.prepare import prepare
from roughfilm.contact.preparation.recipe import read_recipe
from roughfilm.contact.surfaces.surface import Surface

POINTS = 160
RECIPE = {"edges": {"direction": "none"}, "smoothing": 1}


def polish(rms=8e-9, seed=11):
    """White heights averaged over 5 x 5 points, as a polished surface has them."""
    noise = np.random.default_rng(seed).standard_normal((POINTS, POINTS))
    for axis in (0, 1):
        noise = sum(np.roll(noise, shift, axis) for shift in range(-2, 3))
    return rms * noise / noise.std()


def with_spots(places, depths, width):
    """The polish with a square spot of a width, in points, and of its own depth at each place."""
    heights = polish()
    for (i, j), depth in zip(places, depths, strict=True):
        heights[i : i + width, j : j + width] += depth
    return Surface(heights=heights, spacing=(1e-6, 1e-6))


def lattice(rows):
    starts = np.linspace(10, POINTS - 20, rows).astype(int)
    return [(i, j) for i in starts for j in starts]


def warned(surface, **recipe):
    return [one for one in prepare(surface, read_recipe({**RECIPE, **recipe})).warnings if "taken for spikes" in one]


@pytest.mark.parametrize("width", [1, 2, 3, 5, 7])
@pytest.mark.parametrize("sign", [-1, 1])
def test_a_texture_of_small_spots_is_removed_with_a_word_and_kept_on_request(width, sign):
    given = with_spots(lattice(4), [sign * 2e-6] * 16, width)
    assert prepare(given, read_recipe(RECIPE)).surface.heights.std() == pytest.approx(polish().std(), rel=0.05)
    (sentence,) = warned(given)
    assert "alike and regular" in sentence
    assert "Sq from" in sentence
    assert prepare(given, read_recipe({**RECIPE, "outliers": {"limit": 0}})).surface.heights.std() == pytest.approx(
        given.heights.std(), rel=0.01
    )


def test_both_rms_heights_are_those_of_the_surface_with_and_without_spots():
    given = with_spots(lattice(5), [3e-6] * 25, 4)
    (sentence,) = warned(given, form="mean")
    before, after = (float(one) for one in sentence.split("Sq from ")[1].split(" µm")[0].split(" to "))
    spots = np.zeros((POINTS, POINTS), bool)
    for i, j in lattice(5):
        spots[i : i + 4, j : j + 4] = True
    assert before == pytest.approx(1e6 * given.heights.std(), rel=0.01)
    assert after == pytest.approx(1e6 * given.heights[~spots].std(), rel=0.02)


def test_spots_alike_are_said_even_if_they_change_little():
    """Four spots of a quarter of a micrometre on a rough surface of the same height."""
    rough = with_spots([], [], 1)
    rough = rough.with_heights(rough.heights * 20)
    heights = rough.heights.copy()
    for i, j in ((30, 31), (100, 40), (64, 120), (130, 88)):
        heights[i, j] += 2e-6
    (sentence,) = warned(rough.with_heights(heights))
    assert "alike" in sentence
    assert "regular" not in sentence


def test_a_few_different_spikes_cause_no_warning():
    heights = 20 * polish()
    for (i, j), height in zip(((30, 31), (100, 40), (64, 120)), (2e-6, -4e-6, 7e-6), strict=True):
        heights[i, j] += height
    assert not warned(Surface(heights=heights, spacing=(1e-6, 1e-6)))


def test_spikes_at_random_places_are_not_regular():
    rng = np.random.default_rng(5)
    places = rng.integers(5, POINTS - 5, (20, 2))
    (sentence,) = warned(with_spots(places, rng.uniform(1e-6, 9e-6, 20), 1))
    assert "alike" not in sentence
    assert "regular" not in sentence
