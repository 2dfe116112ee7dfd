"""The moving average has the frequency response it states."""

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.preparation.smoothing import smooth
from roughfilm.contact.surfaces.surface import Surface


@pytest.mark.parametrize("points", [3, 5])
def test_a_wave_keeps_its_phase_and_loses_the_stated_part(points):
    n, waves = 120, 7
    phase = 2 * np.pi * waves * np.arange(n) / n
    left = smooth(Surface(heights=np.cos(phase)[:, None] * np.ones((1, 9)), spacing=(1.0, 1.0)), points)
    kept = np.sin(np.pi * points * waves / n) / (points * np.sin(np.pi * waves / n))
    assert np.allclose(left.heights, kept * np.cos(phase)[:, None], atol=1e-14)


def test_one_point_changes_nothing():
    given = Surface(heights=np.eye(5), spacing=(1.0, 1.0))
    assert smooth(given, 1) is given


@pytest.mark.parametrize("points", [0, 2, -3, 7])
def test_other_numbers_are_refused(points):
    with pytest.raises(InputError, match=r"^smoothing: got .* give an odd number"):
        smooth(Surface(heights=np.eye(5), spacing=(1.0, 1.0)), points)
