"""Gaussian surfaces have the autocorrelation, the anisotropy and the lay that were asked."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

from roughfilm.contact.synthetic.exact_spectra import autocorrelation, gaussian_rms_slope
from roughfilm.contact.synthetic.gaussian import correlation_length_at, gaussian

PIXEL = 1e-6


def surface(points=(256, 256), **changes):
    given = {
        "size": (points[0] * PIXEL, points[1] * PIXEL),
        "points": points,
        "seed": 6151,
        "rms_height": 2e-7,
        "correlation_length": 10 * PIXEL,
    }
    return gaussian(**(given | changes))


def measured(surface):
    """R at all lags of the period."""
    products = np.fft.ifft2(np.abs(np.fft.fft2(surface.heights)) ** 2).real
    return products / products[0, 0]


def slope_tensor(surface):
    power = np.abs(np.fft.fft2(surface.heights) / surface.heights.size) ** 2
    qx, qy = (
        2 * np.pi * np.fft.fftfreq(count, length) for count, length in zip(surface.shape, surface.spacing, strict=True)
    )
    qx, qy = np.meshgrid(qx, qy, indexing="ij")
    return np.array([[np.sum(a * b * power) for b in (qx, qy)] for a in (qx, qy)])


@pytest.mark.parametrize("points", [(128, 128), (129, 160)])
def test_every_seed_has_the_periodic_autocorrelation_without_its_mean(points):
    """The periods overlap, and the mean over all lags, π λ²/(ln 5 Lx Ly), is taken out."""
    x, y = (np.arange(count) * PIXEL for count in points)
    periodic = sum(
        autocorrelation(np.hypot(x[:, None] + k * points[0] * PIXEL, y + m * points[1] * PIXEL), 10 * PIXEL)
        for k in (-1, 0, 1)
        for m in (-1, 0, 1)
    )
    mean = math.pi * 100 / (math.log(5) * points[0] * points[1])
    expected = (periodic - mean) / (periodic[0, 0] - mean)
    assert_allclose(measured(surface(points)), expected, atol=1e-9)


@pytest.mark.parametrize(("name", "exponent"), [("gaussian", 2), ("exponential", 1)])
def test_random_amplitudes_have_the_autocorrelation_in_the_mean_over_seeds(name, exponent):
    """Within four standard errors, and for the exponential form within what waves below two pixels carry, dx/(2λ)."""
    found = np.array([measured(surface(seed=500 + k, amplitudes="random", autocorrelation=name)) for k in range(25)])
    below = 0.0 if exponent == 2 else 1 / 20
    mean = 4 * 100 / 256**2
    for lag in ((5, 0), (0, 5), (10, 0), (0, 10), (7, 7), (15, 0), (60, 60)):
        values = found[:, *lag]
        expected = autocorrelation(np.hypot(*lag) * PIXEL, 10 * PIXEL, exponent=exponent)
        error = 4 * values.std(ddof=1) / np.sqrt(25)
        assert error < 0.04
        assert abs(values.mean() - expected) < error + mean + below * expected


def test_the_correlation_length_is_where_the_autocorrelation_is_a_fifth():
    row = measured(surface((512, 512)))[:, 0]
    assert np.interp(-0.2, -row[:100], np.arange(100)) == pytest.approx(10, rel=0.01)


@pytest.mark.parametrize(
    ("name", "level", "ratio"),
    [("gaussian", 0.5, 0.656255), ("gaussian", math.exp(-1), 0.788248), ("exponential", 0.5, 0.430677)],
)
def test_lengths_at_other_levels(name, level, ratio):
    """sqrt(ln 2/ln 5), sqrt(1/ln 5), ln 2/ln 5, and the same read off a surface."""
    length = correlation_length_at(level, 10 * PIXEL, name)
    assert length == pytest.approx(10 * PIXEL * ratio, rel=1e-5)
    row = measured(surface((512, 512), autocorrelation=name, correlation_length=20 * PIXEL))[:, 0]
    assert np.interp(-level, -row[:100], np.arange(100)) == pytest.approx(20 * ratio, rel=0.04)


@pytest.mark.parametrize("anisotropy", [1 / 6, 1.0, 3.0])
@pytest.mark.parametrize("lay_angle", [0.0, 0.5, math.pi / 2, -1.2, 3.0])
def test_lay_and_anisotropy_are_those_of_the_slopes(anisotropy, lay_angle):
    """<h_along²> = 2 ln 5 σ²/(γλ)², <h_across²> = 2 ln 5 σ²/λ², and no correlation between the two."""
    across = 12 * PIXEL * max(1, 1 / anisotropy)
    made = surface((300, 512), anisotropy=anisotropy, lay_angle=lay_angle, correlation_length=across)
    turn = np.array([[math.cos(lay_angle), math.sin(lay_angle)], [-math.sin(lay_angle), math.cos(lay_angle)]])
    along_across = turn @ slope_tensor(made) @ turn.T
    steepest = 2 * math.log(5) * (2e-7 / across) ** 2
    # The mean that is left out lifts all other waves by about 2 λ² γ/(Lx Ly).
    lifted = 1 / (1 - math.pi * anisotropy * (across / PIXEL) ** 2 / (math.log(5) * 300 * 512))
    assert_allclose(np.diag(along_across), lifted * steepest * np.array([anisotropy**-2, 1]), rtol=2e-3)
    assert abs(along_across[0, 1]) < 2e-3 * np.sqrt(np.prod(np.diag(along_across)))
    total = gaussian_rms_slope(2e-7, anisotropy * across, across)
    assert made.source["achieved"]["rms_slope"] == pytest.approx(total, rel=0.02)


@pytest.mark.parametrize("gamma", [1 / 3, 1.0, 6.0])
@pytest.mark.parametrize("name", ["gaussian", "exponential"])
def test_gamma_is_the_ratio_of_the_lengths_at_one_half_along_x_and_y(gamma, name):
    across = 12 * PIXEL * max(1, 1 / gamma)
    made = measured(surface((600, 512), anisotropy=gamma, correlation_length=across, autocorrelation=name))
    along_x, along_y = (np.interp(-0.5, -row[:120], np.arange(120)) for row in (made[:, 0], made[0, :]))
    assert along_x / along_y == pytest.approx(gamma, rel=0.04)


def test_pixels_need_not_be_square():
    made = gaussian(
        size=(3e-4, 2e-4), points=(151, 250), seed=88, rms_height=1e-7, correlation_length=2e-5, lay_angle=0.7
    )
    tensor = slope_tensor(made)
    assert tensor[0, 0] / tensor[1, 1] == pytest.approx(1, abs=1e-3)
    assert made.heights.std() == pytest.approx(1e-7, rel=1e-12)
