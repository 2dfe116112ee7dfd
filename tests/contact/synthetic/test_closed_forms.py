"""The closed forms of spectra agree with quadrature and with differences."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.synthetic.exact_spectra import (
    autocorrelation,
    gaussian_rms_slope,
    rms_slope_over_height,
    self_affine_moment,
)


@pytest.mark.parametrize("hurst", [0.1, 0.5, 0.8, 1.0])
@pytest.mark.parametrize("order", [0, 2, 4])
def test_moments_are_the_integrals_of_the_spectrum(hurst, order):
    """In units of qr: C = 1 up to q = 1, q^(-2 - 2H) up to q = 30."""
    below = quad(lambda q: q ** (order + 1), 0, 1)[0]
    above = quad(lambda q: q ** (order - 1 - 2 * hurst), 1, 30, epsrel=1e-12)[0]
    exact = self_affine_moment(order, hurst=hurst, roll_off=2 * math.pi, cut_off=2 * math.pi / 30)
    assert exact == pytest.approx(below + above, rel=1e-10)


def test_slope_over_height_scales_as_one_over_length():
    values = [rms_slope_over_height(hurst=0.8, roll_off=unit, cut_off=unit / 20) for unit in (1.0, 1e-6)]
    assert values[1] == pytest.approx(1e6 * values[0], rel=1e-12)


def test_the_slope_is_the_curvature_of_the_autocorrelation():
    """<hx²> = -σ² R''(0), by a second difference."""
    step = 1e-4
    curvature = [2 * (1 - autocorrelation(np.array(step), length)) / step**2 for length in (3.0, 0.7)]
    assert gaussian_rms_slope(2.0, 3.0, 0.7) == pytest.approx(2 * math.sqrt(sum(curvature)), rel=1e-5)


@pytest.mark.parametrize(
    "call",
    [
        lambda: self_affine_moment(2, hurst=0.0, roll_off=1.0, cut_off=0.1),
        lambda: self_affine_moment(2, hurst=float("nan"), roll_off=1.0, cut_off=0.1),
        lambda: self_affine_moment(3, hurst=0.5, roll_off=1.0, cut_off=0.1),
        lambda: self_affine_moment(2, hurst=0.5, roll_off=0.1, cut_off=1.0),
        lambda: autocorrelation(np.ones(2), 0.0),
        lambda: autocorrelation(np.ones(2), 1.0, exponent=3.0),
        lambda: gaussian_rms_slope(1.0, 0.0, 1.0),
    ],
)
def test_what_makes_no_sense_is_refused_in_one_line(call):
    with pytest.raises(InputError) as caught:
        call()
    assert "\n" not in str(caught.value)
