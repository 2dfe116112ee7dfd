"""Waves pressed flat: the pressure that the elastic half-space needs for it, by a sum over its Fourier modes."""

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.mechanics.exact.full_contact import full_contact_pressure
from roughfilm.contact.synthetic.self_affine import self_affine

MODULUS = 2.1e11


def lowered(pressure, spacing):
    """Displacement 2p/(E*|q|) of every mode but the mean."""
    qx, qy = (2 * np.pi * np.fft.fftfreq(n, d) for n, d in zip(pressure.shape, spacing, strict=True))
    q = np.hypot(qx[:, None], qy[None, :])
    q[0, 0] = np.inf
    return np.fft.ifft2(2 / (MODULUS * q) * np.fft.fft2(pressure)).real


def test_a_sum_of_waves_is_flat_under_it():
    nx, ny, lx, ly = 30, 21, 4e-4, 3e-4
    numbers = np.array([[1, 0], [0, 2], [3, -2], [5, 4], [-2, 7]])
    vectors = 2 * np.pi * numbers / np.array([lx, ly])
    amplitudes, phases = np.array([1, 0.4, -0.3, 0.2, 0.1]) * 1e-6, np.array([0.3, 2, -1, 0, 5])
    x, y = np.arange(nx)[:, None] * lx / nx, np.arange(ny)[None, :] * ly / ny
    heights = sum(
        a * np.cos(qx * x + qy * y + turn) for a, (qx, qy), turn in zip(amplitudes, vectors, phases, strict=True)
    )
    pressure = full_contact_pressure(
        x, y, amplitudes=amplitudes, wave_vectors=vectors, phases=phases, composite_modulus=MODULUS, load=5e9
    )
    assert pressure.shape == (nx, ny)
    assert pressure.mean() == pytest.approx(5e9, rel=1e-12)
    flat = heights - lowered(pressure, (lx / nx, ly / ny))
    np.testing.assert_allclose(flat, 0, rtol=0, atol=1e-18)


def test_the_mean_square_of_the_pressure_is_that_of_the_slope():
    """<(p − P)²> = (E*/2)² <|∇z|²> of any surface; here that of a self-affine one, recorded in its source."""
    surface = self_affine(
        size=(1e-3, 1e-3), points=(48, 48), seed=4211, hurst=0.8, roll_off=3e-4, cut_off=7e-5, rms_slope=0.05
    )
    waves = np.fft.rfft2(surface.heights, norm="forward")
    m, n = np.nonzero(np.abs(waves) > 1e-20)
    one_of_two = (n > 0) | (m < 24)
    m, n = m[one_of_two], n[one_of_two]
    numbers = np.stack([np.where(m > 24, m - 48, m), n], axis=1)
    x = np.arange(48)[:, None] * 1e-3 / 48
    pressure = full_contact_pressure(
        x,
        x.T,
        amplitudes=2 * np.abs(waves[m, n]),
        wave_vectors=2 * np.pi * numbers / 1e-3,
        phases=np.angle(waves[m, n]),
        composite_modulus=MODULUS,
        load=0.0,
    )
    assert pressure.std() == pytest.approx(MODULUS / 2 * 0.05, rel=1e-10)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"wave_vectors": [[0.0, 0.0]]}, r"\(0, 0\)"),
        ({"wave_vectors": [1.0, 2.0]}, "n pairs"),
        ({"amplitudes": [1.0, 2.0]}, "n pairs"),
        ({"amplitudes": [np.nan]}, "finite"),
        ({"load": np.inf}, "finite"),
        ({"composite_modulus": 0.0}, "above 0"),
    ],
)
def test_what_makes_no_sense_is_refused(changes, words):
    wave = {"amplitudes": [1e-6], "wave_vectors": [[1e4, 0.0]], "composite_modulus": MODULUS, "load": 1e9}
    with pytest.raises(InputError, match=words):
        full_contact_pressure(0.0, 0.0, **(wave | changes))
