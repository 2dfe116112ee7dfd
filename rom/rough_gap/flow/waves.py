"""Stokes flow over waves of any length on the walls of a gap, to second order in their height."""

import numpy as np
from numpy.typing import ArrayLike

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.rough_gap.flow.factors import RoughGapFactors
from roughfilm.rom.rough_gap.walls import Walls

THIN_RESPONSE = np.array([[3.0, 1.0], [0.0, 1.0]])
"""The responses at k = 0, those of Reynolds' theory."""

SLOPE_RESPONSE = np.array([[1 / 10, 1 / 6], [1 / 4, 1 / 12]])
"""The next order of the responses over k²."""

SERIES_WAVE_NUMBER = 1.0
"""Wave number below which differences of exponentials are computed by series."""

LARGE_WAVE_NUMBER = 300.0
"""Wave number above which 1/sinh k is negligible."""

SERIES_TERMS = 9
"""Number of terms of a series; the remainder at k = 1 is below round-off."""


def wall_response(wave_number: ArrayLike) -> Array:
    """The response of a gap of 1 to slip e^{ikx} on its walls, half the shear stress over the slip, shape (2, 2, ...).

    The first axis is flow across the crests and along them; the second is opposite waves on the walls, with which the
    gap swells, and equal waves, with which it winds. A wave on one wall is half of each. With a biharmonic stream
    function across the crests and a harmonic velocity along them, the responses are

        across: k (cosh k - 1)/(sinh k - k) and k (cosh k + 1)/(sinh k + k);
        along:  (k/2) tanh(k/2) and (k/2) coth(k/2).

    As k → 0 they are 3 + k²/10, 1 + k²/6, k²/4, 1 + k²/12, with Reynolds' theory as first terms and that of
    :mod:`roughfilm.rom.rough_gap.flow.slope` as second. As k → ∞ they are k, k, k/2, k/2.

    Parameters
    ----------
    wave_number : k >= 0 times the gap, of any shape.
    """
    k = np.asarray(wave_number, dtype=np.float64)
    constant = (2, 2) + (1,) * k.ndim
    return np.asarray(THIN_RESPONSE.reshape(constant) + SLOPE_RESPONSE.reshape(constant) * k**2 * attenuation(k))


def attenuation(wave_number: ArrayLike) -> Array:
    """The slope's part of :func:`wall_response` over its second order, from 1 at k = 0 down to 0, shape (2, 2, ...).

    As k → ∞ it is 10/k, 6/k, 2/k, 6/k.
    """
    k = np.asarray(wave_number, dtype=np.float64)
    x = np.maximum(k, SERIES_WAVE_NUMBER)
    inverse = np.where(x < LARGE_WAVE_NUMBER, 1 / np.sinh(np.minimum(x, LARGE_WAVE_NUMBER)), 0.0)
    coth, half = 1 / np.tanh(x), x / 2 / np.tanh(x / 2)
    far = [
        10 * (x * coth + 2 * x * inverse - 3) / (x**2 * (1 - x * inverse)),
        6 * (x * coth - 1) / (x**2 * (1 + x * inverse)),
        1 / half,
        12 * (half - 1) / x**2,
    ]
    y = np.minimum(k, SERIES_WAVE_NUMBER) ** 2
    near = [
        10 * _sum(y, 5, rising=True) / _sum(y, 3),
        6 * _sum(y, 3, rising=True) / (1 + _sum(y, 1)),
        _sum(y / 4, 1) / _sum(y / 4, 0),
        3 * _sum(y / 4, 3, rising=True) / _sum(y / 4, 1),
    ]
    return np.where(k < SERIES_WAVE_NUMBER, near, far).reshape(2, 2, *k.shape)


def _sum(y: Array, start: int, *, rising: bool = False) -> Array:
    """The sum Σ yⁿ/(2n + start)!, each term times 2n + 2 if ``rising``."""
    total, factorial = np.zeros_like(y), 1.0
    for i in range(2, start + 1):
        factorial *= i
    for n in range(SERIES_TERMS):
        total += y**n * (2 * n + 2 if rising else 1) / factorial
        factorial *= (2 * n + start + 1) * (2 * n + start + 2)
    return total


def nearly_smooth_flow(walls: Walls, *, stokes: bool = True) -> RoughGapFactors:
    """Compute the factors of a gap in Stokes flow to second order in roughness over gap, for any wavelengths.

    d and e are the outward waves of the lower and the upper wall over h̄, n is the direction of each wave and r its
    :func:`wall_response`. With the tensors r = r_across nn + r_along (I - nn) and the sum over waves
    Φ = Σ ½(r_swelling |d + e|² + r_winding |d - e|²),

        A/h̄³ = (1 + 6<d² + e²>) I - 6 Φ,    B/h̄ = (1 + <d²>) e₁ - 2 Φ e₁,    f h̄ = 1 + 2 Φ₁₁.

    One wave of amplitude ε on one wall has A = 1 + 3ε² (1 - r) with the mean r of both kinds. A - 1 is then
    -3ε² - 2/5 (kε)² across the crests of long waves, and -3kε² across those of short ones.

    Parameters
    ----------
    walls : walls with rms heights much less than the mean gap and slopes much less than 1; the neglected terms are of
        third order in heights (fourth for a sinusoid), and grow with the slope.
    stokes : False for Reynolds' theory to the same order, as in :func:`rom.homogenization.exact.nearly_smooth`.
    """
    gap, (dx, dy) = walls.mean_gap, walls.spacing
    below, above = (np.fft.fft2(wall / gap, norm="forward") for wall in (-walls.lower, walls.upper))
    below[0, 0] = above[0, 0] = 0.0
    qx = np.fft.fftfreq(walls.lower.shape[0], dx)[:, None] * (2 * np.pi * gap)
    qy = np.fft.fftfreq(walls.lower.shape[1], dy)[None, :] * (2 * np.pi * gap)
    k = np.hypot(qx, qy)
    response = wall_response(k) if stokes else np.broadcast_to(THIN_RESPONSE[..., None, None], (2, 2, *k.shape))
    power = np.array([np.abs(below + above) ** 2, np.abs(below - above) ** 2]) / 2
    across, along = (response * power).sum(axis=1)
    k[0, 0] = 1.0
    normal = np.array([qx / k, qy / k], dtype=object)
    rotated = np.array([[((across - along) * p * q).sum() for q in normal] for p in normal], dtype=np.float64)
    phi = rotated + along.sum() * np.eye(2)
    lower, both = float((np.abs(below) ** 2).sum()), float(power.sum())
    flat = walls.slides
    return RoughGapFactors(
        mean_gap=1.0,
        pressure=(1 + 6 * both) * np.eye(2) - 6 * phi,
        shear=np.array([1 + lower, 0.0]) - 2 * phi[:, 0] if flat else np.full(2, np.nan),
        friction=float(1 + 2 * phi[0, 0]) if flat else np.nan,
    ).scaled(gap)
