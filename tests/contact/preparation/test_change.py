"""How far a preparation changes a surface: what smoothing does to a wave, and which part of a map is lost."""

import math

import numpy as np
import pytest

from roughfilm.contact.preparation.prepare import prepare
from roughfilm.contact.preparation.recipe import AS_IT_IS, read_recipe
from roughfilm.contact.surfaces.surface import Surface


def waves(points, length, periods=6):
    """Waves in both directions of a number of points, over whole periods."""
    x = np.arange(periods * length)
    return Surface(
        heights=1e-7 * np.add.outer(np.cos(2 * np.pi * x / length), np.sin(2 * np.pi * x / length))[:points, :points],
        spacing=(1e-6, 1e-6),
    )


def prepared(surface, **recipe):
    return prepare(surface, read_recipe({**AS_IT_IS, **recipe}))


@pytest.mark.parametrize("length", [4, 6, 12])
def test_a_moving_average_lowers_slope_and_height_of_a_wave_by_its_transmission(length):
    found = prepared(waves(72, length, 72 // length), smoothing=3)
    fall = -math.log((1 + 2 * math.cos(2 * math.pi / length)) / 3)
    change = found.record["change"]
    assert change["slope"] == pytest.approx(fall, rel=0.02)
    assert change["height"] == pytest.approx(fall, rel=1e-9)
    assert change["lost"] == 0
    assert any("smoothing over 3 points lowers the rms slope" in one for one in found.warnings) == (length < 12)


def test_a_cell_as_it_was_measured_is_unchanged():
    found = [
        prepared(one).record["change"]
        for one in (waves(72, 12), waves(72, 12).with_heights(waves(72, 12).heights, periodic=True))
    ]
    assert found[0]["slope"] == pytest.approx(0, abs=0.02)
    change = found[1]
    assert (change["slope"], change["height"], change["lost"]) == (0, 0, 0)
    # Waves in both directions have λ = 2π Sq/g = 12 points, but for the differences that stand for slopes.
    assert change["waves"] == pytest.approx(36, rel=0.05)


def test_points_that_are_filled_or_cut_off_and_terms_of_the_form_are_lost():
    surface = waves(72, 12)
    invalid = np.zeros(surface.shape, dtype=bool)
    invalid[10:28, 20:40] = True
    holed = surface.with_heights(np.where(invalid, 0.0, surface.heights), invalid=invalid)
    filled = prepared(holed).record["change"]
    assert filled["lost"] == pytest.approx(invalid.mean())
    formed = prepared(holed, form="quadratic").record["change"]
    assert 1 - formed["lost"] == pytest.approx((1 - invalid.mean()) * (1 - 3 / formed["waves"]))
    odd = Surface(heights=surface.heights[:67], spacing=surface.spacing)
    joined = prepared(odd, edges={"direction": "both"})
    kept = joined.surface.heights.size / odd.heights.size * (1 - joined.joint.mean_weight)
    assert kept < 1
    assert joined.record["change"]["lost"] == pytest.approx(1 - kept)
