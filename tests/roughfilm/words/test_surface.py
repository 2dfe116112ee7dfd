"""A prepared surface says which waves its parameters include, also where it was prepared twice."""

import numpy as np
import pytest

from roughfilm.contact.preparation.prepare import prepare
from roughfilm.contact.preparation.recipe import read_recipe
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.words.surface import preparation_steps, scale_limits

GIVEN = Surface(heights=np.random.default_rng(871).normal(size=(64, 48)) * 1e-6, spacing=(1e-6, 1e-6))
PLAIN = {"grid": {"points": "kept"}}
NOT_COMPARABLE = "; values without nesting indices are not comparable between laboratories"


@pytest.mark.parametrize(
    ("entries", "sentence"),
    [
        ({}, f"not scale-limited: S none, L none, F quadratic{NOT_COMPARABLE}"),
        ({"l_filter": "30 um"}, f"not scale-limited: S none, L 30 µm, F quadratic{NOT_COMPARABLE}"),
        ({"s_filter": "4 um"}, "S-F surface: S 4 µm, L none, F quadratic"),
        ({"s_filter": "4 um", "l_filter": "30 um", "form": "none"}, "S-L surface: S 4 µm, L 30 µm, F none"),
    ],
)
def test_a_surface_names_its_nesting_indices(entries, sentence):
    assert scale_limits(prepare(GIVEN, read_recipe({**PLAIN, **entries}))) == sentence


def test_a_second_preparation_adds_to_the_first():
    first = prepare(GIVEN, read_recipe({**PLAIN, "form": "tilt", "s_filter": "6 um"})).surface
    again = prepare(first, read_recipe({**PLAIN, "form": "mean", "s_filter": "4 um", "l_filter": "30 um"}))
    assert scale_limits(again) == "S-L surface: S 6 µm, L 30 µm, F tilt, mean"
    assert "S-filter: nesting index 4 µm" in preparation_steps(again)
