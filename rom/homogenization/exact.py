"""Gaps whose flow factors are known without solving anything."""

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.homogenization.factors import FlowFactors
from roughfilm.rom.homogenization.gap_factors import flow_factors_at
from roughfilm.rom.homogenization.ridges import sinusoidal_ridges


def sinusoid(amplitude: float, *, mean_gap: float = 1.0, direction: float = 0.0) -> FlowFactors:
    """Factors of h = H (1 + a cos q·x), whatever the length of the waves: those of :func:`sinusoidal_ridges`.

    Across the ridges A/H³ = (1 - a²)^(5/2)/(1 + a²/2) and B/H = (1 - a²)/(1 + a²/2); along them 1 + 3a²/2 and 1.

    Parameters
    ----------
    amplitude : a over the mean gap, 0 <= a < 1.
    mean_gap : H, m.
    direction : of q, rad: 0 for ridges across the sliding direction, π/2 for ridges along it.

    Examples
    --------
    >>> sinusoid(0.5).pressure.diagonal().round(6).tolist()
    [0.433013, 1.375]
    """
    return flow_factors_at(mean_gap, sinusoidal_ridges(amplitude * mean_gap, direction))


def nearly_smooth(gap: Array, spacing: tuple[float, float]) -> FlowFactors:
    """Factors of a gap of any shape to second order in s = σ/H, its rms over its mean.

    With n the direction of each of its waves, and <> the mean over waves weighted by their share of σ²:
    A = H³(1 + 3s² - 9s² <nn>), B = H(e₁ - 3s² <n₁n>), d = (1 + s²)/H, e = s² <n₁²>/H. (A₁₁/H³ - 1)/s² is -6 for ridges
    across the flow, 3 for ridges along it, and -3/2 for roughness without a lay.

    Parameters
    ----------
    gap : one period, shape (nx, ny), m, with an rms far below its mean; the error is of third order in s.
    spacing : (dx, dy), m.

    Source: Elrod, J. Lubr. Technol. 101 (1979) 8; Tripp, J. Lubr. Technol. 105 (1983) 458,
    doi:10.1115/1.3254641.
    """
    mean = float(gap.mean())
    power = np.abs(np.fft.fft2(gap / mean - 1, norm="forward")) ** 2
    qx = np.fft.fftfreq(gap.shape[0], spacing[0])[:, None]
    qy = np.fft.fftfreq(gap.shape[1], spacing[1])[None, :]
    power[0, 0] = 0.0
    length = qx * qx + qy * qy
    length[0, 0] = 1.0
    share = power / length
    waves = np.array([[(share * q * p).sum() for q in (qx, qy)] for p in (qx, qy)])
    squared = float(power.sum())
    return FlowFactors(
        mean_gap=1.0,
        pressure=(1 + 3 * squared) * np.eye(2) - 9 * waves,
        shear=np.array([1.0, 0.0]) - 3 * waves[:, 0],
        couette=1 + squared,
        shear_couette=float(waves[0, 0]),
    ).scaled(mean)


def self_dual(gap: Array) -> float:
    """A = exp <ln h³>, m³, in every direction, of a self-dual gap, exact for any contrast.

    A gap is self-dual if 1/h, scaled to the same mean of ln h, is h shifted, rotated or mirrored, and if the gap is
    symmetric under rotation by 90°, for example h = exp(a cos qx cos qy).

    Parameters
    ----------
    gap : h > 0, m, at the nodes of one period; the symmetry is not checked.

    Sources: Keller, J. Math. Phys. 5 (1964) 548, doi:10.1063/1.1704146; Dykhne, Sov. Phys. JETP 32 (1971) 63.
    """
    return float(np.exp(3 * np.log(gap).mean()))
