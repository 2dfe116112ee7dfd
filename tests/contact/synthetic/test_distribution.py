"""Heights follow the distribution that was asked exactly, and the spectrum is kept nearly."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy import stats

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.contact.synthetic.description import make, read_entries
from roughfilm.contact.synthetic.distribution import pearson_quantile, with_heights_of, with_skewness
from roughfilm.contact.synthetic.gaussian import gaussian
from roughfilm.contact.synthetic.self_affine import self_affine


@pytest.fixture(scope="module", params=[(128, 128), (129, 144), (144, 129)])
def surface(request):
    return self_affine(
        size=(1e-3, 1e-3),
        points=request.param,
        seed=3361,
        hurst=0.8,
        roll_off=1e-3 / 6,
        cut_off=1e-3 / 20,
        rms_height=1e-6,
    )


def spectral_error(found, asked):
    """Relative rms difference of all wave amplitudes but that of the mean."""
    found, asked = (np.abs(np.fft.fft2(one.heights)) for one in (found, asked))
    found[0, 0] = asked[0, 0] = 0
    return np.sqrt(np.sum((found - asked) ** 2) / np.sum(asked**2))


@pytest.mark.parametrize(
    "quantile",
    [
        lambda p: 1e-6 * p,
        lambda p: 1e-6 * stats.weibull_min.ppf(p, 1.5),
        lambda p: 1e-6 * stats.norm.ppf(p) - 5e-6,
        lambda p: 1e-6 * np.floor(4 * p),
    ],
    ids=["uniform", "weibull", "normal", "steps"],
)
def test_sorted_heights_are_the_quantiles_bit_for_bit(surface, quantile):
    made = with_heights_of(surface, quantile)
    count = surface.heights.size
    assert (np.sort(made.heights, axis=None) == quantile((np.arange(count) + 0.5) / count)).all()


@pytest.mark.parametrize("skewness", [-2.0, -0.5, 0.0, 1.0, 3.0])
def test_skewness_is_met_and_the_spectrum_kept(surface, skewness):
    made = with_skewness(surface, skewness)
    heights = made.heights.ravel()
    assert stats.skew(heights) == pytest.approx(skewness, rel=0.01, abs=1e-12)
    assert stats.kurtosis(heights) == pytest.approx(1.5 * skewness**2, rel=0.03, abs=0.01)
    assert heights.std() == pytest.approx(surface.heights.std(), rel=1e-12)
    assert heights.mean() == pytest.approx(surface.heights.mean(), abs=1e-12 * heights.std())
    results = made.source["distribution"]
    error = spectral_error(made, surface)
    assert results["spectral_error"] == pytest.approx(error, rel=1e-6)
    assert results["skewness"] == pytest.approx(stats.skew(heights), rel=1e-9, abs=1e-12)
    assert results["kurtosis"] == pytest.approx(3 + stats.kurtosis(heights), rel=1e-9)
    assert error < 0.02 + 0.01 * skewness**2


def test_turns_bring_the_spectrum_nearer(surface):
    errors = [spectral_error(with_skewness(surface, -1.5, iterations=turns), surface) for turns in (0, 3, 100)]
    assert errors[1] < 0.5 * errors[0]
    assert errors[2] < 0.5 * errors[1]


@pytest.mark.parametrize("skewness", [-4.0, -1.0, -0.01, 4e-3, 0.3, 4.0])
def test_quantiles_are_those_of_pearson_type_three(skewness):
    p = np.array([1e-7, 0.01, 0.3, 0.5, 0.9, 1 - 1e-7])
    assert_allclose(pearson_quantile(p, skewness), stats.pearson3.ppf(p, skewness), rtol=1e-7, atol=1e-9)


def test_quantiles_grow_and_join_where_the_expansion_begins():
    p = (np.arange(200_000) + 0.5) / 200_000
    expanded, exact = pearson_quantile(p, 3e-3 * (1 - 1e-9)), pearson_quantile(p, 3e-3 * (1 + 1e-9))
    assert (np.diff(expanded) > 0).all()
    assert (np.diff(exact) > 0).all()
    assert_allclose(expanded, exact, rtol=0, atol=2e-8)


def test_a_described_surface_keeps_its_rms_slope():
    description = {
        "kind": "self_affine",
        "size": ["1 mm", "1 mm"],
        "points": [160, 121],
        "seed": 8713,
        "hurst": 0.8,
        "roll_off": "0.25 mm",
        "cut_off": "80 um",
        "rms_slope": 0.1,
        "height_distribution": {"skewness": -1.2},
    }
    made = make(read_entries(description))
    waves = np.fft.fft2(made.heights)
    squares = 0.0
    for axis in (0, 1):
        q = np.expand_dims(2 * np.pi * np.fft.fftfreq(made.shape[axis], made.spacing[axis]), 1 - axis)
        squares += np.sum(np.abs(q * waves) ** 2) / made.heights.size**2
    assert np.sqrt(squares) == pytest.approx(0.1, rel=1e-12)
    assert stats.skew(made.heights, axis=None) == pytest.approx(-1.2, rel=0.01)
    assert made.source["achieved"]["rms_slope"] == pytest.approx(0.1, rel=1e-12)
    assert float(made.source["achieved"]["rms_height"].split()[0]) == pytest.approx(made.heights.std(), rel=1e-12)


FLAT = Surface(heights=np.zeros((8, 8)), spacing=(1e-6, 1e-6), periodic=True)
WAVY = gaussian(size=(3e-5, 3e-5), points=(30, 30), seed=71, rms_height=1e-7, correlation_length=5e-6)


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: with_skewness(FLAT, 0.5), "flat"),
        (lambda: with_skewness(Surface(heights=np.eye(8), spacing=(1.0, 1.0)), 0.5), "not periodic"),
        (
            lambda: with_skewness(
                Surface(heights=np.eye(8), spacing=(1.0, 1.0), periodic=True, invalid=np.eye(8, dtype=bool)), 0.5
            ),
            "invalid pixels",
        ),
        (lambda: with_skewness(WAVY, 4.5), "-4 to 4"),
        (lambda: with_skewness(WAVY, float("nan")), "-4 to 4"),
        (lambda: with_skewness(WAVY, 1.0, iterations=-1), "iterations"),
        (lambda: with_heights_of(WAVY, lambda p: -p), "growing"),
        (lambda: with_heights_of(WAVY, lambda p: p * np.nan), "not finite"),
        (lambda: with_heights_of(WAVY, lambda p: p * 1e200), "not finite"),
        (lambda: with_heights_of(WAVY, lambda p: p[1:]), "not finite"),
        (lambda: with_heights_of(WAVY, lambda p: 0 * p + 1e-6), "all equal"),
        (lambda: with_heights_of(WAVY, lambda p: 1e-300 * p), "all equal"),
    ],
)
def test_what_makes_no_sense_is_refused_in_one_line(call, words):
    with pytest.raises(InputError, match=words) as caught:
        call()
    assert "\n" not in str(caught.value)
