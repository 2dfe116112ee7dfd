"""Heights have the four moments asked, and a smooth density."""

import numpy as np
import pytest
from scipy import stats

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.synthetic.four_moments import FourMoments, heights_with, heights_within
from roughfilm.contact.synthetic.profile import STEEL_PROFILES


def four(heights):
    return np.abs(heights).mean(), heights.std(), stats.skew(heights), stats.kurtosis(heights, fisher=False)


def asked(moments):
    return moments.average, moments.rms, moments.skewness, moments.kurtosis


@pytest.mark.parametrize("count", [33, 512, 10_000])
@pytest.mark.parametrize(
    "moments", [*STEEL_PROFILES.values(), FourMoments(average=0.75, rms=1, skewness=1.5, kurtosis=6)]
)
def test_moments_are_met_and_heights_grow(moments, count):
    heights = heights_with(moments, count)
    assert heights.mean() == pytest.approx(0, abs=1e-12 * moments.rms)
    assert four(heights) == pytest.approx(asked(moments), rel=2e-8)
    assert (np.diff(heights) > 0).all()


@pytest.mark.parametrize("peak", [1.9e-6, 2.2e-6, 2.7e-6])
def test_the_highest_is_met_beside_the_moments(peak):
    moments = FourMoments(average=0.93e-6, rms=1.2e-6, skewness=-0.99, kurtosis=4.3, peak=peak)
    heights = heights_with(moments, 512)
    assert heights[-1] - heights.mean() == pytest.approx(peak, rel=2e-8)
    assert four(heights) == pytest.approx(asked(moments), rel=2e-8)
    assert (np.diff(heights) > 0).all()


def test_density_is_smooth():
    """Of 512 heights no step is more than a fifth longer or shorter than its neighbours, but the last few."""
    for moments in STEEL_PROFILES.values():
        steps = np.diff(heights_with(moments, 512))[10:-10]
        assert np.abs(np.diff(np.log(steps))).max() < 0.2


@pytest.mark.parametrize("spread", [stats.norm, stats.logistic, stats.gumbel_l, stats.uniform])
def test_the_moments_of_a_known_distribution_give_nearly_its_heights(spread):
    known = spread.ppf((np.arange(2000) + 0.5) / 2000)
    known -= known.mean()
    average, rms, skewness, kurtosis = map(float, four(known))
    made = heights_with(FourMoments(average=average, rms=rms, skewness=skewness, kurtosis=kurtosis), 2000)
    assert np.sqrt(np.mean((made - known) ** 2)) < 0.02 * rms


def test_upside_down_only_the_skewness_turns():
    up, down = (heights_with(FourMoments(average=0.78, rms=1, skewness=s, kurtosis=4), 256) for s in (0.6, -0.6))
    np.testing.assert_allclose(np.sort(-down), up, rtol=0, atol=1e-6)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"average": 1.1}, "average"),
        ({"rms": 0.0}, "rms"),
        ({"kurtosis": 1.2, "skewness": 0.5}, "kurtosis"),
        ({"skewness": float("nan")}, "skewness"),
        ({"peak": 0.0}, "peak"),
    ],
)
def test_moments_that_no_heights_have_are_refused(changes, words):
    with pytest.raises(InputError, match=words):
        FourMoments(**({"average": 0.8, "rms": 1.0, "skewness": 0.0, "kurtosis": 3.0} | changes))


@pytest.mark.parametrize(("average", "kurtosis"), [(0.999, 3.0), (0.2, 1.5), (1.0, 1.0)])
def test_moments_that_do_not_go_together_are_refused(average, kurtosis):
    with pytest.raises(InputError, match="no smooth distribution"):
        heights_with(FourMoments(average=average, rms=1.0, skewness=0.0, kurtosis=kurtosis), 256)


@pytest.mark.parametrize("count", [31, 2_000_000, 64.0])
def test_too_few_or_too_many_are_refused(count):
    with pytest.raises(InputError, match="count"):
        heights_with(STEEL_PROFILES["B"], count)


def test_heights_lie_between_the_highest_and_the_lowest_that_are_asked():
    z = heights_within(average=2.0e-6, rms=2.5e-6, peak=9.0e-6, valley=4.5e-6, count=4096)
    found = (np.abs(z).mean(), z.std(), z[-1], -z[0], z.mean() + 1)
    np.testing.assert_allclose(found, (2.0e-6, 2.5e-6, 9.0e-6, 4.5e-6, 1), rtol=1e-7)
    assert (np.diff(z) > 0).all()


def test_normal_heights_come_back_from_their_own_four_numbers():
    normal = stats.norm.ppf((np.arange(500) + 0.5) / 500)
    z = heights_within(
        average=np.abs(normal).mean(), rms=normal.std(), peak=normal[-1], valley=-normal[0], count=normal.size
    )
    np.testing.assert_allclose(z, normal, atol=1e-6)


@pytest.mark.parametrize(
    ("numbers", "place"),
    [
        ({"average": 3e-6}, "heights.average"),
        ({"valley": -1e-6}, "heights.valley"),
        ({"peak": 1e-7}, "Sp/Sq 0.04"),
    ],
)
def test_heights_that_cannot_be_are_refused(numbers, place):
    with pytest.raises(InputError, match=place):
        heights_within(**{"average": 2e-6, "rms": 2.5e-6, "peak": 9e-6, "valley": 4.5e-6, "count": 256} | numbers)
