"""Self-affine surfaces have the spectrum, the roughness and the isotropy that were asked."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from roughfilm.contact.synthetic.exact_spectra import rms_slope_over_height
from roughfilm.contact.synthetic.self_affine import self_affine

SIDE = 1e-3


def waves(surface):
    """|q|, rad/m, and power of all waves of a surface, by a complex transform of its own."""
    power = np.abs(np.fft.fft2(surface.heights) / surface.heights.size) ** 2
    qx, qy = (
        2 * np.pi * np.fft.fftfreq(count, length) for count, length in zip(surface.shape, surface.spacing, strict=True)
    )
    return *np.meshgrid(qx, qy, indexing="ij"), power


def slopes(surface):
    """<hx²>, <hy²>, <hx hy> of the waves."""
    qx, qy, power = waves(surface)
    return np.sum(qx**2 * power), np.sum(qy**2 * power), np.sum(qx * qy * power)


def surface(**changes):
    given = {
        "size": (SIDE, SIDE),
        "points": (256, 256),
        "seed": 20071,
        "hurst": 0.8,
        "roll_off": SIDE / 4,
        "cut_off": 8 * SIDE / 256,
        "rms_height": 1e-6,
    }
    return self_affine(**(given | changes))


@pytest.mark.parametrize("hurst", [0.3, 0.8, 1.0])
@pytest.mark.parametrize("points", [(256, 256), (255, 301)])
def test_the_spectrum_falls_as_a_power_and_ends_at_the_cut_off(hurst, points):
    qx, qy, power = waves(surface(hurst=hurst, points=points))
    q = np.hypot(qx, qy)
    roll_off, cut_off = 2 * np.pi * 4 / SIDE, 2 * np.pi * 32 / SIDE
    falling = (q > 1.001 * roll_off) & (q < 0.999 * cut_off)
    flat = (q > 0) & (q < 0.999 * roll_off)
    assert_allclose(np.polyfit(np.log(q[falling]), np.log(power[falling]), 1)[0], -2 - 2 * hurst, rtol=1e-8)
    assert_allclose(power[flat], power[flat][0], rtol=1e-8)
    at_roll_off = power[falling] * (q[falling] / roll_off) ** (2 + 2 * hurst)
    assert_allclose(at_roll_off, power[flat][0], rtol=1e-8)
    assert power[q > 1.001 * cut_off].max() < 1e-28 * power[flat][0]
    assert power[0, 0] < 1e-28 * power[flat][0]


def test_random_amplitudes_have_the_exponent_within_its_standard_error():
    """The log of an exponential variable has the variance π²/6, whatever its mean."""
    qx, qy, power = waves(surface(amplitudes="random", seed=9551, hurst=0.7))
    q = np.hypot(qx, qy)
    falling = (q > 2 * np.pi * 4.01 / SIDE) & (q < 2 * np.pi * 31.9 / SIDE) & ((qy > 0) | ((qy == 0) & (qx > 0)))
    x, y = np.log(q[falling]), np.log(power[falling])
    error = np.pi / np.sqrt(6 * np.sum((x - x.mean()) ** 2))
    assert error < 0.1
    assert abs(np.polyfit(x, y, 1)[0] + 3.4) < 3 * error
    assert np.std(y + 3.4 * x) == pytest.approx(np.pi / np.sqrt(6), rel=0.05)


@pytest.mark.parametrize("points", [(256, 256), (301, 270)])
@pytest.mark.parametrize("amplitudes", ["fixed", "random"])
def test_rms_height_and_rms_slope_are_met_to_rounding(points, amplitudes):
    assert surface(points=points, amplitudes=amplitudes, rms_height=3e-7).heights.std() == pytest.approx(
        3e-7, rel=1e-12
    )
    steep = surface(points=points, amplitudes=amplitudes, rms_height=None, rms_slope=0.1)
    along_x, along_y, _ = slopes(steep)
    assert np.sqrt(along_x + along_y) == pytest.approx(0.1, rel=1e-12)
    assert float(steep.source["achieved"]["rms_height"].split()[0]) == pytest.approx(steep.heights.std(), rel=1e-12)
    assert abs(steep.heights.mean()) < 1e-12 * steep.heights.std()


@pytest.mark.parametrize("hurst", [0.2, 0.5, 0.8, 1.0])
def test_slope_over_height_is_that_of_the_continuous_spectrum(hurst):
    made = surface(points=(400, 400), hurst=hurst, roll_off=SIDE / 16, cut_off=SIDE / 199)
    along_x, along_y, _ = slopes(made)
    exact = rms_slope_over_height(hurst=hurst, roll_off=SIDE / 16, cut_off=SIDE / 199)
    assert np.sqrt(along_x + along_y) / made.heights.std() == pytest.approx(exact, rel=0.005)


@pytest.mark.parametrize("size", [(SIDE, SIDE), (1.5 * SIDE, SIDE)])
def test_slopes_are_the_same_in_all_directions(size):
    along_x, along_y, mixed = slopes(surface(size=size, points=(384, 270), seed=313))
    assert along_x / along_y == pytest.approx(1, abs=0.01)
    assert abs(mixed) < 1e-9 * along_x


def test_heights_of_many_waves_are_gaussian():
    """Skewness and excess kurtosis vanish within the scatter over seeds."""
    scaled = np.array([surface(seed=7000 + k, roll_off=SIDE / 10, cut_off=SIDE / 40).heights / 1e-6 for k in range(20)])
    for moment, expected in ((3, 0.0), (4, 3.0)):
        found = np.mean(scaled**moment, axis=(1, 2))
        assert abs(found.mean() - expected) < 4 * found.std() / np.sqrt(20) + 0.02


@pytest.mark.parametrize("ratio", [1.0, 0.75, 1.5, 0.7310585])
def test_one_seed_is_one_surface_at_any_scale(ratio):
    """Waves of equal length, such as (5, 0) and (3, 4), are drawn in an order that does not depend on the scale."""

    def made(side):
        shortest, longest = side * min(ratio, 1.0), side * max(ratio, 1.0)
        return self_affine(
            size=(side, side * ratio),
            points=(64, 64),
            seed=5,
            hurst=0.8,
            roll_off=shortest / 2,
            cut_off=longest / 8,
            rms_height=side,
        ).heights

    for side in (1e-3, 3.7e-4, 2.3e-5, 7e-6, np.pi, 0.1):
        assert made(side) / side == pytest.approx(made(1.0), abs=1e-13)
