"""Stokes flow over waves on the walls of a gap, to second order in their height: what their length does."""

import numpy as np
from numpy.typing import ArrayLike

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.rough_gap.flow.factors import RoughGapFactors
from roughfilm.rom.rough_gap.walls import Walls

THIN = np.array([[3.0, 1.0], [0.0, 1.0]])
"""The responses at k = 0: Reynolds' theory."""

SLOPE = np.array([[1 / 10, 1 / 6], [1 / 4, 1 / 12]])
"""What the next order adds to them, over k²."""

SMALL, LARGE = 1.0, 300.0
"""Wave numbers: below, differences of exponentials are summed as series; above, 1/sinh k counts as nothing."""

TERMS = 9
"""Of a series: what is left out at k = 1 is below rounding."""


def wall_response(wave_number: ArrayLike) -> Array:
    """How strongly a gap of 1 withstands slip on its walls that varies as e^{ikx}: half the shear stress per slip.

    Shape (2, 2, ...): flow across the crests and along them; walls that move apart and together, so that the gap
    swells, and walls that move up and down together, so that it winds. A wave on one wall is half of each. With a
    biharmonic stream function across the crests and a harmonic velocity along them,

        across: k (cosh k - 1)/(sinh k - k) and k (cosh k + 1)/(sinh k + k);
        along:  (k/2) tanh(k/2) and (k/2) coth(k/2).

    As k → 0: 3 + k²/10, 1 + k²/6, k²/4, 1 + k²/12, of which Reynolds' theory has the first terms, and the order that
    :mod:`roughfilm.rom.rough_gap.flow.slope` adds the second. As k → ∞: k, k, k/2, k/2.

    Parameters
    ----------
    wave_number : k >= 0 over the gap, of any shape.
    """
    k = np.asarray(wave_number, dtype=np.float64)
    constant = (2, 2) + (1,) * k.ndim
    return np.asarray(THIN.reshape(constant) + SLOPE.reshape(constant) * k**2 * attenuation(k))


def attenuation(wave_number: ArrayLike) -> Array:
    """What slope truly adds to :func:`wall_response`, over what the next order would: from 1 at k = 0 down to 0.

    Shapes as there. As k → ∞: 10/k, 6/k, 2/k, 6/k.
    """
    k = np.asarray(wave_number, dtype=np.float64)
    x = np.maximum(k, SMALL)
    inverse = np.where(x < LARGE, 1 / np.sinh(np.minimum(x, LARGE)), 0.0)
    coth, half = 1 / np.tanh(x), x / 2 / np.tanh(x / 2)
    far = [
        10 * (x * coth + 2 * x * inverse - 3) / (x**2 * (1 - x * inverse)),
        6 * (x * coth - 1) / (x**2 * (1 + x * inverse)),
        1 / half,
        12 * (half - 1) / x**2,
    ]
    y = np.minimum(k, SMALL) ** 2
    near = [
        10 * _sum(y, 5, rising=True) / _sum(y, 3),
        6 * _sum(y, 3, rising=True) / (1 + _sum(y, 1)),
        _sum(y / 4, 1) / _sum(y / 4, 0),
        3 * _sum(y / 4, 3, rising=True) / _sum(y / 4, 1),
    ]
    return np.where(k < SMALL, near, far).reshape(2, 2, *k.shape)


def _sum(y: Array, start: int, *, rising: bool = False) -> Array:
    """Σ yⁿ/(2n + start)!, each times 2n + 2 if ``rising``."""
    total, factorial = np.zeros_like(y), 1.0
    for i in range(2, start + 1):
        factorial *= i
    for n in range(TERMS):
        total += y**n * (2 * n + 2 if rising else 1) / factorial
        factorial *= (2 * n + start + 1) * (2 * n + start + 2)
    return total


def nearly_smooth_flow(walls: Walls, *, stokes: bool = True) -> RoughGapFactors:
    """Factors of a gap in Stokes flow to second order in roughness over gap, whatever the wavelengths.

    With d and e the outward waves of the lower and the upper wall, over h̄, n the direction of each wave, r its
    :func:`wall_response` and Φ = Σ ½(r_swelling |d + e|² + r_winding |d - e|²) summed over waves, of tensors
    r = r_across nn + r_along (I - nn):

        A/h̄³ = (1 + 6<d² + e²>) I - 6 Φ,    B/h̄ = (1 + <d²>) e₁ - 2 Φ e₁,    f h̄ = 1 + 2 Φ₁₁.

    One wave of amplitude ε on one wall has A = 1 + 3ε² (1 - r), r the mean of both: -3ε² - 2/5 (kε)² across the
    crests of long waves, -3kε² across those of short ones.

    Parameters
    ----------
    walls : whose rms heights are far below the mean gap, and whose slopes far below 1; what is left out is of third
        order in heights (fourth for a sinusoid), and grows with the slope.
    stokes : False for Reynolds' theory to the same order, which then is :func:`rom.homogenization.exact.nearly_smooth`.
    """
    gap, (dx, dy) = walls.mean_gap, walls.spacing
    below, above = (np.fft.fft2(wall / gap, norm="forward") for wall in (-walls.lower, walls.upper))
    below[0, 0] = above[0, 0] = 0.0
    qx = np.fft.fftfreq(walls.lower.shape[0], dx)[:, None] * (2 * np.pi * gap)
    qy = np.fft.fftfreq(walls.lower.shape[1], dy)[None, :] * (2 * np.pi * gap)
    k = np.hypot(qx, qy)
    response = wall_response(k) if stokes else np.broadcast_to(THIN[..., None, None], (2, 2, *k.shape))
    power = np.array([np.abs(below + above) ** 2, np.abs(below - above) ** 2]) / 2
    across, along = (response * power).sum(axis=1)
    k[0, 0] = 1.0
    normal = np.array([qx / k, qy / k], dtype=object)
    turned = np.array([[((across - along) * p * q).sum() for q in normal] for p in normal], dtype=np.float64)
    phi = turned + along.sum() * np.eye(2)
    lower, both = float((np.abs(below) ** 2).sum()), float(power.sum())
    flat = walls.slides
    return RoughGapFactors(
        mean_gap=1.0,
        pressure=(1 + 6 * both) * np.eye(2) - 6 * phi,
        shear=np.array([1 + lower, 0.0]) - 2 * phi[:, 0] if flat else np.full(2, np.nan),
        friction=float(1 + 2 * phi[0, 0]) if flat else np.nan,
    ).scaled(gap)
