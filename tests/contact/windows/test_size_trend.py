"""The value on the whole surface is covered where the trend is known, and refused where Sq has no plateau."""

import math

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.contact.synthetic.description import make, read_entries
from roughfilm.contact.windows.scatter import scatter
from roughfilm.contact.windows.size_trend import Verdict, growth_of, size_trend

SIZES = (4e-4, 2e-4, 1e-4)


@pytest.mark.parametrize("power", [1, 2])
@pytest.mark.parametrize("count", [8, 60])
def test_the_limit_is_covered(power, count):
    """Means over windows of a quantity 1 + 0.1 (L₀/L)^p, with a scatter of 10 % at L₀ that grows as 1/L."""
    rng = np.random.default_rng(1)
    hits = []
    for _ in range(300):
        ratios = SIZES[0] / np.array(SIZES)
        drawn = [1 + 0.1 * one**power + 0.1 * one * rng.normal(size=count) for one in ratios]
        found = [scatter(one) for one in drawn]
        trend = size_trend(SIZES, [one.mean for one in found], [one.mean_uncertainty for one in found], 0.0)
        if trend.limit is not None:
            hits.append(abs(trend.limit - 1) <= trend.limit_uncertainty)
    assert len(hits) > 150
    assert np.mean(hits) >= 0.93


def test_exact_means_give_slope_limit_and_part():
    trend = size_trend((1.0, 2.0, 4.0), (3 + 1.0, 3 + 0.5, 3 + 0.25), (0.1, 0.1, 0.1), 0.05)
    assert trend.verdict is Verdict.EXTRAPOLATED or trend.verdict is Verdict.NOT_RESOLVED
    assert (trend.slope, trend.limit, trend.part) == pytest.approx((1.0, 3.0, 0.25))
    assert list(trend.sizes) == [4, 2, 1]


def rms_over_sizes(description):
    """The mean Sq of the squares of a described surface with sides of 1/4, 1/8 and 1/16 of its period."""
    surface = make(read_entries(description))
    counts = [surface.shape[0] // k for k in (4, 8, 16)]
    heights = [
        np.mean([surface.heights[i : i + n, j : j + n].std() for i in range(0, 512, n) for j in range(0, 512, n)])
        for n in counts
    ]
    return [n * surface.spacing[0] for n in counts], heights


AFFINE = {
    "kind": "self_affine",
    "size": ["1 mm", "1 mm"],
    "points": [512, 512],
    "seed": 3,
    "hurst": 0.8,
    "cut_off": "8 um",
    "rms_height": "1 um",
}


def test_a_self_affine_surface_without_roll_off_is_not_extrapolated():
    sizes, heights = rms_over_sizes(AFFINE | {"roll_off": "1 mm"})
    growth = growth_of(sizes, heights)
    assert growth > 0.4
    trend = size_trend(sizes, heights, [0.01 * one for one in heights], growth)
    assert trend.verdict is Verdict.NO_PLATEAU
    assert trend.limit is None


def test_the_rms_height_of_a_surface_with_roll_off_is_extrapolated():
    sizes, heights = rms_over_sizes(AFFINE | {"roll_off": "25 um"})
    growth = growth_of(sizes, heights)
    assert 0 < growth < 0.1
    trend = size_trend(sizes, heights, [0.01 * one for one in heights], growth)
    assert trend.limit == pytest.approx(1e-6, abs=trend.limit_uncertainty)


def test_too_few_sizes_and_too_strong_trends_are_said():
    assert size_trend((1.0,), (1.0,), (0.1,), math.nan).verdict is Verdict.UNKNOWN
    assert size_trend((2.0, 1.0), (1.0, 1.0), (0.1, None), 0.0).verdict is Verdict.UNKNOWN
    assert size_trend((2.0, 1.0), (1.0, 1.9), (0.01, 0.01), 0.0).verdict is Verdict.TOO_STRONG
    with pytest.raises(InputError, match="give different lengths above 0"):
        size_trend((1.0, 1.0), (1.0, 1.0), (0.1, 0.1), 0.0)


def test_a_flat_surface_has_no_trend():
    flat = Surface(heights=np.zeros((4, 4)), spacing=(1.0, 1.0))
    assert math.isnan(growth_of((2.0, 1.0), (flat.heights.std(), 0.0)))
    assert size_trend((2.0, 1.0), (5.0, 5.0), (0.0, 0.0), 0.0).limit == pytest.approx(5.0)
